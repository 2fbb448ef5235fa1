//! Elementary functions and random numbers.

use std::f64::consts::TAU;

use glam::{DVec2, Vec4};
use lucerna::cpu::rng::{sample_2d, sample_key};

use super::{BsdfProbe, ELEMENTARY, rig, run};

#[test]
fn elementary_functions_keep_their_digits() {
    let mut rig = rig();
    // Numbers of all magnitudes below 1, and the ones next to 1.
    let mut inputs: Vec<f32> = (1..40_000).map(|i| 2f32.powf(-24.0 * (i as f32) / 40_000.0)).collect();
    inputs.extend((1..1000).map(|i| 1.0 - i as f32 / (1 << 24) as f32));
    let rows: Vec<Vec4> = inputs.iter().map(|&x| Vec4::splat(x)).collect();
    rig.upload("probed", &rows).unwrap();
    let params = BsdfProbe { count: rows.len() as u32, ..BsdfProbe::default() };
    let got = run(&mut rig, &ELEMENTARY, &params, rows.len());
    for (&x, got) in inputs.iter().zip(got) {
        let x = f64::from(x);
        let relative = |got: f32, right: f64| (f64::from(got) / right - 1.0).abs();
        // 4 ulp; of the exponential, WGSL allows 3 + 2 |x| ulp, on a result near -1.
        assert!(relative(got.x, (-x).ln_1p()) < 4.0 * f64::from(f32::EPSILON), "log1p(-{x}) = {}", got.x);
        assert!(relative(got.y, (-x * 20.0).exp_m1()) < 8e-7, "expm1(-20 * {x}) = {}", got.y);
        let (sin, cos) = (x * TAU).sin_cos();
        assert!((f64::from(got.z) - sin).abs() < 2e-7 && (f64::from(got.w) - cos).abs() < 2e-7, "turn {x}: {got}");
    }
}

#[test]
fn equal_keys_draw_equal_numbers_and_others_do_not() {
    let key = sample_key(77, 5, 9);
    assert_eq!((key.index, key.half), (2, 1));
    assert_eq!(sample_2d(key, 4), sample_2d(key, 4));
    let others = [sample_key(78, 5, 9), sample_key(77, 4, 9), sample_key(77, 7, 9), sample_key(77, 5, 8)];
    assert!(others.iter().all(|&other| sample_2d(other, 4) != sample_2d(key, 4)));
    assert_ne!(sample_2d(key, 5), sample_2d(key, 4));
    // Neighbouring pixels: the correlation of 2^20 pairs has a deviation of 2^-10; five of them.
    let draw = |pixel: u32| sample_2d(sample_key(pixel, 0, 3), 0) - DVec2::splat(0.5);
    let sum: DVec2 = (0..1 << 20).map(|pixel| draw(pixel) * draw(pixel + 1)).sum();
    let correlation = sum / f64::from(1 << 20) * 12.0;
    assert!(correlation.abs().max_element() < 5.0 / 1024.0, "{correlation}");
}
