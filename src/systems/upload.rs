//! Packed arrays to buffers.

use bevy_ecs::prelude::*;

use super::state::{Device, Dirty, FilmProgress, PackedScene, Pending, keep_fault, no_fault};
use super::{EngineError, Phase};
use crate::layout::alias::AliasColumn;
use crate::layout::light::LightRecord;
use crate::layout::trace::{MaterialRecord, Shading};
use crate::layout::tree::Triangle;
use crate::layout::view::ViewMode;
use crate::passes::{build, film};

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            upload_changed_triangles.pipe(keep_fault),
            upload_changed_materials.pipe(keep_fault),
            upload_changed_lights.pipe(keep_fault),
            reserve_film.pipe(keep_fault),
        )
            .chain()
            .in_set(Phase::Upload)
            .run_if(no_fault),
    );
}

/// Writes the runs of triangles and normals that were flattened anew, and makes room for the tree over all.
fn upload_changed_triangles(
    mut device: ResMut<Device>,
    mut pending: ResMut<Pending>,
    scene: Res<PackedScene>,
    dirty: Res<Dirty>,
) -> Result<(), EngineError> {
    if !dirty.tree {
        return Ok(());
    }
    let count = u64::from(scene.triangles);
    let device = &mut device.0;
    device.reserve("triangles", count * size_of::<Triangle>() as u64)?;
    for (name, bytes) in build::buffers(scene.triangles) {
        device.reserve(name, bytes)?;
    }
    for (first, triangles) in std::mem::take(&mut pending.triangles) {
        device.write("triangles", u64::from(first), &triangles)?;
    }
    if scene.normals {
        device.reserve("shading", count * size_of::<Shading>() as u64)?;
        for (first, shading) in std::mem::take(&mut pending.shading) {
            device.write("shading", u64::from(first), &shading)?;
        }
    }
    Ok(())
}

/// Writes the records that are not what they were.
fn upload_changed_materials(
    mut device: ResMut<Device>,
    mut pending: ResMut<Pending>,
    scene: Res<PackedScene>,
) -> Result<(), EngineError> {
    if pending.materials.is_empty() {
        return Ok(());
    }
    device.0.reserve("materials", (scene.records.len() * size_of::<MaterialRecord>()) as u64)?;
    for (first, records) in std::mem::take(&mut pending.materials) {
        device.0.write("materials", u64::from(first), &records)?;
    }
    Ok(())
}

/// Writes the tables of lights and sky, whole: their columns depend on each other.
fn upload_changed_lights(mut device: ResMut<Device>, mut pending: ResMut<Pending>) -> Result<(), EngineError> {
    if let Some(lights) = pending.lights.take()
        && !lights.is_empty()
    {
        device.0.reserve("lights", (lights.len() * size_of::<LightRecord>()) as u64)?;
        device.0.write("lights", 0, &lights)?;
    }
    if let Some(sky) = pending.sky.take() {
        device.0.reserve("sky", (sky.cells.len() * size_of::<glam::Vec4>()) as u64)?;
        device.0.write("sky", 0, &sky.cells)?;
        device.0.reserve("sky_columns", (sky.columns.len() * size_of::<AliasColumn>()) as u64)?;
        device.0.write("sky_columns", 0, &sky.columns)?;
    }
    Ok(())
}

/// Makes room for a film that starts anew, and sets the features its pipelines are compiled for.
fn reserve_film(
    mut device: ResMut<Device>,
    mut progress: ResMut<FilmProgress>,
    scene: Res<PackedScene>,
    dirty: Res<Dirty>,
) -> Result<(), EngineError> {
    if dirty.picture {
        progress.shown = None;
    }
    // Another tree has the same hits, but may have other steps to them.
    if dirty.tree {
        progress.shown = progress.shown.filter(|mode| *mode == ViewMode::Beauty);
    }
    if !dirty.film {
        return Ok(());
    }
    *progress = FilmProgress::default();
    let pixels = u64::from(scene.shot.window_width) * u64::from(scene.shot.window_height);
    for (name, bytes) in film::buffers(pixels) {
        device.0.reserve(name, bytes)?;
    }
    let of_device = device.0.gpu().shader_features().iter().copied();
    let features: Vec<&str> = scene.features.iter().map(String::as_str).chain(of_device).collect();
    device.0.set_features(&features);
    Ok(())
}
