// A surface's BSDF. Beside Lambert's it has one specular lobe, of Phong (feature `phong`), GGX (`ggx`) or a mirror
// (`mirror`), chosen by luminance; part of the light may pass straight through (`alpha`); or it is a smooth dielectric and
// nothing else (`dielectric`). Lobes that have density are one mixture; below the surface they carry nothing. Where the shading normal is
// not the surface's own (`normals`), what would be lost to that is kept (lib/bsdf/facet).

import package::gen::{MaterialRecord};
@if(dielectric) import package::gen::{MATERIAL_DIELECTRIC};
@if(ggx) import package::gen::{MATERIAL_GGX};
@if(mirror) import package::gen::{MATERIAL_MIRROR};
@if(phong) import package::lib::math::{cos_power};
@if(dielectric) import package::lib::bsdf::dielectric::{eta_squared, fresnel, interface_of, refracted};
@if(ggx) import package::lib::bsdf::ggx::{ggx_evaluate, ggx_sample};
@if(normals) import package::lib::bsdf::facet::{crowded, crowding, kept_above, mirrored};
import package::lib::colour::{luminance};
import package::lib::bsdf::lambert::{lambert_pdf, lambert_value};
@if(dielectric || phong || mirror) import package::lib::bsdf::mirror::{reflected};
@if(phong) import package::lib::bsdf::phong::{phong_pdf, phong_value};
import package::lib::sampling::{cosine_angle, direction_around};
@if(phong) import package::lib::sampling::{phong_angle};

// How a surface is seen. All unit length; both normals are on the side of `wo`.
struct ShadingFrame {
    // Away from the surface, to where the ray came from.
    wo: vec3<f32>,
    shading: vec3<f32>,
    geometric: vec3<f32>,
    // 1 where the surface is seen from its back, by its winding.
    back_face: u32,
}

struct BsdfSample {
    // World space, unit length.
    direction: vec3<f32>,
    // By solid angle, of the whole mixture; 0 where the direction is the only one that its lobe has.
    pdf: f32,
    // f * cos / pdf, or such a lobe's value by its probability; 0 where nothing is carried.
    weight: vec3<f32>,
}

struct BsdfValue {
    // f * cos.
    value: vec3<f32>,
    // By which mixture_sample() draws this direction, by solid angle.
    pdf: f32,
}

// Probability of sampling the specular lobe instead of the diffuse one: by luminance.
fn share_of_specular(kd: vec3<f32>, ks: vec3<f32>) -> f32 {
    let specular = luminance(ks);
    return select(0.0, specular / (luminance(kd) + specular), specular > 0.0);
}

fn is_above(frame: ShadingFrame, wi: vec3<f32>) -> bool {
    return dot(wi, frame.shading) > 0.0 && dot(wi, frame.geometric) > 0.0;
}

// The mixture in a direction `wi`, but for lobes of a single direction.
fn mixture_evaluate(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> BsdfValue {
    var carries = is_above(frame, wi);
    @if(dielectric) {
        carries = carries && (m.flags & MATERIAL_DIELECTRIC) == 0u;
    }
    if (!carries) {
        return BsdfValue(vec3<f32>(0.0), 0.0);
    }
    let cos_theta = dot(wi, frame.shading);
    var value = lambert_value(m.kd, cos_theta);
    var pdf = lambert_pdf(cos_theta);
    @if(normals) {
        value *= crowding(frame.shading, frame.geometric);
        pdf *= crowding(frame.shading, frame.geometric);
    }
    @if(ggx || phong || mirror) {
        pdf *= 1.0 - m.specular_probability;
    }
    @if(ggx || phong) {
        var lobe = lobe_evaluate(m, frame, wi);
        @if(normals) {
            let below = mirrored(wi, frame.geometric);
            if (dot(below, frame.shading) > 0.0) {
                let other = lobe_evaluate(m, frame, below);
                lobe = BsdfValue(lobe.value + other.value, lobe.pdf + other.pdf);
            }
        }
        value += lobe.value;
        pdf += m.specular_probability * lobe.pdf;
    }
    @if(alpha) {
        value *= 1.0 - m.transparency;
        pdf *= 1.0 - m.transparency;
    }
    return BsdfValue(value, pdf);
}

// The specular lobe by itself, about the shading normal, above which both directions are.
@if(ggx || phong)
fn lobe_evaluate(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> BsdfValue {
    var lobe = BsdfValue(vec3<f32>(0.0), 0.0);
    @if(phong) {
        if (is_phong(m)) {
            let power = cos_power(reflected(frame.wo, frame.shading), wi, m.ns);
            lobe = BsdfValue(phong_value(m.ks, m.ns, power, dot(wi, frame.shading)), phong_pdf(m.ns, power));
        }
    }
    @if(ggx) {
        if ((m.flags & MATERIAL_GGX) != 0u) {
            let at = ggx_evaluate(m.alpha, frame.shading, frame.wo, wi);
            lobe = BsdfValue(m.ks * at.value, at.pdf);
        }
    }
    return lobe;
}

// Whether the specular lobe, if there is one, is Phong's.
@if(phong)
fn is_phong(m: MaterialRecord) -> bool {
    var phong = true;
    @if(ggx) {
        phong = phong && (m.flags & MATERIAL_GGX) == 0u;
    }
    @if(mirror) {
        phong = phong && (m.flags & MATERIAL_MIRROR) == 0u;
    }
    return phong;
}

// `pick` chooses the lobe, `u` the direction; all in [0, 1).
fn mixture_sample(m: MaterialRecord, frame: ShadingFrame, pick: f32, u: vec2<f32>) -> BsdfSample {
    var chosen = pick;
    @if(alpha) {
        if (pick < m.transparency) {
            return BsdfSample(-frame.wo, 0.0, m.tf);
        }
        // Below 1 however the division is rounded, as all that follows expects.
        chosen = min((pick - m.transparency) / (1.0 - m.transparency), 0x1.fffffep-1);
    }
    @if(dielectric) {
        if ((m.flags & MATERIAL_DIELECTRIC) != 0u) {
            return dielectric_sample(m, frame, chosen);
        }
    }
    @if(mirror) {
        if ((m.flags & MATERIAL_MIRROR) != 0u && chosen < m.specular_probability) {
            let wi = mirror_direction(frame);
            return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), m.ks / m.specular_probability, is_above(frame, wi)));
        }
    }
    return density_sample(m, frame, chosen, u);
}

