//! What a scene file says of a light without extent.

use glam::DVec3;

use crate::components::{PointLight, SpotCone};
use crate::scene::ron::{Fields, Kind, Node, Reader};

/// `Point(position: (..), intensity: (..))`, or `Spot(position: (..), look_at: (..), intensity: (..), angle: 45, blend: 0.15)`.
pub fn read_light(reader: &Reader, node: &Node, path: &str) -> Option<PointLight> {
    match &node.kind {
        Kind::Variant("Point", Some(content)) => read_point(Fields::open(reader, content, path)?),
        Kind::Variant("Spot", Some(content)) => read_spot(Fields::open(reader, content, path)?),
        _ => {
            let found = node.describe();
            let message =
                format!("expected Point(position: .., intensity: ..) or Spot(.., look_at: (x, y, z)), found {found}");
            reader.error(node, path, message);
            None
        }
    }
}

fn read_point(fields: Fields) -> Option<PointLight> {
    let light = read_common(&fields);
    fields.finish().then_some(light?)
}

fn read_spot(fields: Fields) -> Option<PointLight> {
    let light = read_common(&fields);
    let look_at = fields.require("look_at", Node::vector);
    if light.zip(look_at).is_some_and(|(light, look_at)| (look_at - light.position).normalize_or_zero() == DVec3::ZERO)
    {
        fields.fail("`position` and `look_at` are the same point");
    }
    let [least, most] = SpotCone::ANGLES;
    let angle = fields.read("angle", |node| node.number(least, most)).unwrap_or(SpotCone::ANGLE);
    let blend = fields.read("blend", |node| node.number(0.0, 1.0)).unwrap_or(SpotCone::BLEND);
    let sound = fields.finish();
    let light = PointLight { cone: Some(SpotCone { look_at: look_at?, angle, blend }), ..light? };
    sound.then_some(light)
}

/// What both have, of a light that shines everywhere.
fn read_common(fields: &Fields) -> Option<PointLight> {
    let position = fields.require("position", Node::vector);
    let intensity = fields.require("intensity", |node| node.colour(PointLight::MOST_INTENSITY));
    Some(PointLight { position: position?, intensity: intensity?, cone: None })
}
