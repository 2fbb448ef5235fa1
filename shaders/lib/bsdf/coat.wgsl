// Clear coat: a layer of index 1.5 over part of a surface. It reflects as a mirror does, or as facets of GGX, by Fresnel's equations. What
// it does not reflect of the light from a direction, 1 - E, the base has, and sends back through the coat. Both ways take no more than is
// there, and are the same backwards:
//
// - diffuse light: (1 - E(o)) (1 - E(i)) / (1 - mean of E), so that a white base is white under any coat (Kelemen and Szirmay-Kalos, "A
//   Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling", 2001);
// - the specular lobe: 1 - max(E(o), E(i)), which leaves a mirror what the coat lets through (as KHR_materials_sheen of glTF scales its
//   base).
//
// The base does not darken by what the coat reflects back into it, nor by the angle within: both are left to its colour, as in glTF.

import package::gen::{MaterialRecord};
import package::lib::bsdf::dielectric::{fresnel, interface_of};
import package::lib::bsdf::ggx::{GgxValue, ggx_evaluate};
import package::lib::colour::{luminance};

const COAT_INDEX: f32 = 1.5;

// Mean of Fresnel's reflectance at that index over all directions, by their cosine.
const MEAN_REFLECTANCE: f32 = 0.09177796;

fn coat_fresnel(cos_theta: f32) -> f32 {
    return fresnel(interface_of(COAT_INDEX, false), cos_theta).reflectance;
}

// A polynomial of the roughness r, least power first.
fn of_roughness(r: f32, low: vec3<f32>, high: vec3<f32>) -> f32 {
    return low.x + r * (low.y + r * (low.z + r * (high.x + r * (high.y + r * high.z))));
}

// E of a rough coat by Fresnel's reflectance: at most 0.0017, 0.0051 and 0.0101 of all light above the integral up to 60, 80 and 90
// degrees, and never below. Fitted to it at 47 roughnesses and 88 angles, by a linear program that keeps the greatest excess least.
fn coat_roughness_gain(alpha: f32, cos_theta: f32) -> f32 {
    let r = sqrt(alpha);
    let y = cos_theta * (1.0 + 4.0 * alpha) / (cos_theta + 4.0 * alpha);
    let a = of_roughness(r, vec3<f32>(1.0634, -2.0963, -2.8126), vec3<f32>(13.4761, -15.1459, 5.6163));
    let b = of_roughness(r, vec3<f32>(-1.6539, 13.587, -33.0034), vec3<f32>(36.1644, -18.4744, 3.355));
    let c = of_roughness(r, vec3<f32>(5.5267, -33.0106, 79.4709), vec3<f32>(-100.0, 65.7553, -16.7408));
    let d = of_roughness(r, vec3<f32>(-6.4803, 33.037, -22.3044), vec3<f32>(-42.3632, 63.5393, -26.0373));
    let e = of_roughness(r, vec3<f32>(2.5601, -11.789, -19.9363), vec3<f32>(91.8712, -100.0, 37.1859));
    return a + y * (b + y * (c + y * (d + y * e)));
}

// E: the part of the light from a direction, by its cosine, that the coat reflects.
fn coat_reflectance(m: MaterialRecord, cos_theta: f32) -> f32 {
    var reflectance = coat_fresnel(cos_theta);
    if (m.coat_alpha > 0.0) {
        // The fit is above 1 where light grazes.
        reflectance = min(reflectance * coat_roughness_gain(m.coat_alpha, cos_theta), 1.0);
    }
    return m.coat * reflectance;
}

// Its mean over all directions, by their cosine; of a rough coat at most 0.0006 too little.
fn coat_mean_reflectance(m: MaterialRecord) -> f32 {
    let r = sqrt(m.coat_alpha);
    let rough = 0.09265 + r * of_roughness(r, vec3<f32>(-0.01885, 0.21597, -1.87831), vec3<f32>(4.02832, -3.6083, 1.19101));
    return m.coat * select(MEAN_REFLECTANCE, rough, m.coat_alpha > 0.0);
}

// What is left of the diffuse lobe.
fn coat_over_diffuse(m: MaterialRecord, cos_o: f32, cos_i: f32) -> f32 {
    let through = (1.0 - coat_reflectance(m, cos_o)) * (1.0 - coat_reflectance(m, cos_i));
    return through / (1.0 - coat_mean_reflectance(m));
}

// What is left of the specular lobe.
fn coat_over_specular(m: MaterialRecord, cos_o: f32, cos_i: f32) -> f32 {
    return 1.0 - max(coat_reflectance(m, cos_o), coat_reflectance(m, cos_i));
}

// Probability of sampling the coat instead of what is below it: by what each sends back.
fn coat_share(m: MaterialRecord, cos_o: f32) -> f32 {
    let reflected = coat_reflectance(m, cos_o);
    let base = (1.0 - reflected) * luminance(m.kd + m.ks);
    return select(0.0, reflected / (reflected + base), reflected > 0.0);
}

// f * cos and pdf of a rough coat by itself; both cosines to `n` are above 0.
fn coat_evaluate(m: MaterialRecord, n: vec3<f32>, wo: vec3<f32>, wi: vec3<f32>) -> GgxValue {
    if (m.coat * m.coat_alpha == 0.0) {
        return GgxValue(0.0, 0.0);
    }
    let at = ggx_evaluate(m.coat_alpha, n, wo, wi);
    return GgxValue(m.coat * coat_fresnel(dot(wo, normalize(wo + wi))) * at.value, at.pdf);
}
