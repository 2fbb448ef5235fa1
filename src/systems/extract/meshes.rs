//! Meshes to triangles in world space, by the order of their names.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::step::Step;
use crate::components::{Geometry, MeshData, Name, Transform, UsesMaterial};
use crate::gpu::GpuTable;
use crate::layout::trace::Shading;
use crate::layout::tree::Triangle;
use crate::passes::tree::PLAN;
use crate::systems::error::EngineError;
use crate::systems::resources::{Everything, MaterialSlot, MeshSlot, Relief, SceneGeometry};
use crate::systems::run::counted;

type Mesh<'a> = (Entity, &'a Name, &'a Geometry, Option<&'a Transform>, Option<&'a UsesMaterial>, Option<&'a MeshSlot>);
type Touched = (With<Geometry>, Or<(Changed<Geometry>, Changed<Transform>, Changed<UsesMaterial>, Changed<Name>)>);

/// What is no mesh any more.
type Stray = (With<MeshSlot>, Or<(Without<Geometry>, Without<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_meshes.pipe(counted("extract_meshes"));
    schedule.add_systems(system.run_if(meshes_changed).in_set(Step::Meshes));
}

/// A mesh came, went, changed or was renamed, a material has another slot, or normals count or do not.
#[expect(clippy::too_many_arguments, reason = "a condition's arguments are what it reads")]
fn meshes_changed(
    everything: Res<Everything>,
    touched: Query<(), Touched>,
    slots: Query<(), Changed<MaterialSlot>>,
    mut gone: RemovedComponents<Geometry>,
    mut unset: RemovedComponents<UsesMaterial>,
    mut unmoved: RemovedComponents<Transform>,
    mut unnamed: RemovedComponents<Name>,
    mut unslotted: RemovedComponents<MaterialSlot>,
    relief: Res<Relief>,
) -> bool {
    let removed = gone.read().count() + unset.read().count() + unmoved.read().count() + unnamed.read().count();
    everything.0
        || removed + unslotted.read().count() > 0
        || !touched.is_empty()
        || !slots.is_empty()
        || relief.is_changed()
}

/// Finds the meshes that are not what their slots say, and flattens those into the tables; all of them where the origin moves,
/// the order changes, or normals come or go.
#[expect(clippy::too_many_arguments, reason = "a system's arguments are what it reads and writes")]
fn extract_meshes(
    meshes: Query<Mesh>,
    materials: Query<&MaterialSlot>,
    stray: Query<Entity, Stray>,
    relief: Res<Relief>,
    mut world: ResMut<SceneGeometry>,
    mut triangles: ResMut<GpuTable<Triangle>>,
    mut shading: ResMut<GpuTable<Shading>>,
    mut commands: Commands,
) -> Result<(), EngineError> {
    for entity in &stray {
        commands.entity(entity).remove::<MeshSlot>();
    }
    let mut sorted: Vec<_> = meshes.iter().collect();
    sorted.sort_by(|a, b| (a.1.as_str(), a.0).cmp(&(b.1.as_str(), b.0)));
    let slots = plan_slots(&sorted, &materials)?;
    let (low, high) = scene_box(&slots);
    let now = SceneGeometry {
        meshes: sorted.iter().map(|mesh| mesh.0).collect(),
        origin: choose_origin(low, high),
        low,
        high,
        normals: relief.0 || slots.iter().any(|slot| !slot.geometry.normal_triangles.is_empty()),
    };
    let placed = (&now.meshes, now.origin) == (&world.meshes, world.origin);
    let kept = placed && now.normals == world.normals;
    let count = slots.last().map_or(0, |slot| slot.first + slot.count) as usize;
    let held = |i: &usize| placed && sorted[*i].5.is_some_and(|held| held.same(&slots[*i]));
    let stale: Vec<usize> = (0..slots.len()).filter(|i| !held(i)).collect();
    if stale.is_empty() && kept && count == triangles.len() {
        return Ok(());
    }
    if count != triangles.len() {
        triangles.resize(count);
    }
    for slot in stale.iter().map(|i| &slots[*i]) {
        triangles.write(slot.first as usize, slot.triangles(now.origin));
    }
    let with_normals = if now.normals { count } else { 0 };
    if shading.len() != with_normals {
        shading.resize(with_normals);
    }
    // Where normals come, all of them: the tree stays, which knows nothing of them.
    let bent: Vec<usize> = if kept { stale.clone() } else { (0..slots.len()).collect() };
    for slot in bent.iter().filter(|_| now.normals).map(|i| &slots[*i]) {
        shading.write(slot.first as usize, slot.shading());
    }
    for i in stale {
        commands.entity(sorted[i].0).insert(slots[i].clone());
    }
    *world = now;
    Ok(())
}

/// Where each mesh goes, and what it is made from. `sorted` is by name.
fn plan_slots(sorted: &[Mesh], materials: &Query<&MaterialSlot>) -> Result<Vec<MeshSlot>, EngineError> {
    let mut first: u64 = 0;
    let default = materials.iter().count() as u32;
    let mut slots = Vec::with_capacity(sorted.len());
    for (_, _, geometry, transform, material, old) in sorted {
        let transform = transform.copied().unwrap_or_default();
        let known = old.filter(|old| Arc::ptr_eq(&old.geometry, &geometry.0) && old.transform == transform);
        let (low, high) = match known {
            Some(old) => (old.low, old.high),
            None => world_box(&geometry.0, &transform.0),
        };
        let count = geometry.0.triangles.len() as u64;
        let material = material.and_then(|uses| materials.get(uses.0).ok()).map_or(default, |slot| slot.0);
        slots.push(MeshSlot {
            first: first.min(u64::from(u32::MAX)) as u32,
            count: count.min(u64::from(u32::MAX)) as u32,
            low,
            high,
            geometry: geometry.0.clone(),
            transform,
            material,
        });
        first += count;
    }
    if first > u64::from(PLAN.most_triangles) {
        return Err(EngineError::TooManyTriangles { count: first, most: PLAN.most_triangles });
    }
    Ok(slots)
}

fn world_box(mesh: &MeshData, transform: &DAffine3) -> (DVec3, DVec3) {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    mesh.positions.iter().fold(empty, |(low, high), p| {
        let p = transform.transform_point3(*p);
        (low.min(p), high.max(p))
    })
}

/// The box of all meshes; low above high if none has a corner.
fn scene_box(slots: &[MeshSlot]) -> (DVec3, DVec3) {
    let filled = slots.iter().filter(|slot| slot.low.cmple(slot.high).all());
    filled.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), slot| (low.min(slot.low), high.max(slot.high)))
}

