//! The engine against the oracle.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DMat3, Vec3};
use lucerna::components::{
    Daylight, Environment, Integrator, Lobe, Material, Passage, Render, Reuse, Sampler, Transform,
};
use lucerna::oracle::Oracle;
use lucerna::scene::generate::to_mesh;
use lucerna::scene::{MeshEntry, SceneDescription};
use lucerna::shader::Library;
use lucerna::{Engine, scene};

use crate::statistics::BATCHES;
use crate::support;
use crate::support::stage::{matte, sky_map};

use super::{compare, halves};

/// A scene of `assets/scenes` at a size that the oracle can bear.
fn shipped(name: &str, side: u32) -> SceneDescription {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/scenes/{name}.ron"));
    let size = format!("({side},{side})");
    let defines = [("film.size", size.as_str()), ("render.max_depth", "5")]
        .map(|(path, value)| scene::Define::given(path, value));
    scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description
}

/// The Cornell box without its light, and a thousand small ones in a grid below its ceiling, in three colours.
fn thousand_lights(side: u32) -> SceneDescription {
    let mut description = shipped("cornell-box", side);
    description.materials.values_mut().for_each(|material| material.ke = Vec3::ZERO);
    for (colour, emission) in
        [Vec3::new(9.0, 2.0, 1.0), Vec3::new(1.0, 8.0, 2.0), Vec3::new(2.0, 3.0, 30.0)].into_iter().enumerate()
    {
        let triangles: Vec<[Vec3; 3]> = (0..1000)
            .filter(|i| i % 3 == colour)
            .map(|i| Vec3::new((i % 10) as f32, (i / 100) as f32, (i / 10 % 10) as f32) * Vec3::new(0.15, -0.04, 0.15))
            .map(|at| at + Vec3::new(-0.7, 0.9, -0.7))
            .map(|at| [at, at + 0.01 * Vec3::X, at + 0.01 * (Vec3::Z + 0.3 * Vec3::Y)])
            .collect();
        let name = format!("lamps:{colour}");
        description.materials.insert(name.clone(), Material { emission, ..matte(Vec3::splat(0.3)) }.into());
        let geometry = Arc::new(to_mesh(&triangles));
        let mesh = MeshEntry { geometry, transform: Transform::default(), material: name };
        description.meshes.insert(format!("lamps/{colour}"), mesh);
    }
    description
}

/// A scene of which everything has a coat of a roughness.
fn coated(mut description: SceneDescription, roughness: f32) -> SceneDescription {
    description.materials.values_mut().for_each(|material| (material.pc, material.pcr) = (1.0, roughness));
    description
}

/// A floor and a wall, rough and shiny, in the open.
pub(super) fn yard(side: u32, environment: Environment) -> SceneDescription {
    let mut description = shipped("teapot", side);
    description.meshes.clear();
    description.materials.clear();
    let floor = crate::support::stage::quad(Vec3::new(-9.0, 0.0, 9.0), 18.0 * Vec3::X, -18.0 * Vec3::Z);
    let wall = crate::support::stage::quad(Vec3::new(-5.0, 0.0, 6.0), 7.0 * Vec3::Y, -12.0 * Vec3::Z);
    let shiny = Material { specular: Vec3::splat(0.3), lobe: Lobe::Ggx(0.7), ..matte(Vec3::new(0.6, 0.5, 0.4)) };
    for (name, part, material) in [("floor", floor, shiny), ("wall", wall, matte(Vec3::splat(0.7)))] {
        description.materials.insert(name.to_owned(), material.into());
        let geometry = Arc::new(to_mesh(&part));
        let mesh = MeshEntry { geometry, transform: Transform::default(), material: name.to_owned() };
        description.meshes.insert(name.to_owned(), mesh);
    }
    description.environment = Some(environment);
    description
}

/// The sky of the tests, turned every way and tinted.
fn turned_sky() -> Environment {
    let turn = DMat3::from_rotation_z(0.5) * DMat3::from_rotation_y(-1.2) * DMat3::from_rotation_x(0.8);
    match sky_map() {
        Environment::Map { image, strength, .. } => {
            Environment::Map { image, strength, tint: Vec3::new(0.5, 1.0, 2.0), turn }
        }
        other => other,
    }
}

/// A day with a low sun.
fn day() -> Environment {
    let ground = Vec3::new(0.4, 0.3, 0.2);
    Environment::Daylight(Daylight {
        elevation: 35.0,
        azimuth: 110.0,
        turbidity: 4.0,
        ground,
        strength: 0.7,
        sun_size: 5.0,
    })
}

