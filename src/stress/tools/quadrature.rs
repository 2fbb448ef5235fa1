//! What lobes reflect in all, by quadrature in f64.

use std::f64::consts::{PI, TAU};

use crate::cpu::bsdf::ggx::lambda;

/// Albedo of the Phong lobe for ks = 1 by quadrature over the angle from the mirror direction; around it, the cosine above
/// the horizon integrates in closed form.
pub fn phong_albedo(ns: f64, cos_view: f64) -> f64 {
    let sin_view = (1.0 - cos_view * cos_view).sqrt();
    const STEPS: usize = 200_000;
    // Steps in s with alpha = pi / 2 * s^4: fine where the lobe of a large exponent is.
    let term = |i: usize| {
        let s = (i as f64 + 0.5) / STEPS as f64;
        let alpha = 0.5 * PI * s.powi(4);
        let (a, b) = (alpha.cos() * cos_view, alpha.sin() * sin_view);
        let ring = match a {
            _ if a >= b => TAU * a,
            _ => {
                let edge = (-a / b).acos();
                2.0 * (a * edge + b * edge.sin())
            }
        };
        alpha.cos().powf(ns) * ring * alpha.sin() * 2.0 * PI * s.powi(3)
    };
    (0..STEPS).map(term).sum::<f64>() / STEPS as f64 * (ns + 2.0) / TAU
}

/// The integral over facets h of D (wo h) / cos_o times `term` of the cosine of wo's reflection about h, by the midpoint rule in
/// s and turn, where tan h = alpha sqrt(1 - s^2) / s makes D cos_h uniform but for 2 s.
pub fn over_facets(alpha: f64, cos_view: f64, term: impl Fn(f64) -> f64) -> f64 {
    // At grazing angles a third as many are off by 1e-4.
    const STEPS: usize = 3000;
    let sin_view = (1.0 - cos_view * cos_view).sqrt();
    let mut sum = 0.0;
    for i in 0..STEPS {
        let s = (i as f64 + 0.5) / STEPS as f64;
        let tan = alpha * (1.0 - s * s).sqrt() / s;
        let cos2 = 1.0 / (1.0 + tan * tan);
        for j in 0..STEPS / 2 {
            let turn = PI * (j as f64 + 0.5) / (STEPS / 2) as f64;
            // (wo h) / cos_h.
            let frame = cos_view + sin_view * tan * turn.cos();
            if frame > 0.0 {
                let cos_i = 2.0 * frame * cos2 - cos_view;
                sum += 2.0 * s * frame / cos_view * term(cos_i);
            }
        }
    }
    sum / (STEPS * STEPS / 2) as f64
}

/// Albedo of the GGX lobe without Fresnel's part.
pub fn ggx_albedo(alpha: f64, cos_view: f64) -> f64 {
    let masked = lambda(alpha, cos_view);
    over_facets(alpha, cos_view, |cos| match cos > 0.0 {
        true => 1.0 / (1.0 + masked + lambda(alpha, cos)),
        false => 0.0,
    })
}
