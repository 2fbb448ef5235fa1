//! What `lucerna stress` takes.

use std::path::PathBuf;

use clap::Args;

use crate::app::shared::values::{MORE, seconds};

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct StressArguments {
    /// As much as it takes to be sure: minutes on a GPU, hours on a processor
    #[arg(long, conflicts_with = "planted")]
    pub full: bool,
    /// Only rows whose name begins so; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Say what each row is about, and measure nothing
    #[arg(long)]
    pub list: bool,
    /// Put mistakes into the shaders one by one, and say which rows see them
    #[arg(long)]
    pub planted: bool,
    /// Measure the shaders of this folder; default ./shaders where there is one, else those built in
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
    /// Begin random-edits with this seed, as a row that failed says
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Make random-edits for so long
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time: Option<f64>,
    /// The table as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Write the table to this file, as JSON
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// No progress
    #[arg(long)]
    pub quiet: bool,
}
