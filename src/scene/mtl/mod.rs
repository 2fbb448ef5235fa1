//! Materials of MTL files. Every line that is not honoured is a warning at its place.
//!
//! Statements that are keys are read by their table ([`keys`](super::keys)). Beside them:
//!
//! | statement | becomes |
//! |---|---|
//! | `Le` | `Ke`: what the Cornell box family of files writes in materials named `*_light` |
//! | `Tr` | counts as 1 - `d`, and only without `d`: exporters write it both ways round |
//! | `map_Kd`, `map_Ks`, `map_Ns`, `map_Ke`, `map_d`, `map_Bump`/`bump` | paths, kept |
//!
//! What one exporter writes on all its materials is judged once the whole library is read: [`exporter`].
//!
//! tobj's own reader panics on `Kd 1` and drops a whole file for one bad line, so this one takes its place.

mod appearance;
mod draft;
mod exporter;
mod maps;
mod material;
mod texture_map;
mod values;

use std::collections::HashMap;
use std::io::BufReader;
use std::path::Path;

use super::diagnostic::{Diagnostic, Diagnostics, Severity, Tally};
use super::lines::{Line, Lines, unquoted};
use super::text;
use draft::{Draft, Habits};

pub use appearance::Appearance;
pub use material::MtlMaterial;
pub use texture_map::{TextureMap, TextureMaps};

/// Bytes that an MTL file may have.
const LIMIT: u64 = 64 << 20;

/// Materials of one file, in its order, names unique. `None` where the file can't be read; its messages say why.
pub fn read_mtl(file: &Path, diagnostics: &mut Diagnostics) -> Option<Vec<(String, MtlMaterial)>> {
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

/// Reads statement by statement, then judges what was read.
fn read_lines(
    file: &Path,
    mut lines: Lines<impl std::io::BufRead>,
    tally: &mut Tally,
) -> Option<Vec<(String, MtlMaterial)>> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut line = Line::default();
    let mut drafts = Drafts::default();
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
            drafts.start(&line, key, unquoted(rest), tally);
        } else if let Some(draft) = drafts.current() {
            draft.read(&line, key, rest, folder, tally);
        } else {
            tally.push("statements before newmtl", || {
                line.warning(key, format!("`{key}` stands before any `newmtl` and is left out"))
            });
        }
    }
    if let Some(zeros) = lines.zeros() {
        let message = "zero bytes fill the end of this file: they are left out".to_owned();
        tally.diagnostics.push(Diagnostic { severity: Severity::Warning, message, ..zeros });
    }
    if drafts.list.is_empty() {
        let message = "there is no material in this file";
        let warning = Diagnostic::file(Severity::Warning, file, message);
        tally.diagnostics.push(warning.help("a material begins with `newmtl NAME`"));
    }
    Some(judge(&drafts.list, tally))
}

/// What the drafts of a whole library come to.
fn judge(drafts: &[Draft], tally: &mut Tally) -> Vec<(String, MtlMaterial)> {
    let habits = Habits::of(drafts);
    let materials: Vec<MtlMaterial> = drafts.iter().map(|draft| draft.material(habits)).collect();
    for (draft, material) in drafts.iter().zip(&materials) {
        draft.warn_of(material, habits, tally);
    }
    habits.warn(drafts, &materials, tally);
    drafts.iter().map(|draft| draft.name().to_owned()).zip(materials).collect()
}

/// The materials of a file while it is read: in its order, names unique.
#[derive(Default)]
struct Drafts {
    list: Vec<Draft>,
    numbers: HashMap<String, usize>,
    current: Option<usize>,
}

impl Drafts {
    /// The material that statements belong to.
    fn current(&mut self) -> Option<&mut Draft> {
        self.current.map(|number| &mut self.list[number])
    }

    /// Begins a material, in the place of one of the same name.
    fn start(&mut self, line: &Line, key: &str, name: &str, tally: &mut Tally) {
        if name.is_empty() {
            self.current = None;
            tally
                .push("newmtl without a name", || line.warning(key, "`newmtl` without a name: its lines are left out"));
            return;
        }
        let draft = Draft::new(name, line, key);
        let number = *self.numbers.entry(name.to_owned()).or_insert(self.list.len());
        self.current = Some(number);
        if number == self.list.len() {
            return self.list.push(draft);
        }
        tally.push("materials given twice", || {
            line.warning(name, format!("`{name}` is given a second time, and this one counts"))
        });
        self.list[number] = draft;
    }
}
