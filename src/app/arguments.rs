//! The commands that there are. What each accepts stands with the command.

use clap::{Parser, Subcommand};

use super::animate::AnimateArguments;
use super::bench::BenchArguments;
use super::check::CheckArguments;
use super::compare::CompareArguments;
use super::edits::EditsArguments;
use super::export::ExportArguments;
use super::help::HelpArguments;
use super::judge::JudgeArguments;
use super::new::NewArguments;
use super::render::RenderArguments;
use super::replay::ReplayArguments;
use super::schema::SchemaArguments;
use super::shared::values::MORE;
use super::stress::StressArguments;
use super::variants::VariantsArguments;
use super::watch::WatchArguments;
use super::window::ViewArguments;

/// A GPU path tracer.
#[derive(Debug, Parser)]
#[command(name = "lucerna", version, after_help = MORE, disable_help_flag = true, disable_help_subcommand = true)]
pub struct Arguments {
    /// Print help
    // The short one, a line a flag: `lucerna help COMMAND` has the long one.
    #[arg(short, long, global = true, action = clap::ArgAction::HelpShort)]
    help: Option<bool>,
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
    /// Trace one sample of a pixel again, and tell what happens at each vertex of its path
    Replay(Box<ReplayArguments>),
    /// Write a scene file for a model, framed and lit, ready to edit
    New(NewArguments),
    /// Render while shaders and scene files are edited, and tell what came of every save
    Watch(WatchArguments),
    /// Render a family of scenes that a file describes, doing only what differs again
    Variants(Box<VariantsArguments>),
    /// Render the frames of a scene that changes with time, and a movie of them
    Animate(Box<AnimateArguments>),
    /// Write a scene as another program reads it, and say what is otherwise there
    Export(Box<ExportArguments>),
    /// Compare a picture with a reference
    Compare(CompareArguments),
    /// Check assets and shaders without rendering
    Check(CheckArguments),
    /// Print what scene and variant files may hold, as JSON schemas
    Schema(SchemaArguments),
    /// Say what there is to draw with, and what is missing
    Doctor,
    /// Print what a command takes, or a topic: exit-codes, paths (of -D), keys (of the window)
    Help(HelpArguments),
    /// Measure how the error of scenes falls with samples and time, or time single stages of the engine
    Bench(Box<BenchArguments>),
    /// Tell whether an edit of the shaders made the estimator better, worse or wrong
    Judge(Box<JudgeArguments>),
    /// Measure what must hold of the numbers: watertight meshes, known answers, estimators that agree
    Stress(StressArguments),
    /// List what was saved while windows were open, or write the shaders of an edit to a folder
    Edits(EditsArguments),
}
