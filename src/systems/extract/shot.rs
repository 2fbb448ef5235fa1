//! Camera, film, settings and environment to the parameters of the trace kernel.

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec3};

use crate::components::{Active, Camera, Environment, Film, Integrator, Name, Render, Sampler};
use crate::layout::film::film_exponent;
use crate::layout::trace::TraceParams;
use crate::layout::tree::root;
use crate::passes::trace::{Lighting, Needs, View, largest_emission};
use crate::systems::EngineError;
use crate::systems::state::{Dirty, FilmProgress, PackedScene};

/// Works the shot out anew, and compares it with the last: whatever is another number starts the film anew.
pub fn extract_changed_shot(
    cameras: Query<(Entity, &Name, &Camera, Has<Active>)>,
    films: Query<(&Film, &Render)>,
    environments: Query<(&Name, &Environment)>,
    mut scene: ResMut<PackedScene>,
    mut dirty: ResMut<Dirty>,
    progress: Res<FilmProgress>,
) -> Result<(), EngineError> {
    let (film, render) = films.iter().next().ok_or(EngineError::NoFilm)?;
    let by_name = |a: &(Entity, &Name, &Camera, bool)| (!a.3, a.1.as_str().to_owned(), a.0);
    let (.., camera, _) = cameras.iter().min_by_key(by_name).ok_or(EngineError::NoCamera)?;
    let environment = match environments.iter().min_by_key(|e| e.0.as_str()) {
        Some((_, Environment::Constant(radiance))) => *radiance,
        Some((_, Environment::Map { .. })) | None => Vec3::ZERO,
    };
    let window = film.window();
    if window.min.cmpge(window.max).any() || window.max.cmpgt(film.size).any() {
        return Err(EngineError::EmptyFilm);
    }
    let sky = scene.sky.as_ref();
    let brightest = environment.max(Vec3::splat(sky.map_or(0.0, |sky| sky.brightest)));
    let exponent = film_exponent(largest_emission(&scene.records, brightest));
    let mut shot = TraceParams {
        environment,
        seed: render.seed,
        max_depth: render.max_depth.max(1),
        root: root(scene.triangles),
        ..Default::default()
    };
    let view = View { position: camera.position, look_at: camera.look_at, up: camera.up, fov_y: camera.fov_y };
    shot.aim(&view, film.size, scene.origin);
    shot.crop(window.min, window.max);
    shot.fit_film(exponent);
    let asked = render.integrator == Integrator::Path;
    let lighting = Lighting {
        lights: scene.lights.lights.len() as u32,
        light_density: scene.lights.density,
        sky: sky.map_or(UVec2::ZERO, |sky| sky.size),
        sky_power: sky.filter(|_| asked).map_or(0.0, |sky| sky.power),
    };
    shot.light(&lighting, 0.5 * (scene.high - scene.low).length());
    let needs = Needs {
        materials: &scene.records,
        environment,
        sky: sky.is_some(),
        sky_light: lighting.sky_power > 0.0,
        lights: lighting.lights > 0,
        normals: scene.normals,
        roulette: render.roulette,
        sobol: render.sampler == Sampler::Sobol,
    };
    let needs = needs.features();
    let fewer = render.spp.max(1) < progress.samples + u32::from(progress.rows > 0);
    // By their bits: a NaN differs from itself, and would start the film anew for ever.
    let same = bytemuck::bytes_of(&shot) == bytemuck::bytes_of(&scene.shot);
    if !same || exponent != scene.exponent || !needs.iter().eq(scene.features.iter()) || fewer {
        scene.features = needs.into_iter().map(str::to_owned).collect();
        scene.shot = shot;
        scene.exponent = exponent;
        dirty.film = true;
    }
    if film.exposure.to_bits() != scene.exposure.to_bits() {
        scene.exposure = film.exposure;
        dirty.picture = true;
    }
    if scene.target != render.spp.max(1) {
        scene.target = render.spp.max(1);
    }
    Ok(())
}
