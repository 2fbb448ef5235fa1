//! Shading normals that lean off the facet they are on: nothing is lost to that, and draws still follow the pdf.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use lucerna::components::{Material, Passage};
use lucerna::cpu::bsdf::Specular::{Ggx, Mirror, Phong};
use lucerna::cpu::bsdf::{Reflection, Specular};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};
use lucerna::gpu::Runtime;

use super::cells::Cells;
use super::{ALBEDO, BsdfProbe, draws, frame, leaning, library, look, probe, rig, run};
use crate::support;
use crate::support::plant::plant;

/// Degrees between viewer and shading normal, between the normals, and turns of the lean from the viewer's side.
const LEANS: [(f64, f64, f64); 6] =
    [(70.0, 30.0, 0.0), (50.0, 45.0, 0.1), (85.0, 20.0, 0.0), (30.0, 54.0, 0.4), (60.0, 0.5, 0.2), (20.0, 25.0, 0.5)];

const SURFACES: [(f32, f32, Specular); 9] = [
    (0.7, 0.0, Phong(0.0)),
    (0.0, 1.0, Phong(5.0)),
    (0.0, 1.0, Phong(100.0)),
    (0.4, 0.5, Phong(33.0)),
    (0.0, 1.0, Ggx(1.0)),
    (0.0, 1.0, Ggx(0.3)),
    (0.0, 1.0, Ggx(0.1)),
    (0.4, 0.5, Ggx(0.2)),
    (0.5, 0.4, Mirror),
];

#[test]
fn draws_equal_the_f64_twin() {
    let mut rig = rig();
    for (kd, ks, lobe) in SURFACES {
        for (degrees, lean, turn) in LEANS {
            let probe = BsdfProbe { count: 1 << 12, ..leaning(probe(kd, ks, lobe, degrees), lean, turn) };
            let (view, reflection) = (frame(&probe), Reflection::from(&probe.material));
            let case = format!("{lobe:?}, {degrees} degrees, leaning by {lean}");
            for (i, got) in draws(&mut rig, &probe).iter().enumerate() {
                let key = sample_key(i as u32, 0, probe.seed);
                let right = reflection.sample(&view, sample_1d(key, 0), sample_2d(key, 1));
                let cosines = [view.shading, view.geometric].map(|n| right.direction.dot(n));
                // On an edge, a rounding decides.
                if cosines.into_iter().any(|cos| cos.abs() < 1e-4) {
                    continue;
                }
                let off = right.direction.distance(got.direction);
                // Where a chord is shortened, a height is the root of what a rounding of its square leaves.
                assert!(off < 2e-5 + 1e-6 / cosines[0].abs(), "{case}: a direction is off by {off}");
                let weight = match right.pdf > 0.0 && cosines[0] > 0.0 {
                    true => {
                        let at = reflection.evaluate(&view, got.direction);
                        // Directions err by 2^-22, and the narrowest lobe's logarithm moves by 20 of that over the cosine.
                        let allowed = 1e-4 + 5e-6 / view.shading.dot(view.wo);
                        assert!(
                            (got.pdf / at.pdf - 1.0).abs() < allowed,
                            "{case}: a pdf of {}, not {}",
                            got.pdf,
                            at.pdf
                        );
                        assert_eq!(got.pdf, got.evaluated, "{case}");
                        at.value / at.pdf
                    }
                    false => right.weight,
                };
                let off = (got.weight - weight).abs().max_element();
                assert!(off < 2e-4 + 1e-6 / cosines[0].abs(), "{case}: a weight of {}, not {weight}", got.weight);
            }
        }
    }
}

/// Cells about the facet's normal, so that no cell has both sides of it.
fn cells(probe: &BsdfProbe) -> Cells {
    Cells { axis: frame(probe).geometric, rows: (0..=90).map(|i| PI * f64::from(i) / 90.0).collect(), turns: 72 }
}

