//! Settings and shaders' parameters as a scene file has them.

use super::change::Changes;
use super::path::Step;
use super::value::Value;
use crate::components::{Crop, ShaderValue};
use crate::scene::description::SceneDescription;
use crate::scene::settings::{Group, SETTINGS, Setting, Settings, Value as Kind};

/// Adds the settings of film and render that differ.
pub fn differences(before: &SceneDescription, after: &SceneDescription, changes: &mut Changes) {
    let [before, after] = [before, after].map(|scene| Settings { film: scene.film, render: scene.render });
    for setting in SETTINGS.iter().filter(|setting| !setting.is_same(&before, &after)) {
        let group = if setting.group == Group::Film { "film" } else { "render" };
        changes.add(vec![Step::Field(group), Step::Field(setting.field)], value(setting, &after));
    }
}

fn value(setting: &Setting, settings: &Settings) -> Value {
    let settings = &mut { *settings };
    match setting.value {
        Kind::Whole { at, .. } => Value::word(*at(settings)),
        Kind::Stops { at, .. } => Value::Single(*at(settings)),
        Kind::Switch(at) => Value::word(*at(settings)),
        Kind::Choice(at) => {
            let choice = at(settings);
            Value::word(choice.words()[choice.index()].variant)
        }
        Kind::Size(at) => Value::Tuple(at(settings).to_array().map(Value::word).to_vec()),
        Kind::Crop(at) => match *at(settings) {
            Some(Crop { min, max }) => Value::Tuple([min.x, max.x, min.y, max.y].map(Value::word).to_vec()),
            None => Value::word("None"),
        },
    }
}

/// Adds the parameters of shaders that differ. One that is set no more is taken away.
pub fn parameters(before: &SceneDescription, after: &SceneDescription, changes: &mut Changes) {
    let (before, after) = (&before.shader.0, &after.shader.0);
    let path = |name: &String| vec![Step::Field("shader"), Step::Key(name.clone())];
    for (name, value) in after.iter().filter(|(name, value)| before.get(*name) != Some(*value)) {
        let value = match value {
            ShaderValue::Number(number) => Value::Number(*number),
            ShaderValue::Switch(on) => Value::word(on),
        };
        changes.add(path(name), value);
    }
    for name in before.keys().filter(|name| !after.contains_key(*name)) {
        changes.add(path(name), Value::word("None"));
    }
}
