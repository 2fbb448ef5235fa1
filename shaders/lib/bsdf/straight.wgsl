// What passes a surface without a turn: through its see-through part, or through a pane.

import package::gen::{MaterialRecord};
@if(thin) import package::gen::{MATERIAL_THIN};
import package::lib::bsdf::frame::{BsdfSample};
@if(thin) import package::lib::bsdf::pane::{pane_split};

// Whether a surface lets any light straight on.
fn lets_through(m: MaterialRecord) -> bool {
    var lets = false;
    @if(alpha) {
        lets = m.transparency > 0.0;
    }
    @if(thin) {
        lets = lets || (m.flags & MATERIAL_THIN) != 0u;
    }
    return lets;
}

// Whether what was drawn is the light that goes straight on. A mirror at a direction in its plane is none: it carries nothing.
fn is_straight(m: MaterialRecord, wo: vec3<f32>, drawn: BsdfSample) -> bool {
    return lets_through(m) && drawn.pdf == 0.0 && all(drawn.direction == -wo);
}

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
