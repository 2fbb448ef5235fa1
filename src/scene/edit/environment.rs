//! The environment as a scene file has it.

use super::change::Changes;
use super::path::Step;
use super::value::Value;
use crate::components::{Daylight, Environment};
use crate::scene::description::SceneDescription;

/// Adds what differs of the environment. Another picture, or a picture turned otherwise, is not to be had from what it came to.
pub fn differences(before: &SceneDescription, after: &SceneDescription, changes: &mut Changes) {
    let entry = [Step::Field("environment")];
    match (&before.environment, &after.environment) {
        (None, None) => {}
        (_, None) => changes.add(entry.to_vec(), Value::word("None")),
        (
            Some(Environment::Map { image, turn, .. }),
            Some(now @ Environment::Map { image: other, turn: turned, .. }),
        ) if image == other && turn == turned => {
            let old = before.environment.as_ref().unwrap_or(now);
            // There is no whole without its path, and none is asked for: a picture was read from a file.
            add(changes, old, now, "Map");
        }
        (_, Some(Environment::Map { .. })) => changes.unsaid.push((
            "another picture as environment".to_owned(),
            "write it into the scene file: environment: Map(path: \"sky.exr\")".to_owned(),
        )),
        (Some(old @ Environment::Daylight(_)), Some(now @ Environment::Daylight(_))) => add(changes, old, now, "Sky"),
        (Some(old), Some(now)) if old == now => {}
        (_, Some(now)) => changes.add(entry.to_vec(), whole(now)),
    }
}

fn add(changes: &mut Changes, old: &Environment, now: &Environment, kind: &'static str) {
    let pairs = fields(old).into_iter().zip(fields(now)).map(|((field, a), (_, b))| (field, a, b));
    changes.add_fields(&[Step::Field("environment")], &[Step::Variant(kind)], pairs, &whole(now));
}

fn whole(environment: &Environment) -> Value {
    let fields = || fields(environment).into_iter().map(|(field, value)| (field.to_owned(), value)).collect();
    match environment {
        Environment::Constant(radiance) => Value::variant("Constant", Value::Colour(*radiance)),
        Environment::Daylight(_) => Value::variant("Sky", Value::Struct(fields())),
        Environment::Map { .. } => Value::variant("Map", Value::Struct(fields())),
    }
}

fn fields(environment: &Environment) -> Vec<(&'static str, Value)> {
    match environment {
        Environment::Constant(_) => Vec::new(),
        Environment::Map { strength, tint, .. } => {
            vec![("strength", Value::Single(*strength)), ("tint", Value::Colour(*tint))]
        }
        Environment::Daylight(Daylight { elevation, azimuth, turbidity, ground, strength, sun_size }) => vec![
            ("sun", Value::Tuple(vec![Value::Number(*elevation), Value::Number(*azimuth)])),
            ("turbidity", Value::Single(*turbidity)),
            ("ground", Value::Colour(*ground)),
            ("strength", Value::Single(*strength)),
            ("sun_size", Value::Number(*sun_size)),
        ],
    }
}
