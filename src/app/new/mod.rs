//! `lucerna new`: a scene file for a model, framed and lit, to be edited.

pub mod template;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::app::shared::describe::quoted;
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::files;
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
    let path = scene_path(&arguments.name)?;
    if path.exists() && !arguments.force {
        let message = format!("{}: is there already", path.display());
        return Err(Failure::usage(message, "choose another name, or write over it with --force"));
    }
    let model = match &arguments.model {
        Some(model) => model.clone(),
        None => default_model(&path)?,
    };
    if has_ending(&model, "ron") {
        let message = format!("{}: is a scene file, and no model", model.display());
        return Err(Failure::usage(message, "name a model: lucerna new NAME MODEL.obj"));
    }
    let loaded = scene::load(&model, &[Define::given("film.size", SIZE)])?;
    loaded.warnings.iter().for_each(|warning| show(warning));
    file::prepare(&path)?;
    let named = files::relative(&model, path.parent().unwrap_or(Path::new("")));
    file::write_text(
        &path,
        &template::scene(&named, ("front", &template::rounded(&loaded.description)), &loaded.description),
    )?;
    let name = quoted(&path.display().to_string());
    output::print(&format!(
        "{}: all of {} in view, {} materials\n  next: lucerna view {name}, and edit it while it is shown; or lucerna render {name}\n",
        path.display(),
        model.display(),
        loaded.description.materials.len(),
    ))?;
    Ok(Exit::Done)
}

/// The file of a scene's name.
fn scene_path(name: &Path) -> Result<PathBuf, Failure> {
    let refused = |message: &str, help: String| Failure::usage(format!("{}: {message}", name.display()), help);
    if has_ending(name, "obj") {
        let stem = quoted(&name.file_stem().unwrap_or_default().to_string_lossy());
        let help = format!("for this model: lucerna new {stem} {}", quoted(&name.display().to_string()));
        return Err(refused("is a model's name, and no scene's", help));
    }
    let whole = name.to_string_lossy();
    let last = whole.rsplit(std::path::is_separator).next().unwrap_or_default();
    if last.is_empty() || last.starts_with('.') {
        let help = "name the scene: lucerna new NAME MODEL.obj".to_owned();
        return Err(refused("is no name of a file that is seen", help));
    }
    Ok(if has_ending(name, "ron") { name.to_path_buf() } else { with_ending(name, "ron") })
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
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
