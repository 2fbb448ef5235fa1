//! Lines of OBJ and MTL files: read as a stream, continuations joined, each part with its place.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostic, Severity};
use super::text::{cannot_read, not_utf8};

/// Bytes that a line may have, its continuations included: a file without line ends must not fill the memory.
const LINE_LIMIT: usize = 4 << 20;

/// What some editors put before UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// One logical line: its text, and where its physical lines begin.
#[derive(Debug, Default)]
pub struct Line {
    pub text: String,
    /// Byte in `text` and line number (from 1) of each physical line.
    starts: Vec<(usize, u32)>,
    file: PathBuf,
}

impl Line {
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

/// The words of a statement of numbers, up to a comment.
pub fn words(rest: &str) -> impl Iterator<Item = &str> {
    rest.split_whitespace().take_while(|word| !word.starts_with('#'))
}

/// Reads logical lines. Lines end with `\n`, `\r\n` or `\r`; a byte order mark is left out.
pub struct Lines<R> {
    reader: R,
    file: PathBuf,
    number: u32,
    bytes: Vec<u8>,
    /// The last line ended with `\r`: a `\n` right after it belongs to it.
    after_return: bool,
    /// The end of the file was met, in a line without an end.
    open_end: bool,
}

impl<R: BufRead> Lines<R> {
    /// `file` is the name in messages.
    pub fn new(reader: R, file: &Path) -> Self {
        Self { reader, file: file.to_path_buf(), number: 0, bytes: Vec::new(), after_return: false, open_end: false }
    }

    /// The number of the line read last, from 1.
    pub fn number(&self) -> u32 {
        self.number
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
            self.append(line, comment)?;
            // A comment may well end with a folder's name, `# C:\models\`: it continues nothing.
            if comment || !line.text.ends_with('\\') {
                return Ok(true);
            }
            line.text.pop();
            line.text.push(' ');
        }
    }

    /// Adds the bytes of one physical line as text.
    fn append(&mut self, line: &mut Line, comment: bool) -> Result<(), Diagnostic> {
        match std::str::from_utf8(&self.bytes) {
            Ok(text) if comment || !text.contains('\0') => line.text.push_str(text),
            Ok(text) => {
                let at = text.find('\0').unwrap_or(0);
                let message = "a zero byte: this is no text file";
                return Err(Diagnostic::at(Severity::Error, &self.file, self.number, text, at, message)
                    .help("is this a binary file, or UTF-16 text? Save text as UTF-8"));
            }
            Err(_) if comment => line.text.push('#'),
            Err(error) => {
                let diagnostic = not_utf8(&self.file, &self.bytes, error.valid_up_to());
                return Err(Diagnostic { line: self.number, ..diagnostic });
            }
        }
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
