//! What `bench [SCENE]...` accepts.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::UVec2;

use super::configuration::{self, Configuration};
use super::measure::Extent;
use crate::app::Failure;
use crate::app::shared::values::size;
use crate::components::Render;
use crate::scene;

/// Samples of a reference for each of a film's, unless said otherwise: its error is 3 % of that of independent samples.
const REFERENCE_FACTOR: u32 = 32;

/// Scenes that are not measured unless they are named: others with the materials that their files have.
const NOT_BY_DEFAULT: &str = "-original";

#[derive(Debug, Args)]
pub struct LightArguments {
    /// Scene files (.ron), models (.obj), or names of files in assets/scenes [default: those not named *-original]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Integrator and sampler, with `roulette`, `reuse` or `adaptive` where these are to be on, joined by `+`
    #[arg(long, value_name = "CONFIG,..", value_delimiter = ',', default_value = configuration::DEFAULT)]
    pub configs: Vec<Configuration>,
    /// Films of each configuration, of as many seeds
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub seeds: u32,
    /// Samples a pixel of each film, which is looked at after 1, 4, 16, .. of them
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(2..=1 << 24))]
    pub spp: u32,
    /// Size of the picture in pixels, each side 1 to 16384 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Segments of the longest path, up to 1024 [default: the scene's]
    #[arg(long, visible_alias = "depth", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(Render::MAX_DEPTH)))]
    pub max_depth: Option<u32>,
    /// What makes the reference
    #[arg(long, value_enum, default_value_t = ReferenceBy::Gpu)]
    pub reference: ReferenceBy,
    /// Samples a pixel of a reference; one of as many or more is used again [default: 32 times --spp]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub reference_spp: Option<u32>,
    /// The bench.json of an earlier run: exit code 1 if anything has become less efficient since
    #[arg(long, value_name = "FILE")]
    pub against: Option<PathBuf>,
    /// With --against, how much less efficient is no matter, percent: clocks and neighbours differ between two runs
    #[arg(long, value_name = "PERCENT", default_value_t = 5.0, value_parser = percent)]
    pub tolerance: f64,
    /// Folder to write to
    #[arg(long, value_name = "DIR", default_value = "result/bench")]
    pub out: PathBuf,
    /// Print bench.json to stdout instead of its table
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

/// What makes references.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ReferenceBy {
    /// This renderer, with independent samples and without roulette
    Gpu,
    /// The path tracer in double precision on the processor
    Cpu,
}

impl LightArguments {
    /// The scenes that were named, or all there are.
    pub fn scenes(&self) -> Result<Vec<String>, Failure> {
        if !self.scenes.is_empty() {
            return Ok(self.scenes.clone());
        }
        let names: Vec<String> = scene::names().into_iter().filter(|name| !name.ends_with(NOT_BY_DEFAULT)).collect();
        if names.is_empty() {
            return Err(Failure::usage("there are no scenes in assets/scenes", "name scene files"));
        }
        Ok(names)
    }

    pub fn extent(&self) -> Extent {
        Extent { seeds: self.seeds, spp: self.spp }
    }

    pub fn reference_spp(&self) -> u32 {
        self.reference_spp.unwrap_or(self.spp.saturating_mul(REFERENCE_FACTOR))
    }
}

fn percent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(percent) if (0.0..=1000.0).contains(&percent) => Ok(percent),
        _ => Err("expected percent from 0 to 1000".into()),
    }
}
