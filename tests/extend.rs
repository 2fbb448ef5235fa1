//! The passes `extend` and `occluded`: hits of the GPU against brute force, other trees, other stacks and the twin.

use glam::Vec3;
use lucerna::cpu::traverse::{any_hit, closest_hit};
use lucerna::layout::ray::{Hit, MAX_STEPS, NO_HIT, Ray};
use lucerna::scene::generate::{Corners, SplitMix, spheres, terrain};

use crate::intersect::rays_at_edges;
use crate::support;
use crate::support::tracer::{Tracer, device_fma};
use crate::support::trees::{
    Cut, build, concentric, coplanar, degenerate, direction, endless, flat_grid, point_in_cube, random_rays, slivers,
    soup, sphere,
};

/// What must be the same whatever the tree: all but the leaf's place and the number of steps.
fn bits(hit: &Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.triangle, hit.b1.to_bits(), hit.b2.to_bits()]
}

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

/// The scenes that are hard to hit, small enough for brute force.
fn hard_scenes() -> Vec<(&'static str, Vec<Corners>)> {
    let mut mixed = degenerate(90);
    mixed.extend(coplanar(4).iter().map(|t| t.map(|v| v * 8.0)));
    vec![
        ("soup", soup(200, 0.3, 21)),
        ("sphere", sphere(1)),
        ("slivers", slivers(6)),
        ("flat boxes", flat_grid(3)),
        ("coplanar", coplanar(6)),
        ("degenerate", mixed),
        ("equal centroids", concentric(200)),
    ]
}

/// Random rays, rays along the axes, with zeros of both signs, from and to corners and edges.
fn hard_rays(triangles: &[Corners], count: usize) -> Vec<Ray> {
    let size = triangles.iter().flatten().map(|v| v.abs().max_element()).fold(0.0, f32::max);
    let mut rays = random_rays(count / 2, size * 1.5, 22);
    rays.extend(rays_at_edges(triangles, count / 4, 23));
    let mut random = SplitMix(24);
    for i in 0..count / 4 {
        let corner = triangles[i % triangles.len()][i % 3];
        let mut d = direction(&mut random);
        let zero = [0.0, -0.0][i % 2];
        d[i % 3] = zero;
        if i % 4 < 2 {
            d[(i + 1) % 3] = -zero;
        }
        let origin = if i % 5 == 0 { point_in_cube(&mut random, size) } else { corner - d * (i % 7) as f32 };
        rays.push(Ray { t_max: if i % 3 == 0 { size } else { endless(corner, d).t_max }, ..endless(origin, d) });
    }
    rays
}

#[test]
fn the_tree_finds_what_brute_force_finds() {
    let mut tracer = Tracer::new();
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count());
        let mut first: Option<Vec<Hit>> = None;
        for cut in [Cut::Median, Cut::Random(3), Cut::Chain] {
            let tree = build(&triangles, cut);
            tracer.load(&tree);
            let hits = tracer.extend(&rays);
            let expected = first.get_or_insert_with(|| tracer.brute(&rays));
            assert_same(&format!("{name}, {cut:?}"), &rays, &hits, expected);
            assert!(
                hits.iter().all(|hit| hit.triangle == NO_HIT || tree.leaves[hit.leaf as usize].index == hit.triangle)
            );
        }
        let hit = first.iter().flatten().filter(|hit| hit.triangle != NO_HIT).count();
        assert!(hit > rays.len() / 50, "{name}: only {hit} rays hit anything");
    }
}

#[test]
fn any_hit_is_whether_there_is_a_closest_one() {
    let mut tracer = Tracer::new();
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count() / 5);
        tracer.load(&build(&triangles, Cut::Random(4)));
        let hits = tracer.extend(&rays);
        let occluded = tracer.occluded(&rays);
        for ((ray, hit), occluded) in rays.iter().zip(&hits).zip(&occluded) {
            assert_eq!(*occluded, u32::from(hit.triangle != NO_HIT), "{name}: {ray:?}");
        }
    }
}

