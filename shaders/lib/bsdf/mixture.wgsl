// A surface's BSDF: Lambert, and with feature `glossy` a Phong lobe beside it. The lobe is chosen by luminance, the pdf is
// that of the whole mixture, and directions below the surface carry nothing.

import package::gen::{MaterialRecord};
@if(glossy) import package::lib::math::{cos_power};
@if(glossy) import package::lib::bsdf::lambert::{lambert_pdf, lambert_value};
@if(glossy) import package::lib::bsdf::phong::{phong_pdf, phong_value};
import package::lib::sampling::{cosine_angle, direction_around};
@if(glossy) import package::lib::sampling::{phong_angle};

struct BsdfSample {
    // World space, unit length.
    direction: vec3<f32>,
    // f * cos / pdf; 0 where nothing is carried.
    weight: vec3<f32>,
}

@if(glossy)
struct BsdfValue {
    // f * cos.
    value: vec3<f32>,
    pdf: f32,
}

// Of a direction `wi` at cosine `cos_theta` above the surface, `mirror` being the reflected `wo`.
@if(glossy)
fn mixture_value(m: MaterialRecord, mirror: vec3<f32>, wi: vec3<f32>, cos_theta: f32) -> BsdfValue {
    let lobe = cos_power(mirror, wi, m.ns);
    return BsdfValue(
        lambert_value(m.kd, cos_theta) + phong_value(m.ks, m.ns, lobe, cos_theta),
        (1.0 - m.glossy) * lambert_pdf(cos_theta) + m.glossy * phong_pdf(m.ns, lobe),
    );
}

// `wo` points away from the surface, `shading` and `geometric` normals to its side; all unit length. `pick` chooses the
// lobe, `u` the direction.
fn mixture_sample(
    m: MaterialRecord,
    wo: vec3<f32>,
    shading: vec3<f32>,
    geometric: vec3<f32>,
    pick: f32,
    u: vec2<f32>,
) -> BsdfSample {
    @if(!glossy) {
        let wi = direction_around(shading, cosine_angle(u.x), u.y);
        // Cosine sampling of a Lambert surface: f cos / pdf is kd.
        return BsdfSample(wi, select(vec3<f32>(0.0), m.kd, dot(wi, geometric) > 0.0));
    }
    @if(glossy) {
        let mirror = 2.0 * dot(wo, shading) * shading - wo;
        var axis = shading;
        var angle = cosine_angle(u.x);
        if (pick < m.glossy) {
            axis = mirror;
            angle = phong_angle(m.ns, u.x);
        }
        let wi = direction_around(axis, angle, u.y);
        let cos_theta = dot(wi, shading);
        if (cos_theta <= 0.0 || dot(wi, geometric) <= 0.0) {
            return BsdfSample(wi, vec3<f32>(0.0));
        }
        let at = mixture_value(m, mirror, wi, cos_theta);
        // A pdf of 0 is left to a lobe sampled at 90 degrees and rounded beyond: it carries nothing.
        if (at.pdf <= 0.0) {
            return BsdfSample(wi, vec3<f32>(0.0));
        }
        return BsdfSample(wi, at.value / at.pdf);
    }
}
