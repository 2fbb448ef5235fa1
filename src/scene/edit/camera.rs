//! Cameras as a scene file has them.

use glam::DVec2;

use super::change::Changes;
use super::path::Step;
use super::value::Value;
use crate::components::{Camera, Focus, Lens};
use crate::scene::description::SceneDescription;

/// Adds what differs of all cameras, and which of them is rendered.
pub fn differences(before: &SceneDescription, after: &SceneDescription, changes: &mut Changes) {
    for (name, camera) in &after.cameras {
        let entry = [Step::Field("cameras"), Step::Key(name.clone())];
        let old = before.cameras.get(name).copied();
        match old {
            Some(old) => {
                let pairs = fields(&old).into_iter().zip(fields(camera)).map(|((field, a), (_, b))| (field, a, b));
                changes.add_fields(&entry, &[], pairs, &whole(camera));
            }
            None => changes.add(entry.to_vec(), whole(camera)),
        }
    }
    for name in before.cameras.keys().filter(|name| !after.cameras.contains_key(*name)) {
        changes.add(vec![Step::Field("cameras"), Step::Key(name.clone())], Value::word("None"));
    }
    if before.active != after.active {
        changes.add(vec![Step::Field("camera")], Value::Text(after.active.clone()));
    }
}

/// The camera as an entry of a scene file's `cameras`, in brackets. What is as in a camera without a lens is left out.
pub fn whole(camera: &Camera) -> Value {
    let plain = fields(&Camera { lens: Lens::default(), ..*camera });
    let all = fields(camera).into_iter().zip(plain);
    let said =
        all.filter(|((field, value), (_, usual))| !["aperture", "focus", "shift"].contains(field) || value != usual);
    Value::Struct(said.map(|((field, value), _)| (field.to_owned(), value)).collect())
}

fn fields(camera: &Camera) -> [(&'static str, Value); 7] {
    let Camera { position, look_at, up, fov_y, lens: Lens { aperture, focus, shift } } = *camera;
    let DVec2 { x, y } = shift;
    [
        ("position", Value::vector(position)),
        ("look_at", Value::vector(look_at)),
        ("up", Value::vector(up)),
        ("fov_y", Value::Number(fov_y)),
        ("aperture", Value::Number(aperture)),
        ("focus", focus_of(camera, focus)),
        ("shift", Value::Tuple(vec![Value::Number(x), Value::Number(y)])),
    ]
}

fn focus_of(camera: &Camera, focus: Focus) -> Value {
    match focus {
        Focus::Distance(distance) => Value::variant("Distance", Value::Number(distance)),
        // A point that the camera has passed stands for the one that is looked at, and no file may have it.
        Focus::At(point) if (point - camera.position).dot(camera.look_at - camera.position) > 0.0 => {
            Value::variant("At", Value::vector(point))
        }
        Focus::At(_) | Focus::LookAt => Value::word("LookAt"),
    }
}
