//! What `bench peers` accepts.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::UVec2;

use crate::app::bench::light::configuration::Configuration;
use crate::app::shared::values::size;
use crate::components::Render;

#[derive(Debug, Args)]
pub struct PeersArguments {
    /// Scene files (.ron), models (.obj), or names of files in assets/scenes
    #[arg(value_name = "SCENE", default_value = "cornell-data")]
    pub scenes: Vec<String>,
    /// A Python that has Mitsuba 3 [default: python3 or python, if one has]
    #[arg(long, value_name = "PYTHON")]
    pub peer: Option<PathBuf>,
    /// Mitsuba's variant [default: cuda_ad_rgb; on an adapter that is the processor, llvm_ad_rgb]
    #[arg(long, value_enum)]
    pub variant: Option<Variant>,
    /// The relMSE down to which both are measured, 1e-6 to 1
    #[arg(long, value_name = "ERROR", default_value_t = 1e-3, value_parser = target)]
    pub to: f64,
    /// Pictures of each by turns, of as many seeds, beside one that does not count
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(2..=100))]
    pub runs: u32,
    /// How Lucerna estimates light: integrator and sampler, with `roulette`, `reuse` or `adaptive` where these are to be on, joined by `+`
    #[arg(long, value_name = "CONFIG,..", value_delimiter = ',', default_value = "path+sobol")]
    pub configs: Vec<Configuration>,
    /// Size of the picture in pixels, each side 1 to 16384 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Segments of the longest path, up to 1024 [default: the scene's]
    #[arg(long, visible_alias = "depth", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(Render::MAX_DEPTH)))]
    pub max_depth: Option<u32>,
    /// Samples a pixel of each of both references [default: enough for --to]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1 << 24))]
    pub reference_spp: Option<u32>,
    /// Folder to write to
    #[arg(long, value_name = "DIR", default_value = "result/peers")]
    pub out: PathBuf,
    /// Print peers.json to stdout instead of its table
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

/// Mitsuba's variants of linear Rec.709.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Variant {
    /// On an NVIDIA GPU, through CUDA and OptiX
    #[value(name = "cuda_ad_rgb")]
    Cuda,
    /// Compiled for the processor; needs libLLVM, which DRJIT_LIBLLVM_PATH can name
    #[value(name = "llvm_ad_rgb")]
    Llvm,
    /// On the processor, without a compiler
    #[value(name = "scalar_rgb")]
    Scalar,
}

impl Variant {
    /// As Mitsuba calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cuda => "cuda_ad_rgb",
            Self::Llvm => "llvm_ad_rgb",
            Self::Scalar => "scalar_rgb",
        }
    }
}

fn target(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if (1e-6..=1.0).contains(&error) => Ok(error),
        _ => Err("expected a relMSE from 1e-6 to 1, such as 1e-3".into()),
    }
}
