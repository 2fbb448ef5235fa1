//! Why a peer rendered nothing.

use std::path::PathBuf;

/// Each says what to do.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum PeerError {
    #[error("no Python with Mitsuba: {tried}")]
    #[diagnostic(help("install it: python3 -m pip install mitsuba; or name a Python that has it with --peer PYTHON"))]
    NoneFound { tried: String },
    #[error("{}: can't be started: {source}", path.display())]
    #[diagnostic(help("name the program of a Python that has Mitsuba, such as --peer venv/bin/python"))]
    NoPython { path: PathBuf, source: std::io::Error },
    #[error("{}: does not import mitsuba: {last}", path.display())]
    #[diagnostic(help("install it there: {} -m pip install mitsuba", path.display()))]
    NoMitsuba { path: PathBuf, last: String },
    #[error("{}: its Mitsuba calls itself `{version}`; {least} or later is needed", path.display())]
    #[diagnostic(help("renew it: {} -m pip install --upgrade mitsuba", path.display()))]
    TooOld { path: PathBuf, version: String, least: String },
    #[error("Mitsuba can't render this: {said}")]
    #[diagnostic(help("another --variant may: scalar_rgb needs neither a GPU nor LLVM"))]
    Refused { said: String },
    #[error("Mitsuba ended by itself ({status}){last}")]
    #[diagnostic(help("run the scene by hand: {run}"))]
    Ended { status: String, last: String, run: String },
    #[error("Mitsuba answered what is no answer: {line}")]
    #[diagnostic(help("say so to those who write Lucerna, with the version of Mitsuba"))]
    NoAnswer { line: String },
}
