//! The scene that a command line names, and what it says over the scene's file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;

use super::failure::{Failure, show};
use super::parameters;
use super::pictures::watch_pictures;
use super::settings::SettingFlags;
use super::values::define;
use crate::scene::settings::Settings;
use crate::scene::{self, Define, Loading, SceneDescription, SceneText, ShaderPlace};
use crate::shader::{Layers, Library};
use crate::watch::{Adjust, SceneSource, Sources, WatchedScene};

/// What every command that draws a scene takes beside its name.
#[derive(Args, Clone, Debug, Default)]
pub struct SceneFlags {
    #[command(flatten)]
    pub settings: SettingFlags,
    /// A camera of the scene, by its name
    // Help texts have it before the seed.
    #[arg(long, value_name = "NAME", display_order = 3)]
    pub camera: Option<String>,
    /// Change a value of the scene file, such as -D materials.ball.ns=64, or set a parameter of a shader, -D shader.NAME=2
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = define)]
    pub define: Vec<Define>,
    /// The folder of shaders [default: ./shaders where there is one, else those that were built in]
    #[arg(long, value_name = "DIR")]
    pub shaders: Option<PathBuf>,
}

/// A scene, read.
#[derive(Clone, Debug)]
pub struct Opened {
    pub path: PathBuf,
    /// With what the command line says over it.
    pub description: SceneDescription,
    /// The scene's own file, as it was read for that.
    pub text: SceneText,
    /// Every file that was read.
    pub files: Vec<PathBuf>,
    /// Where shaders' parameters are set, by their names.
    pub shader_places: BTreeMap<String, ShaderPlace>,
    /// Samples a pixel, where the scene or the command line gives them.
    pub spp: Option<u32>,
}

impl SceneFlags {
    /// Finds the scene of a name or path, reads it, shows its warnings unless `quiet`, and applies the flags.
    pub fn open(&self, name: &str, quiet: bool) -> Result<Opened, Failure> {
        let path = scene::find(name)?;
        let tell = watch_pictures(quiet);
        let loaded = scene::load_with(&path, &self.define, &Loading { tell: &tell, ..Loading::default() })?;
        if !quiet {
            loaded.warnings.iter().for_each(|warning| show(warning));
        }
        let mut description = loaded.description;
        self.adjust(&mut description)?;
        let unseen = scene::unseen_by(&description, &description.active, &path);
        if let Some(warning) = unseen.filter(|warning| !quiet && !loaded.warnings.contains(warning)) {
            show(&warning);
        }
        let gives_spp = loaded.given.contains("spp") || self.settings.gives("spp");
        let spp = gives_spp.then_some(description.render.spp);
        let (text, files, shader_places) = (loaded.text, loaded.files, loaded.shader_places);
        Ok(Opened { path, description, text, files, shader_places, spp })
    }

    /// Whether the command line says how many samples a pixel is to get.
    pub fn gives_samples(&self) -> bool {
        self.settings.gives("spp") || self.define.iter().any(|define| define.path == "render.spp")
    }

    /// The shaders to draw a scene with, which are to have the parameters that it sets.
    pub fn library(&self, opened: &Opened) -> Result<Library, Failure> {
        let library = match self.shader_folder() {
            Some(folder) => Library::open(folder)?,
            None => Library::embedded(),
        };
        parameters::check(&opened.description.shader, &opened.shader_places, &library)?;
        Ok(library)
    }

    /// What an engine that runs the scene with `library` is to watch.
    pub fn sources(&self, opened: Opened, library: Library) -> Sources {
        let Opened { path, description, text, files, .. } = opened;
        let watched = WatchedScene::file(path, self.define.clone(), self.adjusting());
        Sources {
            shaders: self.shader_folder().map(|folder| (Layers::folder(folder), library)),
            scene: Some(SceneSource { watched, description, text, files }),
        }
    }

    /// What the flags say over a scene that was read again. One that does not fit the edited scene is left out: the rest of the scene is
    /// worth seeing.
    pub fn adjusting(&self) -> Adjust {
        let flags = self.clone();
        Box::new(move |description: &mut SceneDescription| drop(flags.adjust(description)))
    }

    /// The folder of shaders; none where the built-in ones are drawn with.
    pub fn shader_folder(&self) -> Option<&Path> {
        self.shaders.as_deref().or_else(|| Library::local_folder())
    }

    /// Applies the flags to the scene, over what its file and the defines say.
    pub fn adjust(&self, description: &mut SceneDescription) -> Result<(), Failure> {
        if let Some(name) = &self.camera {
            choose_camera(description, name)?;
        }
        let mut settings = Settings { film: description.film, render: description.render };
        self.settings.apply(&mut settings);
        let size = description.film.size;
        Settings { film: description.film, render: description.render } = settings;
        scene::reframe(description, size);
        let film = &description.film;
        if let Some(crop) = film.crop
            && crop.max.cmpgt(film.size).any()
        {
            let [x0, x1, y0, y1] = [crop.min.x, crop.max.x, crop.min.y, crop.max.y];
            let (message, help) = match self.settings.gives("crop") {
                true => ("--crop", "choose a part of the picture, or a larger --size"),
                false => ("the scene's crop", "give a --crop that fits the --size"),
            };
            let message =
                format!("{message} {x0},{x1},{y0},{y1} reaches beyond the picture of {}x{}", film.size.x, film.size.y);
            return Err(Failure::usage(message, help));
        }
        Ok(())
    }
}

/// Renders by the camera of a name.
pub fn choose_camera(description: &mut SceneDescription, name: &str) -> Result<(), Failure> {
    if !description.cameras.contains_key(name) {
        let names: Vec<&str> = description.cameras.keys().map(String::as_str).collect();
        let help = format!("its cameras are: {}", names.join(", "));
        return Err(Failure::usage(format!("--camera: the scene has no camera `{name}`"), help));
    }
    description.active = name.to_owned();
    Ok(())
}