#[test]
fn a_stack_that_overflows_loses_nothing() {
    let mut tracers = [1, 2, 4].map(|size| (size, Tracer::with_stack(size)));
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count() / 5);
        for cut in [Cut::Median, Cut::Random(5)] {
            let tree = build(&triangles, cut);
            let mut right = None;
            for (size, small) in &mut tracers {
                small.load(&tree);
                let expected = right.get_or_insert_with(|| small.brute(&rays));
                assert_same(&format!("stack of {size}: {name}, {cut:?}"), &rays, &small.extend(&rays), expected);
                let occluded = small.occluded(&rays);
                assert!(occluded.iter().zip(&*expected).all(|(o, hit)| (*o == 1) == (hit.triangle != NO_HIT)));
            }
        }
    }
}

#[test]
fn a_processor_walks_as_a_gpu_does() {
    let (mut gpu, mut processor) = (Tracer::new(), Tracer::on_software());
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count() / 5);
        let tree = build(&triangles, Cut::Median);
        for tracer in [&mut gpu, &mut processor] {
            tracer.load(&tree);
        }
        assert!(gpu.extend(&rays) == processor.extend(&rays), "{name}: other hits, or as many in other steps");
        assert_eq!(gpu.occluded(&rays), processor.occluded(&rays), "{name}");
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
    for mut tracer in [Tracer::new(), Tracer::with_stack(1)] {
        tracer.load(&tree);
        let hits = tracer.extend(&rays);
        assert_same("chain", &rays, &hits, &tracer.brute(&rays));
        assert!(hits.iter().all(|hit| hit.steps < 3 * count as u32), "the walk goes round in circles");
        let expected = [0, count as u32 - 1, count as u32 / 2, NO_HIT];
        assert_eq!([0, 64, 128, 192].map(|i| hits[i].triangle), expected);
        assert!(hits[192].steps > count as u32, "{} steps, which no stack of this size needs", hits[192].steps);
    }
}

#[test]
fn a_million_equal_centroids_are_walked() {
    // 2^13 where loops end at 65,535 rounds.
    let fma = device_fma();
    let triangles = concentric(if support::stress() { 1 << 20 } else { 1 << 13 });
    let tree = build(&triangles, Cut::Median);
    let mut tracer = Tracer::new();
    tracer.load(&tree);
    let rays = random_rays(300, 2.0, 31);
    let hits = tracer.extend(&rays);
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
    let mut tracer = Tracer::new();
    let mut scenes = hard_scenes();
    scenes.push(("spheres", spheres(20_000, 7)));
    scenes.push(("terrain", terrain(20_000, 7)));
    let fma = device_fma();
    for (name, triangles) in scenes {
        let tree = build(&triangles, Cut::Median);
        tracer.load(&tree);
        let rays = hard_rays(&triangles, ray_count() / 2);
        let hits = tracer.extend(&rays);
        let expected: Vec<Hit> = rays.iter().map(|ray| closest_hit(fma, ray, &tree)).collect();
        assert_close(name, &rays, &hits, &expected);
        let others = hits.iter().zip(&expected).filter(|(hit, twin)| hit.steps != twin.steps).count();
        // Slabs may round differently where the device's reciprocal does: it is allowed 2.5 ulp.
        assert!(others * 1000 <= rays.len(), "{name}: {others} of {} rays took another number of steps", rays.len());
        assert!(rays.iter().zip(&hits).all(|(ray, hit)| any_hit(fma, ray, &tree) == (hit.triangle != NO_HIT)));
    }
}

#[test]
fn rays_at_edges_and_corners_of_closed_meshes_never_miss() {
    let count = if support::stress() { 10_000_000 } else { 100_000 };
    let mut tracer = Tracer::new();
    for (name, triangles) in [("sphere", sphere(3)), ("slivers", slivers(6)), ("slivers", slivers(7))] {
        tracer.load(&build(&triangles, Cut::Median));
        for seed in 0..10 {
            let rays = rays_at_edges(&triangles, count / 10, 40 + seed);
            let hits = tracer.extend(&rays);
            let missed = hits.iter().position(|hit| hit.triangle == NO_HIT);
            assert!(missed.is_none(), "{name}: {:?}", missed.map(|i| rays[i]));
        }
    }
}

