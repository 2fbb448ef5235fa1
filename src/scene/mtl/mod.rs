//! Materials of MTL files. Every line that is not honoured is a warning at its place.
//!
//! Statements that are keys are read by their table ([`keys`](super::keys)). Beside them:
//!
//! | statement | becomes |
//! |---|---|
//! | `Le` | `Ke`: what the Cornell box family of files writes in materials named `*_light` |
//! | `Tr` | counts as 1 - `d`, and only without `d`: exporters write it both ways round |
//! | `disp`, `map_Disp` | `map_Bump`, and only without one |
//!
//! What one exporter writes on all its materials is judged once the whole library is read: [`exporter`].
//!
//! tobj's own reader panics on `Kd 1` and drops a whole file for one bad line, so this one takes its place.

mod alone;
mod appearance;
mod draft;
mod exporter;
mod fate;
mod ledger;
mod maps;
mod material;
mod options;
mod texture_map;
mod values;

use std::collections::{BTreeMap, HashMap};
use std::io::BufReader;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Diagnostics, Severity, Tally};
use super::lines::{Line, Lines, unquoted};
use super::text;
use draft::{Draft, Habits};
use ledger::Ledger;
use maps::MapFiles;

pub use appearance::Appearance;
pub use fate::{Fate, Verdict};
pub use ledger::{Account, Edited};
pub use material::MtlMaterial;
pub use texture_map::{TextureMap, TextureMaps};

/// Bytes that an MTL file may have.
const LIMIT: u64 = 64 << 20;

/// What is in an MTL file.
#[derive(Debug, Default)]
pub struct Library {
    /// In the file's order, names unique.
    pub materials: Vec<(String, MtlMaterial)>,
    /// By the files that maps name: the first statement that does, as a warning without its message.
    pub map_places: BTreeMap<PathBuf, Diagnostic>,
}

/// Reads a file. `None` where the file can't be read; its messages say why.
pub fn read_mtl(file: &Path, diagnostics: &mut Diagnostics) -> Option<Library> {
    let mut tally = Tally::new(file);
    let read = read_file(file, &mut tally, &mut Ledger::default());
    let library = read.map(|(drafts, map_places)| {
        let (materials, _) = judge(&drafts, &mut tally);
        let names = drafts.iter().map(|draft| draft.name().to_owned());
        Library { materials: names.zip(materials).collect(), map_places }
    });
    diagnostics.list.extend(tally.finish());
    library
}

/// The statements of each material of a file, and how they are read. Its messages are those of [`read_mtl`].
pub fn read_accounts(file: &Path, diagnostics: &mut Diagnostics) -> BTreeMap<String, Account> {
    let mut tally = Tally::listening(file);
    let mut ledger = Ledger::new();
    let read = read_file(file, &mut tally, &mut ledger);
    let accounts = read.map(|(drafts, _)| {
        let (materials, habits) = judge(&drafts, &mut tally);
        let account = |(draft, material): (&Draft, MtlMaterial)| {
            (draft.name().to_owned(), ledger.account(draft, material, habits))
        };
        drafts.iter().zip(materials).map(account).collect()
    });
    if ledger.left_out() > 0 {
        let message = format!("the last {} statements of this library are not told one by one", ledger.left_out());
        tally.diagnostics.push(Diagnostic::file(Severity::Warning, file, message));
    }
    diagnostics.list.extend(tally.finish());
    accounts.unwrap_or_default()
}

/// What a file's statements say, material by material; and the files that maps name.
type Read = (Vec<Draft>, BTreeMap<PathBuf, Diagnostic>);

fn read_file(file: &Path, tally: &mut Tally, ledger: &mut Ledger) -> Option<Read> {
    match text::open(file, LIMIT) {
        Ok(handle) => read_lines(file, Lines::new(BufReader::new(handle), file), tally, ledger),
        Err(error) => {
            tally.diagnostics.push(error);
            None
        }
    }
}

/// Reads statement by statement.
fn read_lines(
    file: &Path,
    mut lines: Lines<impl std::io::BufRead>,
    tally: &mut Tally,
    ledger: &mut Ledger,
) -> Option<Read> {
    let mut files = MapFiles::new(file.parent().unwrap_or(Path::new("")));
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
            ledger.start(unquoted(rest));
        } else if let Some(draft) = drafts.current() {
            let taken = draft.read(&line, key, rest, &mut files, tally);
            ledger.note(&line, key, rest, taken, tally);
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
    Some((drafts.list, files.places))
}

/// What the drafts of a whole library come to.
fn judge(drafts: &[Draft], tally: &mut Tally) -> (Vec<MtlMaterial>, Habits) {
    let habits = Habits::of(drafts);
    let materials: Vec<MtlMaterial> = drafts.iter().map(|draft| draft.material(habits)).collect();
    for (draft, material) in drafts.iter().zip(&materials) {
        draft.warn_of(material, habits, tally);
    }
    habits.warn(drafts, &materials, tally);
    (materials, habits)
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
