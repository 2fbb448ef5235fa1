//! Messages about asset files, each with the place it is about.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use super::printable::printable;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// The file can be used, but not all of it as written.
    Warning,
    /// The file can't be used.
    Error,
}

/// One message about one place in a file.
///
/// `Display` gives `file:line:column: error: message`, and the help on a line of its own; `miette` adds the source line.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Diagnostic {
    pub severity: Severity,
    /// The file as it was named, or `-D` for a define of the command line.
    pub file: PathBuf,
    /// From 1; 0 where the message is about the whole file.
    pub line: u32,
    /// In characters, from 1; 0 where the message is about the whole file.
    pub column: u32,
    /// The line itself, or the part of a long line around the column.
    pub source_line: String,
    /// Characters of the line that `source_line` leaves out at its start.
    pub source_skipped: u32,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

/// Longest part of a source line that is kept, in characters.
const SHOWN: usize = 200;

impl Diagnostic {
    /// A message about a whole file.
    pub fn file(severity: Severity, file: &Path, message: impl Into<String>) -> Self {
        Self {
            severity,
            file: file.to_path_buf(),
            line: 0,
            column: 0,
            source_line: String::new(),
            source_skipped: 0,
            message: message.into(),
            help: None,
        }
    }

    /// A message about the character at byte `offset` of line `line` (from 1), whose text is `text`.
    pub fn at(
        severity: Severity,
        file: &Path,
        line: u32,
        text: &str,
        offset: usize,
        message: impl Into<String>,
    ) -> Self {
        let before = text.char_indices().take_while(|(at, _)| *at < offset).count();
        let skipped = before.saturating_sub(SHOWN / 2);
        let source_line = text.chars().skip(skipped).take(SHOWN).map(|c| if c.is_control() { ' ' } else { c });
        Self {
            line,
            column: u32::try_from(before + 1).unwrap_or(u32::MAX),
            source_line: source_line.collect(),
            source_skipped: u32::try_from(skipped).unwrap_or(u32::MAX),
            ..Self::file(severity, file, message)
        }
    }

    /// Adds what to do about it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file.display())?;
        if self.line > 0 {
            write!(f, "{}:{}:", self.line, self.column)?;
        }
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, " {severity}: {}", printable(&self.message))?;
        match &self.help {
            Some(help) => write!(f, "\n    help: {}", printable(help)),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostic {}

impl miette::Diagnostic for Diagnostic {
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(printable(help)) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        (self.line > 0).then_some(self)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = miette::LabeledSpan> + '_>> {
        let span = (self.line > 0).then(|| self.span())?;
        Some(Box::new(std::iter::once(miette::LabeledSpan::new_with_span(None, span))))
    }
}

impl Diagnostic {
    /// The character the message is about, within `source_line`.
    fn span(&self) -> miette::SourceSpan {
        let nth = self.column.saturating_sub(1 + self.source_skipped) as usize;
        let offset = self.source_line.char_indices().nth(nth).map_or(self.source_line.len(), |(at, _)| at);
        let length = self.source_line[offset..].chars().next().map_or(0, char::len_utf8);
        (offset, length).into()
    }
}

/// The one source line a diagnostic keeps, under its true line number.
impl miette::SourceCode for Diagnostic {
    fn read_span<'a>(
        &'a self,
        span: &miette::SourceSpan,
        _before: usize,
        _after: usize,
    ) -> Result<Box<dyn miette::SpanContents<'a> + 'a>, miette::MietteError> {
        if span.offset() + span.len() > self.source_line.len() {
            return Err(miette::MietteError::OutOfBounds);
        }
        Ok(Box::new(miette::MietteSpanContents::new_named(
            self.file.display().to_string(),
            self.source_line.as_bytes(),
            (0, self.source_line.len()).into(),
            self.line as usize - 1,
            self.source_skipped as usize,
            1,
        )))
    }
}

/// Several messages, in the order they were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics {
    pub list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Adds one message.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Whether any of them is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }
}

/// Collects messages of which some repeat without end: of each kind, the first few are kept and the others counted.
#[derive(Debug)]
pub struct Tally {
    file: PathBuf,
    pub diagnostics: Diagnostics,
    counts: BTreeMap<&'static str, u32>,
    /// Messages since it was last asked, kept or not; none where nobody asks.
    heard: Option<Vec<String>>,
}

impl Tally {
    /// Messages of one kind that are kept in full.
    const KEPT: u32 = 8;

    /// `file` is what the counts are reported for.
    pub fn new(file: &Path) -> Self {
        Self { file: file.to_path_buf(), diagnostics: Diagnostics::default(), counts: BTreeMap::new(), heard: None }
    }

    /// One that can be asked what was said since.
    pub fn listening(file: &Path) -> Self {
        Self { heard: Some(Vec::new()), ..Self::new(file) }
    }

    /// What was said since it was last asked.
    pub fn heard(&mut self) -> Vec<String> {
        self.heard.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Adds a message where it is kept, and tells it where somebody asks.
    fn say(&mut self, kept: bool, diagnostic: impl FnOnce() -> Diagnostic) {
        if !kept && self.heard.is_none() {
            return;
        }
        let diagnostic = diagnostic();
        if let Some(heard) = &mut self.heard {
            heard.push(diagnostic.message.clone());
        }
        if kept {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Adds a message of a kind, made only if it is kept.
    pub fn push(&mut self, kind: &'static str, diagnostic: impl FnOnce() -> Diagnostic) {
        let count = self.counts.entry(kind).or_insert(0);
        *count = count.saturating_add(1);
        let kept = *count <= Self::KEPT;
        self.say(kept, diagnostic);
    }

    /// Adds a message of a kind of which only the first matters, made only if it is the first.
    pub fn once(&mut self, kind: &'static str, diagnostic: impl FnOnce() -> Diagnostic) {
        let first = self.counts.insert(kind, 1).is_none();
        self.say(first, diagnostic);
    }

    /// Whether there was a message of a kind.
    pub fn has_told(&self, kind: &'static str) -> bool {
        self.counts.contains_key(kind)
    }

    /// All messages, with the counts of those that were not kept.
    pub fn finish(mut self) -> Diagnostics {
        for (kind, count) in &self.counts {
            if *count > Self::KEPT {
                let message = format!("and {} more: {kind}", count - Self::KEPT);
                self.diagnostics.push(Diagnostic::file(Severity::Warning, &self.file, message));
            }
        }
        self.diagnostics
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { list: vec![diagnostic] }
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, diagnostic) in self.list.iter().enumerate() {
            write!(f, "{}{diagnostic}", if i == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

impl miette::Diagnostic for Diagnostics {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn miette::Diagnostic> + 'a>> {
        Some(Box::new(self.list.iter().map(|diagnostic| diagnostic as &dyn miette::Diagnostic)))
    }
}
