//! Textures in the engine against the oracle, by means over blocks of pixels.

use std::time::{Duration, Instant};

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use lucerna::components::{Integrator, Reading, Render, Texels, Texture, TextureFilter};
use lucerna::oracle::Oracle;
use lucerna::shader::Library;
use lucerna::{Engine, scene};

use super::board::{COLUMNS, Scene, wall};
use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;

/// The means of a batch over the blocks of a picture.
type Blocks = Vec<DVec3>;

fn blocks(side: u32, a_side: usize, pixels: impl Iterator<Item = DVec3>) -> Blocks {
    let pixels_a_block = side as usize / a_side;
    let mut sums = vec![DVec3::ZERO; a_side * a_side];
    for (i, pixel) in pixels.enumerate() {
        let (x, y) = (i % side as usize / pixels_a_block, i / side as usize / pixels_a_block);
        sums[y * a_side + x] += pixel / (pixels_a_block * pixels_a_block) as f64;
    }
    sums
}

/// The batches of the oracle.
fn right(scene: &Scene, a_side: usize, spp: u32) -> Vec<Blocks> {
    let mut world = World::new();
    scene::apply(&mut world, &scene.description);
    scene.dress(&mut world);
    let oracle = Oracle::new(&mut world).unwrap();
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let picture = |i: u32| oracle.render(i * spp..(i + 1) * spp, 1, threads, &|_, _| ()).mean;
    (0..BATCHES as u32).map(|i| blocks(scene.description.film.size.x, a_side, picture(i).into_iter())).collect()
}

/// The batches of the engine, which has the scene's description, with its textures.
fn ours(engine: &mut Engine, scene: &Scene, a_side: usize, spp: u32) -> Vec<Blocks> {
    engine.edit(|world| scene.dress(world));
    let batch = |seed: u32| {
        engine.edit(|world| {
            world.query::<&mut Render>().iter_mut(world).for_each(|mut render| (render.seed, render.spp) = (seed, spp));
        });
        while !engine.step(Duration::from_millis(100)).unwrap().finished {}
        let film = engine.film().unwrap();
        blocks(scene.description.film.size.x, a_side, film.rgb.iter().map(|p| Vec3::from(*p).as_dvec3()))
    };
    (0..BATCHES as u32).map(batch).collect()
}

/// What is wrong with each block and channel.
fn differences(ours: &[Blocks], right: &[Blocks]) -> Vec<String> {
    let mut wrong = Vec::new();
    for block in 0..right[0].len() {
        for c in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| ours[i][block][c] - right[i][block][c]),
                mean: right.iter().map(|batch| batch[block][c]).sum::<f64>() / BATCHES as f64,
            };
            wrong.extend(agree(&pairs).err().map(|why| format!("block {block}, channel {c}: {why}")));
        }
    }
    wrong
}

fn render(integrator: Integrator) -> Render {
    Render { integrator, max_depth: 3, texture_filter: TextureFilter::Exact, ..Render::default() }
}

/// The scene with each of its textures changed.
fn with(scene: &Scene, change: impl Fn(&mut Texture)) -> Scene {
    let mut scene = scene.clone();
    scene.maps.iter_mut().flat_map(|(_, maps)| maps.each()).for_each(change);
    scene
}

/// The codes of sRGB taken as if they were proportional.
fn as_linear(texture: &mut Texture) {
    if let (Reading::Colour, Texels::Rgba8(codes)) = (texture.reading, &texture.image.texels) {
        let texels = Texels::Float(codes.iter().map(|code| code.map(|c| f32::from(c) / 255.0)).collect());
        texture.image = std::sync::Arc::new(lucerna::components::TextureImage { texels, ..*texture.image });
    }
}

#[test]
fn each_map_equals_the_oracle() {
    let spp = if support::stress() { 8192 } else { 2048 };
    let start = Instant::now();
    let scene = wall(render(Integrator::Path));
    let rights = right(&scene, COLUMNS, spp);
    println!("oracle {:?}", start.elapsed());
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, COLUMNS, spp);
    println!("engine {:?}", start.elapsed());
    let wrong = differences(&films, &rights);
    println!("{wrong:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}
