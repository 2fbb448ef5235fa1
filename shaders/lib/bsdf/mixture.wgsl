// A surface's BSDF. Beside Lambert's it has one specular lobe, of Phong (feature `phong`), GGX (`ggx`) or a mirror
// (`mirror`), chosen by luminance, and over both there may be a clear coat (`coat`); part of the light may pass straight through (`alpha`);
// or it is a smooth dielectric and nothing else (`dielectric`), or a pane (`thin`). Lobes that have density are one mixture; below the
// surface they carry nothing. Where the shading normal is not the surface's own (`normals`), what would be lost to that is kept
// (lib/bsdf/facet).

import package::gen::{MaterialRecord};
@if(dielectric) import package::gen::{MATERIAL_DIELECTRIC};
@if(ggx) import package::gen::{MATERIAL_GGX};
@if(mirror) import package::gen::{MATERIAL_MIRROR};
@if(thin) import package::gen::{MATERIAL_THIN};
@if(phong) import package::lib::math::{cos_power};
@if(coat) import package::lib::bsdf::coat::{coat_evaluate, coat_over_diffuse, coat_over_specular, coat_reflectance, coat_share};
@if(dielectric) import package::lib::bsdf::glass::{dielectric_sample};
@if(ggx) import package::lib::bsdf::ggx::{ggx_evaluate};
@if(ggx || coat) import package::lib::bsdf::ggx::{ggx_sample};
@if(normals) import package::lib::bsdf::facet::{crowded, crowding, kept_above, mirrored};
@if(normals && coat) import package::lib::bsdf::facet::{cos_before_crowding};
import package::lib::bsdf::frame::{BsdfSample, BsdfValue, ShadingFrame, is_above};
@if(mirror || coat) import package::lib::bsdf::frame::{mirror_direction};
import package::lib::colour::{luminance};
import package::lib::bsdf::lambert::{lambert_pdf, lambert_value};
@if(phong) import package::lib::bsdf::mirror::{reflected};
@if(thin) import package::lib::bsdf::pane::{pane_sample};
@if(phong) import package::lib::bsdf::phong::{phong_pdf, phong_value};
import package::lib::sampling::{cosine_angle, direction_around};
@if(phong) import package::lib::sampling::{phong_angle};

// Probability of sampling the specular lobe instead of the diffuse one: by luminance.
fn share_of_specular(kd: vec3<f32>, ks: vec3<f32>) -> f32 {
    let specular = luminance(ks);
    return select(0.0, specular / (luminance(kd) + specular), specular > 0.0);
}

