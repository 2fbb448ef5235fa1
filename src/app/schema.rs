//! `lucerna schema`: what scene and variant files may hold, for programs.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::app::shared::output;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::scene::schema;

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct SchemaArguments {
    /// Of which files
    #[arg(value_enum, default_value_t = Files::Scene)]
    pub files: Files,
    /// Print this scene or variant file as the JSON that its schema describes, instead
    #[arg(long, value_name = "FILE", conflicts_with = "files")]
    pub of: Option<PathBuf>,
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Files {
    /// Scene files
    Scene,
    /// Variant files
    Variants,
}

/// Prints a JSON schema, or a file as JSON.
pub fn run(arguments: &SchemaArguments) -> Result<Exit, Failure> {
    let value = match (&arguments.of, arguments.files) {
        (Some(path), _) => schema::document(path)?,
        (None, Files::Scene) => schema::scene().to_value(),
        (None, Files::Variants) => schema::variants().to_value(),
    };
    output::print(&format!("{value:#}\n"))?;
    Ok(Exit::Done)
}
