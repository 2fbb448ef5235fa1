//! Materials as a scene file has them: numbers and maps, by the table of keys.

use std::path::Path;

use super::map;
use super::value::Value;
use crate::scene::description::SceneDescription;
use crate::scene::keys::{KEYS, Key, Value as Kind};
use crate::scene::mtl::MtlMaterial;

/// A number or map of a material that is another one now.
#[derive(Clone, Debug)]
pub struct MaterialChange {
    /// `model:material`
    pub name: String,
    pub key: &'static Key,
    /// All of the key, or what of its map.
    pub part: Option<&'static str>,
    pub value: Value,
}

/// What differs of all materials, whose pictures are named from `folder`.
pub fn differences(before: &SceneDescription, after: &SceneDescription, folder: &Path) -> Vec<MaterialChange> {
    let both = after.materials.iter().filter_map(|(name, now)| Some((name, before.materials.get(name)?, now)));
    let others = both.filter(|(_, before, now)| before != now);
    others.flat_map(|(name, before, now)| of_one(name, before, now, folder)).collect()
}

fn of_one(name: &str, before: &MtlMaterial, now: &MtlMaterial, folder: &Path) -> Vec<MaterialChange> {
    let change = |key, part, value| MaterialChange { name: name.to_owned(), key, part, value };
    let (old, new) = (&mut before.clone(), &mut now.clone());
    let mut changes = Vec::new();
    for key in KEYS {
        if let Kind::Map(used, at) = key.value {
            let found = map::difference(at(old).as_ref(), at(new).as_ref(), used, folder);
            changes.extend(found.map(|(part, value)| change(key, part, value)));
            continue;
        }
        // What a map says alone is no number that anybody gave.
        let (was_alone, is_alone) = (old.is_alone(key.scene), new.is_alone(key.scene));
        let value = value(key, new);
        if !is_alone && (was_alone || value != self::value(key, old)) {
            changes.extend(value.map(|value| change(key, None, value)));
        }
    }
    changes
}

/// What a material has of a key: its number, unless its map says it alone, or its map.
pub fn of_key(material: &MtlMaterial, key: &Key, folder: &Path) -> Option<Value> {
    let material = &mut material.clone();
    match key.value {
        Kind::Map(used, at) => at(material).as_ref().map(|map| map::whole(map, used, folder)),
        _ if material.is_alone(key.scene) => None,
        _ => value(key, material),
    }
}

/// The number of a key; none of a map.
fn value(key: &Key, material: &mut MtlMaterial) -> Option<Value> {
    Some(match key.value {
        Kind::Colour(_, at) => Value::Colour(*at(material)),
        Kind::Number(_, at) => Value::Single(*at(material)),
        Kind::Optional(_, at) => at(material).map_or_else(|| Value::word("None"), Value::Single),
        Kind::Switch(at) => Value::word(*at(material)),
        Kind::Whole(_, at) => Value::word(*at(material)),
        Kind::Map(..) => return None,
    })
}

/// A whole material as an entry of a scene file's `materials`, in brackets: what is not as in a material that nobody has said anything of, and
/// its first three numbers. Its pictures are named from `folder`; without one, they are left out.
pub fn whole(material: &MtlMaterial, folder: Option<&Path>) -> Value {
    let (own, plain) = (&mut material.clone(), &mut MtlMaterial::default());
    let mut fields = Vec::new();
    for key in KEYS {
        let said = match (&key.value, folder) {
            (Kind::Map(used, at), Some(folder)) => at(own).as_ref().map(|map| map::whole(map, *used, folder)),
            // What its map says alone.
            (_, Some(_)) if own.is_alone(key.scene) => None,
            _ => {
                let now = value(key, own);
                now.filter(|now| ["kd", "ks", "ns"].contains(&key.scene) || Some(now) != value(key, plain).as_ref())
            }
        };
        fields.extend(said.map(|value| (key.scene.to_owned(), value)));
    }
    Value::Struct(fields)
}
