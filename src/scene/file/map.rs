//! What a scene file says of one map of a material.

use std::path::{Path, PathBuf};

use glam::Vec2;

use crate::components::{Channel, Wrap};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::locate::{as_written, folder_of, locate, near_names, relative_to};
use crate::scene::mtl::TextureMap;
use crate::scene::ron::{Fields, Kind, Node, Reader};
use crate::scene::text::missing;
use crate::scene::textures::MapUse;

/// The greatest number of a map, either way.
const MOST: f64 = 1e6;

/// A change to one map.
#[derive(Clone, Debug)]
pub enum MapEdit {
    /// `None`, or `Off`.
    Off,
    /// A file that is looked up otherwise than it is by default; without one, changes to the map that is there.
    On(Box<MapChange>),
}

/// What is given of a map.
#[derive(Clone, Debug)]
pub struct MapChange {
    /// As written, then found or looked for: relative to the folder of the file that has it.
    file: Option<PathBuf>,
    wrap: Option<[Wrap; 2]>,
    scale: Option<Vec2>,
    offset: Option<Vec2>,
    gain: Option<f32>,
    base: Option<f32>,
    channel: Option<Channel>,
    bump: Option<f32>,
    flip_green: Option<bool>,
    off: Option<bool>,
    /// An error about the file, or the whole, without its message.
    place: Diagnostic,
}

impl MapChange {
    /// Of a place, and nothing given.
    fn new(place: Diagnostic) -> Self {
        Self {
            file: None,
            wrap: None,
            scale: None,
            offset: None,
            gain: None,
            base: None,
            channel: None,
            bump: None,
            flip_green: None,
            off: None,
            place,
        }
    }

    /// Finds the file. The place where it is named, as a warning without its message, and what there is to say of it.
    fn find(&mut self, scene: &Path) -> Option<FoundMap> {
        let folder = folder_of(&self.place, scene);
        let name = self.file.as_ref()?.to_string_lossy().into_owned();
        let found = locate(folder, &name);
        let path = found.as_ref().map_or_else(|| as_written(folder, &name), |found| found.path.clone());
        let place = Diagnostic { severity: Severity::Warning, ..self.place.clone() };
        let message = match found {
            None => {
                let help = near_names(folder, &name).unwrap_or_else(|| relative_to(&self.place, scene));
                Some(Diagnostic { message: missing("image", &path), ..self.place.clone() }.help(help))
            }
            Some(found) => found.differs.map(|why| {
                let message = format!("there is no `{name}`: `{}` is read, {why}", path.display());
                Diagnostic { message, ..place.clone() }
            }),
        };
        self.file = Some(path.clone());
        Some(FoundMap { path, place, message })
    }
}

/// A file that a map of a scene file names.
pub struct FoundMap {
    /// Where it is, or was looked for.
    pub path: PathBuf,
    /// A warning about its name, without its message.
    pub place: Diagnostic,
    /// That it isn't there, or another one is read.
    pub message: Option<Diagnostic>,
}

impl MapEdit {
    /// Finds the file that it names, if it does.
    pub fn find(&mut self, scene: &Path) -> Option<FoundMap> {
        match self {
            Self::Off => None,
            Self::On(change) => change.find(scene),
        }
    }

    /// Whether it changes how the map is looked up that is there.
    pub fn is_change(&self) -> bool {
        matches!(self, Self::On(change) if change.file.is_none())
    }

    /// Writes it into a material's map; else the error, which `field` is told in.
    pub fn apply(&self, map: &mut Option<TextureMap>, field: &str) -> Result<(), Diagnostic> {
        let Self::On(change) = self else {
            *map = None;
            return Ok(());
        };
        let base = match &change.file {
            // Whether the map counts alone is a matter of the number.
            Some(file) => {
                Some(TextureMap { alone: map.as_ref().is_some_and(|map| map.alone), ..TextureMap::new(file) })
            }
            None => map.take(),
        };
        let Some(base) = base else {
            let message = format!("there is no `{field}` that this could change");
            return Err(Diagnostic { message, ..change.place.clone() }.help("give it a `file`"));
        };
        *map = Some(TextureMap {
            wrap: change.wrap.unwrap_or(base.wrap),
            scale: change.scale.unwrap_or(base.scale),
            offset: change.offset.unwrap_or(base.offset),
            gain: change.gain.unwrap_or(base.gain),
            base: change.base.unwrap_or(base.base),
            channel: change.channel.or(base.channel),
            bump: change.bump.unwrap_or(base.bump),
            flip_green: change.flip_green.unwrap_or(base.flip_green),
            off: change.off.unwrap_or(base.off),
            ..base
        });
        Ok(())
    }
}

