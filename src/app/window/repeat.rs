//! The command that gives again, without a window, what one shows.

use std::path::Path;

use glam::UVec2;

use crate::app::shared::describe::{Described, quoted};
use crate::app::shared::scene::SceneFlags;
use crate::engine::FilmImage;
use crate::scene::settings::{Group, SETTINGS, Setting, Settings};
use crate::scene::{Define, SceneDescription, edit};

/// What a window shows.
pub struct Shown<'a> {
    /// The scene's file, or the variant file.
    pub path: &'a Path,
    /// The scene is a member of a variant file.
    pub is_member: bool,
    /// As the files have it.
    pub saved: &'a SceneDescription,
    /// As it is now.
    pub scene: &'a SceneDescription,
    pub flags: &'a SceneFlags,
    pub film: &'a FilmImage,
    /// That it was traced on.
    pub adapter: String,
}

/// A command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repeat {
    pub line: String,
    /// Something was edited beside the files that no command line can say.
    pub lacks_edits: bool,
}

impl Shown<'_> {
    /// The command that replays a sample of a pixel of the whole film; none of a member, which has none of its own.
    pub fn replay(&self, pixel: UVec2, sample: u32) -> Option<String> {
        if self.is_member {
            return None;
        }
        let (defines, _) = self.said();
        Some(self.described(&defines).replay(pixel, sample))
    }

    /// The command that gives the same film again.
    pub fn repeat(&self) -> Repeat {
        if self.is_member {
            let [file, name] = [&self.path.display().to_string(), &self.scene.name].map(|word| quoted(word));
            let size = self.scene.film.size;
            let spp = self.film.spp.max(1);
            let line = format!("lucerna variants {file} --only {name} --spp {spp} --size {}x{}", size.x, size.y);
            return Repeat { line, lacks_edits: self.edits(self.saved) };
        }
        let (defines, said) = self.said();
        Repeat { line: self.described(&defines).repeat(), lacks_edits: self.edits(&said) }
    }

    /// What command lines say beside flags, and the scene that comes of that.
    fn said(&self) -> (Vec<Define>, SceneDescription) {
        let mut defines = self.flags.define.clone();
        let mut said = self.saved.clone();
        said.active.clone_from(&self.scene.active);
        if let Some(camera) = self.scene.cameras.get(&self.scene.active)
            && said.cameras.get(&said.active) != Some(camera)
        {
            said.cameras.insert(said.active.clone(), *camera);
            let path = format!("cameras.{}", said.active);
            defines.push(Define::given(path, edit::camera(camera)));
        }
        defines.extend(self.unflagged());
        (said.film, said.render) = (self.scene.film, self.scene.render);
        (defines, said)
    }

    fn described<'a>(&'a self, defines: &'a [Define]) -> Described<'a> {
        Described {
            path: self.path,
            description: self.scene,
            defines,
            shaders: self.flags.shaders.as_deref(),
            window: self.film.window,
            spp: self.film.spp,
            adapter: &self.adapter,
        }
    }

    /// Whether the scene is another than one that can be said, whatever its film's size and samples are.
    fn edits(&self, said: &SceneDescription) -> bool {
        let mut said = said.clone();
        (said.film.size, said.film.crop) = (self.scene.film.size, self.scene.film.crop);
        said.render.spp = self.scene.render.spp;
        said != *self.scene
    }

    /// Settings that were edited and have no flag.
    fn unflagged(&self) -> Vec<Define> {
        let [saved, now] = [self.saved, self.scene].map(|scene| Settings { film: scene.film, render: scene.render });
        let edited =
            SETTINGS.iter().filter(|setting| setting.flag.is_none() && setting.text(&saved) != setting.text(&now));
        let define = |setting: &Setting| {
            let group = if setting.group == Group::Film { "film" } else { "render" };
            Define::given(format!("{group}.{}", setting.field), setting.text(&now))
        };
        edited.map(define).collect()
    }
}