#[test]
fn draws_follow_the_pdf() {
    let mut rig = rig();
    for (kd, ks, lobe) in SURFACES.into_iter().filter(|(_, _, lobe)| *lobe != Mirror) {
        for (degrees, lean, turn) in LEANS {
            let probe = BsdfProbe { count: 1 << 16, ..leaning(probe(kd, ks, lobe, degrees), lean, turn) };
            let (view, reflection, cells) = (frame(&probe), Reflection::from(&probe.material), cells(&probe));
            let case = format!("{lobe:?}, {degrees} degrees, leaning by {lean}");
            let observed = cells.count(draws(&mut rig, &probe).iter().map(|draw| draw.direction));
            let parts = cells.integrate(|d| reflection.evaluate(&view, d).pdf);
            let total = parts.iter().sum::<f64>();
            // The shading horizon, and its image, cut cells: more draws would show what that leaves.
            assert!((total - 1.0).abs() < 2e-3, "{case}: the pdf integrates to {total}");
            cells.hold(&observed, &parts, probe.count, &case);
        }
    }
}

/// What a surface reflects in all.
fn albedo(rig: &mut Runtime, probe: &BsdfProbe) -> DVec3 {
    let mut mean = |pick: f32| {
        let probe = BsdfProbe { count: 512, pick, ..*probe };
        let rows = run(rig, &ALBEDO, &probe, probe.count as usize);
        rows.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / f64::from(probe.count)
    };
    let p = f64::from(probe.material.specular_probability);
    let specular = if p > 0.0 { p * mean(0.0) } else { DVec3::ZERO };
    let diffuse = if p < 1.0 { (1.0 - p) * mean(0.999_999) } else { DVec3::ZERO };
    specular + diffuse
}

/// The most that is lost of a flat surface's albedo, over all surfaces and leans.
fn worst_loss(rig: &mut Runtime) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (kd, ks, lobe) in SURFACES {
        for (degrees, lean, turn) in LEANS {
            let flat = probe(kd, ks, lobe, degrees);
            let (flat_albedo, got) = (albedo(rig, &flat), albedo(rig, &leaning(flat, lean, turn)));
            let off = (got - flat_albedo).abs().max_element();
            if off > worst.0 {
                worst = (off, format!("{lobe:?}, {degrees} degrees, leaning by {lean}: {got}, flat {flat_albedo}"));
            }
        }
    }
    worst
}

#[test]
fn a_leaning_normal_loses_nothing_that_a_flat_one_keeps() {
    // Weights jump where a direction has one origin more: the midpoint rule leaves 1e-3 of that.
    let (off, case) = worst_loss(&mut rig());
    assert!(off < 1e-3, "{case}");
    for (right, wrong) in [
        ("select(wi, mirrored(wi, facet), dot(wi, facet) < 0.0)", "wi"),
        ("return 2.0 / (1.0 + dot(n, facet));", "return 1.0;"),
    ] {
        let library = plant(library(), "lib/bsdf/facet", right, wrong);
        let (off, case) = worst_loss(&mut Runtime::new(support::gpu(), library));
        assert!(off > 1e-2, "`{wrong}` goes unnoticed: {case}");
    }
}

#[test]
fn glass_sends_all_light_to_the_right_sides() {
    let mut rig = rig();
    for ni in [1.0, 1.1, 1.5, 2.4] {
        for back_face in [false, true] {
            for (degrees, lean, turn) in LEANS {
                let values = Material { passage: Passage::Glass(ni), filter: Vec3::ONE, ..Material::BLACK };
                let view = BsdfProbe { back_face: u32::from(back_face), count: 1 << 10, ..look(&values, degrees) };
                let probe = leaning(view, lean, turn);
                let (view, reflection) = (frame(&probe), Reflection::from(&probe.material));
                let squeeze = f64::from(if back_face { ni } else { 1.0 / ni }).powi(2);
                for (i, got) in draws(&mut rig, &probe).iter().enumerate() {
                    let key = sample_key(i as u32, 0, probe.seed);
                    let right = reflection.sample(&view, sample_1d(key, 0), sample_2d(key, 1));
                    let case = format!("Ni {ni}, from behind: {back_face}, {degrees} degrees, leaning by {lean}");
                    let off = got.direction.distance(right.direction);
                    assert!(off < 2e-5, "{case}: {}, not {}", got.direction, right.direction);
                    let crosses = got.direction.dot(view.geometric) < 0.0;
                    let weight = if crosses { squeeze } else { 1.0 };
                    assert!((got.weight - weight).abs().max_element() < 1e-5, "{case}: a weight of {}", got.weight);
                }
            }
        }
    }
}