#[test]
fn a_scene_scaled_by_a_power_of_two_is_hit_in_the_same_bits() {
    let mut tracer = Tracer::new();
    for (name, triangles) in hard_scenes() {
        let rays = hard_rays(&triangles, ray_count() / 5);
        tracer.load(&build(&triangles, Cut::Median));
        let expected = tracer.extend(&rays);
        for scale in [2f32.powi(-20), 2f32.powi(20)] {
            let scaled: Vec<Corners> = triangles.iter().map(|t| t.map(|v| v * scale)).collect();
            tracer.load(&build(&scaled, Cut::Median));
            let ends = |t: f32| if t < 1e38 { t * scale } else { t };
            let scaled_rays: Vec<Ray> =
                rays.iter().map(|r| Ray { origin: r.origin * scale, t_max: ends(r.t_max), ..*r }).collect();
            let hits = tracer.extend(&scaled_rays);
            let expected: Vec<Hit> = expected.iter().map(|hit| Hit { t: ends(hit.t), ..*hit }).collect();
            assert_same(&format!("{name} scaled by {scale:e}"), &scaled_rays, &hits, &expected);
        }
    }
}

#[test]
fn a_scene_moved_far_away_is_hit_alike() {
    // Coordinates on a grid that the moved scene still has: what differs is the traversal's own rounding.
    let on_grid = |v: Vec3| (v * 16.0).round() / 16.0;
    let triangles: Vec<Corners> = soup(300, 3.0, 50).iter().map(|t| t.map(|v| on_grid(v * 20.0))).collect();
    let rays: Vec<Ray> =
        random_rays(ray_count(), 40.0, 51).iter().map(|r| Ray { origin: on_grid(r.origin), ..*r }).collect();
    let mut tracer = Tracer::new();
    tracer.load(&build(&triangles, Cut::Median));
    let expected = tracer.extend(&rays);
    for far in [1e4, 1e6] {
        let shift = Vec3::new(far, -far, far);
        let moved: Vec<Corners> = triangles.iter().map(|t| t.map(|v| v + shift)).collect();
        tracer.load(&build(&moved, Cut::Median));
        let moved_rays: Vec<Ray> = rays.iter().map(|r| Ray { origin: r.origin + shift, ..*r }).collect();
        let hits = tracer.extend(&moved_rays);
        assert_same("moved scene against brute force", &moved_rays, &hits, &tracer.brute(&moved_rays));
        let differ = hits.iter().zip(&expected).filter(|(a, b)| a.triangle != b.triangle).count();
        assert!((differ as f64) < 1e-5 * rays.len() as f64, "moved by {far}: {differ} other hits");
    }
}

#[test]
fn any_number_of_triangles_and_rays() {
    let fma = device_fma();
    let mut tracer = Tracer::new();
    let triangles = sphere(0);
    for n in 0..4 {
        let tree = build(&triangles[..n], Cut::Median);
        tracer.load(&tree);
        for count in [0, 1, 2, 63, 64, 65, 129] {
            let rays = random_rays(count, 2.0, 60);
            let hits = tracer.extend(&rays);
            let expected: Vec<Hit> = rays.iter().map(|ray| closest_hit(fma, ray, &tree)).collect();
            assert_close(&format!("{n} triangles, {count} rays"), &rays, &hits, &expected);
            assert_same(&format!("{n} triangles, {count} rays"), &rays, &hits, &tracer.brute(&rays));
        }
        let still = [endless(Vec3::ZERO, Vec3::ZERO)];
        assert_eq!(tracer.extend(&still)[0].triangle, NO_HIT);
    }
}

#[test]
fn few_triangles_are_hit_as_many_are() {
    let mut tracer = Tracer::new();
    for (name, triangles) in hard_scenes() {
        for count in [2, 3, 17, 31, 32] {
            let rays = hard_rays(&triangles[..count], ray_count() / 5);
            for cut in [Cut::Median, Cut::Random(6), Cut::Chain] {
                tracer.load(&build(&triangles[..count], cut));
                let hits = tracer.few(&rays);
                assert_same(&format!("{name}, {count}, {cut:?}"), &rays, &hits, &tracer.extend(&rays));
                assert_same(&format!("{name}, {count}, {cut:?}"), &rays, &hits, &tracer.brute(&rays));
            }
        }
    }
}
