//! What the command line accepts. Whatever is out of range is refused here, with exit code 2.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use glam::UVec2;

use super::bench::light::{self, LightArguments};
use super::compare::CompareArguments;
use super::judge::JudgeArguments;
use super::scene::SceneFlags;
use super::{Exit, Failure, bench};
use crate::components::{Crop, Film};
use crate::gpu::Gpu;
use crate::image::Output;
use crate::scene::settings::MOST_STOPS;

/// What ends every help text.
pub const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    wrong input, or an error on the way
  2    the command line means nothing
  3    no graphics adapter that can be used: see `lucerna doctor`
  4    compared pictures differ by more than a --max flag allows
  5    judged shaders have another mean
  6    whether judged shaders have another mean can't be told yet
  130  interrupted; what there was, if anything, has been written";

/// A GPU path tracer.
#[derive(Debug, Parser)]
#[command(name = "lucerna", version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// Without one, a window on the scene cornell-box, where there is a display
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Open a window on a scene, and move in it
    View(ViewArguments),
    /// Render a scene to PNG, EXR and a report
    Render(RenderArguments),
    /// Render while shaders and scene files are edited, and tell what came of every save
    Watch(WatchArguments),
    /// Compare a picture with a reference
    Compare(CompareArguments),
    /// Check assets and shaders without rendering
    Check(CheckArguments),
    /// Say what there is to draw with, and what is missing
    Doctor,
    /// Measure how the error of scenes falls with samples and time, or time single stages of the engine
    Bench(Box<BenchArguments>),
    /// Tell whether an edit of the shaders made the estimator better, worse or wrong
    Judge(Box<JudgeArguments>),
}

/// The scene that opens where none is named.
pub const DEFAULT_SCENE: &str = "cornell-box";

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, allow_negative_numbers = true)]
pub struct ViewArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    #[arg(default_value = DEFAULT_SCENE)]
    pub scene: String,
    #[command(flatten)]
    pub flags: SceneFlags,
}

impl Default for ViewArguments {
    fn default() -> Self {
        Self { scene: DEFAULT_SCENE.to_owned(), flags: SceneFlags::default() }
    }
}

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, allow_negative_numbers = true)]
pub struct RenderArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// Render for so many seconds instead (with --spp: whichever comes first)
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time: Option<f64>,
    /// Write to this file: .png, .exr or .json; may be given several times [default: result/SCENE.png, .exr and .json]
    #[arg(short, value_name = "FILE", value_parser = output)]
    pub output: Vec<Output>,
    /// Print the time of every pass
    #[arg(long)]
    pub stats: bool,
    /// Print the report to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, allow_negative_numbers = true)]
pub struct WatchArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// No messages on stderr beside the events
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct CheckArguments {
    /// Assets (.ron, .obj, .mtl) or folders of them [default: the folder assets, and all shaders]
    pub paths: Vec<PathBuf>,
}

#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES, args_conflicts_with_subcommands = true)]
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
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(i64::from(bench::LEAST_RUNS)..=100_000))]
    pub runs: u32,
    /// Print one JSON object instead of a table
    #[arg(long)]
    pub json: bool,
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e7 => Ok(seconds),
        _ => Err("expected seconds above 0, at most 1e7".into()),
    }
}

/// An exposure.
pub fn stops(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= MOST_STOPS => Ok(stops),
        _ => Err(format!("expected a number from -{MOST_STOPS} to {MOST_STOPS}")),
    }
}

pub(super) fn size(text: &str) -> Result<UVec2, String> {
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some(UVec2::new(w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some(size) if size.min_element() >= 1 && size.max_element() <= Film::MAX_SIDE => Ok(size),
        _ => Err(format!("expected WIDTHxHEIGHT, each from 1 to {}", Film::MAX_SIDE)),
    }
}

/// A rectangle of pixels.
pub fn crop(text: &str) -> Result<Crop, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x0, x1, y0, y1]) if x0 < x1 && y0 < y1 => Ok(Crop { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) }),
        _ => Err("expected X0,X1,Y0,Y1 in pixels, with X0 < X1 and Y0 < Y1".into()),
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

/// `KEY=VALUE`.
pub fn define(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.to_owned(), value.to_owned())),
        _ => Err("expected KEY=VALUE, such as materials.ball.ns=64".into()),
    }
}

pub(super) fn output(text: &str) -> Result<Output, String> {
    use miette::Diagnostic;
    Output::new(text).map_err(|error| match error.help() {
        Some(help) => format!("{error}; {help}"),
        None => error.to_string(),
    })
}

impl BenchArguments {
    /// Runs the benchmark; a single stage's on a device that is opened for it.
    pub fn run(self) -> Result<Exit, Failure> {
        match self.command {
            None => light::run(&self.light),
            Some(BenchCommand::Scenes(light)) => light::run(&light),
            Some(BenchCommand::Sort { counts, how }) => {
                bench::sort::run(Gpu::open()?, &counts, how.runs, how.json)?;
                Ok(Exit::Done)
            }
            Some(BenchCommand::Build { triangles, how }) => {
                bench::build::run(Gpu::open()?, &triangles, how.runs, how.json)?;
                Ok(Exit::Done)
            }
            Some(BenchCommand::Extend { triangles, how }) => {
                bench::extend::run(Gpu::open()?, &triangles, how.runs, how.json)?;
                Ok(Exit::Done)
            }
        }
    }
}
