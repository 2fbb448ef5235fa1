//! What is known of the members of a family once they were rendered: what tables, sheet and page show, and what a later run goes on from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Of all members, in the order of the file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// Of this format.
    pub version: u32,
    pub name: String,
    /// The variant file.
    pub file: String,
    pub axes: Vec<AxisRecord>,
    pub records: Vec<Record>,
    /// The name of the member that the others are compared with.
    pub reference: Option<String>,
    pub interrupted: bool,
    /// What is to be known of its numbers: sentences.
    #[serde(default)]
    pub remarks: Vec<String>,
}

/// An axis of the sweep.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct AxisRecord {
    pub name: String,
    pub labels: Vec<String>,
}

/// A member. Its files are `NAME.png` and `NAME.exr` in the folder `members`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Record {
    pub name: String,
    /// Hash of all that its picture follows from.
    pub key: String,
    /// Its place on each axis; empty where it was written by hand.
    pub at: Vec<usize>,
    /// Paths and values that it sets, as written; the last of a path wins.
    pub settings: Vec<(String, String)>,
    pub state: State,
    /// Of its film, samples ascending.
    pub snapshots: Vec<Snapshot>,
    /// Linear Rec.709 radiance.
    pub mean: [f64; 3],
    pub bad_samples: u64,
    pub adapter: String,
    /// The member whose film it shares: one that differs in exposure or samples alone.
    pub film_of: Option<String>,
    pub against: Option<Against>,
    pub work: Work,
    /// The command that renders it alone.
    pub repeat: String,
}

/// How far a member came.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum State {
    Done,
    /// With what is wrong, and where: line and column from 1, 0 where it is about the whole file.
    Failed {
        message: String,
        file: Option<String>,
        line: u32,
        column: u32,
    },
    /// It lost the race after so many seconds, with this much confidence, 0 to 1.
    Lost {
        seconds: f64,
        confidence: f64,
    },
    /// Not rendered yet.
    Missing,
}

/// A film after some samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    pub spp: u32,
    /// Of tracing.
    pub seconds: f64,
    pub rays: u64,
    /// The film's own estimate.
    pub relmse: f64,
}

/// A member compared with the reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Against {
    pub relmse: f64,
    /// Of the pictures as shown, 0 to 1; none in a build without FLIP.
    pub flip: Option<f64>,
    /// The member's mean as part of the reference's, by channel.
    pub mean: [f64; 3],
}

/// What a member cost beyond its samples, for what members before it had done already.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// Files read.
    pub read: u32,
    /// Bytes sent to the GPU, by buffer.
    pub uploaded: BTreeMap<String, u64>,
    /// Trees built.
    pub trees: u64,
    /// Pipelines compiled, by pass.
    pub compiled: BTreeMap<String, u64>,
}
