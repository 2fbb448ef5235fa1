//! What `lucerna replay` accepts.

use std::path::PathBuf;

use clap::{Args, value_parser};
use glam::UVec2;

use crate::app::shared::scene::SceneFlags;
use crate::app::shared::values::{MORE, pixel};
use crate::layout::film::MOST_SAMPLES;

#[derive(Debug, Args)]
#[command(after_help = MORE, allow_negative_numbers = true)]
pub struct ReplayArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    /// The pixel of the whole picture, counted from 0, from the left and the top
    #[arg(long, value_name = "X,Y", value_parser = pixel, required = true, allow_hyphen_values = true)]
    pub pixel: UVec2,
    /// Which of the pixel's samples, counted from 0
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(..i64::from(MOST_SAMPLES)), default_value_t = 0)]
    pub sample: u32,
    #[command(flatten)]
    pub flags: SceneFlags,
    /// Write the scene with its files, the shaders and the command to this folder, so that the path can be replayed elsewhere
    #[arg(long, value_name = "DIR")]
    pub bundle: Option<PathBuf>,
    /// Print all of it to stdout as one JSON object, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// No warnings of the scene
    #[arg(long, short)]
    pub quiet: bool,
}
