//! What a variant file or an animation comes to: members, and what they are compared by.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::scene::define::Define;
use crate::scene::diagnostic::Diagnostic;

/// The most members of a family.
pub const MOST_MEMBERS: usize = 4096;

/// A variant file or an animation, understood. No member of it was read.
#[derive(Clone, Debug)]
pub struct Family {
    /// Of the file, without its ending.
    pub name: String,
    pub path: PathBuf,
    /// The scene file that members change, but for those that have their own.
    pub scene: PathBuf,
    pub axes: Vec<Axis>,
    /// The grid of the axes, the last fastest, and then those written by hand.
    pub members: Vec<Member>,
    pub reference: Option<Chosen>,
    pub goal: Option<Goal>,
    /// Frames a second, where its members are the frames of a movie.
    pub fps: Option<f64>,
    /// Of an animation: the members in which a value is that of a key, where what is wrong stands as it is written.
    pub keyed: BTreeSet<usize>,
    /// What is not taken as written.
    pub warnings: Vec<Diagnostic>,
    /// All variant files that were read for it: of the chain of `extends`.
    pub files: Vec<PathBuf>,
}

impl Family {
    /// The scene file that a member changes.
    pub fn scene_of<'f>(&'f self, member: &'f Member) -> &'f Path {
        member.scene.as_deref().unwrap_or(&self.scene)
    }

    /// What its members are, in a word.
    pub fn word(&self) -> &'static str {
        if self.fps.is_some() { "frames" } else { "members" }
    }
}

/// What a sweep goes over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    pub name: String,
    /// Paths that change together.
    pub paths: Vec<String>,
    /// Of its values, each another.
    pub labels: Vec<String>,
}

/// A scene of a family.
#[derive(Clone, Debug)]
pub struct Member {
    /// Unlike all others', also where case does not count; fit for a file's name.
    pub name: String,
    /// Its place on each axis; empty where it was written by hand.
    pub at: Vec<usize>,
    /// Another scene file than the family's.
    pub scene: Option<PathBuf>,
    pub defines: Vec<Define>,
    /// A folder of shaders, where it has its own.
    pub shaders: Option<PathBuf>,
    /// Where it is asked for: a warning without a message.
    pub place: Diagnostic,
    /// A file or folder that it names is not there.
    pub wrong: Option<Diagnostic>,
}

/// The member that the others are compared with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    pub member: String,
    /// Samples a pixel of a film of its own; none where its picture is the reference.
    pub spp: Option<u32>,
}

/// When a member is done.
#[derive(Clone, Debug, PartialEq)]
pub enum Goal {
    /// After so many samples a pixel, ascending; it is looked at after each.
    Samples(Vec<u32>),
    /// After so many seconds of tracing, ascending.
    Seconds(Vec<f64>),
    /// When its relMSE is at most this, with 95 % confidence.
    Error(f64),
}
