//! Paths of `map_*` statements, and the options before them.

use std::path::{Path, PathBuf};

use crate::scene::diagnostic::Tally;
use crate::scene::lines::Line;

/// Words that follow an option, at least and at most.
fn arguments(option: &str) -> Option<(usize, usize)> {
    Some(match option {
        "-blendu" | "-blendv" | "-bm" | "-boost" | "-cc" | "-clamp" | "-imfchan" | "-texres" | "-type" => (1, 1),
        "-mm" => (2, 2),
        "-o" | "-s" | "-t" => (1, 3),
        _ => return None,
    })
}

/// The image file a map names, resolved against the MTL file's folder. Options are warned of, since none is honoured yet.
pub fn path(line: &Line, key: &str, rest: &str, folder: &Path, tally: &mut Tally) -> Option<PathBuf> {
    let mut rest = rest.trim();
    while let Some((option, (least, most))) = first_word(rest).and_then(|word| Some((word, arguments(word)?))) {
        tally.push("map options", || {
            line.warning(option, format!("the option `{option}` of `{key}` is not honoured yet"))
        });
        rest = rest[option.len()..].trim_start();
        for taken in 0..most {
            let Some(word) = first_word(rest) else { break };
            let last = word.len() == rest.len();
            if taken >= least && (last || word.parse::<f64>().is_err()) {
                break;
            }
            rest = rest[word.len()..].trim_start();
        }
    }
    let name = rest.trim_matches('"').trim();
    if name.is_empty() {
        tally.push("maps without a file", || line.warning(key, format!("`{key}` names no file: it is left out")));
        return None;
    }
    if name.starts_with('-') {
        tally.push("map options", || {
            line.warning(name, format!("unknown option in `{name}`: this `{key}` is left out"))
        });
        return None;
    }
    let path = folder.join(name.replace('\\', "/"));
    if !path.is_file() {
        tally.push("missing images", || {
            line.warning(name, format!("there is no image `{}`", path.display()))
                .help("the path is relative to the folder of the MTL file")
        });
    }
    Some(path)
}

fn first_word(rest: &str) -> Option<&str> {
    rest.split_whitespace().next()
}
