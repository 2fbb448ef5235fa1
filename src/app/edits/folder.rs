//! The folder in which edits outlive the window: a file an edit, and each text of a shader once, by what it holds.
//!
//! Every file appears whole, so that a window that crashes leaves a record that can be read. Windows may share a folder: a number is taken
//! by who first writes the file of its name.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use super::edit::Edit;
use crate::files;
use crate::image::{SaveError, file};
use crate::shader::Library;

/// Where a window keeps its edits, below the folder that it was started in.
pub const PLACE: &str = "result/edits";

/// Edits that are kept; the oldest go first.
pub const MOST: usize = 200;

/// A text that no edit names is left for so long: another window may be about to name it.
const SPARED: Duration = Duration::from_secs(24 * 3600);

/// Bytes that one of these files may have.
const LIMIT: u64 = 16 << 20;

/// An edit as it is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// By which it is called.
    pub number: u32,
    /// Tells windows apart: when it opened, and its process.
    pub window: String,
    /// The number of the edit whose shaders ran before, which it is judged by.
    pub before: Option<u32>,
    /// Every module, and the name of its text; none where there is nothing to go back to.
    pub shaders: Option<BTreeMap<String, String>>,
    #[serde(flatten)]
    pub edit: Edit,
}

/// A folder of edits.
#[derive(Clone, Debug)]
pub struct EditsFolder(PathBuf);

/// The edits of a folder, oldest first, and what in it can't be read.
#[derive(Debug, Default)]
pub struct Listed {
    pub edits: Vec<Kept>,
    pub unread: Vec<String>,
}

impl EditsFolder {
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self(folder.into())
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Writes the texts of a library that are not there yet. Returns their names by module.
    pub fn keep_texts(&self, library: &Library) -> Result<BTreeMap<String, String>, SaveError> {
        let mut named = BTreeMap::new();
        for module in library.modules() {
            // What can't be read was no part of what ran.
            let Some(text) = library.text(module) else { continue };
            let name = text_name(text);
            let path = self.text_path(&name);
            if !path.is_file() {
                file::write_text(&path, text)?;
            }
            named.insert(module.to_owned(), name);
        }
        Ok(named)
    }

    /// Writes an edit under the first number behind all others, which it gets. What is too much goes.
    pub fn add(&self, kept: &mut Kept) -> Result<(), SaveError> {
        let last = self.numbers().map_err(|source| self.failed(source))?.last().copied().unwrap_or(0);
        let mut number = last;
        loop {
            number = number.checked_add(1).ok_or_else(|| self.failed(io::Error::other("there are no more numbers")))?;
            kept.number = number;
            let text = as_text(kept);
            if file::write_new(&self.edit_path(number), |out| out.write_all(text.as_bytes()))? {
                break;
            }
        }
        // It is kept; what could not be removed is tried with the next.
        let _ = self.prune();
        Ok(())
    }

    /// Writes anew what is known of an edit.
    pub fn update(&self, kept: &Kept) -> Result<(), SaveError> {
        file::write_text(&self.edit_path(kept.number), &as_text(kept))
    }

    /// All edits. A folder that is not there has none.
    pub fn list(&self) -> io::Result<Listed> {
        let mut listed = Listed::default();
        for number in self.numbers()? {
            let path = self.edit_path(number);
            let read = files::read(&path, LIMIT).and_then(|bytes| Ok(serde_json::from_slice::<Kept>(&bytes)?));
            match read {
                Ok(kept) => listed.edits.push(Kept { number, ..kept }),
                Err(error) => listed.unread.push(format!("{}: {error}", path.display())),
            }
        }
        Ok(listed)
    }

    /// A text by its name, as it was written.
    pub fn text(&self, name: &str) -> io::Result<String> {
        let path = self.text_path(name);
        let explained = |error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", path.display()));
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '-';
        if !name.chars().all(is_name) {
            return Err(io::Error::other(format!("`{name}` is no name of a text")));
        }
        let text = String::from_utf8(files::read(&path, LIMIT).map_err(explained)?).map_err(io::Error::other)?;
        match text_name(&text) == name {
            true => Ok(text),
            false => Err(io::Error::other(format!("{}: is not what was written", path.display()))),
        }
    }

    /// The numbers that are taken, in order.
    fn numbers(&self) -> io::Result<Vec<u32>> {
        let entries = match std::fs::read_dir(&self.0) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries?,
        };
        // As this folder writes them: other names are other files.
        let number = |name: String| {
            let number = name.strip_suffix(".json")?.parse::<u32>().ok()?;
            (name == format!("{number}.json")).then_some(number)
        };
        let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
        let mut numbers: Vec<u32> = names.filter_map(number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }

    /// Removes the oldest edits beyond [`MOST`], and texts that no edit names.
    fn prune(&self) -> io::Result<()> {
        let numbers = self.numbers()?;
        let surplus = numbers.len().saturating_sub(MOST);
        if surplus == 0 {
            return Ok(());
        }
        for number in &numbers[..surplus] {
            std::fs::remove_file(self.edit_path(*number))?;
        }
        let listed = self.list()?;
        if !listed.unread.is_empty() {
            // What names which texts is not known.
            return Ok(());
        }
        let shaders = listed.edits.iter().filter_map(|kept| kept.shaders.as_ref());
        let named: BTreeSet<&str> = shaders.flat_map(|texts| texts.values().map(String::as_str)).collect();
        for entry in std::fs::read_dir(self.0.join(TEXTS))?.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_named = name.strip_suffix(".wgsl").is_some_and(|name| named.contains(name));
            let written = entry.metadata().and_then(|metadata| metadata.modified());
            let is_old = written.is_ok_and(|at| SystemTime::now().duration_since(at).is_ok_and(|age| age > SPARED));
            if !is_named && is_old {
                std::fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    fn edit_path(&self, number: u32) -> PathBuf {
        self.0.join(format!("{number}.json"))
    }

    fn text_path(&self, name: &str) -> PathBuf {
        self.0.join(TEXTS).join(format!("{name}.wgsl"))
    }

    fn failed(&self, source: io::Error) -> SaveError {
        SaveError::Write { path: self.0.clone(), source }
    }
}

/// The folder of texts below that of edits.
const TEXTS: &str = "texts";

fn as_text(kept: &Kept) -> String {
    serde_json::to_string_pretty(kept).expect("invariant: an edit is plain data") + "\n"
}

/// A text's name: its hash (FNV-1a, the same in every build) and its length, so that equal texts are kept once.
fn text_name(text: &str) -> String {
    let hash = text
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3));
    format!("{hash:016x}-{}", text.len())
}
