//! White furnace: what each lobe reflects in all, against quadrature in f64.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use lucerna::cpu::bsdf::ShadingFrame;
use lucerna::cpu::bsdf::Specular::{Ggx, Phong};
use lucerna::cpu::bsdf::ggx::lambda;
use lucerna::gpu::Runtime;

use super::{ALBEDO, BsdfProbe, frame, probe, rig, run};

/// Mean weight of a probe's draws, over the unit square.
fn mean(rig: &mut Runtime, probe: &BsdfProbe) -> DVec3 {
    let rows = run(rig, &ALBEDO, probe, probe.count as usize);
    rows.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / f64::from(probe.count)
}

/// Albedo of the Phong lobe for ks = 1 by quadrature over the angle from the mirror direction; around it, the cosine above
/// the horizon integrates in closed form.
fn phong_albedo(ns: f64, cos_view: f64) -> f64 {
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

#[test]
fn phong_albedo_is_the_integral() {
    let mut rig = rig();
    for ns in [0.0, 1.0, 7.0, 100.0, 3e3, 1e5] {
        for degrees in [0.0, 30.0, 60.0, 80.0, 89.0] {
            let both = BsdfProbe { count: 640, ..probe(0.5, 0.5, Phong(ns), degrees) };
            let p = f64::from(both.material.specular_probability);
            let lobe = mean(&mut rig, &BsdfProbe { pick: 0.0, ..both });
            let cosine = mean(&mut rig, &BsdfProbe { pick: 0.999_999, ..both });
            let got = p * lobe + (1.0 - p) * cosine;
            let ShadingFrame { shading: n, wo, .. } = frame(&both);
            let right = both.material.kd.as_dvec3() + both.material.ks.as_dvec3() * phong_albedo(ns, n.dot(wo));
            assert!((got - right).abs().max_element() < 1e-4, "Ns {ns}, {degrees} degrees: {got}, not {right}");
        }
    }
}

/// The integral over facets h of D (wo h) / cos_o times `term` of the cosine of wo's reflection about h, by the midpoint rule in
/// s and turn, where tan h = alpha sqrt(1 - s^2) / s makes D cos_h uniform but for 2 s.
fn over_facets(alpha: f64, cos_view: f64, term: impl Fn(f64) -> f64) -> f64 {
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

const ALPHAS: [f64; 5] = [1e-3, 0.02, 0.2, 0.6, 1.0];
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];

#[test]
fn ggx_albedo_is_the_integral() {
    let mut rig = rig();
    for alpha in ALPHAS {
        for degrees in ANGLES {
            let probe = BsdfProbe { count: 640, ..probe(0.0, 1.0, Ggx(alpha), degrees) };
            let got = mean(&mut rig, &probe).x;
            let view = frame(&probe);
            let cos_view = view.shading.dot(view.wo);
            let masked = lambda(alpha, cos_view);
            let right = over_facets(alpha, cos_view, |cos| match cos > 0.0 {
                true => 1.0 / (1.0 + masked + lambda(alpha, cos)),
                false => 0.0,
            });
            assert!((got - right).abs() < 1e-4, "alpha {alpha}, {degrees} degrees: {got}, not {right}");
        }
    }
}

#[test]
fn ggx_facets_that_are_seen_fill_the_view() {
    // The weak white furnace (Heitz 2014): masked but not shadowed, nothing is lost.
    for alpha in ALPHAS {
        for degrees in ANGLES {
            let cos_view = degrees.to_radians().cos();
            let all = over_facets(alpha, cos_view, |_| 1.0 / (1.0 + lambda(alpha, cos_view)));
            assert!((all - 1.0).abs() < 1e-4, "alpha {alpha}, {degrees} degrees: {all}");
        }
    }
}
