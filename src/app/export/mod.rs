//! `lucerna export`: a scene as another program reads it.

pub mod mitsuba;

use std::path::PathBuf;

use clap::Args;

use crate::app::shared::output;
use crate::app::shared::scene::SceneFlags;
use crate::app::shared::settings::SettingFlags;
use crate::app::shared::values::{MORE, define};
use crate::app::{Exit, Failure};
use crate::image::SaveError;
use crate::scene::{self, Define};
use mitsuba::{Exported, Weight};

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct ExportArguments {
    /// A scene file (.ron), a model (.obj), or the name of a file in assets/scenes
    pub scene: String,
    /// Folder to write scene.xml to, and the meshes and pictures that it needs
    #[arg(long, value_name = "DIR", required = true)]
    pub mitsuba: PathBuf,
    #[command(flatten)]
    pub settings: SettingFlags,
    /// A camera of the scene, by its name
    #[arg(long, value_name = "NAME", display_order = 3)]
    pub camera: Option<String>,
    /// Change a value of the scene file, such as -D materials.ball.ns=64
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = define)]
    pub define: Vec<Define>,
    /// No warnings of the scene
    #[arg(long, short)]
    pub quiet: bool,
}

/// Writes the scene, and says what is otherwise there than here.
pub fn run(arguments: &ExportArguments) -> Result<Exit, Failure> {
    let flags = SceneFlags {
        settings: arguments.settings.clone(),
        camera: arguments.camera.clone(),
        define: arguments.define.clone(),
        shaders: None,
    };
    let folder = &arguments.mitsuba;
    mitsuba::prepare(folder).map_err(unwritten)?;
    let opened = flags.open(&arguments.scene, arguments.quiet)?;
    mitsuba::spare(folder, &opened.files).map_err(unwritten)?;
    let exported = mitsuba::export(&opened.description, scene::audit(&opened.path), folder).map_err(unwritten)?;
    output::print(&told(&exported))?;
    Ok(Exit::Done)
}

/// Why nothing was exported. Its file can't be chosen, but its folder.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{0}")]
#[diagnostic(help("choose another folder with --mitsuba DIR, or make room there"))]
struct Unwritten(SaveError);

fn unwritten(error: SaveError) -> Failure {
    Failure::of(Unwritten(error))
}

/// What was written, and how it differs.
pub fn told(exported: &Exported) -> String {
    let Exported { scene, meshes, lights, notes } = exported;
    let count = |number: &usize, what: &str| format!("{number} {what}{}", if *number == 1 { "" } else { "s" });
    let mut text = format!(
        "{}: {}, {}\n",
        scene.display(),
        count(meshes, "mesh").replace("meshs", "meshes"),
        count(lights, "light")
    );
    let mut list = |head: &str, weight: Weight| {
        let lines: String =
            notes.iter().filter(|note| note.weight == weight).map(|note| format!("  {note}\n")).collect();
        if !lines.is_empty() {
            text += &format!("{head}\n{lines}");
        }
    };
    list("not the same picture, for Mitsuba has nothing that is alike:", Weight::Another);
    list("told apart by a close look alone:", Weight::Slight);
    text
}
