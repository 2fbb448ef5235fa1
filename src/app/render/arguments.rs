//! What `lucerna render` accepts.

use clap::Args;

use crate::app::shared::quality::Quality;
use crate::app::shared::scene::SceneFlags;
use crate::app::shared::values::{MORE, error, output, seconds};
use crate::image::Output;

#[derive(Debug, Args)]
#[command(after_help = MORE, allow_negative_numbers = true)]
pub struct RenderArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// Render until the picture's relMSE is at most this, with 95 % confidence (with --spp or --time: whichever comes first)
    #[arg(long, value_name = "RELMSE", value_parser = error)]
    pub error: Option<f64>,
    /// Render for so many seconds instead (with --spp or --error: whichever comes first)
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time: Option<f64>,
    /// How good the picture is to be [default: the scene's number of samples, else good]
    #[arg(long, value_enum, conflicts_with_all = ["spp", "time", "error"])]
    pub quality: Option<Quality>,
    /// Write to this file: .png, .exr or .json; may be given several times [default: result/SCENE.png, .exr and .json]
    #[arg(short, value_name = "FILE", value_parser = output)]
    pub output: Vec<Output>,
    /// Tell where the picture's error comes from: which light, by which way, at which bounce
    #[arg(long)]
    pub sources: bool,
    /// Tell where the picture hangs on single bright samples, by a mean that leaves them out; the picture stays what it is
    #[arg(long)]
    pub robust: bool,
    /// Print where the time went, phase by phase and pass by pass
    #[arg(long)]
    pub stats: bool,
    /// Print the report to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}
