//! The twin's arithmetic: what the proofs of watertightness and of the one least hit rest upon.

use glam::{DVec3, Vec2, Vec3};
use lucerna::cpu::bounds::Bounds;
use lucerna::cpu::intersect::{
    Fma, difference_of_products, edge_function, intersect_triangle, offset_ray_origin, prepare_query, slab_interval,
    surface_point, triangle_normal,
};
use lucerna::cpu::traverse::{any_hit, closest_hit, closest_hit_brute};
use lucerna::layout::ray::{NO_HIT, Ray};
use lucerna::scene::generate::{SplitMix, spheres, terrain, to_mesh};

use crate::support::trees::{
    self, Cut, build, concentric, coplanar, degenerate, direction, endless, flat_grid, point_in_cube, random_rays,
    rays_at_edges, records, slivers, soup, sphere,
};

#[test]
fn difference_of_products_has_the_right_sign_and_digits() {
    let mut random = SplitMix(1);
    for i in 0..200_000 {
        let p = point_in_cube(&mut random, 1.0);
        let (a, b, c) = (p.x, p.y, p.z);
        // Every other pair of products is as nearly equal as floats can be.
        let d = if i % 2 == 0 { a * b / c } else { random.range(-1.0, 1.0) as f32 };
        // Products of two floats are exact in f64, and so is the sign of their difference.
        let exact = f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d);
        for fma in BOTH {
            let got = f64::from(difference_of_products(fma, a, b, c, d));
            assert!(got == 0.0 || got.signum() == exact.signum(), "{a} * {b} - {c} * {d}: {got} for {exact}");
            // 1.5 ulp (Jeannerod, Louvet, Muller 2013), an ulp being at most 2^-23 of the value.
            let most = exact.abs() * 1.5 * 2f64.powi(-23);
            assert!((got - exact).abs() <= most, "{fma:?}: {a} * {b} - {c} * {d}: {got} for {exact}");
        }
    }
}

#[test]
fn edge_function_changes_only_its_sign_with_its_ends() {
    for fma in BOTH {
        let mut random = SplitMix(2);
        for i in 0..100_000 {
            let (p, q) = (point_in_cube(&mut random, 3.0), point_in_cube(&mut random, 3.0));
            let p = Vec2::new(p.x, p.y);
            let q = match i % 4 {
                0 => p * (1.0 + 2f32.powi(-22)),
                1 => Vec2::new(p.x, q.y),
                2 => p,
                _ => Vec2::new(q.x, q.y),
            };
            assert_eq!(edge_function(fma, p, q), -edge_function(fma, q, p), "{p} {q}");
        }
    }
}

#[test]
fn slabs_of_a_box_enclose_those_of_every_box_inside() {
    for fma in BOTH {
        let mut random = SplitMix(3);
        for i in 0..100_000 {
            let mut d = direction(&mut random);
            if i % 3 == 0 {
                d[i % 2] = [0.0, -0.0, 1e-30, -1e-12][i / 3 % 4];
            }
            let query = prepare_query(fma, &endless(point_in_cube(&mut random, 2.0), d), 1.0);
            let corners = [(); 4].map(|()| point_in_cube(&mut random, 1.0));
            let [a, b, c, _] = corners;
            let inner = slab_interval(&query, Bounds { low: a.min(b), high: a.max(b) });
            let outer = slab_interval(&query, Bounds { low: a.min(b).min(c), high: a.max(b).max(c) });
            assert!(outer.x <= inner.x && outer.y >= inner.y, "{inner} is not within {outer}");
            assert!(inner.is_finite() && outer.is_finite());
        }
    }
}

/// Both ways of rounding that WGSL allows.
const BOTH: [Fma; 2] = [Fma::Fused, Fma::Unfused];

#[test]
fn rays_at_edges_and_corners_of_closed_meshes_never_miss() {
    for fma in BOTH {
        for triangles in [sphere(2), slivers(6), slivers(7)] {
            let tree = build(&triangles, Cut::Median);
            for ray in rays_at_edges(&triangles, 100_000, 4) {
                assert_ne!(closest_hit(fma, &ray, &tree).triangle, NO_HIT, "{ray:?}");
            }
        }
    }
}

