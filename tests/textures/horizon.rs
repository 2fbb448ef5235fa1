//! A checker board to the horizon, where a footprint is many times as long as wide: what filtering spares, and that it tells no lies.

use std::time::Duration;

use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3};
use lucerna::components::{Camera, Lobe, Material, Passage, Reading, Render, Sampler, Texture, TextureFilter};
use lucerna::engine::Engine;
use lucerna::shader::Library;

use super::board::{Scene, Textures, quad};
use super::garden::picture;
use crate::support;

const SIZE: UVec2 = UVec2::new(64, 48);
/// Pixels a side of the blocks whose means are compared.
const BLOCK: usize = 16;

/// How the board is seen.
#[derive(Clone, Copy, Debug)]
enum Sight {
    Direct,
    InMirror,
    ThroughGlass,
}

fn scene(sight: Sight) -> Scene {
    let render = Render { max_depth: 6, roulette: false, sampler: Sampler::Sobol, ..Render::default() };
    let mut scene = Scene::new(SIZE.x, render);
    scene.description.film.size = SIZE;
    scene.description.environment = Some(lucerna::components::Environment::Constant(Vec3::ONE));
    let aims = match sight {
        Sight::Direct => DVec3::new(0.0, 1.1, -4.0),
        Sight::InMirror => DVec3::new(0.0, 1.3, -6.0),
        Sight::ThroughGlass => DVec3::new(0.6, 1.1, -4.0),
    };
    let camera = Camera { position: 1.5 * DVec3::Y, look_at: aims, up: DVec3::Y, fov_y: 50.0, ..Camera::default() };
    scene.description.cameras.values_mut().for_each(|held| *held = camera);
    let checker = picture(UVec2::splat(128), |x, y| match (x / 64 + y / 64) % 2 {
        0 => [235, 235, 225, 255],
        _ => [40, 60, 150, 255],
    });
    let board =
        quad(Vec3::new(-800.0, 0.0, 800.0), 1600.0 * Vec3::X, -1600.0 * Vec3::Z, [Vec2::ZERO, Vec2::splat(800.0)]);
    let maps = Textures { diffuse: Some(Texture::new(checker, Reading::Colour)), ..Textures::default() };
    scene.part("board", board, DAffine3::IDENTITY, Material { diffuse: Vec3::ONE, ..Material::BLACK }, maps);
    let mut part = |name: &str, corner: Vec3, e: Vec3, f: Vec3, material: Material| {
        let wall = quad(corner, e, f, [Vec2::ZERO, Vec2::ONE]);
        scene.part(name, wall, DAffine3::IDENTITY, material, Textures::default());
    };
    match sight {
        Sight::Direct => {}
        Sight::InMirror => {
            let mirror = Material { specular: Vec3::splat(0.9), lobe: Lobe::Mirror, ..Material::BLACK };
            part("mirror", Vec3::new(-12.0, 0.01, -6.0), 24.0 * Vec3::X, 8.0 * Vec3::Y, mirror);
        }
        Sight::ThroughGlass => {
            let glass = Material { passage: Passage::Glass(1.5), filter: Vec3::ONE, ..Material::BLACK };
            // A pane whose edges are not seen.
            part("front", Vec3::new(-40.0, -1.0, -1.2), 80.0 * Vec3::X, 40.0 * Vec3::Y, glass);
            part("back", Vec3::new(40.0, -1.0, -2.0), -80.0 * Vec3::X, 40.0 * Vec3::Y, glass);
        }
    }
    scene
}

fn film(scene: &Scene, filter: TextureFilter, spp: u32, seed: u32) -> Vec<[f32; 3]> {
    let mut description = scene.description.clone();
    description.render = Render { texture_filter: filter, spp, seed, ..description.render };
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    engine.edit(|world| scene.dress(world));
    while !engine.step(Duration::from_millis(200)).unwrap().finished {}
    assert!(engine.features().contains("textures"));
    engine.film().unwrap().rgb
}

/// Mean of squared differences, as parts of what is right.
fn relmse(film: &[[f32; 3]], right: &[[f32; 3]]) -> f64 {
    let values = film.iter().flatten().zip(right.iter().flatten()).map(|(a, b)| (f64::from(*a), f64::from(*b)));
    values.map(|(a, b)| (a - b).powi(2) / (b * b + 1e-2)).sum::<f64>() / (3 * film.len()) as f64
}

/// The greatest difference of the means of blocks, as part of what is right.
fn worst_block(film: &[[f32; 3]], right: &[[f32; 3]]) -> f64 {
    let width = SIZE.x as usize;
    let mean = |film: &[[f32; 3]], x: usize, y: usize, channel: usize| {
        let pixels = (0..BLOCK * BLOCK).map(|i| (y * BLOCK + i / BLOCK) * width + x * BLOCK + i % BLOCK);
        pixels.map(|pixel| f64::from(film[pixel][channel])).sum::<f64>()
    };
    let blocks = (0..SIZE.y as usize / BLOCK).flat_map(|y| (0..width / BLOCK).map(move |x| (x, y)));
    let places = blocks.flat_map(|(x, y)| (0..3).map(move |channel| (x, y, channel)));
    places.map(|(x, y, c)| (mean(film, x, y, c) / mean(right, x, y, c) - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn footprints_spare_samples_and_keep_means() {
    let spp = if support::stress() { 4096 } else { 1024 };
    for sight in [Sight::Direct, Sight::InMirror, Sight::ThroughGlass] {
        let scene = scene(sight);
        let right = film(&scene, TextureFilter::Exact, spp, 1);
        let exact = relmse(&film(&scene, TextureFilter::Exact, 16, 2), &right);
        let footprint = relmse(&film(&scene, TextureFilter::Footprint, 16, 2), &right);
        let bias = worst_block(&film(&scene, TextureFilter::Footprint, spp, 3), &right);
        println!(
            "{sight:?}: at 16 spp {footprint:.2e}, exact {exact:.2e}; blocks differ by {:.3} % at most",
            100.0 * bias
        );
        assert!(footprint < 0.95 * exact, "{sight:?}: {footprint} with footprints, {exact} without");
        assert!(bias < 5e-3, "{sight:?}: a block differs by {} %", 100.0 * bias);
    }
}
