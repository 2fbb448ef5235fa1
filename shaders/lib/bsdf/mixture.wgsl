// A surface's BSDF: Lambert, and with feature `glossy` a Phong lobe beside it. The lobe is chosen by luminance, the pdf is
// that of the whole mixture, and directions below the surface carry nothing.

import package::gen::{MaterialRecord};
@if(glossy) import package::lib::math::{cos_power};
import package::lib::bsdf::lambert::{lambert_pdf, lambert_value};
@if(glossy) import package::lib::bsdf::phong::{phong_pdf, phong_value};
import package::lib::sampling::{cosine_angle, direction_around};
@if(glossy) import package::lib::sampling::{phong_angle};

// How a surface is seen. All unit length; both normals are on the side of `wo`.
struct Facing {
    // Away from the surface, to where the ray came from.
    wo: vec3<f32>,
    shading: vec3<f32>,
    geometric: vec3<f32>,
    // 1 where the surface is seen from its back, by its winding.
    from_behind: u32,
}

struct BsdfSample {
    // World space, unit length.
    direction: vec3<f32>,
    // By solid angle, of the whole mixture; 0 where the direction is the only one that its lobe has.
    pdf: f32,
    // f * cos / pdf; 0 where nothing is carried.
    weight: vec3<f32>,
}

struct BsdfValue {
    // f * cos.
    value: vec3<f32>,
    // By which mixture_sample() draws this direction, by solid angle.
    pdf: f32,
}

// The mixture in a direction `wi`, but for lobes of a single direction.
fn mixture_evaluate(m: MaterialRecord, facing: Facing, wi: vec3<f32>) -> BsdfValue {
    let cos_theta = dot(wi, facing.shading);
    if (cos_theta <= 0.0 || dot(wi, facing.geometric) <= 0.0) {
        return BsdfValue(vec3<f32>(0.0), 0.0);
    }
    @if(!glossy) {
        return BsdfValue(lambert_value(m.kd, cos_theta), lambert_pdf(cos_theta));
    }
    @if(glossy) {
        let mirror = 2.0 * dot(facing.wo, facing.shading) * facing.shading - facing.wo;
        let lobe = cos_power(mirror, wi, m.ns);
        return BsdfValue(
            lambert_value(m.kd, cos_theta) + phong_value(m.ks, m.ns, lobe, cos_theta),
            (1.0 - m.glossy) * lambert_pdf(cos_theta) + m.glossy * phong_pdf(m.ns, lobe),
        );
    }
}

// `pick` chooses the lobe, `u` the direction; all in [0, 1).
fn mixture_sample(m: MaterialRecord, facing: Facing, pick: f32, u: vec2<f32>) -> BsdfSample {
    @if(!glossy) {
        let wi = direction_around(facing.shading, cosine_angle(u.x), u.y);
        let cos_theta = dot(wi, facing.shading);
        // Cosine sampling of a Lambert surface: f cos / pdf is kd.
        let weight = select(vec3<f32>(0.0), m.kd, cos_theta > 0.0 && dot(wi, facing.geometric) > 0.0);
        return BsdfSample(wi, lambert_pdf(cos_theta), weight);
    }
    @if(glossy) {
        var axis = facing.shading;
        var angle = cosine_angle(u.x);
        if (pick < m.glossy) {
            axis = 2.0 * dot(facing.wo, facing.shading) * facing.shading - facing.wo;
            angle = phong_angle(m.ns, u.x);
        }
        let wi = direction_around(axis, angle, u.y);
        let at = mixture_evaluate(m, facing, wi);
        // A pdf of 0 is left to a lobe sampled at 90 degrees and rounded beyond: it carries nothing.
        let weight = select(vec3<f32>(0.0), at.value / at.pdf, at.pdf > 0.0);
        return BsdfSample(wi, at.pdf, weight);
    }
}