#[test]
fn every_tree_finds_what_brute_force_finds() {
    for fma in BOTH {
        let scenes =
            [soup(300, 0.3, 6), sphere(2), slivers(6), flat_grid(4), coplanar(6), degenerate(100), concentric(200)];
        for (k, triangles) in scenes.iter().enumerate() {
            for cut in [Cut::Median, Cut::Random(7), Cut::Chain] {
                let tree = build(triangles, cut);
                for ray in random_rays(2_000, 1.5, 8) {
                    let (hit, oracle) = (closest_hit(fma, &ray, &tree), closest_hit_brute(fma, &ray, &tree));
                    assert_eq!(
                        (hit.t.to_bits(), hit.triangle, hit.leaf, hit.b1.to_bits(), hit.b2.to_bits()),
                        (oracle.t.to_bits(), oracle.triangle, oracle.leaf, oracle.b1.to_bits(), oracle.b2.to_bits()),
                        "scene {k}, {cut:?}, {ray:?}"
                    );
                    assert_eq!(any_hit(fma, &ray, &tree), hit.triangle != NO_HIT);
                }
            }
        }
    }
}

#[test]
fn hits_are_where_an_exact_ray_meets_the_plane() {
    for fma in BOTH {
        let triangles = soup(1, 1.0, 9);
        let [a, b, c] = triangles[0].map(|v| v.as_dvec3());
        let normal = (b - a).cross(c - a);
        let mut random = SplitMix(10);
        for _ in 0..20_000 {
            let (u, v) = (random.unit(), random.unit());
            let target =
                if u + v < 1.0 { a + (b - a) * u + (c - a) * v } else { b + (a - b) * u + (c - b) * (1.0 - v) };
            let origin = point_in_cube(&mut random, 4.0);
            let ray = endless(origin, (target - origin.as_dvec3()).as_vec3());
            let query = prepare_query(fma, &ray, 2.0);
            let Some(hit) = intersect_triangle(&query, triangles[0][0], triangles[0][1], triangles[0][2]) else {
                continue;
            };
            let d = ray.direction.as_dvec3();
            let exact = normal.dot(a - origin.as_dvec3()) / normal.dot(d);
            // Rounding moves the plane's corners by some 2^-22 of their distance, which the slope to the ray magnifies.
            let bound = 2f64.powi(-20) * 8.0 * normal.length() / normal.dot(d).abs();
            assert!((f64::from(hit.t) - exact).abs() <= bound, "t {} for {exact}", hit.t);
            let (point, error) = surface_point(triangles[0][0], triangles[0][1], triangles[0][2], hit.b1, hit.b2);
            let along = origin.as_dvec3() + d * exact;
            // Moved away from edges that are nearer than 16 errors.
            let near_edge = hit.b1.min(hit.b2).min(1.0 - hit.b1 - hit.b2) < 1e-3;
            let moved = if near_edge { 48.0 * f64::from(error.max_element()) } else { 0.0 };
            assert!((point.as_dvec3() - along).length() <= bound * d.length() + moved, "{point} for {along}");
        }
    }
}

#[test]
fn triangles_without_area_are_never_hit() {
    for fma in BOTH {
        let mut random = SplitMix(12);
        for [a, b, c] in degenerate(600) {
            assert_eq!(triangle_normal(fma, a, b, c), Vec3::ZERO);
            for _ in 0..20 {
                // Through a point of the triangle, as nearly as floats allow, and through its corners.
                let target = a.lerp(b, random.unit() as f32);
                let origin = point_in_cube(&mut random, 20.0).round();
                for target in [target, a, b, c] {
                    let query = prepare_query(fma, &endless(origin, target - origin), 64.0);
                    assert!(
                        target == origin || intersect_triangle(&query, a, b, c).is_none(),
                        "{a} {b} {c} from {origin}"
                    );
                }
            }
        }
    }
}

/// PBRT, 4th ed., section 6.8.6, and its test of re-intersection.
#[test]
fn an_offset_ray_never_meets_the_triangle_it_leaves() {
    for fma in BOTH {
        let mut random = SplitMix(13);
        let mut tested = 0;
        for i in 0..300_000 {
            let size = 10f32.powf(random.range(-2.0, 2.0) as f32);
            let shift = point_in_cube(&mut random, [0.0, 1.0, 1000.0][i % 3]);
            // Half of them in a plane through the origin, where coordinates along the normal have no error of their
            // own.
            let flat = if i % 2 == 0 { Vec3::ONE } else { Vec3::new(1.0, 0.0, 1.0) };
            let [a, b, c] = [(); 3].map(|()| (shift + point_in_cube(&mut random, size)) * flat);
            let u = random.unit().sqrt();
            let (b1, b2) = ((1.0 - u) as f32, (u * random.unit()) as f32);
            let normal = triangle_normal(fma, a, b, c);
            // A thin triangle's own rounding, and a direction in its plane, are not what an offset can mend.
            let sliver = normal.length() < 0.1 * (b - a).length().max((c - a).length()).max((c - b).length()).powi(2);
            if sliver {
                continue;
            }
            let n = normal.normalize();
            let (p, error) = surface_point(a, b, c, b1, b2);
            let w = direction(&mut random);
            if w.dot(n).abs() < 1e-4 {
                continue;
            }
            let origin = offset_ray_origin(p, error, n, w);
            let side = (origin.as_dvec3() - a.as_dvec3()).dot(exact_normal(a, b, c)) * f64::from(w.dot(n));
            assert!(side > 0.0, "the origin lies on the other side");
            let query = prepare_query(fma, &endless(origin, w), size + 1000.0);
            let hit = intersect_triangle(&query, a, b, c).filter(|hit| hit.t > 0.0);
            assert!(hit.is_none(), "{a} {b} {c} left from {origin} to {w}: {hit:?}");
            tested += 1;
        }
        assert!(tested > 200_000);
    }
}

