//! The passes `extend` and `occluded`: hits of the GPU against brute force, other trees, other stacks and the twin.

use glam::Vec3;
use lucerna::cpu::traverse::{any_hit, closest_hit};
use lucerna::layout::ray::{Hit, MAX_STEPS, NO_HIT, Ray};
use lucerna::scene::generate::{Corners, spheres, terrain};
use lucerna::stress::tools::tracer::{Tracer, bits, device_fma};

use crate::support;
use crate::support::trees::{Cut, build, concentric, endless, hard_rays, hard_scenes, random_rays, sphere};

#[track_caller]
fn assert_same(what: &str, rays: &[Ray], got: &[Hit], expected: &[Hit]) {
    assert_eq!(got.len(), expected.len());
    let differ: Vec<usize> = (0..got.len()).filter(|&i| bits(&got[i]) != bits(&expected[i])).collect();
    if let Some(&i) = differ.first() {
        panic!("{what}: {} of {} differ; {:?}: {:?} for {:?}", differ.len(), got.len(), rays[i], got[i], expected[i]);
    }
}

fn ray_count() -> usize {
    if support::stress() { 1_000_000 } else { 20_000 }
}

#[test]
fn a_processor_walks_as_a_gpu_does() {
    let (mut gpu, mut processor) = (Tracer::new(&support::lab()), Tracer::on_software(&support::lab()));
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count() / 5);
        let tree = build(&triangles, Cut::Median);
        for tracer in [&mut gpu, &mut processor] {
            tracer.load(&tree).unwrap();
        }
        assert!(
            gpu.extend(&rays).unwrap() == processor.extend(&rays).unwrap(),
            "{name}: other hits, or as many in other steps"
        );
        assert_eq!(gpu.occluded(&rays).unwrap(), processor.occluded(&rays).unwrap(), "{name}");
    }
}

/// From its deep end, a chain's other children all wait on the stack; what misses every triangle visits them all.
#[test]
fn a_chain_deeper_than_the_stack_is_walked_to_its_end() {
    let count = 1 << 13;
    let triangles: Vec<Corners> =
        (0..count).map(|i| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|v| v + Vec3::Z * (i as f32))).collect();
    let tree = build(&triangles, Cut::Chain);
    // Alike rays together: lavapipe counts the rounds of eight neighbours' loops in one.
    let kinds = [
        endless(Vec3::new(0.3, 0.3, -1.0), Vec3::Z),
        endless(Vec3::new(0.3, 0.3, count as f32), Vec3::NEG_Z),
        Ray { t_min: count as f32 / 2.0, ..endless(Vec3::new(0.3, 0.3, -1.0), Vec3::Z) },
        endless(Vec3::new(0.9, 0.9, count as f32), Vec3::NEG_Z),
    ];
    let rays: Vec<Ray> = kinds.iter().flat_map(|ray| [*ray; 64]).collect();
    for mut tracer in [Tracer::new(&support::lab()), Tracer::with_stack(&support::lab(), 1)] {
        tracer.load(&tree).unwrap();
        let hits = tracer.extend(&rays).unwrap();
        assert_same("chain", &rays, &hits, &tracer.brute(&rays).unwrap());
        assert!(hits.iter().all(|hit| hit.steps < 3 * count as u32), "the walk goes round in circles");
        let expected = [0, count as u32 - 1, count as u32 / 2, NO_HIT];
        assert_eq!([0, 64, 128, 192].map(|i| hits[i].triangle), expected);
        assert!(hits[192].steps > count as u32, "{} steps, which no stack of this size needs", hits[192].steps);
    }
}

#[test]
fn a_million_equal_centroids_are_walked() {
    // 2^13 where loops end at 65,535 rounds.
    let fma = device_fma(&support::gpu());
    let triangles = concentric(if support::stress() { 1 << 20 } else { 1 << 13 });
    let tree = build(&triangles, Cut::Median);
    let mut tracer = Tracer::new(&support::lab());
    tracer.load(&tree).unwrap();
    let rays = random_rays(300, 2.0, 31);
    let hits = tracer.extend(&rays).unwrap();
    let expected: Vec<Hit> = rays.iter().map(|ray| closest_hit(fma, ray, &tree)).collect();
    assert_close("equal centroids", &rays, &hits, &expected);
    assert!(hits.iter().all(|hit| hit.steps < MAX_STEPS));
}

