//! What can be wrong with a shader, and where.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use miette::{LabeledSpan, SourceSpan};

/// A file of WGSL, or the generated one.
#[derive(Debug)]
pub struct Source {
    /// As messages name it: `shaders/lib/rng.wgsl`.
    pub file: String,
    pub text: String,
}

/// The kind of a [`ShaderError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// A file or folder can't be read.
    Read,
    /// The text is not WGSL, or not our subset of WESL.
    Syntax,
    /// A module or a name in it that does not exist, or a name used without its import.
    Import,
    /// Modules that import each other.
    Cycle,
    /// One name declared twice.
    Duplicate,
    /// What naga's front end or validator refuses.
    Type,
    /// A parameter whose declaration says no number, or none that it may be.
    Parameter,
    /// A number that code wants to show of itself, and can't.
    Probe,
    /// A binding that is missing, used twice, or of a kind that passes do not have.
    Binding,
    /// A shared struct that naga lays out otherwise than Rust.
    Layout,
    /// A loop of an edited shader that had to be ended while it ran.
    Loop,
    /// No error: what some drivers take long to compile.
    Slow,
}

/// An error in a shader, at its place in the original file. Displays as `file:line:column: message`.
#[derive(Clone)]
pub struct ShaderError {
    pub kind: ErrorKind,
    pub message: String,
    pub help: Option<Box<str>>,
    /// None if no file can be named.
    pub place: Option<Box<Place>>,
}

/// A place in a source.
#[derive(Clone, Debug)]
pub struct Place {
    pub source: Arc<Source>,
    /// Bytes of `source.text`.
    pub range: Range<usize>,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

impl Place {
    pub(super) fn new(source: Arc<Source>, range: Range<usize>) -> Self {
        let text = &source.text;
        let start = text.floor_char_boundary(range.start);
        let end = text.floor_char_boundary(range.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line = text[..start].matches('\n').count() + 1;
        let column = text[line_start..start].chars().count() + 1;
        Place { source, range: start..end, line, column }
    }

    /// The line of the source that holds the start of the place.
    pub fn source_line(&self) -> &str {
        self.source.text.lines().nth(self.line - 1).unwrap_or("")
    }
}

impl ShaderError {
    pub(super) fn at(kind: ErrorKind, source: &Arc<Source>, range: Range<usize>, message: impl Into<String>) -> Self {
        Self::of(kind, Place::new(source.clone(), range), message)
    }

    /// An error at a place.
    pub fn of(kind: ErrorKind, place: Place, message: impl Into<String>) -> Self {
        ShaderError { kind, message: message.into(), help: None, place: Some(Box::new(place)) }
    }

    pub(super) fn nowhere(kind: ErrorKind, message: impl Into<String>) -> Self {
        ShaderError { kind, message: message.into(), help: None, place: None }
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into().into_boxed_str());
        self
    }

    /// The file, if one can be named.
    pub fn file(&self) -> Option<&str> {
        self.place.as_ref().map(|place| place.source.file.as_str())
    }

    /// Line and column, both from 1; the column counts characters.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        self.place.as_ref().map(|place| (place.line, place.column))
    }

    /// The message, below it the source line with the place marked, and the help: for a terminal without colours, or
    /// over a picture.
    pub fn report(&self) -> String {
        let mut report = self.to_string();
        if let Some(place) = &self.place {
            let line = place.source_line();
            let number = place.line.to_string();
            let indent: String =
                line.chars().take(place.column - 1).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
            let rest = line.chars().count().saturating_sub(place.column - 1);
            let length = place.source.text[place.range.clone()].chars().take_while(|&c| c != '\n').count();
            let carets = "^".repeat(length.clamp(1, rest.max(1)));
            let margin = " ".repeat(number.len());
            report.push_str(&format!("\n {number} | {line}\n {margin} | {indent}{carets}"));
        }
        if let Some(help) = &self.help {
            report.push_str(&format!("\n help: {help}"));
        }
        report
    }
}

impl fmt::Display for ShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{}:{}:{}: ", place.source.file, place.line, place.column)?;
        }
        f.write_str(&self.message)
    }
}

impl fmt::Debug for ShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}: {}", self.kind, self.report())
    }
}

impl std::error::Error for ShaderError {}

impl miette::SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn miette::SpanContents<'a> + 'a>, miette::MietteError> {
        let contents = self.text.read_span(span, before, after)?;
        Ok(Box::new(miette::MietteSpanContents::new_named(
            self.file.clone(),
            contents.data(),
            *contents.span(),
            contents.line(),
            contents.column(),
            contents.line_count(),
        )))
    }
}

impl miette::Diagnostic for ShaderError {
    fn severity(&self) -> Option<miette::Severity> {
        Some(if self.kind == ErrorKind::Slow { miette::Severity::Warning } else { miette::Severity::Error })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        self.place.as_ref().map(|place| &*place.source as &dyn miette::SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.place.as_ref()?;
        Some(Box::new(std::iter::once(LabeledSpan::underline(place.range.clone()))))
    }
}
