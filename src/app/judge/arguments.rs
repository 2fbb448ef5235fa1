//! What `judge` accepts.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use glam::UVec2;

use super::commits::Commits;
use super::core::{Plan, WITHIN};
use crate::app::shared::tracer::STEP;
use crate::app::shared::values::{MORE, define, output, seconds, size};
use crate::image::Output;
use crate::scene::Define;

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct JudgeArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    /// Folder of the shaders to judge by [default: those this program was built with]
    #[arg(long, value_name = "DIR")]
    pub old: Option<PathBuf>,
    /// Folder of the shaders to be judged
    #[arg(long, value_name = "DIR", default_value = "shaders")]
    pub new: PathBuf,
    /// Judge a commit by another, A..B (HEAD where one is left out), or the folder by the commit A: --new names the folder
    #[arg(long, value_name = "A..B", conflicts_with = "old")]
    pub git: Option<Commits>,
    /// End as `git bisect run` asks: 0 means agree, 1 they differ, 125 can't be told, 128 and above nothing can be judged
    #[arg(long)]
    pub bisect: bool,
    /// End after so many seconds, compiling included, unless all is clear before [default: 30, without --films]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time: Option<f64>,
    /// Trace so many films of each, unless all is clear before (with --time: whichever comes first)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(4..=1 << 24))]
    pub films: Option<u32>,
    /// Samples a pixel of each film [default: a power of two, so that the time, or half a minute, is enough for 192 films]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub spp: Option<u32>,
    /// Size of the picture in pixels, each side 1 to 16384 [default: the scene's, halved until the time is enough]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// A camera of the scene, by its name
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Seed of all random numbers; films of both have seeds of their own that follow from it
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u32,
    /// Probability that equal means are called different
    #[arg(long, value_name = "P", default_value = "1e-3", value_parser = alpha)]
    pub alpha: f64,
    /// Say nothing of efficiency before a difference of so many percent of the whole picture would have been found [default: 0.5]
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    pub within: Option<f64>,
    /// Judge even if the scene runs the same code by both
    #[arg(long)]
    pub force: bool,
    /// Change a value of the scene file, such as -D materials.ball.ns=64
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = define)]
    pub define: Vec<Define>,
    /// Write the new picture: .png with the blocks marked that differ, .exr, or .json (all that --json prints)
    #[arg(short, value_name = "FILE", value_parser = output)]
    pub output: Vec<Output>,
    /// Print all that was found to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

impl JudgeArguments {
    /// The time counts from `begin`.
    pub fn plan(&self, begin: Instant) -> Plan {
        Plan {
            spp: self.spp,
            whole: self.size.is_some(),
            begin,
            seconds: self.time,
            films: self.films,
            alpha: self.alpha,
            within: self.within.map_or(WITHIN, |percent| 0.01 * percent),
            seed: self.seed,
            batch: STEP,
        }
    }
}

fn alpha(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(alpha) if (1e-12..=0.5).contains(&alpha) => Ok(alpha),
        _ => Err("expected a probability from 1e-12 to 0.5".into()),
    }
}

fn percent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(percent) if (1e-3..=100.0).contains(&percent) => Ok(percent),
        _ => Err("expected percent from 0.001 to 100".into()),
    }
}
