// Normalised modified Phong lobe: f = ks (n + 2) / (2 pi) cos^n(alpha), alpha from the mirror direction (Lafortune and
// Willems 1994). `lobe` is cos^n(alpha).

import package::lib::math::{INV_PI};

// f * cos of the incident direction.
fn phong_value(ks: vec3<f32>, n: f32, lobe: f32, cos_theta: f32) -> vec3<f32> {
    return ks * (0.5 * INV_PI * (n + 2.0) * lobe * cos_theta);
}

fn phong_pdf(n: f32, lobe: f32) -> f32 {
    return 0.5 * INV_PI * (n + 1.0) * lobe;
}