/// Whether the engine and the oracle agree on a scene, `spp` samples of each a pixel and batch; and whether an error of 2.5 % in
/// the one is seen: 6.4 standard errors of 0.3 % are 1.9 %.
pub(super) fn judge(name: &str, mut description: SceneDescription, integrator: Integrator, sampler: Sampler, spp: u32) {
    description.render = Render { integrator, sampler, spp, roulette: true, ..description.render };
    let width = description.film.size.x;
    let mut world = World::new();
    scene::apply(&mut world, &description);
    let oracle = Oracle::new(&mut world).unwrap();
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let rights: Vec<_> = (0..BATCHES as u32)
        .map(|i| halves(width, &oracle.render(i * spp..(i + 1) * spp, 1, threads, &|_, _| ()).mean))
        .collect();
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    let films: Vec<_> = (0..BATCHES as u32)
        .map(|seed| {
            engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.seed = seed));
            while !engine.step(Duration::from_millis(100)).unwrap().finished {}
            halves(width, &engine.film().unwrap().rgb.iter().map(|p| Vec3::from(*p).as_dvec3()).collect::<Vec<_>>())
        })
        .collect();
    compare(|i| films[i], |i| rights[i]).unwrap_or_else(|why| panic!("{name}, {integrator:?}, {sampler:?}: {why}"));
    let planted = compare(|i| films[i].map(|v| 0.975 * v), |i| rights[i]);
    assert!(planted.is_err_and(|why| why.contains("differ")), "{name}: a planted error went unnoticed");
    println!("{name}, {integrator:?}, {sampler:?}: agree");
}

#[test]
fn equals_the_engine() {
    judge("cornell-box", shipped("cornell-box", 16), Integrator::Path, Sampler::Sobol, 256);
    let mut under_sky = shipped("teapot", 12);
    under_sky.environment = Some(sky_map());
    judge("teapot under a sky", under_sky, Integrator::Path, Sampler::Sobol, 100);
    judge("a yard under a turned sky", yard(12, turned_sky()), Integrator::Path, Sampler::Sobol, 128);
    judge("a yard by day", yard(12, day()), Integrator::Path, Sampler::Sobol, 128);
}

#[test]
fn equals_the_engine_where_everything_is_coated() {
    for integrator in [Integrator::Path, Integrator::Bsdf] {
        for roughness in [0.0, 0.4] {
            let open = coated(yard(12, Environment::Constant(Vec3::new(0.4, 0.5, 0.7))), roughness);
            judge(&format!("a yard under a coat of {roughness}"), open, integrator, Sampler::Sobol, 128);
        }
    }
    judge("cornell-box under a coat", coated(shipped("cornell-box", 16), 0.4), Integrator::Path, Sampler::Sobol, 256);
}

#[test]
fn equals_the_engine_where_paths_are_reused() {
    let reused = |name: &str, mut description: SceneDescription, spp: u32| {
        description.render.reuse = Reuse::Tiles;
        judge(&format!("{name}, paths reused"), description, Integrator::Path, Sampler::Sobol, spp);
    };
    reused("cornell-box", shipped("cornell-box", 16), 256);
    reused("a yard under a turned sky", yard(12, turned_sky()), 128);
    reused("cornell-box under a coat", coated(shipped("cornell-box", 16), 0.4), 256);
    if support::stress() {
        reused("a yard by day", yard(24, day()), 2048);
        reused("teapot", shipped("teapot", 24), 256);
        reused("glass", shipped("glass", 24), 2048);
        reused("a thousand lights", thousand_lights(24), 8192);
    }
}

#[test]
fn equals_the_engine_behind_panes() {
    let mut glazed = yard(12, Environment::Constant(Vec3::new(0.4, 0.5, 0.7)));
    let pane = Material { passage: Passage::Pane(1.5), filter: Vec3::new(0.8, 0.9, 1.0), ..Material::default() };
    glazed.materials.insert("pane".to_owned(), pane.into());
    let part = crate::support::stage::quad(Vec3::new(2.0, 0.2, -2.0), 5.0 * Vec3::Y, Vec3::new(1.0, 0.0, 5.0));
    let geometry = Arc::new(to_mesh(&part));
    let mesh = MeshEntry { geometry, transform: Transform::default(), material: "pane".to_owned() };
    glazed.meshes.insert("pane".to_owned(), mesh);
    for integrator in [Integrator::Path, Integrator::Bsdf] {
        judge("a yard behind a pane", glazed.clone(), integrator, Sampler::Sobol, 256);
    }
}

#[test]
fn equals_the_engine_under_turned_skies_and_by_day() {
    if !support::stress() {
        return;
    }
    judge("a yard by day", yard(24, day()), Integrator::Bsdf, Sampler::Pcg, 8192);
    judge("a yard under a turned sky", yard(24, turned_sky()), Integrator::Bsdf, Sampler::Pcg, 2048);
    let open = |environment| SceneDescription { environment: Some(environment), ..shipped("teapot", 24) };
    judge("teapot under a turned sky", open(turned_sky()), Integrator::Path, Sampler::Sobol, 4096);
    judge("teapot by day", open(day()), Integrator::Path, Sampler::Sobol, 2048);
}

#[test]
fn equals_the_engine_by_each_estimator() {
    if !support::stress() {
        return;
    }
    // Each estimator on each kind of scene: on a GPU, and on more than two cores.
    for sampler in [Sampler::Sobol, Sampler::Pcg] {
        judge("teapot", shipped("teapot", 24), Integrator::Path, sampler, 256);
        judge("glass", shipped("glass", 24), Integrator::Path, sampler, 2048);
        judge("a thousand lights", thousand_lights(24), Integrator::Path, sampler, 8192);
        let mut under_sky = shipped("glass", 24);
        under_sky.environment = Some(sky_map());
        judge("glass under a sky", under_sky, Integrator::Path, sampler, 2048);
        judge("cornell-box", shipped("cornell-box", 24), Integrator::Bsdf, sampler, 1024);
        judge("teapot", shipped("teapot", 24), Integrator::Bsdf, sampler, 1024);
    }
}
