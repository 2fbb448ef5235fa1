//! Why a picture can't be read, and what to do about it.

use std::path::PathBuf;

use glam::UVec2;

use crate::components::Film;

/// A picture that can't be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", path.display())]
pub struct ReadError {
    pub path: PathBuf,
    pub fault: Fault,
}

impl miette::Diagnostic for ReadError {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.fault.help()
    }
}

/// What is wrong with it, without its name.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum Fault {
    #[error("can't open: {0}")]
    #[diagnostic(help("name a picture that can be read: .exr, .hdr or .png"))]
    Open(std::io::Error),
    #[error("is a folder")]
    #[diagnostic(help("name a picture in it: .exr, .hdr or .png"))]
    Folder,
    #[error("is no picture of a kind that is read")]
    #[diagnostic(help("EXR, Radiance HDR and PNG are read, whatever the name ends in"))]
    Unknown,
    #[error("is empty")]
    #[diagnostic(help("write the file again"))]
    Empty,
    #[error("is cut short")]
    #[diagnostic(help("it was not written or copied to its end: write or copy it again"))]
    CutShort,
    #[error("can't read: {0}")]
    #[diagnostic(help("the file is damaged, or of a variant that is not read: write it again"))]
    Broken(String),
    #[error("{what}")]
    Unsupported {
        what: String,
        #[help]
        help: &'static str,
    },
    #[error("has no channels R, G and B, and no Y, in any layer; its channels are: {0}")]
    #[diagnostic(help("write the picture as RGB, with or without a prefix, such as `beauty.R`"))]
    Channels(String),
    #[error("{}x{} pixels is {}", .0.x, .0.y, if .0.min_element() == 0 { "empty" } else { "too large" })]
    #[diagnostic(help("a side has 1 to {} pixels", Film::MAX_SIDE))]
    TooLarge(UVec2),
}
