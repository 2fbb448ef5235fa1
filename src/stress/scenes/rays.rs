//! Rays that are hard to trace: at edges and corners, along axes, with zeros of both signs.

use glam::Vec3;

use crate::layout::ray::{Ray, T_FAR};
use crate::scene::generate::{Corners, SplitMix};

/// A point in the cube of half width `size`.
pub fn point_in_cube(random: &mut SplitMix, size: f32) -> Vec3 {
    let mut coordinate = || random.range(-1.0, 1.0) as f32 * size;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// A unit vector, uniform over the sphere.
pub fn direction(random: &mut SplitMix) -> Vec3 {
    let z = random.range(-1.0, 1.0);
    let (sin, cos) = random.range(0.0, std::f64::consts::TAU).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    glam::DVec3::new(r * cos, r * sin, z).as_vec3()
}

/// A ray without ends.
pub fn endless(origin: Vec3, direction: Vec3) -> Ray {
    Ray { origin, t_min: 0.0, direction, t_max: T_FAR }
}

/// Rays from and to anywhere in a cube of half width `size`.
pub fn random_rays(count: usize, size: f32, seed: u64) -> Vec<Ray> {
    let mut random = SplitMix(seed);
    (0..count).map(|_| endless(point_in_cube(&mut random, size), direction(&mut random))).collect()
}

/// Rays from inside a closed mesh at points of its edges, and at its corners exactly.
pub fn rays_at_edges(triangles: &[Corners], count: usize, seed: u64) -> Vec<Ray> {
    let mut random = SplitMix(seed);
    (0..count)
        .map(|i| {
            let corners = triangles[(random.next_u64() % triangles.len() as u64) as usize];
            let k = (random.next_u64() % 3) as usize;
            let (a, b) = (corners[k].as_dvec3(), corners[(k + 1) % 3].as_dvec3());
            let target = if i % 2 == 0 { a } else { a.lerp(b, random.unit()) };
            let origin = point_in_cube(&mut random, 0.4);
            endless(origin, (target - origin.as_dvec3()).as_vec3())
        })
        .collect()
}

/// Random rays, rays along the axes, with zeros of both signs, from and to corners and edges.
pub fn hard_rays(triangles: &[Corners], count: usize) -> Vec<Ray> {
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
