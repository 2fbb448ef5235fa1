//! Errors at the edge: shown once on stderr, and turned into an exit code.

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use crate::engine::EngineError;
use crate::gpu::GpuError;
use crate::image::{ReadError, SaveError};
use crate::scene::{Diagnostic, Diagnostics};
use crate::shader::ShaderError;

/// What the process ends with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// All was done.
    Done,
    /// Wrong input, or an error on the way.
    Failed,
    /// A command line that means nothing.
    Usage,
    /// No graphics adapter that can be used.
    NoAdapter,
    /// Compared pictures differ by more than was allowed.
    Differs,
    /// Judged shaders have another mean.
    MeansDiffer,
    /// Judged shaders may have another mean, or the same; or a measurement here proves nothing.
    CannotTell,
    /// What must hold of the numbers does not.
    Unstable,
    /// Shaders that don't link or compile.
    BrokenShaders,
    /// To `git bisect run`: the means of this commit differ.
    Bad,
    /// To `git bisect run`: this commit can't be judged.
    Skipped,
    /// To `git bisect run`: no commit can be judged.
    Abandoned,
    /// Interrupted; what there was, if anything, has been written.
    Interrupted,
}

impl Exit {
    /// The number the shell sees.
    pub fn code(self) -> u8 {
        match self {
            Exit::Done => 0,
            Exit::Failed | Exit::BrokenShaders | Exit::Bad => 1,
            Exit::Usage => 2,
            Exit::NoAdapter => 3,
            Exit::Differs => 4,
            Exit::MeansDiffer => 5,
            Exit::CannotTell => 6,
            Exit::Unstable => 7,
            Exit::Skipped => 125,
            Exit::Abandoned => 128,
            Exit::Interrupted => 130,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit.code())
    }
}

/// Why a command stopped.
#[derive(Debug)]
pub struct Failure {
    pub exit: Exit,
    pub report: miette::Report,
}

/// A command line that parses, and can't be meant.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{message}")]
struct Misused {
    message: String,
    #[help]
    help: String,
}

impl Failure {
    /// Of the command line: what is wrong, and what to do.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        let misused = Misused { message: message.into(), help: help.into() };
        Self { exit: Exit::Usage, report: misused.into() }
    }

    /// Of anything else.
    pub fn of(error: impl miette::Diagnostic + Send + Sync + 'static) -> Self {
        Self { exit: Exit::Failed, report: miette::Report::new(error) }
    }

    /// Of the engine.
    pub fn engine(error: EngineError) -> Self {
        match error {
            EngineError::Gpu(error) => error.into(),
            other => Self::of(other),
        }
    }

    /// Prints it to stderr.
    pub fn show(&self) {
        show(&*self.report);
    }
}

impl From<GpuError> for Failure {
    fn from(error: GpuError) -> Self {
        let exit = match error {
            GpuError::NoAdapter
            | GpuError::NoSuchAdapter { .. }
            | GpuError::NoSuchBuffer { .. }
            | GpuError::NoPresenter
            | GpuError::CannotPresent { .. } => Exit::NoAdapter,
            GpuError::Shader(_) => Exit::BrokenShaders,
            _ => Exit::Failed,
        };
        Self { exit, report: error.into() }
    }
}

impl From<Diagnostic> for Failure {
    fn from(error: Diagnostic) -> Self {
        Self::of(error)
    }
}

impl From<Diagnostics> for Failure {
    fn from(errors: Diagnostics) -> Self {
        Self::of(errors)
    }
}

impl From<ShaderError> for Failure {
    fn from(error: ShaderError) -> Self {
        Self { exit: Exit::BrokenShaders, ..Self::of(error) }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::of(error)
    }
}

impl From<SaveError> for Failure {
    fn from(error: SaveError) -> Self {
        Self::of(error)
    }
}

/// Prints a diagnostic, or those that it gathers, to stderr.
pub fn show(diagnostic: &dyn miette::Diagnostic) {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let mut related = diagnostic.related().into_iter().flatten().peekable();
    let text = match related.peek() {
        None => rendered(diagnostic, colour),
        Some(_) => related.map(|one| rendered(one, colour)).collect(),
    };
    // If stderr is closed, nobody reads it.
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// `file:line:column: error: message`, the source line with a mark below it, and the help: what editors and users can
/// both follow. Ends with a line break.
pub fn rendered(diagnostic: &dyn miette::Diagnostic, colour: bool) -> String {
    let whole = diagnostic.to_string();
    let help = diagnostic.help().map(|help| help.to_string());
    // A diagnostic's own text may end in its help, which is to come after the source line.
    let message = match &help {
        Some(help) => whole.strip_suffix(help.as_str()).map_or(whole.as_str(), |rest| {
            let rest = rest.trim_end();
            rest.strip_suffix("help:").map_or(whole.as_str(), str::trim_end)
        }),
        None => &whole,
    };
    let word = match diagnostic.severity() {
        Some(miette::Severity::Warning) => "warning",
        Some(miette::Severity::Advice) => "advice",
        _ => "error",
    };
    let marked = format!("{word}: ");
    let message = match snippet(diagnostic) {
        // Located, but without the word: behind the place is where it belongs.
        Some(found) if !message.contains(&marked) => match message.strip_prefix(found.place.as_str()) {
            Some(rest) => format!("{}{marked}{}", found.place, rest),
            None => format!("{}{marked}{message}", found.place),
        },
        None if !message.contains(&marked) => format!("{marked}{message}"),
        _ => message.to_owned(),
    };
    let (red, plain) = match (colour, word) {
        (false, _) => ("", ""),
        (true, "error") => ("\u{1b}[1;31m", "\u{1b}[0m"),
        (true, _) => ("\u{1b}[1;33m", "\u{1b}[0m"),
    };
    let mut text = message.replacen(&marked, &format!("{red}{word}:{plain} "), 1) + "\n";
    if let Some(found) = snippet(diagnostic) {
        text += &found.text;
    }
    if let Some(help) = help {
        text += &format!("  help: {help}\n");
    }
    text
}

/// A source line with its mark.
struct Snippet {
    /// `file:line:column: `
    place: String,
    text: String,
}

/// The line that the first label is in.
fn snippet(diagnostic: &dyn miette::Diagnostic) -> Option<Snippet> {
    let source = diagnostic.source_code()?;
    let label = diagnostic.labels()?.next()?;
    // Asked for no line around it, miette gives no more than the span itself.
    let contents = source.read_span(label.inner(), 1, 1).ok()?;
    let all = std::str::from_utf8(contents.data()).ok()?;
    let before = all.get(..label.offset().saturating_sub(contents.span().offset()))?;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = all[start..].lines().next()?;
    let at = before[start..].chars().count();
    let length =
        line.get(before.len() - start..).map_or(0, |rest| rest.get(..label.len()).unwrap_or(rest).chars().count());
    let number = (contents.line() + before.matches('\n').count() + 1).to_string();
    let column = if start == 0 { contents.column() } else { 0 } + at + 1;
    let margin = " ".repeat(number.len());
    let indent: String = line.chars().take(at).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
    let carets = "^".repeat(length.max(1));
    let place = match contents.name() {
        Some(name) => format!("{name}:{number}:{column}: "),
        None => String::new(),
    };
    Some(Snippet { place, text: format!("  {number} | {line}\n  {margin} | {indent}{carets}\n") })
}