/// The point that is zero on the GPU, where f32 is finest: zero itself for a scene around it, else the centre of the
/// scene, snapped to a grid of twice its size or more. A function of the scene alone, so that a scene reached by edits
/// equals one opened fresh; the grid keeps it still under small edits.
fn choose_origin(low: DVec3, high: DVec3) -> DVec3 {
    let size = (high - low).max_element();
    if !(size.is_finite() && size > 0.0) {
        return DVec3::ZERO;
    }
    let grid = 2f64.powi(size.log2().ceil() as i32 + 1);
    let snapped = ((low + high) * (0.5 / grid)).round() * grid;
    if snapped.is_finite() { snapped } else { DVec3::ZERO }
}

impl MeshSlot {
    /// The mesh's triangles, relative to the scene's origin: f64 until the last step.
    fn triangles(&self, origin: DVec3) -> impl Iterator<Item = Triangle> {
        let mesh = &*self.geometry;
        let place = move |i: u32| (self.transform.0.transform_point3(mesh.positions[i as usize]) - origin).as_vec3();
        mesh.triangles.iter().zip(self.first..).map(move |(corners, index)| {
            let [a, b, c] = corners.map(place);
            Triangle { a, index, b, material: self.material, c, flags: 0 }
        })
    }

    /// The corner normals of the mesh's triangles, in world space.
    fn shading(&self) -> Vec<Shading> {
        let mesh = &*self.geometry;
        let turn: DMat3 = self.transform.0.matrix3.inverse().transpose();
        let bend = |i: u32| (turn * mesh.normals[i as usize].as_dvec3()).normalize_or_zero().as_vec3();
        match mesh.normal_triangles.as_slice() {
            [] => vec![Shading::pack([Vec3::ZERO; 3]); mesh.triangles.len()],
            corners => corners.iter().map(|c| Shading::pack(c.map(bend))).collect(),
        }
    }
}
