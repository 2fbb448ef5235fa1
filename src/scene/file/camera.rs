//! What a scene file says of a camera.

use glam::{DVec2, DVec3};

use crate::components::{Camera, Focus, Lens};
use crate::scene::ron::{Fields, Kind, Node, Reader};

/// `(position: (..), look_at: (..), up: (0, 1, 0), fov_y: 45, aperture: 0, focus: LookAt, shift: (0, 0))`
pub fn read_camera(reader: &Reader, node: &Node, path: &str) -> Option<Camera> {
    let fields = Fields::open(reader, node, path)?;
    let position = fields.require("position", Node::vector);
    let look_at = fields.require("look_at", Node::vector);
    let up = fields.read("up", Node::vector).unwrap_or(DVec3::Y);
    let fov_y = fields.read("fov_y", |node| node.number(1e-3, 179.0)).unwrap_or(45.0);
    let view = position.zip(look_at).map(|(position, look_at)| (look_at - position).normalize_or_zero());
    match view {
        Some(DVec3::ZERO) => fields.fail("`position` and `look_at` are the same point"),
        Some(view) if view.cross(up.normalize_or_zero()).length() < 1e-9 => {
            fields.fail("`up` is zero or along the view: choose another direction");
        }
        _ => {}
    }
    let aperture = fields.read("aperture", |node| node.number(0.0, Lens::MOST_APERTURE)).unwrap_or(0.0);
    let focus = fields.read("focus", |node| {
        let focus = read_focus(node)?;
        match (focus, position, view) {
            (Focus::At(point), Some(position), Some(view)) if (point - position).dot(view) <= 0.0 => {
                Err("this point is not in front of the camera".to_owned())
            }
            _ => Ok(focus),
        }
    });
    let shift = fields.read("shift", |node| node.numbers(-Lens::MOST_SHIFT, Lens::MOST_SHIFT).map(DVec2::from_array));
    let sound = fields.finish();
    let lens = Lens { aperture, focus: focus.unwrap_or_default(), shift: shift.unwrap_or_default() };
    let camera = Camera { position: position?, look_at: look_at?, up, fov_y, lens };
    sound.then_some(camera)
}

/// `Distance(12)`; `At((x, y, z))`, with or without the inner parentheses; or `LookAt`.
fn read_focus(node: &Node) -> Result<Focus, String> {
    match &node.kind {
        Kind::Variant("LookAt", None) => Ok(Focus::LookAt),
        Kind::Variant("Distance", Some(content)) => {
            let [nearest, farthest] = Lens::FOCUS_RANGE;
            content.inner().number(nearest, farthest).map(Focus::Distance)
        }
        Kind::Variant("At", Some(content)) => content.inner().vector().map(Focus::At),
        _ => Err(format!("expected Distance(12), At((x, y, z)) or LookAt, found {}", node.describe())),
    }
}
