//! Meshes to triangles in world space, by the order of their names.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DVec3, Vec3};

use crate::components::{Geometry, MeshData, Name, Transform, UsesMaterial};
use crate::layout::trace::Shading;
use crate::layout::tree::Triangle;
use crate::passes::build::MOST_TRIANGLES;
use crate::systems::EngineError;
use crate::systems::state::{Dirty, MeshSlot, PackedScene, Pending};

type Mesh<'a> = (Entity, &'a Name, &'a Geometry, Option<&'a Transform>, Option<&'a UsesMaterial>, Option<&'a MeshSlot>);
type Touched = Or<(Changed<Geometry>, Changed<Transform>, Changed<UsesMaterial>, Changed<Name>)>;

/// Finds the meshes that are not what their slots say, and flattens those; all of them where slots or the origin move, or
/// the buffers have to grow, which then lose what they held.
#[expect(clippy::too_many_arguments, reason = "a system's arguments are what it reads and writes")]
pub fn extract_changed_meshes(
    meshes: Query<Mesh>,
    touched: Query<(), (With<Geometry>, Touched)>,
    mut gone: RemovedComponents<Geometry>,
    mut unset: RemovedComponents<UsesMaterial>,
    mut unmoved: RemovedComponents<Transform>,
    mut unnamed: RemovedComponents<Name>,
    mut commands: Commands,
    mut scene: ResMut<PackedScene>,
    mut pending: ResMut<Pending>,
    mut dirty: ResMut<Dirty>,
) -> Result<(), EngineError> {
    let gone: Vec<Entity> = gone.read().collect();
    let removed = !gone.is_empty() || unset.read().count() + unmoved.read().count() + unnamed.read().count() > 0;
    if scene.sent && touched.is_empty() && !removed && !scene.is_changed() {
        return Ok(());
    }
    for entity in gone {
        if let Ok(mut entity) = commands.get_entity(entity) {
            entity.try_remove::<MeshSlot>();
        }
    }
    let mut sorted: Vec<_> = meshes.iter().collect();
    sorted.sort_by(|a, b| (a.1.as_str(), a.0).cmp(&(b.1.as_str(), b.0)));
    let slots = plan_slots(&sorted, &scene)?;
    let (low, high) = scene_box(&slots);
    let origin = choose_origin(low, high);
    let order: Vec<Entity> = sorted.iter().map(|mesh| mesh.0).collect();
    let normals = slots.iter().any(|slot| !slot.geometry.normal_triangles.is_empty());
    let triangles = slots.last().map_or(0, |slot| slot.first + slot.count);
    let moved = order != scene.meshes || origin != scene.origin || normals != scene.normals;
    let all = !scene.sent || moved || triangles > scene.triangles;
    let mut changed = all;
    for ((entity, .., old), slot) in sorted.iter().zip(slots.iter()) {
        if !all && old.is_some_and(|old| same(old, slot)) {
            continue;
        }
        changed = true;
        flatten(slot, origin, normals, &mut pending);
        commands.entity(*entity).insert(slot.clone());
    }
    if changed {
        scene.sent = true;
        scene.triangles = triangles;
        scene.meshes = order;
        scene.origin = origin;
        (scene.low, scene.high) = (low, high);
        scene.normals = normals;
        dirty.tree = true;
        dirty.film = true;
    }
    Ok(())
}

fn same(old: &MeshSlot, new: &MeshSlot) -> bool {
    (old.first, old.count, old.material, old.transform) == (new.first, new.count, new.material, new.transform)
        && Arc::ptr_eq(&old.geometry, &new.geometry)
}

/// Where each mesh goes, and what it is made from. `sorted` is by name.
fn plan_slots(sorted: &[Mesh], scene: &PackedScene) -> Result<Vec<MeshSlot>, EngineError> {
    let mut first: u64 = 0;
    let default = scene.materials.len() as u32;
    let mut slots = Vec::with_capacity(sorted.len());
    for (_, _, geometry, transform, material, old) in sorted {
        let transform = transform.copied().unwrap_or_default();
        let known = old.filter(|old| Arc::ptr_eq(&old.geometry, &geometry.0) && old.transform == transform);
        let (low, high) = match known {
            Some(old) => (old.low, old.high),
            None => world_box(&geometry.0, &transform.0),
        };
        let count = geometry.0.triangles.len() as u64;
        let material = material.and_then(|m| scene.material_index.get(&m.0).copied()).unwrap_or(default);
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
    if first > u64::from(MOST_TRIANGLES) {
        return Err(EngineError::TooManyTriangles { count: first, most: MOST_TRIANGLES });
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
    /// The centre of the box of one of the mesh's triangles, relative to the scene's origin.
    pub fn centre(&self, triangle: u32, origin: DVec3) -> Vec3 {
        let corners = self.geometry.triangles[triangle as usize]
            .map(|i| (self.transform.0.transform_point3(self.geometry.positions[i as usize]) - origin).as_vec3());
        let [a, b, c] = corners;
        (a.min(b).min(c) + a.max(b).max(c)) * 0.5
    }

    /// The mesh's triangles, relative to the scene's origin: f64 until the last step.
    pub fn triangles(&self, origin: DVec3) -> impl Iterator<Item = Triangle> {
        let mesh = &*self.geometry;
        let place = move |i: u32| (self.transform.0.transform_point3(mesh.positions[i as usize]) - origin).as_vec3();
        mesh.triangles.iter().zip(self.first..).map(move |(corners, index)| {
            let [a, b, c] = corners.map(place);
            Triangle { a, index, b, material: self.material, c, flags: 0 }
        })
    }
}

/// Appends a mesh's triangles, and its corner normals if any mesh has some, to what is to be uploaded.
fn flatten(slot: &MeshSlot, origin: DVec3, normals: bool, pending: &mut Pending) {
    pending.triangles.push((slot.first, slot.triangles(origin).collect()));
    if !normals {
        return;
    }
    let mesh = &*slot.geometry;
    let turn: DMat3 = slot.transform.0.matrix3.inverse().transpose();
    let bend = |i: u32| (turn * mesh.normals[i as usize].as_dvec3()).normalize_or_zero().as_vec3();
    let shading = match mesh.normal_triangles.as_slice() {
        [] => vec![Shading::pack([Vec3::ZERO; 3]); mesh.triangles.len()],
        corners => corners.iter().map(|c| Shading::pack(c.map(bend))).collect(),
    };
    pending.shading.push((slot.first, shading));
}