// The mixture in a direction `wi`, but for lobes of a single direction.
fn mixture_evaluate(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> BsdfValue {
    var carries = is_above(frame, wi);
    @if(dielectric) {
        carries = carries && (m.flags & MATERIAL_DIELECTRIC) == 0u;
    }
    @if(thin) {
        carries = carries && (m.flags & MATERIAL_THIN) == 0u;
    }
    if (!carries) {
        return BsdfValue(vec3<f32>(0.0), 0.0);
    }
    let cos_theta = dot(wi, frame.shading);
    var value = diffuse_lobe(m, frame, wi);
    var pdf = lambert_pdf(cos_theta);
    @if(normals) {
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
    @if(coat) {
        let share = coat_share(m, dot(frame.wo, frame.shading));
        let coat = coat_lobe(m, frame, wi);
        value += coat.value;
        pdf = (1.0 - share) * pdf + share * coat.pdf;
    }
    @if(alpha) {
        value *= 1.0 - m.transparency;
        pdf *= 1.0 - m.transparency;
    }
    return BsdfValue(value, pdf);
}

// f * cos of the diffuse lobe by itself, above the surface.
fn diffuse_lobe(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> vec3<f32> {
    let cos_theta = dot(wi, frame.shading);
    var value = lambert_value(m.kd, cos_theta);
    @if(normals) {
        value *= crowding(frame.shading, frame.geometric);
    }
    @if(coat) {
        var cos_base = cos_theta;
        @if(normals) {
            cos_base = cos_before_crowding(wi, frame.shading, frame.geometric);
        }
        value *= coat_over_diffuse(m, dot(frame.wo, frame.shading), cos_base);
    }
    return value;
}

// The part of mixture_evaluate()'s value that is the same seen from anywhere: the diffuse lobe, where no coat is over it.
@if(reuse && (ggx || phong || coat))
fn mixture_seen_from_anywhere(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> vec3<f32> {
    var diffuse = is_above(frame, wi);
    @if(dielectric) {
        diffuse = diffuse && (m.flags & MATERIAL_DIELECTRIC) == 0u;
    }
    @if(thin) {
        diffuse = diffuse && (m.flags & MATERIAL_THIN) == 0u;
    }
    @if(coat) {
        diffuse = diffuse && m.coat == 0.0;
    }
    var value = select(vec3<f32>(0.0), diffuse_lobe(m, frame, wi), diffuse);
    @if(alpha) {
        value *= 1.0 - m.transparency;
    }
    return value;
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
    @if(coat) {
        lobe.value *= coat_over_specular(m, dot(frame.wo, frame.shading), dot(wi, frame.shading));
    }
    return lobe;
}

// The coat's lobe by itself, with what the facet mirrors.
@if(coat)
fn coat_lobe(m: MaterialRecord, frame: ShadingFrame, wi: vec3<f32>) -> BsdfValue {
    var at = coat_evaluate(m, frame.shading, frame.wo, wi);
    @if(normals) {
        let below = mirrored(wi, frame.geometric);
        if (dot(below, frame.shading) > 0.0) {
            let other = coat_evaluate(m, frame.shading, frame.wo, below);
            at.value += other.value;
            at.pdf += other.pdf;
        }
    }
    return BsdfValue(vec3<f32>(at.value), at.pdf);
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
    @if(thin) {
        if ((m.flags & MATERIAL_THIN) != 0u) {
            return pane_sample(m, frame, chosen);
        }
    }
    @if(coat) {
        return coated_sample(m, frame, chosen, u);
    }
    @else {
        @if(mirror) {
            if ((m.flags & MATERIAL_MIRROR) != 0u && chosen < m.specular_probability) {
                let wi = mirror_direction(frame);
                return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), m.ks / m.specular_probability, is_above(frame, wi)));
            }
        }
        return density_sample(m, frame, chosen, u);
    }
}

// The same of a surface that may have a coat: that is chosen first.
@if(coat)
fn coated_sample(m: MaterialRecord, frame: ShadingFrame, pick: f32, u: vec2<f32>) -> BsdfSample {
    let cos_o = dot(frame.wo, frame.shading);
    let share = coat_share(m, cos_o);
    let coated = pick < share;
    let below = select(min((pick - share) / (1.0 - share), 0x1.fffffep-1), 1.0, coated);
    var is_mirror = coated && m.coat_alpha == 0.0;
    // Of a mirror, by the probability of choosing it.
    var part = vec3<f32>(0.0);
    if (is_mirror) {
        part = vec3<f32>(coat_reflectance(m, cos_o) / share);
    }
    @if(mirror) {
        if ((m.flags & MATERIAL_MIRROR) != 0u && below < m.specular_probability) {
            is_mirror = true;
            part = m.ks * (coat_over_specular(m, cos_o, cos_o) / ((1.0 - share) * m.specular_probability));
        }
    }
    if (is_mirror) {
        let wi = mirror_direction(frame);
        return BsdfSample(wi, 0.0, select(vec3<f32>(0.0), part, is_above(frame, wi)));
    }
    return density_sample(m, frame, below, u, coated);
}

// A direction of the lobes that have density; `coated`: of the coat, and `pick` is 1.
fn density_sample(m: MaterialRecord, frame: ShadingFrame, pick: f32, u: vec2<f32>, @if(coat) coated: bool) -> BsdfSample {
    var wi = direction_around(frame.shading, cosine_angle(u.x), u.y);
    @if(normals) {
        wi = crowded(wi, frame.shading, frame.geometric);
    }
    @if(phong) {
        if (pick < m.specular_probability && is_phong(m)) {
            wi = direction_around(reflected(frame.wo, frame.shading), phong_angle(m.ns, u.x), u.y);
        }
    }
    @if(ggx && !coat) {
        if (pick < m.specular_probability && (m.flags & MATERIAL_GGX) != 0u) {
            wi = ggx_sample(m.alpha, frame.shading, frame.wo, u);
        }
    }
    @if(coat) {
        // Facets of the coat, of the base, or none.
        var alpha = select(0.0, m.coat_alpha, coated);
        @if(ggx) {
            if (pick < m.specular_probability && (m.flags & MATERIAL_GGX) != 0u) {
                alpha = m.alpha;
            }
        }
        if (alpha > 0.0) {
            wi = ggx_sample(alpha, frame.shading, frame.wo, u);
        }
    }
    @if(normals && coat) {
        if (coated && dot(wi, frame.shading) > 0.0) {
            wi = kept_above(wi, frame.geometric);
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
    @if(!(ggx || phong || mirror || coat)) {
        // Cosine sampling of a Lambert surface: f cos / pdf is kd, without a rounding.
        weight = select(vec3<f32>(0.0), m.kd, at.pdf > 0.0);
    }
    return BsdfSample(wi, at.pdf, weight);
}
