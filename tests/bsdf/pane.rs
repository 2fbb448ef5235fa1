//! Panes as one sheet: how much is mirrored and how much goes on, alike from both sides.

use glam::{DVec3, Vec3};
use lucerna::components::{Material, Passage};
use lucerna::cpu::bsdf::dielectric::Interface;
use lucerna::cpu::bsdf::{Reflection, mirror};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};
use lucerna::gpu::Runtime;

use super::{BsdfProbe, draws, frame, leaning, library, look, rig};
use crate::support;
use crate::support::plant::plant;

fn pane(ni: f32, tf: Vec3, degrees: f64, back_face: bool) -> BsdfProbe {
    let values = Material { passage: Passage::Pane(ni), filter: tf, diffuse: Vec3::ONE, ..Material::BLACK };
    BsdfProbe { back_face: u32::from(back_face), count: 1 << 12, ..look(&values, degrees) }
}

/// What the two faces reflect and let through in all, crossing by crossing.
fn series(ni: f64, tf: f64, cos: f64) -> [f64; 2] {
    let r = Interface::new(ni, false).reflectance(cos);
    let (mut parts, mut within) = ([r, 0.0], 1.0 - r);
    for crossing in 0..200_000 {
        within *= tf;
        parts[1 - crossing % 2] += (1.0 - r) * within;
        within *= r;
    }
    parts
}

/// The worst error of what is mirrored and of what goes on, by the draws' weights and how often each is drawn.
fn worst(rig: &mut Runtime) -> f64 {
    let tf = Vec3::new(1.0, 0.5, 0.0);
    let mut worst = 0f64;
    for (ni, degrees) in [1.0f32, 1.1, 1.5, 3.0].into_iter().flat_map(|ni| [0.0, 45.0, 80.0, 89.0].map(|d| (ni, d))) {
        for back_face in [false, true] {
            let probe = pane(ni, tf, degrees, back_face);
            let view = frame(&probe);
            let cos = view.shading.dot(view.wo);
            let right = tf.as_dvec3().to_array().map(|t| series(ni.into(), t, cos));
            let right = [0, 1].map(|i| DVec3::from_array(right.map(|parts| parts[i])));
            // One of each by its luminance: the probabilities follow from the two, so that weights tell both.
            let luminances = right.map(|part| part.dot(DVec3::new(0.2126, 0.7152, 0.0722)));
            let share = luminances[0] / (luminances[0] + luminances[1]);
            for draw in draws(rig, &probe) {
                assert_eq!((draw.pdf, draw.evaluated), (0.0, 0.0));
                let straight = draw.direction.dot(view.shading) < 0.0;
                let (direction, weight) = match straight {
                    true => (-view.wo, right[1] / (1.0 - share)),
                    false => (mirror(view.shading, view.wo), right[0] / share),
                };
                assert!(draw.direction.distance(direction) < 1e-6, "Ni {ni}, {degrees} degrees");
                worst = worst.max((draw.weight - weight).abs().max_element() / weight.max_element());
            }
        }
    }
    worst
}

#[test]
fn all_ways_between_the_faces_are_summed() {
    // At grazing angles 1 - r has lost some of its digits.
    let off = worst(&mut rig());
    assert!(off < 2e-5, "{off}");
    for (right, wrong) in
        [("/ between;", "/ between * 1.01;"), ("PaneSplit(r + r * m.tf", "PaneSplit(r + 0.9 * r * m.tf")]
    {
        let mut rig = Runtime::new(support::gpu(), plant(library(), "lib/bsdf/pane", right, wrong));
        assert!(worst(&mut rig) > 1e-3, "`{wrong}` goes unnoticed");
    }
}

#[test]
fn draws_equal_the_twin_whatever_the_facet() {
    let mut rig = rig();
    for (degrees, lean, turn) in [(0.0, 0.0, 0.0), (70.0, 30.0, 0.0), (50.0, 45.0, 0.1), (85.0, 20.0, 0.0)] {
        for back_face in [false, true] {
            let flat = pane(1.5, Vec3::new(0.9, 0.5, 1.0), degrees, back_face);
            let probe = if lean > 0.0 { leaning(flat, lean, turn) } else { flat };
            let (view, reflection) = (frame(&probe), Reflection::from(&probe.material));
            let mut straight = 0;
            for (i, got) in draws(&mut rig, &probe).iter().enumerate() {
                let key = sample_key(i as u32, 0, probe.seed);
                let right = reflection.sample(&view, sample_1d(key, 0), sample_2d(key, 1));
                let case = format!("{degrees} degrees, leaning by {lean}");
                assert!(
                    got.direction.distance(right.direction) < 2e-5,
                    "{case}: {} for {}",
                    got.direction,
                    right.direction
                );
                assert!((got.weight - right.weight).abs().max_element() < 2e-5, "{case}: a weight of {}", got.weight);
                straight += u32::from(got.direction == -probe.wo.as_dvec3().normalize());
            }
            assert!(straight > 0, "nothing goes through");
        }
    }
}

#[test]
fn clear_panes_keep_all_light() {
    let mut rig = rig();
    for (ni, degrees) in [(1.0, 30.0), (1.5, 0.0), (1.5, 60.0), (2.4, 88.0)] {
        for draw in draws(&mut rig, &pane(ni, Vec3::ONE, degrees, false)) {
            assert!((draw.weight - 1.0).abs().max_element() < 2e-6, "Ni {ni}: {}", draw.weight);
        }
    }
}
