//! Coats over every lobe: draws equal the twin's and follow the pdf, no more comes out than goes in, and either way as much.

use glam::{DVec3, Vec3};
use lucerna::components::{Lobe, Material, Passage};
use lucerna::cpu::bsdf::coat::Coat;
use lucerna::cpu::bsdf::{Reflection, ShadingFrame, Specular};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};
use lucerna::gpu::Runtime;

use super::cells::{Cells, cells};
use super::{ALBEDO, BsdfProbe, draws, frame, leaning, library, look, rig, run};
use crate::support;
use crate::support::plant::plant;

/// A base under a coat of an amount and a roughness.
fn coated((kd, ks, lobe): (f32, f32, Lobe), coat: f32, coat_roughness: f32) -> Material {
    Material {
        diffuse: Vec3::splat(kd),
        specular: Vec3::new(ks, 0.5 * ks, ks),
        lobe,
        coat,
        coat_roughness,
        ..Material::BLACK
    }
}

const BASES: [(f32, f32, Lobe); 6] = [
    (0.8, 0.0, Lobe::Phong(0.0)),
    (0.0, 0.0, Lobe::Phong(0.0)),
    (0.4, 0.5, Lobe::Phong(33.0)),
    (0.2, 0.7, Lobe::Ggx(0.4)),
    (0.3, 0.6, Lobe::Mirror),
    (0.0, 1.0, Lobe::Ggx(0.7)),
];

const COATS: [(f32, f32); 5] = [(1.0, 0.0), (0.5, 0.0), (1.0, 0.1), (1.0, 0.45), (0.6, 1.0)];

/// Degrees between viewer and shading normal, between the normals, and turns of the lean from the viewer's side.
const LEANS: [(f64, f64, f64); 3] = [(70.0, 30.0, 0.0), (50.0, 45.0, 0.1), (20.0, 25.0, 0.5)];

#[test]
fn draws_equal_the_f64_twin() {
    let mut rig = rig();
    for base in BASES {
        for (coat, roughness) in COATS {
            for (degrees, lean) in
                [(0.0, None), (50.0, None), (85.0, None), (0.0, Some(LEANS[0])), (0.0, Some(LEANS[1]))]
            {
                let mut values = coated(base, coat, roughness);
                values.passage = if degrees == 50.0 { Passage::SeeThrough(0.75) } else { Passage::Opaque };
                let flat = |degrees: f64| BsdfProbe { count: 1 << 11, ..look(&values, degrees) };
                let probe = lean.map_or_else(|| flat(degrees), |(d, lean, turn)| leaning(flat(d), lean, turn));
                let case = format!("{base:?} under {coat}, {roughness} at {degrees}, {lean:?}");
                equals_the_twin(&mut rig, &probe, &case);
            }
        }
    }
}

fn equals_the_twin(rig: &mut Runtime, probe: &BsdfProbe, case: &str) {
    let (view, reflection) = (frame(probe), Reflection::from(&probe.material));
    let mut parted = 0;
    for (i, got) in draws(rig, probe).iter().enumerate() {
        let key = sample_key(i as u32, 0, probe.seed);
        let right = reflection.sample(&view, sample_1d(key, 0), sample_2d(key, 1));
        let cosines = [view.shading, view.geometric].map(|n| right.direction.dot(n));
        // On an edge, a rounding decides.
        if cosines.into_iter().any(|cos| cos.abs() < 1e-4) {
            continue;
        }
        let off = right.direction.distance(got.direction);
        if off > 1e-3 {
            // So it does between two lobes.
            parted += 1;
            continue;
        }
        assert!(off < 2e-5 + 1e-6 / cosines[0].abs(), "{case}: a direction is off by {off}");
        let weight = match right.pdf > 0.0 && cosines[0] > 0.0 {
            true => {
                let at = reflection.evaluate(&view, got.direction);
                // Directions err by 2^-22, and the narrowest lobe's logarithm moves by 200 of that over the cosine.
                let allowed = 1e-4 + 1e-4 / view.shading.dot(view.wo);
                assert!((got.pdf / at.pdf - 1.0).abs() < allowed, "{case}: a pdf of {}, not {}", got.pdf, at.pdf);
                assert_eq!(got.pdf, got.evaluated, "{case}");
                at.value / at.pdf
            }
            false => right.weight,
        };
        let off = (got.weight - weight).abs().max_element();
        assert!(off < 3e-4 + 1e-6 / cosines[0].abs(), "{case}: a weight of {}, not {weight}", got.weight);
    }
    assert!(parted < 3, "{case}: {parted} draws are of other lobes");
}

