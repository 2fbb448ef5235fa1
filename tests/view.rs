//! What is seen first, instead of the film: each view against its twin, and when it is drawn.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec2};
use lucerna::Engine;
use lucerna::components::{Camera, Crop, Film, Material};
use lucerna::cpu::tree::Tree;
use lucerna::cpu::view::ViewScene;
use lucerna::gpu::GpuTable;
use lucerna::layout::trace::{MaterialRecord, Shading};
use lucerna::layout::tree::{Triangle, node_count};
use lucerna::layout::view::ViewMode;
use lucerna::scene;
use lucerna::shader::Library;
use lucerna::stress::tools::tracer::device_fma;
use lucerna::systems::present::view_params;
use lucerna::systems::resources::{Device, SceneGeometry, Shot, texture_set};

use crate::support;
use crate::textures::garden::Garden;

const STEP: Duration = Duration::from_millis(100);
const PIXELS: usize = 48 * 36;

fn open(name: &str, spp: &str) -> Engine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let defines =
        [("film.size", "(48,36)"), ("render.spp", spp)].map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&path, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    Engine::open(support::gpu(), Library::shipped(), &description).unwrap()
}

/// Those that the pass `view` draws.
fn views_of_surfaces() -> impl Iterator<Item = (ViewMode, &'static str)> {
    ViewMode::ALL.into_iter().filter(|(mode, _)| ![ViewMode::Beauty, ViewMode::Debug, ViewMode::Probe].contains(mode))
}

fn picture(engine: &Engine) -> Vec<u32> {
    engine.read(|world| world.resource::<Device>().0.read_some("picture", PIXELS)).unwrap()
}

/// How often `view` and `display` were dispatched so far.
fn counts(engine: &Engine) -> [u64; 2] {
    ["view", "display"].map(|pass| engine.dispatches().get(pass).copied().unwrap_or(0))
}

fn finish(engine: &mut Engine) {
    while !engine.step(STEP).unwrap().finished {}
}

/// The picture that the twin makes of what the device holds, seen from its camera turned by `nudge`, parts of the film's half sides.
fn twin(world: &World, mode: ViewMode, nudge: Vec2) -> Vec<u32> {
    let fma = device_fma(&support::gpu());
    let (geometry, shot) = (world.resource::<SceneGeometry>(), world.resource::<Shot>());
    let device = &world.resource::<Device>().0;
    let materials = world.resource::<GpuTable<MaterialRecord>>().rows();
    let count = world.resource::<GpuTable<Triangle>>().len() as u32;
    let nodes = device.read_some("nodes", node_count(count) as usize).unwrap();
    let tree = Tree { leaves: device.read_some("leaves", count as usize).unwrap(), nodes };
    let shading: Vec<Shading> =
        if geometry.normals { device.read_some("shading", count as usize).unwrap() } else { Vec::new() };
    let textures = texture_set(world);
    let seen = ViewScene { tree: &tree, materials, shading: &shading, textures, fma };
    let mut params = view_params(geometry, shot, mode);
    let camera = &mut params.trace_params;
    camera.forward += nudge.x * camera.right + nudge.y * camera.up;
    seen.view(&params)
}

/// Checks a picture against the twin's: a pixel may be what the twin sees a thousandth of a pixel beside its middle, for a device may round
/// directions otherwise, and a ray at an edge then sees what is beside it.
fn check(engine: &Engine, mode: ViewMode, named: &str) {
    let got = picture(engine);
    let nudge = 1e-3 * 2.0 / 48.0;
    let ways = [Vec2::ZERO, Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y].map(|way| nudge * way);
    let right = ways.map(|way| engine.read(|world| twin(world, mode, way)));
    let near = |a: u32, b: u32| a.to_le_bytes().iter().zip(b.to_le_bytes()).all(|(a, b)| a.abs_diff(b) <= 1);
    let wrong = (0..got.len()).filter(|i| !right.iter().any(|right| near(got[*i], right[*i]))).count();
    assert_eq!(wrong, 0, "{named}: pixels are of nothing that is there");
    let beside = differing(&got, &right[0]);
    assert!(beside <= PIXELS / 50, "{named}: {beside} pixels are of what is beside them");
}

/// How many pixels differ by more than a code in any channel.
fn differing(a: &[u32], b: &[u32]) -> usize {
    let far = |(a, b): (&u32, &u32)| a.to_le_bytes().iter().zip(b.to_le_bytes()).any(|(a, b)| a.abs_diff(b) > 1);
    a.iter().zip(b).filter(|pair| far(*pair)).count()
}

