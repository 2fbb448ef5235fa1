//! Text files in memory, and the places in them.

use std::io::Read;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Severity};
use crate::files::{self, NoFile};

/// A file's text, or a change of one value, that messages can point into.
#[derive(Debug)]
pub struct Text {
    /// The file as it was named, or `-D`.
    pub file: PathBuf,
    pub text: String,
    /// Of a change that a file asks for: where that is.
    home: Option<Home>,
}

/// Where the text of a change is written: its path up to `split` bytes, its value behind.
#[derive(Debug)]
struct Home {
    split: usize,
    path: Diagnostic,
    value: Diagnostic,
}

impl Text {
    /// A text that messages point into itself.
    pub fn new(file: &Path, text: String) -> Self {
        Self { file: file.to_path_buf(), text, home: None }
    }

    /// `path=value`, of which messages point to where path and value are written: at places, whose own messages come before.
    pub fn change(path: &str, value: &str, place_of_path: &Diagnostic, place_of_value: &Diagnostic) -> Self {
        let home = Home { split: path.len(), path: place_of_path.clone(), value: place_of_value.clone() };
        let file = place_of_path.file.clone();
        Self { file, text: format!("{path}={value}"), home: Some(home) }
    }

    /// Reads a UTF-8 file of at most `limit` bytes, without its byte order mark.
    pub fn read(file: &Path, limit: u64) -> Result<Self, Diagnostic> {
        let mut bytes = Vec::new();
        let handle = open(file, limit)?;
        handle.take(limit + 1).read_to_end(&mut bytes).map_err(|error| cannot_read(file, &error))?;
        if bytes.len() as u64 > limit {
            return Err(too_large(file, bytes.len() as u64, limit));
        }
        Self::from_bytes(file, bytes)
    }

    /// Takes a file's bytes, which must be UTF-8.
    pub fn from_bytes(file: &Path, bytes: Vec<u8>) -> Result<Self, Diagnostic> {
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = error.utf8_error().valid_up_to();
            not_utf8(file, error.as_bytes(), valid)
        })?;
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        Ok(Self::new(file, text))
    }

    /// An error about `part`, a slice of this text.
    pub fn error(&self, part: &str, message: impl Into<String>) -> Diagnostic {
        self.at(Severity::Error, part, message)
    }

    /// A message about `part`, a slice of this text.
    pub fn at(&self, severity: Severity, part: &str, message: impl Into<String>) -> Diagnostic {
        let offset = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        if let Some(home) = &self.home {
            return home.error(severity, &message.into(), &self.text, offset);
        }
        let before = &self.text[..self.text.floor_char_boundary(offset)];
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = before.matches('\n').count() as u32 + 1;
        let text = self.text[start..].lines().next().unwrap_or_default();
        Diagnostic::at(severity, &self.file, line, text, offset - start, message)
    }

    /// An error at a line and column, both from 1, columns in characters.
    pub fn error_at(&self, line: usize, column: usize, message: impl Into<String>) -> Diagnostic {
        let text = self.text.split('\n').nth(line.saturating_sub(1)).unwrap_or_default();
        if let Some(home) = &self.home {
            let start = text.as_ptr() as usize - self.text.as_ptr() as usize;
            let offset = text.char_indices().nth(column.saturating_sub(1)).map_or(text.len(), |(at, _)| at);
            return home.error(Severity::Error, &message.into(), &self.text, start + offset);
        }
        let text = text.strip_suffix('\r').unwrap_or(text);
        let offset = text.char_indices().nth(column.saturating_sub(1)).map_or(text.len(), |(at, _)| at);
        Diagnostic::at(Severity::Error, &self.file, line as u32, text, offset, message)
    }
}

impl Home {
    /// A message about byte `offset` of a change's `text`.
    fn error(&self, severity: Severity, message: &str, text: &str, offset: usize) -> Diagnostic {
        let place = self.place(text, offset);
        let message =
            if place.message.is_empty() { message.to_owned() } else { format!("{}: {message}", place.message) };
        Diagnostic { severity, message, ..place }
    }

