// What passes a surface without a turn: through its see-through part, or through a pane.

import package::gen::{MaterialRecord};
@if(thin) import package::gen::{MATERIAL_THIN};
@if(thin) import package::lib::bsdf::pane::{pane_split};

// The part of the light that goes straight on, at a cosine to the shading normal.
fn passed_straight(m: MaterialRecord, cos_theta: f32) -> vec3<f32> {
    var passed = vec3<f32>(0.0);
    @if(alpha) {
        passed = m.transparency * m.tf;
    }
    @if(thin) {
        if ((m.flags & MATERIAL_THIN) != 0u) {
            passed += (1.0 - m.transparency) * pane_split(m, cos_theta).passed;
        }
    }
    return passed;
}