/// `"wood.png"`, `(file: "wood.png", scale: (2, 2), ..)`, `None` or `Off`. What a map of this use has no use for is no field of it.
pub fn read_map(reader: &Reader, node: &Node, path: &str, used: MapUse) -> Option<MapEdit> {
    let place = |node: &Node| node.text.error(node.source, "");
    match &node.kind {
        Kind::Variant("None" | "Off", None) => Some(MapEdit::Off),
        Kind::Fields(_) | Kind::Items(_) => {
            let fields = Fields::open(reader, node, path)?;
            let mut change = MapChange::new(place(fields.get("file").unwrap_or(node)));
            change.file = fields.read("file", read_file);
            read_lookup(&fields, used, &mut change);
            fields.finish().then(|| MapEdit::On(Box::new(change)))
        }
        _ => match read_file(node) {
            Ok(file) => Some(MapEdit::On(Box::new(MapChange { file: Some(file), ..MapChange::new(place(node)) }))),
            Err(_) => {
                let message =
                    format!("expected \"wood.png\", (file: \"wood.png\", ..) or None, found {}", node.describe());
                reader.error(node, path, message);
                None
            }
        },
    }
}

/// How the file is looked up.
fn read_lookup(fields: &Fields, used: MapUse, change: &mut MapChange) {
    let number = |name| fields.read(name, |node| node.number(-MOST, MOST)).map(|value| value as f32);
    change.scale = fields.read("scale", |node| match &node.kind {
        Kind::Items(_) => read_pair(node),
        _ => node.number(-MOST, MOST).map(|value| Vec2::splat(value as f32)),
    });
    change.offset = fields.read("offset", read_pair);
    change.wrap = fields.read("clamp", read_clamp);
    if matches!(used, MapUse::Colour | MapUse::Number) {
        change.gain = number("gain");
        change.base = number("base");
    }
    if matches!(used, MapUse::Number | MapUse::Bump) {
        let words = [Channel::Red, Channel::Green, Channel::Blue, Channel::Alpha, Channel::Luminance];
        let names = words.map(|channel| format!("{channel:?}"));
        let words: Vec<_> = names.iter().map(String::as_str).zip(words).collect();
        change.channel = fields.read("channel", |node| node.one_of(&words));
    }
    if used == MapUse::Bump {
        change.bump = number("bump");
    }
    if matches!(used, MapUse::Normal | MapUse::Bump) {
        change.flip_green = fields.read("flip_green", Node::boolean);
    }
    change.off = fields.read("off", Node::boolean);
}

/// The name of a file.
fn read_file(node: &Node) -> Result<PathBuf, String> {
    match node.string()? {
        file if file.is_empty() => Err("expected the path of a picture, found an empty string".into()),
        file => Ok(file.into()),
    }
}

fn read_pair(node: &Node) -> Result<Vec2, String> {
    node.numbers(-MOST, MOST).map(|[u, v]| Vec2::new(u as f32, v as f32))
}

/// Of both axes, or one by one.
fn read_clamp(node: &Node) -> Result<[Wrap; 2], String> {
    let wrap = |clamp: bool| if clamp { Wrap::Clamp } else { Wrap::Repeat };
    match &node.kind {
        Kind::Items(items) if items.len() == 2 => Ok([wrap(items[0].boolean()?), wrap(items[1].boolean()?)]),
        Kind::Items(_) => Err(format!("expected true, false or two of them in parentheses, found {}", node.describe())),
        _ => node.boolean().map(|clamp| [wrap(clamp); 2]),
    }
}
