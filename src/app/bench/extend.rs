//! `bench extend`: rays through generated spheres, from the camera and from where those hit, checked against the twin.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::{BenchError, BenchReport, Case, measure, spheres};
use crate::cpu::intersect::{Fma, offset_ray_origin, surface_point, triangle_normal};
use crate::cpu::traverse::closest_hit;
use crate::cpu::tree::Tree;
use crate::gpu::{Gpu, Runtime};
use crate::layout::ray::{Hit, NO_HIT, Ray, T_FAR};
use crate::layout::tree::{Triangle, node_count};
use crate::passes::tree::PLAN;
use crate::passes::{Recording, extend};
use crate::scene::generate::{SPHERES_VIEW, SplitMix};
use crate::shader::Library;

/// Seed of the scene and of the bounces.
const SEED: u64 = 7;

/// Rays that are compared with the twin's.
const CHECKED: usize = 1000;

/// Traces, in each number of triangles, primary rays and one diffuse bounce from each hit, `runs` times,
/// and prints how long that took.
pub fn run(gpu: Arc<Gpu>, triangles: &[u32], runs: u32, json: bool) -> Result<(), BenchError> {
    let mut cases = Vec::new();
    for &count in triangles {
        cases.extend(scene(&gpu, count, runs)?);
    }
    BenchReport { bench: "extend", adapter: gpu.name(), runs, cases }.print(json)
}

/// The cases of one scene.
fn scene(gpu: &Arc<Gpu>, count: u32, runs: u32) -> Result<Vec<Case>, BenchError> {
    // As many rays as peers are measured with, and fewer where a processor does the work.
    let side = if gpu.is_software() { 256 } else { 2048 };
    let mut rig = Runtime::new(gpu.clone(), Library::shipped());
    let triangles = spheres(count, SEED);
    rig.set_features(gpu.shader_features());
    rig.upload("triangles", &triangles)?;
    for (name, bytes) in (PLAN.buffers)(count).into_iter().chain(extend::buffers(side * side)) {
        rig.reserve(name, bytes)?;
    }
    let mut building = Recording::default();
    (PLAN.record)(&mut building, &triangles);
    rig.play(&building)?;
    let tree = Tree {
        leaves: rig.read_some("leaves", count as usize)?,
        nodes: rig.read_some("nodes", node_count(count) as usize)?,
    };
    let primary = primary_rays(side);
    let (hits, closest) = case(&mut rig, &tree, "primary", &primary, runs)?;
    let bounce = bounce_rays(&primary, &hits, &triangles);
    let mut cases = vec![closest];
    cases.push(case(&mut rig, &tree, "diffuse bounce", &bounce, runs)?.1);
    cases.push(occlusion_case(&mut rig, &tree, &bounce, runs)?);
    Ok(cases)
}

/// The closest hits of some rays, and how long they took.
fn case(rig: &mut Runtime, tree: &Tree, kind: &str, rays: &[Ray], runs: u32) -> Result<(Vec<Hit>, Case), BenchError> {
    let mut recording = Recording::default();
    extend::record(&mut recording, rays.len() as u32, tree.leaves.len() as u32);
    if !rays.is_empty() {
        rig.upload("rays", rays)?;
    }
    let rows = measure(rig, &Recording::default(), &recording, runs)?;
    let hits: Vec<Hit> = rig.read_some("hits", rays.len())?;
    check(kind, tree, rays, &hits)?;
    check_walks(rig, kind, &recording, &hits)?;
    let share = |sum: f64| if hits.is_empty() { 0.0 } else { sum / hits.len() as f64 };
    let name = format!("{} triangles, {kind}", tree.leaves.len());
    let case = Case::new(name, rays.len() as u64, "rays/s", rows)
        .note("hit fraction", share(hits.iter().filter(|hit| hit.triangle != NO_HIT).count() as f64))
        .note("nodes visited by a ray", share(hits.iter().map(|hit| f64::from(hit.steps)).sum()));
    Ok((hits, case))
}

