//! Lights without extent as a scene file has them.

use super::change::Changes;
use super::path::Step;
use super::value::Value;
use crate::components::{PointLight, SpotCone};
use crate::scene::description::SceneDescription;

/// Adds what differs of all lights.
pub fn differences(before: &SceneDescription, after: &SceneDescription, changes: &mut Changes) {
    let entry = |name: &String| [Step::Field("lights"), Step::Key(name.clone())];
    for (name, light) in &after.lights {
        let entry = entry(name);
        match before.lights.get(name).filter(|old| kind(old) == kind(light)) {
            Some(old) => {
                let pairs = fields(old).into_iter().zip(fields(light)).map(|((field, a), (_, b))| (field, a, b));
                changes.add_fields(&entry, &[Step::Variant(kind(light))], pairs, &whole(light));
            }
            None => changes.add(entry.to_vec(), whole(light)),
        }
    }
    for name in before.lights.keys().filter(|name| !after.lights.contains_key(*name)) {
        changes.add(entry(name).to_vec(), Value::word("None"));
    }
}

fn kind(light: &PointLight) -> &'static str {
    if light.cone.is_some() { "Spot" } else { "Point" }
}

fn whole(light: &PointLight) -> Value {
    let fields = fields(light).into_iter().map(|(field, value)| (field.to_owned(), value)).collect();
    Value::variant(kind(light), Value::Struct(fields))
}

fn fields(light: &PointLight) -> Vec<(&'static str, Value)> {
    let PointLight { position, intensity, cone } = *light;
    let mut fields = vec![("position", Value::vector(position)), ("intensity", Value::Colour(intensity))];
    if let Some(SpotCone { look_at, angle, blend }) = cone {
        fields.push(("look_at", Value::vector(look_at)));
        fields.push(("angle", Value::Number(angle)));
        fields.push(("blend", Value::Number(blend)));
    }
    fields
}
