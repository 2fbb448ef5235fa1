//! Lines of OBJ and MTL files: read as a stream, continuations joined, each part with its place.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Severity};
use super::text::{cannot_read, lenient, not_utf8};

/// Bytes that a line may have, its continuations included: a file without line ends must not fill the memory.
pub const LINE_LIMIT: usize = 4 << 20;

/// What some editors put before UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What DOS ends a text with.
pub const CTRL_Z: u8 = 0x1a;

/// Statements of names, which may be in any encoding; so may be those of images, `map_*`.
const NAMING: &[&str] =
    &["usemtl", "newmtl", "mtllib", "o", "g", "maplib", "usemap", "bump", "disp", "decal", "refl", "norm"];

/// One logical line: its text, and where its physical lines begin.
#[derive(Debug, Default)]
pub struct Line {
    pub text: String,
    /// Byte in `text` and line number (from 1) of each physical line.
    starts: Vec<(usize, u32)>,
    file: PathBuf,
}

impl Line {
    /// How many physical lines it is.
    pub fn physical(&self) -> usize {
        self.starts.len()
    }

    /// A message about `part`, a slice of this line's text.
    pub fn at(&self, severity: Severity, part: &str, message: impl Into<String>) -> Diagnostic {
        let offset = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        let nth = self.starts.iter().rposition(|(start, _)| *start <= offset).unwrap_or(0);
        let (start, number) = self.starts.get(nth).copied().unwrap_or((0, 1));
        let end = self.starts.get(nth + 1).map_or(self.text.len(), |(next, _)| *next);
        Diagnostic::at(severity, &self.file, number, self.text[start..end].trim_end(), offset - start, message)
    }

    /// An error about `part`.
    pub fn error(&self, part: &str, message: impl Into<String>) -> Diagnostic {
        self.at(Severity::Error, part, message)
    }

    /// A warning about `part`.
    pub fn warning(&self, part: &str, message: impl Into<String>) -> Diagnostic {
        self.at(Severity::Warning, part, message)
    }

    /// The first word and the rest of the line, both trimmed; `None` for a blank line or a comment.
    pub fn statement(&self) -> Option<(&str, &str)> {
        let text = self.text.trim();
        if text.is_empty() || text.starts_with('#') {
            return None;
        }
        let end = text.find(char::is_whitespace).unwrap_or(text.len());
        Some((&text[..end], text[end..].trim_start()))
    }
}

/// A name as it stands behind its statement, without the quotes that some programs put around it.
pub fn unquoted(name: &str) -> &str {
    let name = name.trim();
    let inner = name.strip_prefix('"').and_then(|name| name.strip_suffix('"')).map(str::trim);
    inner.filter(|inner| !inner.is_empty() && !inner.contains('"')).unwrap_or(name)
}

/// The words of a statement of numbers, up to a comment.
pub fn words(rest: &str) -> impl Iterator<Item = &str> {
    rest.split_whitespace().take_while(|word| !word.starts_with('#'))
}

/// Reads logical lines. Lines end with `\n`, `\r\n` or `\r`; a byte order mark is left out, and so are Ctrl-Z and zero bytes at the
/// end of the file.
pub struct Lines<R> {
    reader: R,
    file: PathBuf,
    number: u32,
    bytes: Vec<u8>,
    /// The last line ended with `\r`: a `\n` right after it belongs to it.
    after_return: bool,
    /// The end of the file was met, in a line without an end.
    open_end: bool,
    /// An error about the first of the zero bytes that fill the end of the file.
    zeros: Option<Diagnostic>,
}

impl<R: BufRead> Lines<R> {
    /// `file` is the name in messages.
    pub fn new(reader: R, file: &Path) -> Self {
        Self {
            reader,
            file: file.to_path_buf(),
            number: 0,
            bytes: Vec::new(),
            after_return: false,
            open_end: false,
            zeros: None,
        }
    }