fn exact_normal(a: Vec3, b: Vec3, c: Vec3) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|v| v.as_dvec3());
    (b - a).cross(c - a)
}

#[test]
fn an_offset_moves_coordinates_that_rounding_would_leave() {
    let moved = offset_ray_origin(Vec3::new(1e6, 0.0, -0.0), Vec3::splat(1e-9), Vec3::ONE.normalize(), Vec3::ONE);
    assert!(moved.x > 1e6 && moved.y > 0.0 && moved.z > 0.0);
    let moved = offset_ray_origin(Vec3::new(1e6, 0.0, -0.0), Vec3::splat(1e-9), Vec3::ONE.normalize(), Vec3::NEG_ONE);
    assert!(moved.x < 1e6 && moved.y < 0.0 && moved.z < 0.0);
    let still = offset_ray_origin(Vec3::ONE, Vec3::ZERO, Vec3::X, Vec3::X);
    assert_eq!(still, Vec3::ONE);
}

#[test]
fn few_triangles_and_rays_without_direction() {
    for fma in BOTH {
        let triangles = sphere(0);
        for n in 0..4 {
            let tree = build(&triangles[..n], Cut::Median);
            assert_eq!((tree.nodes.len(), tree.leaves.len()), (n.saturating_sub(1), n));
            for triangle in &triangles[..n] {
                let ray = endless(Vec3::ZERO, triangle[0] + triangle[1] + triangle[2]);
                assert_ne!(closest_hit(fma, &ray, &tree).triangle, NO_HIT);
                let ended = Ray { t_max: 0.1, ..ray };
                assert_eq!(closest_hit(fma, &ended, &tree).triangle, NO_HIT);
            }
            assert_eq!(closest_hit(fma, &endless(Vec3::ZERO, Vec3::ZERO), &tree).triangle, NO_HIT);
        }
    }
}

#[test]
fn generated_scenes_have_the_asked_number_of_sound_triangles() {
    for (name, make) in [("spheres", spheres as fn(u32, u64) -> Vec<_>), ("terrain", terrain)] {
        for n in [0, 1, 12, 13, 1_291, 1_292, 1_293, 20_000] {
            let triangles = make(n, 7);
            assert_eq!(triangles.len(), n as usize, "{name}");
            for (i, [a, b, c]) in triangles.iter().enumerate() {
                assert!(exact_normal(*a, *b, *c).length() > 1e-6, "{name}: triangle {i} has no area");
                assert!([a, b, c].iter().all(|v| v.is_finite()));
            }
        }
        assert_eq!(make(5_000, 7), make(5_000, 7));
        assert_ne!(make(5_000, 7), make(5_000, 8));
    }
    let triangles = spheres(1_292, 7);
    let mesh = to_mesh(&triangles);
    // An icosphere of 1,280 triangles has 642 corners; the room has its own.
    assert!(mesh.positions.len() < 642 + 30);
    for (corners, index) in triangles.iter().zip(&mesh.triangles) {
        assert_eq!(corners.map(|v| v.as_dvec3()), index.map(|i| mesh.positions[i as usize]));
    }
    assert_eq!(records(&triangles)[5].index, 5);
    assert!(trees::direction(&mut SplitMix(1)).is_normalized());
}

#[test]
fn a_fused_reciprocal_is_rounded_right_from_any_start_within_3_ulp() {
    let mut random = SplitMix(14);
    let mut off = 0;
    for _ in 0..100_000 {
        let x = f32::from_bits(random.range(f64::from(1.0f32.to_bits()), f64::from(2.0f32.to_bits())) as u32);
        assert_eq!(Fma::Fused.reciprocal(x), 1.0 / x);
        for step in [-3i32, -1, 1, 3] {
            let r = f32::from_bits((1.0 / x).to_bits().wrapping_add_signed(step));
            off += u32::from(r.mul_add((-x).mul_add(r, 1.0), r) != 1.0 / x);
        }
    }
    // One step of Newton's squares the error: what is left is 2^-42, which decides one rounding in some 2^17.
    assert!(off < 40, "{off} of 400,000");
}
