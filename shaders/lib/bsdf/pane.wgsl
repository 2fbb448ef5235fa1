// A pane of glass as one sheet: two parallel smooth faces at once. Light is mirrored or goes straight on; both sides are alike. With r for what
// a face reflects and t for what a crossing between the faces leaves (`tf`), all ways between them sum to
//
//   T = (1 - r)^2 t / (1 - r^2 t^2)   and   R = r + r t T,
//
// (1 - r) / (1 + r) and 2 r / (1 + r) in clear glass (Stokes 1862). A face reflects alike from within, at the refracted angle.

import package::gen::{MaterialRecord};
import package::lib::bsdf::dielectric::{fresnel, interface_of};
import package::lib::bsdf::frame::{BsdfSample, ShadingFrame, is_above};
@if(thin) import package::lib::bsdf::frame::{mirror_direction};
import package::lib::colour::{luminance};

// What a pane reflects and lets through.
struct PaneSplit {
    reflected: vec3<f32>,
    passed: vec3<f32>,
}

fn pane_split(m: MaterialRecord, cos_theta: f32) -> PaneSplit {
    let r = fresnel(interface_of(m.ni, false), cos_theta).reflectance;
    let between = max((1.0 - r * m.tf) * (1.0 + r * m.tf), vec3<f32>(1e-30));
    let passed = (1.0 - r) * (1.0 - r) * m.tf / between;
    return PaneSplit(r + r * m.tf * passed, passed);
}

@if(thin)
fn pane_sample(m: MaterialRecord, frame: ShadingFrame, pick: f32) -> BsdfSample {
    let split = pane_split(m, dot(frame.wo, frame.shading));
    let reflected = split.reflected;
    let passed = split.passed;
    let both = luminance(reflected + passed);
    let share = select(0.0, luminance(reflected) / both, both > 0.0);
    if (pick < share) {
        let wi = mirror_direction(frame);
        return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), reflected / share, is_above(frame, wi)));
    }
    return BsdfSample(-frame.wo, 0.0, passed / (1.0 - share));
}