#[test]
fn draws_follow_the_pdf() {
    let mut rig = rig();
    for base in BASES {
        for (coat, roughness) in COATS {
            for lean in [None, Some(LEANS[1])] {
                let values = coated(base, coat, roughness);
                let flat = BsdfProbe { count: 1 << 17, ..look(&values, 55.0) };
                let probe = lean.map_or(flat, |(_, lean, turn)| leaning(flat, lean, turn));
                let (view, reflection) = (frame(&probe), Reflection::from(&probe.material));
                let case = format!("{base:?} under {coat}, {roughness}, {lean:?}");
                let all = draws(&mut rig, &probe);
                let single = all.iter().filter(|draw| draw.pdf == 0.0 && draw.weight != DVec3::ZERO).count();
                let single = single as f64 / all.len() as f64;
                let lobe = match (values.coat_roughness > 0.0, reflection.specular) {
                    (true, _) => Specular::Ggx(f64::from(roughness).powi(2)),
                    (false, Specular::Mirror) => Specular::Ggx(1.0),
                    (false, lobe) => lobe,
                };
                let cells = match lean {
                    None => cells(&probe, lobe),
                    // About the facet's normal, so that no cell has both sides of it.
                    Some(_) => {
                        let rows = (0..=90).map(|i| std::f64::consts::PI * f64::from(i) / 90.0).collect();
                        Cells { axis: view.geometric, rows, turns: 72 }
                    }
                };
                let spread = all.iter().filter(|draw| draw.pdf > 0.0 || draw.weight == DVec3::ZERO);
                let observed = cells.count(spread.map(|draw| draw.direction));
                let parts = cells.integrate(|d| reflection.evaluate(&view, d).pdf);
                let total = parts.iter().sum::<f64>() + single;
                // Four errors of a rate; and what cells that an edge cuts leave.
                let allowed = 2e-3 + 4.0 * (single * (1.0 - single) / all.len() as f64).sqrt();
                assert!((total - 1.0).abs() < allowed, "{case}: the pdf integrates to {total}");
                if single > 0.999 {
                    continue;
                }
                cells.hold(&observed, &parts, probe.count, &case);
            }
        }
    }
}

/// What a surface reflects in all, lobe by lobe.
fn albedo(rig: &mut Runtime, probe: &BsdfProbe) -> DVec3 {
    let mut mean = |pick: f64| {
        let probe = BsdfProbe { count: 512, pick: pick as f32, ..*probe };
        let rows = run(rig, &ALBEDO, &probe, probe.count as usize);
        rows.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / f64::from(probe.count)
    };
    let view = frame(probe);
    let reflection = Reflection::from(&probe.material);
    let base = (reflection.kd + reflection.ks).dot(DVec3::new(0.2126, 0.7152, 0.0722));
    let (coat, p) = (reflection.coat.share(view.wo.dot(view.shading), base), reflection.specular_probability);
    let parts = [(coat, 0.0), ((1.0 - coat) * p, coat + 1e-4 * p), ((1.0 - coat) * (1.0 - p), 0.999_999)];
    parts.into_iter().filter(|(part, _)| *part > 1e-9).map(|(part, pick)| part * mean(pick)).sum()
}

/// White bases that lose nothing by themselves.
const WHITE: [(f32, f32, Lobe); 3] = [(1.0, 0.0, Lobe::Phong(0.0)), (0.0, 1.0, Lobe::Mirror), (0.5, 0.5, Lobe::Mirror)];

const ROUGHNESSES: [f32; 9] = [0.0, 0.011, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0];

/// Of an angle in degrees: what a coat of any roughness may lose of a white base, as `lib/bsdf/coat` says.
fn loss(degrees: f64) -> f64 {
    let above = match degrees {
        ..=60.0 => 0.0017,
        ..=80.0 => 0.0051,
        _ => 0.0101,
    };
    above + 6e-4
}

/// The most that is gained, and the most that is lost beyond what is promised, over coats, angles and white bases.
fn worst_furnace(rig: &mut Runtime) -> (f64, f64, String) {
    let (mut gain, mut lost, mut what) = (0.0, 0.0, String::new());
    for (base, roughness) in WHITE.into_iter().flat_map(|base| ROUGHNESSES.map(|roughness| (base, roughness))) {
        let base = (base.0, base.1, base.2);
        for degrees in [0.0, 30.0, 59.0, 79.0, 85.0, 89.0, 89.9] {
            let values = Material { specular: Vec3::splat(base.1), ..coated(base, 1.0, roughness) };
            let got = albedo(rig, &look(&values, degrees)).x - 1.0;
            let allowed = if roughness == 0.0 { 0.0 } else { loss(degrees) };
            let off = f64::max(got, -got - allowed);
            if off > f64::max(gain, lost) {
                what = format!("{base:?}, roughness {roughness}, {degrees} degrees: {got:+}");
            }
            (gain, lost) = (gain.max(got), lost.max(-got - allowed));
        }
    }
    (gain, lost, what)
}

#[test]
fn a_white_base_stays_white() {
    // The midpoint rule leaves 3e-4 of a rough coat at a grazing angle.
    let (gain, lost, what) = worst_furnace(&mut rig());
    assert!(gain < 3e-4 && lost < 3e-4, "{what}");
    for (right, wrong) in [
        ("return through / (1.0 - coat_mean_reflectance(m));", "return through;"),
        ("return 1.0 - max(", "return 1.01 - max("),
    ] {
        let mut rig = Runtime::new(support::gpu(), plant(library(), "lib/bsdf/coat", right, wrong));
        let (gain, lost, _) = worst_furnace(&mut rig);
        assert!(gain > 3e-3 || lost > 3e-3, "`{wrong}` goes unnoticed");
    }
}

