//! Materials of MTL files. Every line that is not honoured is a warning at its place.
//!
//! | statement | becomes |
//! |---|---|
//! | `Kd`, `Ks` | diffuse and Phong reflectance; one value is grey, and the `energy` policy of the scene bounds their sum |
//! | `Ns` | exponent of the Phong lobe, at most 1e5 |
//! | `Ke`, `Le` | emission; `Le` is what the Cornell box family of files writes in materials named `*_light` |
//! | `d` | opacity; `Tr` counts as 1 - d, and only without `d`: exporters write it both ways round |
//! | `Ni`, `Tf`, `illum` | kept; `Ni` alone makes no glass |
//! | `map_Kd`, `map_Ks`, `map_Ns`, `map_Ke`, `map_d`, `map_Bump`/`bump` | paths, kept |
//! | `Pr`, `Pm` and other extensions | not honoured |
//!
//! tobj's own reader panics on `Kd 1` and drops a whole file for one bad line, so this one takes its place.

mod draft;
mod maps;
mod values;

use std::io::BufReader;
use std::path::Path;

use super::diagnostic::{Diagnostics, Severity, Tally};
use super::lines::{Line, Lines};
use super::text;
use crate::components::Material;
use draft::Draft;

/// Bytes that an MTL file may have.
const LIMIT: u64 = 64 << 20;

/// Materials of one file, in its order, names unique. `None` where the file can't be read; its messages say why.
pub fn read_mtl(file: &Path, diagnostics: &mut Diagnostics) -> Option<Vec<(String, Material)>> {
    let mut tally = Tally::new(file);
    let materials = match text::open(file, LIMIT) {
        Ok(handle) => read_lines(file, Lines::new(BufReader::new(handle), file), &mut tally),
        Err(error) => {
            tally.diagnostics.push(error);
            None
        }
    };
    diagnostics.list.extend(tally.finish());
    materials
}

/// Reads statement by statement; each `newmtl` finishes the material before it.
fn read_lines(
    file: &Path,
    mut lines: Lines<impl std::io::BufRead>,
    tally: &mut Tally,
) -> Option<Vec<(String, Material)>> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut line = Line::default();
    let mut list: Vec<(String, Material)> = Vec::new();
    let mut draft: Option<Draft> = None;
    loop {
        match lines.next(&mut line) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                tally.diagnostics.push(error);
                return None;
            }
        }
        let Some((key, rest)) = line.statement() else { continue };
        if key.eq_ignore_ascii_case("newmtl") {
            finish(draft.take(), &mut list, tally);
            draft = start(&line, key, rest, &list, tally);
        } else if let Some(draft) = &mut draft {
            draft.read(&line, key, rest, folder, tally);
        } else {
            tally.push("statements before newmtl", || {
                line.warning(key, format!("`{key}` stands before any `newmtl` and is left out"))
            });
        }
    }
    finish(draft, &mut list, tally);
    if list.is_empty() {
        let message = "there is no material in this file";
        let warning = super::Diagnostic::file(Severity::Warning, file, message);
        tally.diagnostics.push(warning.help("a material begins with `newmtl NAME`"));
    }
    Some(list)
}

/// Begins a material.
fn start(line: &Line, key: &str, name: &str, list: &[(String, Material)], tally: &mut Tally) -> Option<Draft> {
    if name.is_empty() {
        tally.push("newmtl without a name", || line.warning(key, "`newmtl` without a name: its lines are left out"));
        return None;
    }
    if list.iter().any(|(other, _)| other == name) {
        tally.push("materials given twice", || {
            line.warning(name, format!("`{name}` is given a second time, and this one counts"))
        });
    }
    Some(Draft::new(name, line, key))
}

/// Adds a finished material, in the place of one of the same name.
fn finish(draft: Option<Draft>, list: &mut Vec<(String, Material)>, tally: &mut Tally) {
    let Some((name, material)) = draft.map(|draft| draft.finish(tally)) else { return };
    match list.iter_mut().find(|(other, _)| *other == name) {
        Some((_, old)) => *old = material,
        None => list.push((name, material)),
    }
}
