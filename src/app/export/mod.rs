//! `lucerna export`: a scene as another program reads it.

pub mod mitsuba;

use std::path::PathBuf;

use clap::Args;

use crate::app::shared::output::{self, Unplaced};
use crate::app::shared::scene::SceneFlags;
use crate::app::shared::settings::SettingFlags;
use crate::app::shared::values::{MORE, define};
use crate::app::{Exit, Failure};
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
    let refused = |error| Failure::of(Unplaced::by("--mitsuba DIR")(error));
    mitsuba::prepare(folder).map_err(refused)?;
    let opened = flags.open(&arguments.scene, arguments.quiet)?;
    mitsuba::spare(folder, &opened.files).map_err(refused)?;
    let exported = mitsuba::export(&opened.description, scene::audit(&opened.path), folder);
    let exported = exported.map_err(refused)?;
    output::print(&told(&exported))?;
    Ok(Exit::Done)
}

/// What was written, and how it differs.
pub fn told(exported: &Exported) -> String {
    let Exported { scene, meshes, lights, notes } = exported;
    let count = |number: &usize, one: &str, many: &str| format!("{number} {}", if *number == 1 { one } else { many });
    let (meshes, lights) = (count(meshes, "mesh", "meshes"), count(lights, "light", "lights"));
    let mut text = format!("{}: {meshes}, {lights}\n", scene.display());
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
