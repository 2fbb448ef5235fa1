// Light sources.

import package::gen::{MATERIAL_ONE_SIDED, MaterialRecord};

// Radiance emitted towards where the ray came from.
fn emitted(material: MaterialRecord, from_behind: bool) -> vec3<f32> {
    let dark = from_behind && (material.flags & MATERIAL_ONE_SIDED) != 0u;
    return select(material.emission, vec3<f32>(0.0), dark);
}
