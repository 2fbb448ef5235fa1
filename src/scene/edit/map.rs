//! Maps of materials as a scene file has them.

use std::path::Path;

use super::value::Value;
use crate::components::Wrap;
use crate::files::relative;
use crate::scene::mtl::TextureMap;
use crate::scene::textures::MapUse;

/// What is to be written for a map that is another one now: a part of it or all, and the value.
pub fn difference(
    before: Option<&TextureMap>,
    after: Option<&TextureMap>,
    used: MapUse,
    folder: &Path,
) -> Option<(Option<&'static str>, Value)> {
    match (before, after) {
        (None, None) => None,
        (Some(_), None) => Some((None, Value::word("None"))),
        (Some(old), Some(new)) => {
            // Whether it counts alone, its number says.
            let same = TextureMap { off: new.off, alone: new.alone, ..old.clone() } == *new;
            match (same, old.off == new.off) {
                (true, true) => None,
                (true, false) => Some((Some("off"), Value::word(new.off))),
                (false, _) => Some((None, whole(new, used, folder))),
            }
        }
        (None, Some(new)) => Some((None, whole(new, used, folder))),
    }
}

/// All of a map: its file alone, where it is looked up as it is.
pub fn whole(map: &TextureMap, used: MapUse, folder: &Path) -> Value {
    let plain = TextureMap::new(&map.file);
    let pair = |v: glam::Vec2| Value::Tuple(v.to_array().map(Value::Single).to_vec());
    let clamps = map.wrap.map(|wrap| Value::word(wrap == Wrap::Clamp));
    let scaled = matches!(used, MapUse::Colour | MapUse::Number);
    let channelled = matches!(used, MapUse::Number | MapUse::Bump);
    let relief = matches!(used, MapUse::Normal | MapUse::Bump);
    let channel = map.channel.map_or("None".to_owned(), |channel| format!("{channel:?}"));
    let file = Value::Text(name(&map.file, folder));
    let fields = [
        (true, "file", file.clone()),
        (map.scale != plain.scale, "scale", pair(map.scale)),
        (map.offset != plain.offset, "offset", pair(map.offset)),
        (map.wrap != plain.wrap, "clamp", Value::Tuple(clamps.to_vec())),
        (scaled && map.gain != plain.gain, "gain", Value::Single(map.gain)),
        (scaled && map.base != plain.base, "base", Value::Single(map.base)),
        (channelled && map.channel.is_some(), "channel", Value::word(channel)),
        (used == MapUse::Bump && map.bump != plain.bump, "bump", Value::Single(map.bump)),
        (relief && map.flip_green, "flip_green", Value::word(true)),
        (map.off, "off", Value::word(true)),
    ];
    let said: Vec<(String, Value)> =
        fields.into_iter().filter(|(said, ..)| *said).map(|(_, field, value)| (field.to_owned(), value)).collect();
    if said.len() == 1 { file } else { Value::Struct(said) }
}

/// A file as a scene file in a folder names it: by the path that leads from there to it as the scene was read.
fn name(file: &Path, folder: &Path) -> String {
    match file.strip_prefix(folder) {
        Ok(rest) if !folder.as_os_str().is_empty() => rest.display().to_string().replace('\\', "/"),
        _ if folder.as_os_str().is_empty() && file.is_relative() => file.display().to_string().replace('\\', "/"),
        _ => relative(file, folder),
    }
}