// A direction of the lobes that have density.
fn density_sample(m: MaterialRecord, frame: ShadingFrame, pick: f32, u: vec2<f32>) -> BsdfSample {
    var wi = direction_around(frame.shading, cosine_angle(u.x), u.y);
    @if(normals) {
        wi = crowded(wi, frame.shading, frame.geometric);
    }
    @if(phong) {
        if (pick < m.specular_probability && is_phong(m)) {
            wi = direction_around(reflected(frame.wo, frame.shading), phong_angle(m.ns, u.x), u.y);
        }
    }
    @if(ggx) {
        if (pick < m.specular_probability && (m.flags & MATERIAL_GGX) != 0u) {
            wi = ggx_sample(m.alpha, frame.shading, frame.wo, u);
        }
    }
    @if(normals && (ggx || phong)) {
        // Below the shading normal a lobe carries nothing, wherever the surface is.
        if (pick < m.specular_probability && dot(wi, frame.shading) > 0.0) {
            wi = kept_above(wi, frame.geometric);
        }
    }
    let at = mixture_evaluate(m, frame, wi);
    // A pdf of 0 is left to a direction below the surface: it carries nothing.
    var weight = select(vec3<f32>(0.0), at.value / at.pdf, at.pdf > 0.0);
    @if(!(ggx || phong || mirror)) {
        // Cosine sampling of a Lambert surface: f cos / pdf is kd, without a rounding.
        weight = select(vec3<f32>(0.0), m.kd, at.pdf > 0.0);
    }
    return BsdfSample(wi, at.pdf, weight);
}

// Where a mirror reflects to.
@if(dielectric || mirror)
fn mirror_direction(frame: ShadingFrame) -> vec3<f32> {
    var wi = reflected(frame.wo, frame.shading);
    @if(normals) {
        wi = kept_above(wi, frame.geometric);
    }
    return wi;
}

// Reflected or refracted by Fresnel's probability, which leaves a weight of 1, but for the filter, and for radiance being
// squeezed into or out of a narrower cone.
@if(dielectric)
fn dielectric_sample(m: MaterialRecord, seen: ShadingFrame, pick: f32) -> BsdfSample {
    var frame = seen;
    let at = interface_of(m.ni, frame.back_face != 0u);
    var split = fresnel(at, dot(frame.wo, frame.shading));
    @if(normals) {
        // Total reflection about a smooth normal can catch light for ever. Where the surface itself would let some out, it does.
        let own = fresnel(at, dot(frame.wo, frame.geometric));
        if (split.cos_transmitted == 0.0 && own.cos_transmitted > 0.0) {
            split = own;
            frame.shading = frame.geometric;
        }
    }
    if (pick < split.reflectance) {
        let wi = mirror_direction(frame);
        return BsdfSample(wi, 0.0, vec3<f32>(select(0.0, 1.0, is_above(frame, wi))));
    }
    var wi = refracted(at, frame.wo, frame.shading, split.cos_transmitted);
    @if(normals) {
        wi = -kept_above(-wi, frame.geometric);
    }
    let beyond = dot(wi, frame.shading) < 0.0 && dot(wi, frame.geometric) < 0.0;
    return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), eta_squared(at) * m.tf, beyond));
}
