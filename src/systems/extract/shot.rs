//! Camera, film, settings and environment to the parameters of the trace kernel.

use bevy_ecs::prelude::*;
use bevy_ecs::query::QuerySingleError;
use glam::{DMat3, Mat3, Vec3};

use super::step::Step;
use crate::components::{
    Active, Adaptive, Camera, CameraItem, Environment, EnvironmentItem, Film, Integrator, Name, Render, Reuse, Sampler,
    Tone, rendered_camera, rendered_environment,
};
use crate::gpu::GpuTable;
use crate::layout::film::{MOST_SAMPLES, TONE_AGX, TONE_NEUTRAL, TONE_NONE, film_exponent};
use crate::layout::light::{LightRecord, LightTable};
use crate::layout::texture::MaterialMaps;
use crate::layout::trace::{MaterialRecord, TraceParams};
use crate::layout::tree::Triangle;
use crate::passes::features::FEATURES;
use crate::passes::film::Look;
use crate::passes::trace::{Needs, largest_emission};
use crate::passes::tree::PLAN;
use crate::prepare::lighting::Lighting;
use crate::prepare::sun::sun_of;
use crate::prepare::{camera, point};
use crate::systems::error::EngineError;
use crate::systems::resources::{
    Displayed, Endless, Everything, FilmProgress, General, LightDensity, SceneGeometry, Shot, Sky, Target, Textures,
};
use crate::systems::run::counted;

type TouchedCamera = (With<Camera>, Or<(Changed<Camera>, Changed<Name>, Changed<Active>)>);
type TouchedFilm = Or<(Changed<Film>, Changed<Render>)>;
type TouchedEnvironment = (With<Environment>, Or<(Changed<Environment>, Changed<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_shot.pipe(counted("extract_shot"));
    schedule.add_systems(system.run_if(entities_changed.or_eager(scene_changed)).in_set(Step::Shot));
}

/// A camera, the film or its settings, or the environment came, went or changed.
#[expect(clippy::too_many_arguments, reason = "a condition's arguments are what it reads")]
fn entities_changed(
    everything: Res<Everything>,
    cameras: Query<(), TouchedCamera>,
    films: Query<(), TouchedFilm>,
    environments: Query<(), TouchedEnvironment>,
    mut gone: RemovedComponents<Camera>,
    mut inactive: RemovedComponents<Active>,
    mut unnamed: RemovedComponents<Name>,
    mut dark: RemovedComponents<Environment>,
    mut lost: RemovedComponents<Film>,
    mut unset: RemovedComponents<Render>,
) -> bool {
    let cameras_gone = gone.read().count() + inactive.read().count() + unnamed.read().count();
    let others_gone = dark.read().count() + lost.read().count() + unset.read().count();
    everything.0
        || cameras_gone + others_gone > 0
        || !cameras.is_empty()
        || !films.is_empty()
        || !environments.is_empty()
}

/// What the scene comes to changed.
#[expect(clippy::too_many_arguments, reason = "a condition's arguments are what it reads")]
fn scene_changed(
    geometry: Res<SceneGeometry>,
    triangles: Res<GpuTable<Triangle>>,
    records: Res<GpuTable<MaterialRecord>>,
    maps: Res<GpuTable<MaterialMaps>>,
    textures: Res<Textures>,
    lights: Res<GpuTable<LightRecord>>,
    density: Res<LightDensity>,
    sky: Res<Sky>,
    endless: Res<Endless>,
    general: Res<General>,
) -> bool {
    geometry.is_changed()
        || triangles.is_changed()
        || records.is_changed()
        || maps.is_changed()
        || textures.is_changed()
        || lights.is_changed()
        || density.is_changed()
        || sky.is_changed()
        || endless.is_changed()
        || general.is_changed()
}

/// What the kernel is to know of the scene, as the systems before made it.
#[derive(bevy_ecs::system::SystemParam)]
struct Packed<'w> {
    geometry: Res<'w, SceneGeometry>,
    triangles: Res<'w, GpuTable<Triangle>>,
    records: Res<'w, GpuTable<MaterialRecord>>,
    maps: Res<'w, GpuTable<MaterialMaps>>,
    textures: Res<'w, Textures>,
    lights: Res<'w, GpuTable<LightRecord>>,
    density: Res<'w, LightDensity>,
    sky: Res<'w, Sky>,
    general: Res<'w, General>,
}

/// What comes of it.
#[derive(bevy_ecs::system::SystemParam)]
struct Extracted<'w> {
    shot: ResMut<'w, Shot>,
    displayed: ResMut<'w, Displayed>,
    target: ResMut<'w, Target>,
}

