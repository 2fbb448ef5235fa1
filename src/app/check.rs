//! `lucerna check`: assets and shaders, nothing rendered.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::arguments::CheckArguments;
use super::failure::show;
use super::{Exit, Failure, output};
use crate::passes::Pass;
use crate::passes::table::TABLE;
use crate::scene;
use crate::shader::{Features, Library};

/// Checks what was named; without names, the folder of assets and every shader.
pub fn run(arguments: &CheckArguments) -> Result<Exit, Failure> {
    let mut errors = 0;
    let mut warnings = 0;
    let mut files = 0;
    let paths = if arguments.paths.is_empty() { vec![assets()] } else { arguments.paths.clone() };
    for path in &paths {
        let checked = scene::check(path);
        files += checked.files.len();
        for diagnostic in &checked.diagnostics.list {
            match diagnostic.severity {
                scene::Severity::Error => errors += 1,
                scene::Severity::Warning => warnings += 1,
            }
            show(diagnostic);
        }
    }
    let mut text = format!("{files} {}", plural(files, "asset", "assets"));
    if arguments.paths.is_empty() {
        let (variants, wrong) = check_shaders();
        errors += wrong;
        text += &format!(", {} passes in {variants} variants", TABLE.len());
    }
    text += &format!(
        ": {errors} {}, {warnings} {}\n",
        plural(errors, "error", "errors"),
        plural(warnings, "warning", "warnings")
    );
    output::print(&text)?;
    Ok(if errors == 0 { Exit::Done } else { Exit::Failed })
}

fn plural<'a>(n: usize, one: &'a str, many: &'a str) -> &'a str {
    if n == 1 { one } else { many }
}

/// The folder of assets: of the current folder, or of the source tree this was built from.
fn assets() -> PathBuf {
    let here = Path::new("assets");
    if here.is_dir() { here.to_path_buf() } else { Path::new(env!("CARGO_MANIFEST_DIR")).join("assets") }
}

/// Features of one pass up to which every set of them is tried; beyond it, each by itself, none, and all.
const MOST_SETS: usize = 6;

/// Links every pass under every set of features its modules name. How many were linked, and how many failed.
fn check_shaders() -> (usize, usize) {
    let library = Library::shipped();
    let known = known_features(&library);
    let (mut variants, mut wrong) = (0, 0);
    let mut told = BTreeSet::new();
    for pass in TABLE {
        for features in feature_sets(&library, pass, &known) {
            match library.link(pass.module, &features) {
                Ok(linked) if linked.entry(pass.entry).is_some() => variants += 1,
                Ok(_) => {
                    wrong += 1;
                    output::note(&format!("{}: error: there is no entry point `{}`", pass.module, pass.entry));
                    break;
                }
                Err(error) => {
                    wrong += 1;
                    // One mistake in a shared module would be told once a pass.
                    if told.insert(error.to_string()) {
                        show(&error);
                    }
                    break;
                }
            }
        }
    }
    (variants, wrong)
}

/// The names in all conditions of all modules.
fn known_features(library: &Library) -> Features {
    let mut found = Features::new();
    for text in library.modules().filter_map(|module| library.text(module)) {
        for condition in text.split("@if(").skip(1).chain(text.split("@elif(").skip(1)) {
            let inside = condition.split(')').next().unwrap_or("");
            let words = inside.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            found.extend(words.filter(|word| !word.is_empty()).map(str::to_owned));
        }
    }
    found
}

/// The sets of features that make a difference to a pass.
fn feature_sets(library: &Library, pass: &Pass, known: &Features) -> Vec<Features> {
    let named: Vec<String> = match library.link(pass.module, known) {
        Ok(linked) => linked.features.into_iter().collect(),
        Err(_) => return vec![Features::new(), known.clone()],
    };
    let pick = |set: usize| (0..named.len()).filter(|bit| set >> bit & 1 == 1).map(|bit| named[bit].clone()).collect();
    if named.len() <= MOST_SETS {
        return (0..1 << named.len()).map(pick).collect();
    }
    let singles = named.iter().map(|name| Features::from([name.clone()]));
    singles.chain([Features::new(), named.iter().cloned().collect()]).collect()
}
