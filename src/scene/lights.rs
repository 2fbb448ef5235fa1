//! Lights in words: the way to list them beside materials.

use super::mtl::Appearance;
use crate::components::PointLight;

/// What a light is, and the numbers that make it so.
pub fn appearance(light: &PointLight) -> Appearance {
    let [x, y, z] = light.position.to_array();
    let [r, g, b] = light.intensity.to_array();
    let reason = format!("{r} {g} {b} W/sr at {x} {y} {z}");
    match light.cone {
        None => Appearance { kind: "point light", reason },
        Some(cone) => {
            let [x, y, z] = cone.look_at.to_array();
            let reason = format!("{reason}, to {x} {y} {z}, angle {}, blend {}", cone.angle, cone.blend);
            Appearance { kind: "spot light", reason }
        }
    }
}