/// Whether the rays in the buffer hit anything, and how long that took.
fn occlusion_case(rig: &mut Runtime, tree: &Tree, rays: &[Ray], runs: u32) -> Result<Case, BenchError> {
    let mut recording = Recording::default();
    extend::record_occluded(&mut recording, rays.len() as u32, tree.leaves.len() as u32);
    let rows = measure(rig, &Recording::default(), &recording, runs)?;
    let name = format!("{} triangles, diffuse bounce, any hit", tree.leaves.len());
    Ok(Case::new(name, rays.len() as u64, "rays/s", rows))
}

/// Some hits against the twin's. Processors round differently, so a ray in a hundred may pass an edge on its other
/// side.
fn check(kind: &str, tree: &Tree, rays: &[Ray], hits: &[Hit]) -> Result<(), BenchError> {
    let step = (rays.len() / CHECKED).max(1);
    let sample: Vec<(&Ray, &Hit)> = rays.iter().zip(hits).step_by(step).collect();
    let differs = |(ray, hit): &&(&Ray, &Hit)| {
        let twin = closest_hit(Fma::Fused, ray, tree);
        (twin.t - hit.t).abs() > 1e-3 * twin.t
    };
    let wrong = sample.iter().filter(differs).count();
    if wrong * 100 > sample.len() {
        return Err(BenchError::Wrong(format!("{wrong} of {} {kind} rays hit something else", sample.len())));
    }
    Ok(())
}

/// All hits against those of the walk for the other kind of device: they are the same to the bit.
fn check_walks(rig: &mut Runtime, kind: &str, recording: &Recording, hits: &[Hit]) -> Result<(), BenchError> {
    let gpu = rig.gpu().clone();
    rig.set_features(if gpu.is_software() { &[] } else { &["software"] });
    rig.play(recording)?;
    let others: Vec<Hit> = rig.read_some("hits", hits.len())?;
    rig.set_features(gpu.shader_features());
    let bits = |hit: &Hit| (hit.t.to_bits(), hit.triangle, hit.leaf, hit.b1.to_bits(), hit.b2.to_bits());
    match hits.iter().zip(&others).filter(|(hit, other)| bits(hit) != bits(other)).count() {
        0 => Ok(()),
        differ => Err(BenchError::Wrong(format!("{differ} {kind} rays hit something else on the other walk"))),
    }
}

/// A ray through the centre of every pixel of a square film, row by row from the top.
fn primary_rays(side: u32) -> Vec<Ray> {
    let (position, look_at, fov_y) = SPHERES_VIEW;
    let forward = (look_at - position).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let scale = (fov_y.to_radians() * 0.5).tan();
    let ray = |row: u32, column: u32| {
        let film = (Vec2::new(column as f32, row as f32) + 0.5) * (2.0 / side as f32) - 1.0;
        let direction = (forward + right * (film.x * scale) - up * (film.y * scale)).normalize();
        Ray { origin: position, t_min: 0.0, direction, t_max: T_FAR }
    };
    (0..side).flat_map(|row| (0..side).map(move |column| ray(row, column))).collect()
}

/// One ray from each hit, in the order of the pixels, distributed by the cosine about the normal.
fn bounce_rays(rays: &[Ray], hits: &[Hit], triangles: &[Triangle]) -> Vec<Ray> {
    let mut random = SplitMix(SEED);
    let mut bounce = |(ray, hit): (&Ray, &Hit)| {
        let triangle = triangles.get(hit.triangle as usize)?;
        let (a, b, c) = (triangle.a, triangle.b, triangle.c);
        let n = triangle_normal(Fma::Fused, a, b, c).normalize();
        let n = if n.dot(ray.direction) > 0.0 { -n } else { n };
        let (point, error) = surface_point(a, b, c, hit.b1, hit.b2);
        // A point of the unit sphere about the normal's end: the cosine's distribution.
        let z = random.range(-1.0, 1.0);
        let (sin, cos) = random.range(0.0, std::f64::consts::TAU).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        let direction = (n + glam::DVec3::new(r * cos, r * sin, z).as_vec3()).try_normalize().unwrap_or(n);
        let origin = offset_ray_origin(point, error, n, direction);
        Some(Ray { origin, t_min: 0.0, direction, t_max: T_FAR })
    };
    rays.iter().zip(hits).filter_map(&mut bounce).collect()
}
