//! `lucerna new`: a scene file for a model, framed and lit, to be edited.

mod paths;
mod template;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::app::shared::describe::quoted;
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::image::file;
use crate::scene::{self, Define};

/// The model where none is named, and none of the scene's name is there.
const MODEL: &str = "assets/models/teapot.obj";

/// The size of its pictures, as a define has it.
const SIZE: &str = "(800, 600)";

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct NewArguments {
    /// The scene's name or path: NAME.ron is written
    pub name: PathBuf,
    /// The model (.obj) [default: NAME.obj beside it, else Newell's teapot]
    pub model: Option<PathBuf>,
    /// Write over a file that is there
    #[arg(long)]
    pub force: bool,
}

/// Reads the model, writes the scene, and says what to do next.
pub fn run(arguments: &NewArguments) -> Result<Exit, Failure> {
    let path = match arguments.name.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("ron") => arguments.name.clone(),
        _ => with_ending(&arguments.name, "ron"),
    };
    if path.exists() && !arguments.force {
        let message = format!("{}: is there already", path.display());
        return Err(Failure::usage(message, "choose another name, or write over it with --force"));
    }
    let model = match &arguments.model {
        Some(model) => model.clone(),
        None => default_model(&path)?,
    };
    let loaded = scene::load(&model, &[Define::given("film.size", SIZE)])?;
    loaded.warnings.iter().for_each(|warning| show(warning));
    file::prepare(&path)?;
    let named = paths::relative(&model, path.parent().unwrap_or(Path::new("")));
    file::write_text(&path, &template::scene(&named, &loaded.description))?;
    let name = quoted(&path.display().to_string());
    output::print(&format!(
        "{}: all of {} in view, {} materials\n  next: lucerna view {name}, and edit it while it is shown; or lucerna render {name}\n",
        path.display(),
        model.display(),
        loaded.description.materials.len(),
    ))?;
    Ok(Exit::Done)
}

/// The model of the scene's name beside it; else the teapot, where this program finds it.
fn default_model(scene: &Path) -> Result<PathBuf, Failure> {
    let beside = scene.with_extension("obj");
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join(MODEL);
    let found = [beside.clone(), PathBuf::from(MODEL), sources].into_iter().find(|model| model.is_file());
    found.ok_or_else(|| {
        let message = format!("there is no {}, and no model is named", beside.display());
        Failure::usage(message, "name one: lucerna new NAME MODEL.obj")
    })
}

/// A path with an ending behind whatever it has.
fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}
