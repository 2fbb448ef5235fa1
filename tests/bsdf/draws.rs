//! Draws of the lobes that have density: equal to the twin's, and distributed as their pdf says.

use lucerna::cpu::bsdf::Specular::{Ggx, Mirror, Phong};
use lucerna::cpu::bsdf::{Reflection, Specular};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};

use super::cells::cells;
use super::{BsdfProbe, draws, frame, probe, rig};
use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};

const TWINS: [(f32, f32, Specular, f64); 10] = [
    (0.7, 0.0, Phong(0.0), 20.0),
    (0.4, 0.5, Phong(33.0), 50.0),
    (0.0, 1.0, Phong(1000.0), 75.0),
    (0.2, 0.6, Phong(1e5), 30.0),
    (0.0, 1.0, Ggx(1.0), 0.0),
    (0.4, 0.5, Ggx(0.25), 50.0),
    (0.0, 1.0, Ggx(0.03), 89.0),
    (0.2, 0.6, Ggx(1e-3), 30.0),
    (0.0, 1.0, Ggx(2e-4), 60.0),
    (0.3, 0.4, Mirror, 60.0),
];

/// How far a lobe of this width lets a density be off: a direction's coordinates err by 2^-22.
fn sharpness(lobe: Specular, degrees: f64) -> f64 {
    match lobe {
        // Of the exponential, 2 n sqrt(17 / n), 17 being -log of the tail's end.
        Phong(ns) => 2.0 * ns.max(1.0).sqrt() * 17f64.sqrt() * 2f64.powi(-22),
        // The logarithm of D moves by at most 2 / alpha of the facet's angle; that is of the sum of two directions, which
        // is short where they graze.
        Ggx(alpha) => 2.0 / alpha / degrees.to_radians().cos() * 2f64.powi(-22),
        Mirror => 0.0,
    }
}

#[test]
fn draws_equal_the_f64_twin() {
    let mut rig = rig();
    for (kd, ks, lobe, degrees) in TWINS {
        for transparency in [0.0, 0.25] {
            let mut probe = BsdfProbe { count: 1 << 14, ..probe(kd, ks, lobe, degrees) };
            probe.material.transparency = transparency;
            let view = frame(&probe);
            let reflection = Reflection::from(&probe.material);
            let mut worst = [0.0f64; 3];
            for (i, got) in draws(&mut rig, &probe).iter().enumerate() {
                let key = sample_key(i as u32, 0, probe.seed);
                let right = reflection.sample(&view, sample_1d(key, 0), sample_2d(key, 1));
                worst[0] = worst[0].max(right.direction.distance(got.direction));
                let cos = view.shading.dot(right.direction);
                if cos.abs() < 1e-5 {
                    continue;
                }
                assert_eq!(got.pdf == 0.0, right.pdf == 0.0 || cos < 0.0, "{lobe:?}, draw {i}: specular or not");
                let weight = match right.pdf > 0.0 && cos > 0.0 {
                    true => {
                        let at = reflection.evaluate(&view, got.direction);
                        worst[1] = worst[1].max((got.pdf / at.pdf - 1.0).abs());
                        worst[1] = worst[1].max((got.evaluated / at.pdf - 1.0).abs());
                        at.value / at.pdf
                    }
                    false => right.weight,
                };
                let off = (got.weight - weight).abs().max_element() / weight.max_element().max(1e-3);
                // A cosine errs by 2^-22 too, and the weight of a grazing direction goes with it.
                worst[2] = worst[2].max(off - 2f64.powi(-22) / cos.abs());
            }
            let density = sharpness(lobe, degrees);
            assert!(worst[0] < 2e-6, "{lobe:?}: a direction is off by {}", worst[0]);
            assert!(worst[1] < 1e-5 + density, "{lobe:?}: a pdf is off by {}", worst[1]);
            assert!(worst[2] < 2e-5 + density, "{lobe:?}: a weight is off by {}", worst[2]);
        }
    }
}

const MIXTURES: [(f32, f32, Specular, f64); 17] = [
    (0.7, 0.0, Phong(0.0), 40.0),
    (0.0, 1.0, Phong(0.0), 10.0),
    (0.0, 1.0, Phong(1.0), 60.0),
    (0.0, 1.0, Phong(25.0), 0.0),
    (0.0, 1.0, Phong(1000.0), 80.0),
    (0.0, 1.0, Phong(1e5), 45.0),
    (0.5, 0.4, Phong(20.0), 35.0),
    (0.3, 0.6, Phong(300.0), 70.0),
    (0.0, 1.0, Ggx(1.0), 0.0),
    (0.0, 1.0, Ggx(0.1), 89.0),
    (0.0, 1.0, Ggx(0.3), 60.0),
    (0.0, 1.0, Ggx(0.3), 80.0),
    (0.0, 1.0, Ggx(0.03), 45.0),
    (0.0, 1.0, Ggx(0.01), 0.0),
    (0.0, 1.0, Ggx(1e-3), 80.0),
    (0.5, 0.4, Ggx(0.1), 50.0),
    (0.3, 0.6, Ggx(0.5), 70.0),
];

#[test]
fn draws_follow_the_pdf() {
    let mut rig = rig();
    for (kd, ks, lobe, degrees) in MIXTURES {
        let probe = probe(kd, ks, lobe, degrees);
        let view = frame(&probe);
        let reflection = Reflection::from(&probe.material);
        let cells = cells(&probe, lobe);
        let observed = cells.count(draws(&mut rig, &probe).iter().map(|draw| draw.direction));
        let parts = cells.integrate(|d| reflection.evaluate(&view, d).pdf);
        // The cells that the horizon or the lobe's own edge cuts are integrated to 1e-3, once over the sphere.
        let total = parts.iter().sum::<f64>();
        assert!((total - 1.0).abs() < 1e-3, "{lobe:?} at {degrees}: the pdf integrates to {total}");
        let expected: Vec<f64> = parts.iter().map(|p| p * f64::from(probe.count)).collect();
        let z = chi_square_z(&observed, &expected);
        assert!(z < CHI_SQUARE_LIMIT, "{lobe:?} at {degrees} degrees: chi-square is {z} deviations out");
        // A pdf that is 2 % too high on one side and too low on the other must not pass.
        let tilted = |i: usize| if i % cells.turns < cells.turns / 2 { 1.02 } else { 0.98 };
        let wrong: Vec<f64> = expected.iter().enumerate().map(|(i, e)| e * tilted(i)).collect();
        assert!(chi_square_z(&observed, &wrong) > 2.0 * CHI_SQUARE_LIMIT, "{lobe:?}: a pdf wrong by 2 % passes");
    }
}
