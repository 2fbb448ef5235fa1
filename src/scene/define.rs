//! A change of one value of a scene file: from the command line, an override, or a sweep.

use super::diagnostic::Diagnostic;

/// A change of one value of a scene file, made before its values are understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Define {
    /// Names of fields joined by dots, such as `materials.ball.ns`.
    pub path: String,
    /// As it would be written in the file.
    pub value: String,
    pub written: Written,
}

/// Where a change was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// By `-D`.
    CommandLine,
    /// In a file: warnings of the places of the path and of the value, whose messages are empty, or say which of several values it is.
    File { path: Box<Diagnostic>, value: Box<Diagnostic> },
}

impl Define {
    /// One of the command line.
    pub fn given(path: impl Into<String>, value: impl Into<String>) -> Self {
        Self { path: path.into(), value: value.into(), written: Written::CommandLine }
    }
}