/// Works the shot out anew, and compares it with the last: whatever is another number starts the film anew.
fn extract_shot(
    cameras: Query<CameraItem>,
    mut films: Query<(&Film, &Render, &mut FilmProgress)>,
    environments: Query<EnvironmentItem>,
    packed: Packed,
    endless: Res<Endless>,
    mut extracted: Extracted,
) -> Result<(), EngineError> {
    let (film, render, mut progress) = films.single_mut().map_err(|error| match error {
        QuerySingleError::NoEntities(_) => EngineError::NoFilm,
        QuerySingleError::MultipleEntities(_) => EngineError::ManyFilms,
    })?;
    let (_, _, camera) = rendered_camera(cameras).ok_or(EngineError::NoCamera)?;
    let environment = rendered_environment(environments);
    let shot = shoot(camera, film, render, environment, &packed)?;
    if !shot.same(&extracted.shot) {
        *extracted.shot = shot;
    }
    let target = if endless.0 { MOST_SAMPLES } else { render.spp.max(1) };
    if target < progress.most_samples() {
        progress.restart();
    }
    extracted.target.set_if_neq(Target(target));
    let look = Look { exposure: film.exposure, tone: tone_code(film.tone) };
    let shown = extracted.displayed.0;
    if (look.exposure.to_bits(), look.tone) != (shown.exposure.to_bits(), shown.tone) {
        extracted.displayed.0 = look;
    }
    Ok(())
}

/// What the display pass knows a tone curve by.
fn tone_code(tone: Tone) -> u32 {
    match tone {
        Tone::None => TONE_NONE,
        Tone::Agx => TONE_AGX,
        Tone::Neutral => TONE_NEUTRAL,
    }
}

fn shoot(
    camera: &Camera,
    film: &Film,
    render: &Render,
    environment: Option<&Environment>,
    packed: &Packed,
) -> Result<Shot, EngineError> {
    let (environment, sky_turn, sun) = match environment {
        Some(Environment::Constant(radiance)) => (*radiance, Mat3::IDENTITY, None),
        Some(Environment::Map { turn, .. }) => (Vec3::ZERO, turn.as_mat3(), None),
        // Its picture has the sun in the middle.
        Some(Environment::Daylight(day)) => {
            (Vec3::ZERO, DMat3::from_rotation_y(-day.azimuth.to_radians()).as_mat3(), sun_of(day))
        }
        None => (Vec3::ZERO, Mat3::IDENTITY, None),
    };
    let window = film.window();
    if window.min.cmpge(window.max).any() || window.max.cmpgt(film.size).any() {
        return Err(EngineError::EmptyFilm);
    }
    let (sky, geometry) = (&packed.sky, &packed.geometry);
    let [low, high] = [geometry.low, geometry.high].map(|corner| (corner - geometry.origin).as_vec3());
    let radius = 0.5 * (geometry.high - geometry.low).length();
    let points = packed.lights.rows().iter().rev().map_while(LightRecord::point);
    let brightest = environment
        .max(Vec3::splat(sky.brightest.max(point::brightest(points, low, high))))
        .max(sun.map_or(Vec3::ZERO, |sun| sun.radiance));
    let exponent = film_exponent(largest_emission(
        packed.records.rows(),
        packed.maps.rows(),
        &packed.textures.brightest,
        brightest,
    ));
    let mut params = TraceParams {
        environment,
        seed: render.seed,
        max_depth: render.max_depth.max(1),
        root: (PLAN.root)(packed.triangles.len() as u32),
        ..Default::default()
    };
    camera::aim(&mut params, camera, film.size, geometry.origin);
    if !packed.maps.is_empty() {
        camera::set_footprint(&mut params, render.texture_filter);
    }
    camera::crop(&mut params, window);
    camera::fit_film(&mut params, exponent);
    let lighting = Lighting {
        lights: packed.lights.len() as u32,
        light_density: packed.density.0,
        points_alone: render.integrator != Integrator::Path,
        sky: sky.size,
        sky_turn,
        sun,
        sky_power: if render.integrator == Integrator::Path { sky.power } else { 0.0 },
    };
    lighting.write(&mut params, radius);
    let needs = Needs {
        materials: packed.records.rows(),
        maps: packed.maps.rows(),
        triangles: packed.triangles.len() as u32,
        environment,
        sky: sky.source.is_some(),
        sky_light: lighting.sky_power > 0.0,
        sun: sun.is_some(),
        lights: lighting.lights > 0,
        point_lights: LightTable::has_points(packed.lights.rows()),
        lens: params.lens_radius > 0.0,
        normals: geometry.normals,
        roulette: render.roulette,
        adaptive: render.adaptive == Adaptive::On,
        reuse: render.reuse == Reuse::Tiles && render.integrator == Integrator::Path && render.max_depth > 2,
        sobol: render.sampler == Sampler::Sobol,
    };
    let idle = FEATURES.iter().filter(|feature| packed.general.0 && feature.can_be_idle).map(|feature| feature.name);
    let features = needs.features().into_iter().chain(idle).map(str::to_owned).collect();
    Ok(Shot { params, exponent, features })
}
