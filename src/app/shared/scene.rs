//! The scene that a command line names, and what it says over the scene's file.

use std::path::{Path, PathBuf};

use clap::Args;
use glam::UVec2;

use super::failure::{Failure, show};
use super::values::{IntegratorName, SamplerName, Switch, crop, define, size, stops};
use crate::components::{Crop, Render};
use crate::scene::{self, SceneDescription};
use crate::shader::{Library, ShaderError};
use crate::watch::{Sources, WatchedScene};

/// What every command that draws a scene takes beside its name.
#[derive(Args, Clone, Debug, Default)]
pub struct SceneFlags {
    /// Samples a pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: Option<u32>,
    /// Size of the whole picture in pixels, each side 1 to 16384
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Render this part only: pixels from X0 up to but not X1, from Y0 up to but not Y1, from the top left
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = crop, allow_hyphen_values = true)]
    pub crop: Option<Crop>,
    /// A camera of the scene, by its name
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Seed of all random numbers
    #[arg(long, value_name = "N")]
    pub seed: Option<u32>,
    /// How light is estimated
    #[arg(long, value_enum)]
    pub integrator: Option<IntegratorName>,
    /// Where the random numbers of a sample come from
    #[arg(long, value_enum)]
    pub sampler: Option<SamplerName>,
    /// Segments of the longest path: 1 sees emitters only, up to 1024
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(Render::MAX_DEPTH)))]
    pub max_depth: Option<u32>,
    /// End paths of little throughput early (unbiased)
    #[arg(long, value_enum)]
    pub roulette: Option<Switch>,
    /// Brighten by so many stops, -64 to 64
    #[arg(long, value_name = "STOPS", value_parser = stops, allow_hyphen_values = true)]
    pub exposure: Option<f32>,
    /// Change a value of the scene file, such as -D materials.ball.ns=64
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = define)]
    pub define: Vec<(String, String)>,
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
    /// Every file that was read.
    pub files: Vec<PathBuf>,
}

impl SceneFlags {
    /// Finds the scene of a name or path, reads it, shows its warnings unless `quiet`, and applies the flags.
    pub fn open(&self, name: &str, quiet: bool) -> Result<Opened, Failure> {
        let path = scene::find(name)?;
        let loaded = scene::load(&path, &self.define)?;
        if !quiet {
            loaded.warnings.iter().for_each(|warning| show(warning));
        }
        let mut description = loaded.description;
        self.adjust(&mut description)?;
        let unseen = scene::unseen_by(&description, &description.active, &path);
        if let Some(warning) = unseen.filter(|warning| !quiet && !loaded.warnings.contains(warning)) {
            show(&warning);
        }
        Ok(Opened { path, description, files: loaded.files })
    }

    /// The shaders to draw with.
    pub fn library(&self) -> Result<Library, ShaderError> {
        match self.shader_folder() {
            Some(folder) => Library::open(folder),
            None => Ok(Library::embedded()),
        }
    }

    /// What an engine that runs the scene with `library` is to watch.
    pub fn sources(&self, opened: Opened, library: Library) -> Sources {
        let flags = self.clone();
        // A flag that does not fit the edited scene is left out: the rest of the scene is worth seeing.
        let adjust = Box::new(move |description: &mut SceneDescription| drop(flags.adjust(description)));
        let file = WatchedScene { path: opened.path, defines: self.define.clone(), adjust };
        Sources {
            shaders: self.shader_folder().map(|folder| (folder.to_path_buf(), library)),
            scene: Some((file, opened.description, opened.files)),
        }
    }

    fn shader_folder(&self) -> Option<&Path> {
        self.shaders.as_deref().or_else(|| Library::local_folder())
    }

    /// Applies the flags to the scene, over what its file and the defines say.
    fn adjust(&self, description: &mut SceneDescription) -> Result<(), Failure> {
        if let Some(name) = &self.camera {
            choose_camera(description, name)?;
        }
        let (film, render) = (&mut description.film, &mut description.render);
        film.size = self.size.unwrap_or(film.size);
        film.crop = self.crop.or(film.crop);
        film.exposure = self.exposure.unwrap_or(film.exposure);
        if let Some(crop) = film.crop
            && crop.max.cmpgt(film.size).any()
        {
            let [x0, x1, y0, y1] = [crop.min.x, crop.max.x, crop.min.y, crop.max.y];
            let (message, help) = match self.crop {
                Some(_) => ("--crop", "choose a part of the picture, or a larger --size"),
                None => ("the scene's crop", "give a --crop that fits the --size"),
            };
            let message =
                format!("{message} {x0},{x1},{y0},{y1} reaches beyond the picture of {}x{}", film.size.x, film.size.y);
            return Err(Failure::usage(message, help));
        }
        render.spp = self.spp.unwrap_or(render.spp);
        render.seed = self.seed.unwrap_or(render.seed);
        render.integrator = self.integrator.map_or(render.integrator, Into::into);
        render.sampler = self.sampler.map_or(render.sampler, Into::into);
        render.max_depth = self.max_depth.unwrap_or(render.max_depth);
        render.roulette = self.roulette.map_or(render.roulette, |switch| switch == Switch::On);
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
