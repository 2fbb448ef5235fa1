//! What a film was rendered with: for the metadata of its files, and as a command line that gives it again.

use std::path::Path;

use glam::UVec2;

use crate::components::Crop;
use crate::scene::settings::{SETTINGS, Setting, Settings};
use crate::scene::{Define, SceneDescription};

/// A film, by all that it follows from.
#[derive(Clone, Copy, Debug)]
pub struct Described<'a> {
    /// The scene file.
    pub path: &'a Path,
    /// As it was rendered.
    pub description: &'a SceneDescription,
    pub defines: &'a [Define],
    /// The folder of shaders, where one was named.
    pub shaders: Option<&'a Path>,
    /// The rendered part.
    pub window: Crop,
    /// Samples that every pixel has.
    pub spp: u32,
    pub adapter: &'a str,
}

impl Described<'_> {
    /// What is needed to repeat the render. Nothing in it differs between equal renders on one machine.
    pub fn metadata(&self) -> Vec<(&'static str, String)> {
        self.metadata_with(self.repeat())
    }

    /// The same with another command line that repeats it.
    pub fn metadata_with(&self, repeat: String) -> Vec<(&'static str, String)> {
        let scene = self.description;
        let defines: Vec<String> =
            self.defines.iter().map(|define| format!("{}={}", define.path, define.value)).collect();
        let mut data = vec![
            ("Software", concat!("Lucerna ", env!("CARGO_PKG_VERSION")).to_owned()),
            ("scene", self.path.display().to_string()),
            ("defines", defines.join("; ")),
            ("camera", scene.active.clone()),
            ("size", format!("{}x{}", scene.film.size.x, scene.film.size.y)),
            ("crop", crop(self.window)),
            ("spp", self.spp.to_string()),
        ];
        data.extend(settings(scene).map(|(setting, text)| (setting.field, text)));
        data.extend([("adapter", self.adapter.to_owned()), ("repeat", repeat)]);
        data
    }

    /// A command line that gives the same film again.
    pub fn repeat(&self) -> String {
        // Interrupted within the first sample, there is none to be had again that is whole.
        self.rendered(vec![("--spp", self.spp.max(1).to_string())])
    }

    /// A command line that renders the film again for as long as flags say.
    pub fn rendered(&self, mut until: Vec<(&'static str, String)>) -> String {
        if self.description.film.crop.is_some() {
            until.push(("--crop", crop(self.window)));
        }
        self.line("render", until)
    }

    /// A command line that renders a part of the film for as long as flags say, to other files.
    pub fn part(&self, window: Crop, until: Vec<(&'static str, String)>, files: &[String]) -> String {
        let mut own = until;
        own.push(("--crop", crop(window)));
        own.extend(files.iter().map(|file| ("-o", file.clone())));
        self.line("render", own)
    }

    /// A command line that replays one of its samples: of a pixel of the whole picture.
    pub fn replay(&self, pixel: UVec2, sample: u32) -> String {
        self.line("replay", vec![("--pixel", format!("{},{}", pixel.x, pixel.y)), ("--sample", sample.to_string())])
    }

    /// A command with options of its own, and with all that its film follows from.
    fn line(&self, command: &str, own: Vec<(&str, String)>) -> String {
        let scene = self.description;
        let mut words = vec!["lucerna".to_owned(), command.to_owned(), quoted(&self.path.display().to_string())];
        let mut option = |name: &str, value: String| words.extend([name.to_owned(), quoted(&value)]);
        own.into_iter().for_each(|(name, value)| option(name, value));
        option("--size", format!("{}x{}", scene.film.size.x, scene.film.size.y));
        option("--camera", scene.active.clone());
        for (setting, text) in settings(scene) {
            if let Some(flag) = setting.flag {
                option(&format!("--{}", flag.name), text);
            }
        }
        for Define { path, value, .. } in self.defines {
            option("-D", format!("{path}={value}"));
        }
        if let Some(folder) = self.shaders {
            option("--shaders", folder.display().to_string());
        }
        words.join(" ")
    }
}

/// All settings but those that a film has of its own: field, and value as its flag has it.
pub fn settings(scene: &SceneDescription) -> impl Iterator<Item = (&'static Setting, String)> {
    let settings = Settings { film: scene.film, render: scene.render };
    let others = SETTINGS.iter().filter(|setting| !["spp", "size", "crop"].contains(&setting.field));
    others.map(move |setting| (setting, setting.text(&settings)))
}

/// A word as a POSIX shell takes it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

fn crop(window: Crop) -> String {
    format!("{},{},{},{}", window.min.x, window.max.x, window.min.y, window.max.y)
}
