//! Schemas of what the tables of settings and of material keys hold.

use schemars::{Schema, json_schema};

use super::parts::{about, any, between, each, number, object, or_none, switch, text, tuple, whole};
use crate::components::Film;
use crate::scene::keys::{KEYS, Key, Value as KeyValue};
use crate::scene::settings::{Group, SETTINGS, Setting, Settings, Value};
use crate::scene::textures::MapUse;

/// The settings of a group, by their fields.
pub fn settings(group: Group) -> impl Iterator<Item = (&'static str, Schema)> {
    SETTINGS.iter().filter(move |setting| setting.group == group).map(|setting| (setting.field, setting_of(setting)))
}

fn setting_of(setting: &Setting) -> Schema {
    let value = match setting.value {
        Value::Whole { least, most, .. } => whole(least, most),
        Value::Stops { most, .. } => between((-most).into(), most.into()),
        Value::Switch(_) => switch(),
        Value::Choice(at) => {
            let words = at(&mut Settings::default()).words();
            any(words.iter().map(|word| json_schema!({ "const": word.variant, "description": word.help })).collect())
        }
        Value::Size(_) => tuple(2, whole(1, Film::MAX_SIDE)),
        Value::Crop(_) => tuple(4, whole(0, Film::MAX_SIDE)),
    };
    match &setting.flag {
        Some(flag) => about(flag.help, value),
        None => value,
    }
}

/// All keys of materials, by their fields.
pub fn keys() -> impl Iterator<Item = (&'static str, Schema)> {
    KEYS.iter().map(|key| (key.scene, about(key.doc, key_of(key))))
}

fn key_of(key: &Key) -> Schema {
    match key.value {
        KeyValue::Colour(colour, _) => each(3, between(0.0, colour.most_in_scene().into())),
        KeyValue::Number(range, _) | KeyValue::Optional(range, _) => between(range.least.into(), range.most.into()),
        KeyValue::Switch(_) => switch(),
        KeyValue::Whole(most, _) => whole(0, most),
        KeyValue::Map(used, _) => any(vec![
            text("the path of a picture, relative to the folder of the file that names it"),
            json_schema!({ "const": "Off" }),
            map_of(used),
        ]),
    }
}

/// A map and how it is looked up.
fn map_of(used: MapUse) -> Schema {
    let scaled = matches!(used, MapUse::Colour | MapUse::Number);
    let channelled = matches!(used, MapUse::Number | MapUse::Bump);
    let relief = matches!(used, MapUse::Normal | MapUse::Bump);
    let always = [
        (
            "file",
            text("relative to the folder of the file that names it; without it, the map that is there is changed"),
        ),
        ("scale", each(2, number())),
        ("offset", tuple(2, number())),
        ("clamp", each(2, switch())),
        ("off", about("the plain number counts, and the window can switch the map on", switch())),
    ];
    let channel = json_schema!({ "enum": ["Red", "Green", "Blue", "Alpha", "Luminance"] });
    let by_use = [
        (scaled, "gain", number()),
        (scaled, "base", number()),
        (channelled, "channel", channel),
        (used == MapUse::Bump, "bump", number()),
        (relief, "flip_green", switch()),
    ];
    let fields = always.into_iter().chain(by_use.into_iter().filter(|(has, ..)| *has).map(|(_, name, of)| (name, of)));
    object("a map", fields.map(|(name, of)| (name, or_none(of))), &[])
}
