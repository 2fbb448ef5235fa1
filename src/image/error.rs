//! Why a picture can't be read, and what to do about it.

use std::path::PathBuf;

use glam::UVec2;

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
    #[error("is {}", if *.text { "text, and no picture of a kind that is read" } else { "no picture of a kind that is read" })]
    #[diagnostic(help("{kinds} are read, whatever the name ends in"))]
    Unknown {
        /// Those that are read.
        kinds: &'static str,
        /// It begins like text.
        text: bool,
    },
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
    #[error("{}x{} pixels is {}", .size.x, .size.y, if .size.min_element() == 0 { "empty" } else { "too large" })]
    #[diagnostic(help("a side has 1 to {most} pixels"))]
    TooLarge { size: UVec2, most: u32 },
    #[error("{}x{} pixels would take {gib:.1} GiB of memory", .size.x, .size.y)]
    #[diagnostic(help(
        "halve its sides, or write it with 8 bits a channel: a texture may take 4 GiB, if there is as much memory"
    ))]
    TooHeavy { size: UVec2, gib: f64 },
}
