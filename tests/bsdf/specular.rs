//! Lobes of a single direction: mirror, dielectric, and what passes straight through.

use glam::{DVec3, Vec3};
use lucerna::components::{Material, Passage};
use lucerna::cpu::bsdf::dielectric::Interface;
use lucerna::cpu::bsdf::{Reflection, Specular, mirror};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};
use lucerna::gpu::Runtime;

use super::{BsdfProbe, SPLIT, draws, frame, library, look, probe, rig, run};
use crate::support;

fn glass(ni: f32, tf: Vec3, degrees: f64, back_face: bool) -> BsdfProbe {
    let values = Material { passage: Passage::Glass(ni), filter: tf, diffuse: Vec3::ONE, ..Material::BLACK };
    BsdfProbe { back_face: u32::from(back_face), count: 1 << 14, ..look(&values, degrees) }
}

#[test]
fn a_mirror_reflects_into_one_direction() {
    let mut rig = rig();
    for degrees in [0.0, 45.0, 89.0, 89.99] {
        let probe = BsdfProbe { count: 64, ..probe(0.0, 1.0, Specular::Mirror, degrees) };
        let view = frame(&probe);
        for draw in draws(&mut rig, &probe) {
            assert!(draw.direction.distance(mirror(view.shading, view.wo)) < 5e-7, "at {degrees} degrees");
            assert_eq!((draw.pdf, draw.evaluated), (0.0, 0.0));
            assert_eq!(draw.weight, DVec3::new(1.0, 0.5, 1.0));
        }
    }
}

/// Worst error of the kernel's reflectance over angles and indices, by itself and beside what passes, in units of what is
/// allowed.
fn fresnel_error(rig: &mut Runtime) -> f64 {
    let mut cosines: Vec<f32> = (0..=4096).map(|i| i as f32 / 4096.0).collect();
    cosines.extend((1..40).map(|i| 2f32.powi(-i)));
    let rows: Vec<glam::Vec4> = cosines.iter().map(|&c| glam::Vec4::splat(c)).collect();
    let mut worst = 0f64;
    for ni in [1.0, 1.0001, 1.01, 1.33, 1.5, 2.0, 2.42, 3.0] {
        for back_face in [false, true] {
            rig.upload("probed", &rows).unwrap();
            let params = BsdfProbe { count: rows.len() as u32, ..glass(ni, Vec3::ONE, 0.0, back_face) };
            let got = run(rig, &SPLIT, &params, rows.len());
            let at = Interface::new(f64::from(ni), back_face);
            for (&cos, got) in cosines.iter().zip(got) {
                let cos = f64::from(cos);
                let right = at.reflectance(cos);
                let cos_t = at.cos_transmitted(cos);
                // At the critical angle the curve is upright, and a rounding of the squared sine is one of 2^-23 / cos_t.
                let rounding = cos_t.map_or(2.0, |c| at.here.powi(2) * 2f64.powi(-21) / c.max(1e-4));
                let allowed = (1e-5 + rounding) * right;
                if (cos_t.is_none() || got.y == 0.0) && cos_t.unwrap_or(0.0) < 2e-3 {
                    continue;
                }
                worst = worst.max((f64::from(got.x) - right).abs() / allowed.max(1e-30));
                // What is not reflected passes: the amplitudes of transmission, squared, by cone and cosine.
                if let Some(cos_t) = cos_t.filter(|_| cos > 0.0) {
                    let across = 2.0 * at.here * cos / (at.here * cos + at.beyond * cos_t);
                    let along = 2.0 * at.here * cos / (at.beyond * cos + at.here * cos_t);
                    let passed = at.beyond * cos_t / (at.here * cos) * 0.5 * (across * across + along * along);
                    worst = worst.max((f64::from(got.x) + passed - 1.0).abs() / (1e-5 + rounding));
                }
            }
        }
    }
    worst
}

#[test]
fn fresnel_is_exact() {
    let worst = fresnel_error(&mut rig());
    assert!(worst <= 1.0, "{worst} times what is allowed");
    let name = "lib/bsdf/dielectric";
    let text = std::fs::read_to_string(format!("shaders/{name}.wgsl")).unwrap();
    let wrong = text.replace("min(1.0, 0.5 * (s * s + p * p))", "min(1.0, 0.505 * (s * s + p * p))");
    assert_ne!(text, wrong);
    let mut rig = Runtime::new(support::gpu(), library().with(name, &wrong));
    assert!(fresnel_error(&mut rig) > 1.0, "a reflectance wrong by 1 % passes");
}

#[test]
fn glass_draws_equal_the_twin() {
    let mut rig = rig();
    let tf = Vec3::new(1.0, 0.5, 0.25);
    for ni in [1.0, 1.1, 1.5, 3.0] {
        for back_face in [false, true] {
            for degrees in [0.0, 20.0, 45.0, 80.0, 89.0] {
                let probe = glass(ni, tf, degrees, back_face);
                let view = frame(&probe);
                let reflection = Reflection::from(&probe.material);
                let split = Interface::new(f64::from(ni), back_face).reflectance(view.shading.dot(view.wo));
                for (i, got) in draws(&mut rig, &probe).iter().enumerate() {
                    assert_eq!((got.pdf, got.evaluated), (0.0, 0.0));
                    let key = sample_key(i as u32, 0, probe.seed);
                    let pick = sample_1d(key, 0);
                    if (pick - split).abs() < 1e-5 {
                        continue;
                    }
                    let right = reflection.sample(&view, pick, sample_2d(key, 1));
                    let off = got.direction.distance(right.direction);
                    // Refraction outwards stretches an error by the tangent beyond.
                    assert!(off < 1e-5, "Ni {ni}, {degrees} degrees, {back_face}: a direction is off by {off}");
                    let off = (got.weight - right.weight).abs().max_element();
                    assert!(off < 1e-6 * right.weight.max_element(), "Ni {ni}: {} for {}", got.weight, right.weight);
                    if ni == 1.0 {
                        assert_eq!((got.direction, got.weight), (-probe.wo.as_dvec3().normalize(), tf.as_dvec3()));
                    }
                }
            }
        }
    }
}

#[test]
fn as_much_passes_as_is_not_opaque() {
    let mut rig = rig();
    let values = Material {
        diffuse: Vec3::splat(0.5),
        passage: Passage::SeeThrough(0.3),
        filter: Vec3::new(1.0, 0.5, 0.0),
        ..Material::BLACK
    };
    let probe = BsdfProbe { count: 1 << 18, ..look(&values, 30.0) };
    let all = draws(&mut rig, &probe);
    let (through, rest): (Vec<_>, Vec<_>) = all.iter().partition(|draw| draw.pdf == 0.0);
    // Of 2^18 draws the part has a deviation of 9e-4: five of them.
    let part = through.len() as f64 / all.len() as f64;
    assert!((part - 0.7).abs() < 4.5e-3, "{part}");
    for draw in through {
        assert_eq!((draw.direction, draw.weight), (-probe.wo.as_dvec3().normalize(), DVec3::new(1.0, 0.5, 0.0)));
    }
    assert!(rest.iter().all(|draw| draw.weight == DVec3::splat(0.5)));
}
