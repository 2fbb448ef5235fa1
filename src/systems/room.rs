//! Refuses what the device has no room for before any work is done on it: a film, and triangles with their tree. Other arrays are made
//! smaller (textures, skies), or are far smaller than those.

use bevy_ecs::prelude::*;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{Device, Everything};
use super::run::counted;
use crate::components::{Film, Geometry};
use crate::layout::tree::Triangle;
use crate::passes::film;
use crate::passes::tree::PLAN;

pub fn add_systems(schedule: &mut Schedule) {
    let film = refuse_film.pipe(counted("refuse_film")).run_if(is_film_too_large);
    let meshes = refuse_meshes.pipe(counted("refuse_meshes")).run_if(are_meshes_too_large);
    schedule.add_systems((film, meshes).chain().in_set(Phase::Room));
}

/// The largest array that a film's window needs.
fn largest_of_film(film: &Film) -> (&'static str, u64) {
    let size = film.window().size();
    largest(film::buffers(u64::from(size.x) * u64::from(size.y)))
}

/// The largest array that so many triangles need; of no more than a tree can hold, which is refused elsewhere.
fn largest_of_triangles(count: u64) -> (&'static str, u64) {
    let count = count.min(u64::from(PLAN.most_triangles));
    let mut arrays = (PLAN.buffers)(count as u32);
    arrays.push(("triangles", count * size_of::<Triangle>() as u64));
    largest(arrays)
}

fn largest(arrays: Vec<(&'static str, u64)>) -> (&'static str, u64) {
    arrays.into_iter().max_by_key(|(_, bytes)| *bytes).unwrap_or_default()
}

fn is_film_too_large(everything: Res<Everything>, films: Query<Ref<Film>>, device: Res<Device>) -> bool {
    let touched = |film: &Ref<Film>| everything.0 || film.is_changed();
    films.iter().any(|film| touched(&film) && largest_of_film(&film).1 > device.0.gpu().most_bytes())
}

fn refuse_film(films: Query<&Film>, device: Res<Device>) -> Result<(), EngineError> {
    films.iter().map(largest_of_film).try_for_each(|(name, bytes)| Ok(device.0.gpu().check_size(name, bytes)?))
}

fn triangles(meshes: &Query<&Geometry>) -> u64 {
    meshes.iter().map(|mesh| mesh.0.triangles.len() as u64).sum()
}

fn are_meshes_too_large(
    everything: Res<Everything>,
    touched: Query<(), Changed<Geometry>>,
    meshes: Query<&Geometry>,
    device: Res<Device>,
) -> bool {
    (everything.0 || !touched.is_empty()) && largest_of_triangles(triangles(&meshes)).1 > device.0.gpu().most_bytes()
}

fn refuse_meshes(meshes: Query<&Geometry>, device: Res<Device>) -> Result<(), EngineError> {
    let (name, bytes) = largest_of_triangles(triangles(&meshes));
    Ok(device.0.gpu().check_size(name, bytes)?)
}
