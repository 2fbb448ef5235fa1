//! What `lucerna bench` accepts, and which benchmark it runs.

use clap::{Args, Subcommand};

use super::light::{self, LightArguments};
use super::peers::{self, PeersArguments};
use super::skip::{self, SkipArguments};
use super::{LEAST_RUNS, build, extend, sort};
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::gpu::Gpu;

#[derive(Debug, Args)]
#[command(after_help = MORE, args_conflicts_with_subcommands = true)]
pub struct BenchArguments {
    #[command(subcommand)]
    pub command: Option<BenchCommand>,
    #[command(flatten)]
    pub light: LightArguments,
}

#[derive(Debug, Subcommand)]
pub enum BenchCommand {
    /// Measure how the error of scenes falls with samples and time: what `bench` does by itself
    Scenes(LightArguments),
    /// Measure how soon this and Mitsuba 3 come to an error, on the same scenes
    Peers(PeersArguments),
    /// Measure what scenes save by leaving out of the kernels what they do not need
    Skip(SkipArguments),
    /// Sort pairs of random 63-bit keys and 32-bit payloads
    Sort {
        /// Numbers of pairs
        #[arg(long = "n", value_name = "N,..", value_delimiter = ',', value_parser = count, default_value = "1Mi,8Mi")]
        counts: Vec<u32>,
        #[command(flatten)]
        how: StageArguments,
    },
    /// Build the tree of generated triangles
    Build {
        /// Numbers of triangles
        #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = count, default_value = "100k,1M")]
        triangles: Vec<u32>,
        #[command(flatten)]
        how: StageArguments,
    },
    /// Ask for hits: primary and diffuse-bounce rays into generated spheres
    Extend {
        /// Numbers of triangles
        #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = count, default_value = "100k,1M")]
        triangles: Vec<u32>,
        #[command(flatten)]
        how: StageArguments,
    },
}

#[derive(Debug, Args)]
pub struct StageArguments {
    /// Timed runs after warm-up, at least 10
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(i64::from(LEAST_RUNS)..=100_000))]
    pub runs: u32,
    /// Print one JSON object instead of a table
    #[arg(long)]
    pub json: bool,
}

impl BenchArguments {
    /// Runs the benchmark; a single stage's on a device that is opened for it.
    pub fn run(self) -> Result<Exit, Failure> {
        match self.command {
            None => light::run(&self.light),
            Some(BenchCommand::Scenes(light)) => light::run(&light),
            Some(BenchCommand::Peers(peers)) => peers::run(&peers),
            Some(BenchCommand::Skip(skip)) => skip::run(&skip),
            Some(BenchCommand::Sort { counts, how }) => {
                sort::run(Gpu::open()?, &counts, how.runs, how.json)?;
                Ok(Exit::Done)
            }
            Some(BenchCommand::Build { triangles, how }) => {
                build::run(Gpu::open()?, &triangles, how.runs, how.json)?;
                Ok(Exit::Done)
            }
            Some(BenchCommand::Extend { triangles, how }) => {
                extend::run(Gpu::open()?, &triangles, how.runs, how.json)?;
                Ok(Exit::Done)
            }
        }
    }
}

/// A number, as `1000000`, `1_000_000`, `1M` or `1Mi` (2^20).
fn count(text: &str) -> Result<u32, String> {
    let units = [("Ki", 1u64 << 10), ("Mi", 1 << 20), ("k", 1000), ("M", 1_000_000)];
    let (digits, unit) =
        units.iter().find_map(|(suffix, unit)| Some((text.strip_suffix(suffix)?, *unit))).unwrap_or((text, 1));
    let number = digits.replace('_', "").parse::<u64>().ok().and_then(|n| n.checked_mul(unit));
    match number.and_then(|n| u32::try_from(n).ok()) {
        Some(n) if (1..=1 << 30).contains(&n) => Ok(n),
        _ => Err("expected a whole number from 1 to 1024Mi, such as 1000000, 1M or 1Mi (2^20)".into()),
    }
}