/// Agreement with another processor: a t within 4 ulp. Where triangles meet, either may be the one.
#[track_caller]
fn assert_close(what: &str, rays: &[Ray], got: &[Hit], expected: &[Hit]) {
    let ulps = |a: f32, b: f32| (a.to_bits() as i64 - b.to_bits() as i64).abs();
    let far: Vec<usize> = (0..got.len()).filter(|&i| ulps(got[i].t, expected[i].t) > 4).collect();
    if let Some(&i) = far.first() {
        panic!("{what}: {} of {} differ; {:?}: {:?} for {:?}", far.len(), got.len(), rays[i], got[i], expected[i]);
    }
}

#[test]
fn the_twin_finds_the_same_hits_in_as_many_steps() {
    let mut tracer = Tracer::new(&support::lab());
    let mut scenes = hard_scenes();
    scenes.push(("spheres", spheres(20_000, 7)));
    scenes.push(("terrain", terrain(20_000, 7)));
    let fma = device_fma(&support::gpu());
    for (name, triangles) in scenes {
        let tree = build(&triangles, Cut::Median);
        tracer.load(&tree).unwrap();
        let rays = hard_rays(&triangles, ray_count() / 2);
        let hits = tracer.extend(&rays).unwrap();
        let expected: Vec<Hit> = rays.iter().map(|ray| closest_hit(fma, ray, &tree)).collect();
        assert_close(name, &rays, &hits, &expected);
        let others = hits.iter().zip(&expected).filter(|(hit, twin)| hit.steps != twin.steps).count();
        // Slabs may round differently where the device's reciprocal does: it is allowed 2.5 ulp.
        assert!(others * 1000 <= rays.len(), "{name}: {others} of {} rays took another number of steps", rays.len());
        assert!(rays.iter().zip(&hits).all(|(ray, hit)| any_hit(fma, ray, &tree) == (hit.triangle != NO_HIT)));
    }
}

#[test]
fn any_number_of_triangles_and_rays() {
    let fma = device_fma(&support::gpu());
    let mut tracer = Tracer::new(&support::lab());
    let triangles = sphere(0);
    for n in 0..4 {
        let tree = build(&triangles[..n], Cut::Median);
        tracer.load(&tree).unwrap();
        for count in [0, 1, 2, 63, 64, 65, 129] {
            let rays = random_rays(count, 2.0, 60);
            let hits = tracer.extend(&rays).unwrap();
            let expected: Vec<Hit> = rays.iter().map(|ray| closest_hit(fma, ray, &tree)).collect();
            assert_close(&format!("{n} triangles, {count} rays"), &rays, &hits, &expected);
            assert_same(&format!("{n} triangles, {count} rays"), &rays, &hits, &tracer.brute(&rays).unwrap());
        }
        let still = [endless(Vec3::ZERO, Vec3::ZERO)];
        assert_eq!(tracer.extend(&still).unwrap()[0].triangle, NO_HIT);
    }
}

#[test]
fn few_triangles_are_hit_as_many_are() {
    let mut tracer = Tracer::new(&support::lab());
    for (name, triangles) in hard_scenes() {
        for count in [2, 3, 17, 31, 32] {
            let rays = hard_rays(&triangles[..count], ray_count() / 5);
            for cut in [Cut::Median, Cut::Random(6), Cut::Chain] {
                tracer.load(&build(&triangles[..count], cut)).unwrap();
                let hits = tracer.few(&rays).unwrap();
                assert_same(&format!("{name}, {count}, {cut:?}"), &rays, &hits, &tracer.extend(&rays).unwrap());
                assert_same(&format!("{name}, {count}, {cut:?}"), &rays, &hits, &tracer.brute(&rays).unwrap());
            }
        }
    }
}