/// Has the camera look from behind and above, where surfaces show their backs, at a crop of a larger film of as many pixels.
fn turn_and_crop(world: &mut World) {
    let mut cameras = world.query::<&mut Camera>();
    for mut camera in cameras.iter_mut(world) {
        let through = camera.look_at - camera.position;
        camera.position = camera.look_at + 0.7 * through + through.length() * DVec3::new(0.7, 0.5, 0.0);
    }
    let min = UVec2::new(7, 5);
    for mut film in world.query::<&mut Film>().iter_mut(world) {
        film.crop = Some(Crop { min, max: min + film.size });
        film.size = UVec2::new(60, 45);
    }
}

#[test]
fn every_view_is_that_of_its_twin() {
    for (name, turned) in [("cornell-box", false), ("cornell-box", true), ("teapot", false)] {
        let mut engine = open(name, "1");
        if turned {
            engine.edit(turn_and_crop);
        }
        for (mode, named) in views_of_surfaces() {
            engine.set_view(mode);
            engine.step(STEP).unwrap();
            let right = engine.read(|world| twin(world, mode, Vec2::ZERO));
            let colours = right.iter().collect::<BTreeSet<_>>().len();
            let of_textures = [ViewMode::Uv, ViewMode::Texel, ViewMode::Level].contains(&mode);
            assert!(colours > 1 || of_textures, "{name}, {turned}, {named}: {colours} colours show little");
            check(&engine, mode, &format!("{name}, {turned}, {named}"));
        }
    }
}

#[test]
fn every_view_of_textures_is_that_of_its_twin() {
    let description = Garden::full(glam::UVec2::new(48, 36)).description;
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    for (mode, named) in views_of_surfaces() {
        engine.set_view(mode);
        engine.step(STEP).unwrap();
        let (got, right) = (picture(&engine), engine.read(|world| twin(world, mode, Vec2::ZERO)));
        let colours = right.iter().collect::<BTreeSet<_>>().len();
        assert!(colours > 3, "{named}: {colours} colours show little");
        // A point that is between two texels, or at the edge of a hole, may be of the other.
        let far = differing(&got, &right);
        assert!(far <= PIXELS / 100, "{named}: {far} pixels differ");
    }
}

#[test]
fn a_view_is_drawn_once_for_what_changed_and_the_film_goes_on() {
    let mut plain = open("cornell-box", "4");
    finish(&mut plain);
    let film = plain.film().unwrap();
    let beauty = picture(&plain);

    let mut engine = open("cornell-box", "4");
    engine.set_live(true);
    engine.set_view(ViewMode::Normal);
    finish(&mut engine);
    assert_eq!(counts(&engine), [1, 0], "one view while the film is traced");
    let normals = picture(&engine);
    assert_eq!(engine.step(STEP).unwrap().dispatches, 0);
    // To read the film is not to show it.
    assert_eq!(engine.film().unwrap(), film);
    assert_eq!(picture(&engine), normals);
    assert_eq!(engine.step(STEP).unwrap().dispatches, 0);

    let [_, displays] = counts(&engine);
    engine.set_view(ViewMode::Albedo);
    assert_eq!(engine.step(STEP).unwrap().dispatches, 1);
    assert_eq!(counts(&engine), [2, displays], "another view");
    engine.set_view(ViewMode::Beauty);
    assert_eq!(engine.step(STEP).unwrap().dispatches, 1, "the film is as it was");
    assert_eq!(counts(&engine), [2, displays + 1]);
    assert_eq!(picture(&engine), beauty);
    assert_eq!(engine.film().unwrap(), film);
}

#[test]
fn a_view_follows_camera_and_materials() {
    let mut engine = open("cornell-box", "1");
    engine.set_view(ViewMode::Albedo);
    finish(&mut engine);
    let first = picture(&engine);
    engine.edit(|world| {
        let mut materials = world.query::<&mut Material>();
        materials.iter_mut(world).for_each(|mut material| material.diffuse *= 0.5);
    });
    finish(&mut engine);
    let darker = picture(&engine);
    assert!(counts(&engine)[0] == 2 && differing(&first, &darker) > PIXELS / 4);
    engine.edit(|world| {
        let mut cameras = world.query::<&mut Camera>();
        cameras.iter_mut(world).for_each(|mut camera| camera.fov_y *= 0.5);
    });
    finish(&mut engine);
    assert_eq!(counts(&engine), [3, 0]);
    let right = engine.read(|world| twin(world, ViewMode::Albedo, Vec2::ZERO));
    assert!(differing(&picture(&engine), &right) <= PIXELS / 400 && differing(&darker, &right) > 0);
}