    /// Reads text from within a file: so many lines are before it.
    pub fn behind(reader: R, file: &Path, lines: u32) -> Self {
        Self { number: lines, ..Self::new(reader, file) }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// An error about the zero bytes that fill the end of the file, once it was read.
    pub fn zeros(&mut self) -> Option<Diagnostic> {
        self.zeros.take()
    }

    /// Reads the next logical line into `line`; false at the end. An error is final: what follows is no text.
    pub fn next(&mut self, line: &mut Line) -> Result<bool, Diagnostic> {
        line.text.clear();
        line.starts.clear();
        if line.file != self.file {
            line.file.clone_from(&self.file);
        }
        loop {
            self.bytes.clear();
            let more = self.read_bytes(line)?;
            if !more && self.bytes.is_empty() {
                return Ok(!line.starts.is_empty());
            }
            if self.number == 1 && self.bytes.starts_with(BYTE_ORDER_MARK) {
                self.bytes.drain(..BYTE_ORDER_MARK.len());
            }
            line.starts.push((line.text.len(), self.number));
            let comment = self.bytes.trim_ascii_start().starts_with(b"#");
            if !comment {
                self.cut_padding(line)?;
            }
            let foreign = self.append(line, comment)?;
            // A comment may well end with a folder's name, `# C:\models\`: it continues nothing.
            let Some(kept) = continued(&line.text).filter(|_| !comment) else { return Ok(true) };
            // In Shift-JIS and GBK a backslash may be the second half of a letter.
            if foreign && line.text[..kept].chars().next_back().is_some_and(|c| !c.is_ascii()) {
                return Ok(true);
            }
            line.text.truncate(kept);
            line.text.push(' ');
        }
    }

    /// Adds the bytes of one physical line as text. Whether they are no UTF-8, as names may be, and what follows a `#`.
    fn append(&mut self, line: &mut Line, comment: bool) -> Result<bool, Diagnostic> {
        let error = match std::str::from_utf8(&self.bytes) {
            Ok(text) => {
                line.text.push_str(text);
                return Ok(false);
            }
            Err(error) => error,
        };
        let start = if line.text.is_empty() { self.bytes.as_slice() } else { line.text.as_bytes() };
        if comment || self.bytes[..error.valid_up_to()].contains(&b'#') || is_naming(start) {
            line.text.push_str(&lenient(&self.bytes));
            return Ok(true);
        }
        let diagnostic = not_utf8(&self.file, &self.bytes, error.valid_up_to());
        Err(Diagnostic { line: self.number, ..diagnostic })
    }

    /// Takes Ctrl-Z or zero bytes off the line, if nothing but their like follows in the whole file; else they are an error.
    fn cut_padding(&mut self, line: &Line) -> Result<(), Diagnostic> {
        let Some(at) = self.bytes.iter().position(|byte| matches!(*byte, 0 | CTRL_Z)) else { return Ok(()) };
        let error = match std::str::from_utf8(&self.bytes) {
            Err(error) if !is_naming(&self.bytes) => {
                Diagnostic { line: self.number, ..not_utf8(&self.file, &self.bytes, error.valid_up_to()) }
            }
            _ => {
                let message = match self.bytes[at] {
                    0 => "a zero byte: this is no text file",
                    _ => "a byte 0x1a (Ctrl-Z), which ends a text, and more text after it",
                };
                let text = lenient(&self.bytes);
                Diagnostic::at(Severity::Error, &self.file, self.number, &text, at, message)
                    .help("is this a binary file, or UTF-16 text? Save text as UTF-8")
            }
        };
        let text = self.bytes[..at].to_vec();
        let mut rest = self.bytes.split_off(at);
        loop {
            if rest.iter().any(|byte| !matches!(*byte, 0 | CTRL_Z) && !byte.is_ascii_whitespace()) {
                return Err(error);
            }
            if self.zeros.is_none() && rest.contains(&0) {
                self.zeros = Some(error.clone());
            }
            self.bytes.clear();
            if !self.read_bytes(line)? && self.bytes.is_empty() {
                break;
            }
            rest.clone_from(&self.bytes);
        }
        self.bytes = text;
        Ok(())
    }

    /// Reads one physical line, without its end, into `bytes`; false at the end of the file.
    fn read_bytes(&mut self, line: &Line) -> Result<bool, Diagnostic> {
        self.number = self.number.saturating_add(1);
        loop {
            let available = match self.reader.fill_buf() {
                Ok(available) => available,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(cannot_read(&self.file, &error)),
            };
            if available.is_empty() {
                // After a last line without an end there is no further one, not even an empty one.
                self.number -= u32::from(self.bytes.is_empty() && self.open_end);
                self.open_end = true;
                return Ok(false);
            }
            if std::mem::take(&mut self.after_return) && available[0] == b'\n' {
                self.reader.consume(1);
                continue;
            }
            let end = available.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let taken = end.unwrap_or(available.len());
            if line.text.len() + self.bytes.len() + taken > LINE_LIMIT {
                let message = format!("a line of more than {LINE_LIMIT} bytes");
                let diagnostic = Diagnostic::at(Severity::Error, &self.file, self.number, "", 0, message);
                return Err(diagnostic.help("is this a binary file?"));
            }
            self.bytes.extend_from_slice(&available[..taken]);
            let Some(end) = end else {
                self.reader.consume(taken);
                continue;
            };
            self.after_return = available[end] == b'\r';
            self.reader.consume(taken + 1);
            return Ok(true);
        }
    }
}

/// Bytes before the backslash of a line that the next one continues; spaces may stand behind it.
fn continued(text: &str) -> Option<usize> {
    text.trim_end_matches([' ', '\t']).strip_suffix('\\').map(str::len)
}

/// Whether a line begins with a statement of names.
fn is_naming(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    let key = line[..end].to_ascii_lowercase();
    key.starts_with(b"map_") || NAMING.iter().any(|name| name.as_bytes() == key)
}