    /// Where byte `offset` of a change's `text` is written: the character itself, if the file has the line as it is here; else
    /// where the path or the value begins.
    fn place(&self, text: &str, offset: usize) -> Diagnostic {
        let (place, start) = match offset < self.split {
            true => (&self.path, 0),
            false => (&self.value, self.split + 1),
        };
        let end = if offset < self.split { self.split } else { text.len() };
        let part = &text[start.min(end)..end];
        let first = part.lines().next().unwrap_or_default();
        let before = part.get(..offset.saturating_sub(start)).filter(|before| before.len() <= first.len());
        let written: String =
            place.source_line.chars().skip(place.column.saturating_sub(1 + place.source_skipped) as usize).collect();
        match before {
            Some(before) if written.starts_with(first) => {
                let column = place.column.saturating_add(before.chars().count() as u32);
                Diagnostic { column, ..place.clone() }
            }
            _ => place.clone(),
        }
    }
}

/// Opens a regular file of at most `limit` bytes for reading.
pub fn open(file: &Path, limit: u64) -> Result<std::fs::File, Diagnostic> {
    let handle = files::open_regular(file).map_err(|error| cannot_read(file, &error))?;
    let length = handle.metadata().map_err(|error| cannot_read(file, &error))?.len();
    if length > limit {
        return Err(too_large(file, length, limit));
    }
    Ok(handle)
}

/// Why a file can't be read, and what to do.
pub fn cannot_read(file: &Path, error: &std::io::Error) -> Diagnostic {
    if let Some(why) = NoFile::of(error) {
        return Diagnostic::file(Severity::Error, file, why.to_string()).help(why.help());
    }
    let (message, help) = match error.kind() {
        std::io::ErrorKind::NotFound => {
            ("there is no such file".to_owned(), "check the path; it is relative to the file that names it")
        }
        std::io::ErrorKind::PermissionDenied => {
            ("no permission to read this file".to_owned(), "change its permissions")
        }
        _ => (format!("cannot be read: {error}"), "check the path and the disk"),
    };
    Diagnostic::file(Severity::Error, file, message).help(help)
}

/// Says that a file which another one names is not there; or that it is no file, and why.
pub fn missing(what: &str, file: &Path) -> String {
    match files::regular(file) {
        Err(error) if NoFile::of(&error).is_some() => format!("can't read the {what} `{}`: {error}", file.display()),
        _ => format!("there is no {what} `{}`", file.display()),
    }
}

/// A file beyond its size limit.
fn too_large(file: &Path, bytes: u64, limit: u64) -> Diagnostic {
    let message = format!("too large: {bytes} bytes, where at most {limit} are read");
    Diagnostic::file(Severity::Error, file, message).help("split it into several files")
}

/// Bytes as text, of which names may be in any encoding: what is UTF-8 is taken so, any other byte as the letter it is in
/// Latin-1, or in a private area where it is none. Other bytes give another text, and a byte is one character.
pub fn lenient(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().map(|byte| match byte {
            0xa1.. => char::from(*byte),
            _ => char::from_u32(0xf700 + u32::from(*byte)).unwrap_or(char::REPLACEMENT_CHARACTER),
        }));
    }
    text
}

/// A number as programs write it, also what Microsoft's C library makes of NaN and infinity: `-nan(ind)`, `1.#QNAN`, `-1.#IND00`.
pub fn number(word: &str) -> Option<f64> {
    if let Ok(value) = word.parse() {
        return Some(value);
    }
    let sign = if word.starts_with('-') { -1.0 } else { 1.0 };
    let bare = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if bare.starts_with("nan(") && bare.ends_with(')') {
        return Some(f64::NAN);
    }
    let (digits, rest) = bare.split_once(".#")?;
    let odd = digits.bytes().all(|byte| byte.is_ascii_digit()) && rest.starts_with(|c: char| c.is_ascii_alphabetic());
    // Cut to few places, infinity is `1.#J`.
    odd.then_some(if rest.starts_with("inf") || rest.starts_with('j') { sign * f64::INFINITY } else { f64::NAN })
}

/// The error for bytes that are no UTF-8, which `valid` bytes of are.
pub fn not_utf8(file: &Path, bytes: &[u8], valid: usize) -> Diagnostic {
    let before = &bytes[..valid];
    let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let line = before.iter().filter(|byte| **byte == b'\n').count() as u32 + 1;
    let end = bytes[valid..].iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |at| valid + at);
    let text = String::from_utf8_lossy(&bytes[start..end.min(start + 4096)]).into_owned();
    let (message, help) = if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        ("this is UTF-16 text".to_owned(), "save it as UTF-8")
    } else {
        (format!("byte {:#04x} is not UTF-8 text", bytes[valid]), "is this a binary file? Save text as UTF-8")
    };
    Diagnostic::at(Severity::Error, file, line, &text, valid - start, message).help(help)
}