/// Each pair of a base and a coat with one of the leans; with `LUCERNA_STRESS` with all.
#[test]
fn no_base_and_no_lean_gains() {
    let mut rig = rig();
    for (i, base) in BASES.into_iter().chain(WHITE).enumerate() {
        for (j, (coat, roughness)) in COATS.into_iter().enumerate() {
            let leans =
                LEANS.into_iter().enumerate().filter(|(k, _)| (i + j + k) % LEANS.len() == 0 || support::stress());
            for (_, (degrees, lean, turn)) in leans {
                let probe = look(&coated(base, coat, roughness), degrees);
                let (flat, got) = (albedo(&mut rig, &probe), albedo(&mut rig, &leaning(probe, lean, turn)));
                let case = format!("{base:?} under {coat}, {roughness}, {degrees} degrees, leaning by {lean}");
                assert!(flat.max_element() < 1.0 + 3e-4, "{case}: {flat} of a flat one");
                // What lobes lose below the shading normal is the same, whatever the facet; of a specular base, the coat of a mirrored
                // direction is that of its origin.
                assert!((got - flat).abs().max_element() < 2e-3, "{case}: {got}, flat {flat}");
            }
        }
    }
}

#[test]
fn what_a_coat_reflects_is_the_integral_or_a_little_more() {
    let mut rig = rig();
    for roughness in [0.011, 0.02, 0.035, 0.06, 0.1, 0.15, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0] {
        for degrees in [0.0, 40.0, 60.0, 75.0, 80.0, 84.0, 87.0, 89.0, 89.9] {
            let probe = look(&coated((0.0, 0.0, Lobe::Phong(0.0)), 1.0, roughness), degrees);
            let view = frame(&probe);
            let said = Reflection::from(&probe.material).coat.reflectance(view.wo.dot(view.shading));
            let above = said - albedo(&mut rig, &probe).x;
            let case = format!("roughness {roughness}, {degrees} degrees");
            assert!(above > -3e-4 && above < loss(degrees) - 3e-4, "{case}: {said} is {above} above the integral");
        }
    }
}

/// Where light grazes as well: a base under more than that would send out negative light.
#[test]
fn a_coat_reflects_no_more_than_all() {
    for roughness in (0..=1000).map(|i| f64::from(i) / 1000.0) {
        let coat = Coat { amount: 1.0, alpha: (roughness > 0.01).then(|| roughness.powi(2)) };
        for cos in (0..400).map(|i| 10f64.powf(-8.0 + f64::from(i) / 50.0)) {
            let (reflected, left) =
                (coat.reflectance(cos), coat.over_diffuse(cos, cos).min(coat.over_specular(cos, 1.0)));
            assert!((0.0..=1.0).contains(&reflected) && left >= 0.0, "{roughness}, {cos:e}: {reflected}, {left} left");
        }
    }
}

#[test]
fn the_mean_of_what_is_reflected_is_one() {
    for roughness in ROUGHNESSES {
        let alpha = (roughness > 0.0).then(|| f64::from(roughness).powi(2));
        let coat = Coat { amount: 0.7, alpha };
        const STEPS: usize = 20_000;
        let root = |i: usize| (i as f64 + 0.5) / STEPS as f64;
        let sum: f64 = (0..STEPS).map(|i| 4.0 * root(i).powi(3) * coat.reflectance(root(i).powi(2))).sum();
        let above = sum / STEPS as f64 - coat.mean_reflectance();
        let most = if roughness == 0.0 { 1e-6 } else { 0.7 * 6e-4 };
        assert!((-1e-6..most).contains(&above), "roughness {roughness}: {above}");
    }
}

#[test]
fn light_goes_both_ways_alike() {
    let n = DVec3::new(0.36, -0.48, 0.8).normalize();
    let at = |degrees: f64, turn: f64| {
        let side = n.any_orthonormal_vector().rotate_axis(n, turn);
        n * degrees.to_radians().cos() + side * degrees.to_radians().sin()
    };
    for base in BASES {
        for (coat, roughness) in COATS {
            let reflection = Reflection::from(&look(&coated(base, coat, roughness), 0.0).material);
            for (o, i) in [(10.0, 40.0), (80.0, 30.0), (50.0, 51.0), (5.0, 88.0)] {
                for turn in [0.0, 1.0, 3.1] {
                    let (wo, wi) = (at(o, 0.3), at(i, 0.3 + turn));
                    let there = reflection.evaluate(&ShadingFrame::flat(n, wo), wi).value / n.dot(wi);
                    let back = reflection.evaluate(&ShadingFrame::flat(n, wi), wo).value / n.dot(wo);
                    // Phong's lobe is reciprocal by its mirror directions alone, as it is here.
                    let off = (there - back).abs().max_element();
                    assert!(
                        off <= 1e-9 * there.max_element(),
                        "{base:?} under {coat}, {roughness}: {there} and {back}"
                    );
                }
            }
        }
    }
}
