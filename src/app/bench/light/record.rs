//! What was measured, and what follows from it: the content of `bench.json`.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};

use crate::gpu::Gpu;
use crate::stats::summary::{Crossing, Slope, Summary, crossing, log_log_slope};

/// The relMSE whose time to reach is reported.
pub const TARGET: f64 = 1e-3;

/// A reference whose own relMSE is above this part of what is measured against it says little.
const NOISY_REFERENCE: f64 = 0.1;

/// A whole benchmark.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bench {
    /// Of Lucerna.
    pub version: String,
    /// Seconds since 1970.
    pub made: u64,
    /// A signal or an error ended it early: what there is is right, and not all.
    pub interrupted: bool,
    pub machine: Machine,
    /// Seeds of each configuration.
    pub seeds: u32,
    /// Samples a pixel of the last snapshot.
    pub spp: u32,
    pub scenes: Vec<SceneRecord>,
}

impl Bench {
    /// One that begins now, without scenes.
    pub fn new(gpu: &Gpu, seeds: u32, spp: u32) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            made: SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()),
            interrupted: false,
            machine: Machine::of(gpu),
            seeds,
            spp,
            scenes: Vec::new(),
        }
    }
}

/// What it ran on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Adapter and driver.
    pub adapter: String,
    /// The adapter is the processor.
    pub software: bool,
    pub os: String,
    pub architecture: String,
    /// Threads the processor runs at once.
    pub threads: usize,
}

impl Machine {
    /// This one, with the device that is open.
    pub fn of(gpu: &Gpu) -> Self {
        Self {
            adapter: gpu.name(),
            software: gpu.is_software(),
            os: std::env::consts::OS.to_owned(),
            architecture: std::env::consts::ARCH.to_owned(),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

/// One scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneRecord {
    pub scene: String,
    /// Pixels of the rendered window.
    pub size: [u32; 2],
    pub max_depth: u32,
    pub triangles: u32,
    /// Of all that decides what the picture is to be: figures of unequal keys can't be compared.
    pub key: String,
    pub reference: ReferenceRecord,
    pub configurations: Vec<ConfigurationRecord>,
}

/// The reference that errors are taken against.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceRecord {
    /// Of the scene, and of the shaders it was made with.
    pub key: String,
    /// How it was made: a configuration's name, or `cpu`.
    pub by: String,
    pub seed: u32,
    pub spp: u32,
    /// Its own relMSE, from its two halves: what is subtracted from every error.
    pub relmse: f64,
    pub adapter: String,
    /// Seconds of tracing it.
    pub seconds: f64,
}

/// One configuration of one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ConfigurationRecord {
    /// As `path+sobol+roulette`.
    pub name: String,
    /// Samples that were no numbers, or too large, over all runs.
    pub bad_samples: u64,
    /// A run a seed.
    pub runs: Vec<Run>,
    pub snapshots: Vec<SnapshotSummary>,
    /// Of log relMSE against log spp; -1 for independent samples.
    pub slope: Option<Slope>,
    /// Seconds to a relMSE of 1e-3, interpolated; none where that is outside of what was measured.
    pub seconds_to_target: Option<f64>,
}

/// A film of one seed, as it grew.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    pub seed: u32,
    pub snapshots: Vec<Snapshot>,
}

/// A film at some number of samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    pub spp: u32,
    /// Wall-clock seconds of all batches so far, each from its submission to its end.
    pub seconds: f64,
    /// Rays so far.
    pub rays: u64,
    /// Against the reference, whose own relMSE is subtracted: may be below 0 where that is not small.
    pub relmse: f64,
    /// The relMSE that the film itself claims, from its halves; none at 1 spp.
    pub claimed: Option<f64>,
}

/// A number of samples over all seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SnapshotSummary {
    pub spp: u32,
    pub seconds: Summary,
    pub relmse: Summary,
    /// 1 / (relMSE * seconds); none where an error is not above 0.
    pub efficiency: Option<Summary>,
    /// Rays a second, in all.
    pub rays_per_second: f64,
    /// Mean of what the films claim over the mean of what is true.
    pub claimed_over_true: Option<f64>,
}

impl Snapshot {
    /// 1 / (relMSE * seconds); none where the error or the time is not above 0.
    pub fn efficiency(&self) -> Option<f64> {
        (self.relmse > 0.0 && self.seconds > 0.0).then(|| 1.0 / (self.relmse * self.seconds))
    }
}

impl ConfigurationRecord {
    /// Works out what follows from the runs.
    pub fn of(name: String, bad_samples: u64, runs: Vec<Run>) -> Self {
        let spps: Vec<u32> = runs.first().map_or(&[][..], |run| &run.snapshots).iter().map(|s| s.spp).collect();
        let snapshots: Vec<_> = spps.iter().filter_map(|&spp| SnapshotSummary::of(spp, &runs)).collect();
        let xs: Vec<f64> = spps.iter().map(|&spp| f64::from(spp)).collect();
        let errors: Vec<Vec<f64>> = runs.iter().map(|run| run.snapshots.iter().map(|s| s.relmse).collect()).collect();
        let slope = log_log_slope(&xs, &errors);
        let mut record = Self { name, bad_samples, runs, snapshots, slope, seconds_to_target: None };
        record.seconds_to_target = match record.reach() {
            Some(Crossing::At(seconds)) => Some(seconds),
            _ => None,
        };
        record
    }

    /// The time to the target.
    pub fn reach(&self) -> Option<Crossing> {
        let points: Vec<_> = self.snapshots.iter().map(|s| (s.seconds.mean, s.relmse.mean)).collect();
        crossing(&points, TARGET)
    }

    /// The film of most samples.
    pub fn last(&self) -> Option<&SnapshotSummary> {
        self.snapshots.last()
    }

    /// The snapshots of all seeds at some number of samples.
    pub fn at(&self, spp: u32) -> impl Iterator<Item = &Snapshot> {
        snapshots_at(&self.runs, spp)
    }
}

fn snapshots_at(runs: &[Run], spp: u32) -> impl Iterator<Item = &Snapshot> {
    runs.iter().flat_map(|run| &run.snapshots).filter(move |snapshot| snapshot.spp == spp)
}

impl SnapshotSummary {
    /// None where no run has that many samples.
    fn of(spp: u32, runs: &[Run]) -> Option<Self> {
        let over = |value: fn(&Snapshot) -> f64| snapshots_at(runs, spp).map(value).collect::<Vec<_>>();
        let (seconds, relmse) = (Summary::of(&over(|s| s.seconds))?, Summary::of(&over(|s| s.relmse))?);
        let efficiencies: Option<Vec<f64>> = snapshots_at(runs, spp).map(Snapshot::efficiency).collect();
        let claims: Option<Vec<f64>> = snapshots_at(runs, spp).map(|s| s.claimed).collect();
        let claimed = claims.and_then(|claims| Summary::of(&claims)).filter(|_| relmse.mean > 0.0);
        let rays: f64 = over(|s| s.rays as f64).iter().sum();
        let time: f64 = over(|s| s.seconds).iter().sum();
        Some(Self {
            spp,
            seconds,
            relmse,
            efficiency: efficiencies.and_then(|values| Summary::of(&values)),
            rays_per_second: if time > 0.0 { rays / time } else { 0.0 },
            claimed_over_true: claimed.map(|claimed| claimed.mean / relmse.mean),
        })
    }
}

impl SceneRecord {
    /// Whether the reference is too noisy to judge a mean error by.
    pub fn is_doubtful(&self, relmse: f64) -> bool {
        self.reference.relmse > NOISY_REFERENCE * relmse
    }
}
