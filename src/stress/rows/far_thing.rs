//! One thing a million times farther away than all else, or a dome around it.

use glam::Vec3;

use crate::cpu::intersect::Fma;
use crate::cpu::traverse::{closest_hit, closest_hit_brute};
use crate::cpu::tree::{Tree, build, by_codes};
use crate::layout::ray::Ray;
use crate::layout::tree::Triangle;
use crate::parallel;
use crate::scene::generate::{Corners, SplitMix};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::clouds::{cloud, point, triangle};
use crate::stress::scenes::rays::{direction, endless};

pub static ROW: Row = Row {
    name: "far-thing",
    holds: "with a thing or a dome 1e5 to 1e7 times the scene's size away, rays visit at most a fifth more nodes than trees by codes without",
    quantity: "nodes visited, by what they may be",
    most: 1.0,
    unit: "rays",
    sizes: [500 * 8, 500 * 8, 5_000 * 8],
    measure,
};

/// 4,000 small triangles in the unit cube, in no order that a tree could live by.
fn near() -> Vec<Triangle> {
    cloud(4_000, 0.03, |_, random| point(random))
}

fn with(mut triangles: Vec<Triangle>, more: impl IntoIterator<Item = Corners>) -> Vec<Triangle> {
    for [a, b, c] in more {
        triangles.push(triangle(triangles.len() as u32, a, b, c));
    }
    triangles
}

/// A sky's dome: an octahedron whose faces are cut into 4^5.
fn dome(radius: f32) -> Vec<Corners> {
    let mut faces: Vec<Corners> = Vec::new();
    for (x, y, z) in [(1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, -1.0)] {
        for sign in [1.0, -1.0] {
            faces.push([Vec3::X * x * sign, Vec3::Y * y * sign, Vec3::Z * z * sign]);
        }
    }
    for _ in 0..5 {
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [d, e, f] = [(a + b), (b + c), (c + a)].map(Vec3::normalize);
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
            })
            .collect();
    }
    faces.into_iter().map(|face| face.map(|v| v * radius)).collect()
}

/// Nodes that a ray visits, on average; each hit equals that of all triangles tried one by one.
fn steps(rays: &[Ray], tree: &Tree) -> Result<f64, StressError> {
    let pieces: Vec<&[Ray]> = rays.chunks(64).collect();
    let counted: Vec<Result<u64, StressError>> =
        parallel::map(pieces.len(), |piece| pieces[piece].iter().map(|ray| steps_of(ray, tree)).sum());
    let steps: Result<u64, StressError> = counted.into_iter().sum();
    Ok(steps? as f64 / rays.len() as f64)
}

fn steps_of(ray: &Ray, tree: &Tree) -> Result<u64, StressError> {
    let (hit, brute) = (closest_hit(Fma::Fused, ray, tree), closest_hit_brute(Fma::Fused, ray, tree));
    match (hit.t, hit.triangle) == (brute.t, brute.triangle) {
        true => Ok(u64::from(hit.steps)),
        false => Err(StressError::Broken(format!("{ray:?} hits {hit:?}, and of all triangles {brute:?}"))),
    }
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut random = SplitMix(3);
    let count = size as usize / 8;
    let rays: Vec<Ray> = (0..count).map(|_| endless(point(&mut random), direction(&mut random))).collect();
    // What there may be is by trees as codes split them: those that are joined anew save less of a dome than of what it is apart.
    let alone = steps(&rays, &by_codes(&near()))?;
    let mut all = Measured::new(0.0, 0);
    let mut take = |case: String, visited: f64, expected: f64| {
        // A node or two above the rest, and cells of half the bits: 20 % covers both; the whole was 30 times dearer.
        let note = format!("{case}: {visited:.1} nodes a ray, {expected:.1} apart");
        let measured = Measured::new(visited / (1.2 * expected + 2.0), 2 * count as u64).noted(note);
        all = std::mem::replace(&mut all, Measured::new(0.0, 0)).worst(measured);
    };
    for (k, far) in [1e5, 1e6, 1e7].into_iter().enumerate() {
        let quad = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|v| Vec3::splat(far) + v);
        take(format!("a thing at {far:e}"), steps(&rays, &build(&with(near(), [quad, quad.map(|v| -v)])))?, alone);
        let sky = steps(&rays, &by_codes(&with(Vec::new(), dome(far))))?;
        take(format!("a dome at {far:e}"), steps(&rays, &build(&with(near(), dome(far))))?, alone + sky);
        lab.tell(k as u64 + 1, 3);
    }
    Ok(all)
}
