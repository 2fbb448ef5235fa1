//! Textures in the engine against the oracle, by means over blocks of pixels.

use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use lucerna::components::{Integrator, Reading, Render, Texels, Texture, TextureFilter, TextureImage};
use lucerna::image::srgb::srgb_decode;
use lucerna::oracle::Oracle;
use lucerna::shader::Library;
use lucerna::{Engine, scene};

use super::board::{COLUMNS, Scene, ball, glass_ball, grille, skylight, wall};
use super::leaves::{self, leaves};
use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;
use crate::support::plant::planted;

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
        texture.image = Arc::new(TextureImage { size: texture.image.size, texels });
    }
}

/// Colours as pictures of more than eight bits hold them: their light itself, which the device keeps as f16.
fn as_light(texture: &mut Texture) {
    if let (Reading::Colour, Texels::Rgba8(codes)) = (texture.reading, &texture.image.texels) {
        let light = |[r, g, b, a]: &[u8; 4]| {
            let [r, g, b] = [r, g, b].map(|code| srgb_decode(f64::from(*code) / 255.0) as f32);
            [r, g, b, f32::from(*a) / 255.0]
        };
        let texels = Texels::Float(codes.iter().map(light).collect());
        texture.image = Arc::new(TextureImage { size: texture.image.size, texels });
    }
}

/// How many blocks differ, by what is wrong.
fn differing(wrong: &[String], name: &str) -> usize {
    let mut blocks: Vec<&str> =
        wrong.iter().filter(|why| why.contains("differ")).filter_map(|why| why.split(',').next()).collect();
    blocks.dedup();
    println!("{name}: {} blocks differ: {blocks:?}", blocks.len());
    blocks.len()
}

/// In how many blocks an error in brightness by so much is seen.
fn seeing(factor: f64, films: &[Blocks], rights: &[Blocks], name: &str) -> usize {
    let brighter: Vec<Blocks> = films.iter().map(|film| film.iter().map(|block| factor * block).collect()).collect();
    differing(&differences(&brighter, rights), &format!("{name}, times {factor}"))
}

/// One block, the whole picture.
fn whole(batches: &[Blocks]) -> Vec<Blocks> {
    batches.iter().map(|blocks| vec![blocks.iter().sum::<DVec3>() / blocks.len() as f64]).collect()
}

/// The batches of a scene that the engine renders by the BSDF alone.
fn by_bsdf(scene: &Scene, a_side: usize, spp: u32) -> Vec<Blocks> {
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    ours(&mut engine, scene, a_side, spp)
}

#[test]
fn each_map_equals_the_oracle() {
    let spp = if support::stress() { 16_384 } else { 2048 };
    let scene = wall(render(Integrator::Path));
    let rights = right(&scene, COLUMNS, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, COLUMNS, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seeing(1.01, &films, &rights, "the wall"), COLUMNS * COLUMNS);
    let wrong = differences(&ours(&mut engine, &with(&scene, as_light), COLUMNS, spp), &rights);
    assert!(wrong.is_empty(), "as light, in f16: {wrong:#?}");
    // What is planted is far more than a percent: fewer samples show it. One patch has a picture of one texel, four have no colour.
    let half_a_texel = |texture: &mut Texture| texture.offset += 0.5 / texture.image.size.as_vec2();
    let upside_down = |texture: &mut Texture| {
        (texture.scale.y, texture.offset.y) = (-texture.scale.y, 1.0 - texture.offset.y);
    };
    let planted: [(&str, Scene, usize); 3] = [
        ("half a texel", with(&scene, half_a_texel), 9),
        ("v upside down", with(&scene, upside_down), 9),
        ("sRGB as linear", with(&scene, as_linear), 7),
    ];
    for (name, changed, least) in planted {
        let films = ours(&mut engine, &changed, COLUMNS, spp / 4);
        assert!(differing(&differences(&films, &rights), name) >= least, "{name} went unnoticed");
    }
    if support::stress() {
        let wrong = differences(&by_bsdf(&wall(render(Integrator::Bsdf)), COLUMNS, spp), &rights);
        assert!(wrong.is_empty(), "by the BSDF alone: {wrong:#?}");
    }
}

#[test]
fn holes_and_mapped_lamps_equal_the_oracle() {
    let spp = if support::stress() { 16_384 } else { 4096 };
    let scene = leaves(render(Integrator::Path));
    let rights = right(&scene, leaves::COLUMNS, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, leaves::COLUMNS, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    // Behind ten layers, or a coloured sheet, the noise of few samples may hide a percent, and three are seen.
    let (all, hidden) = (leaves::COLUMNS * leaves::COLUMNS, if support::stress() { 1 } else { 2 });
    assert!(seeing(1.01, &films, &rights, "leaves") >= all - hidden);
    assert_eq!(seeing(1.03, &films, &rights, "leaves"), all);
    // Light that is found by chance is noisy: without many samples, a percent shows in the whole picture alone.
    let films = by_bsdf(&leaves(render(Integrator::Bsdf)), leaves::COLUMNS, spp);
    let (films, rights) = if support::stress() { (films, rights) } else { (whole(&films), whole(&rights)) };
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "by the BSDF alone: {wrong:#?}");
    assert!(seeing(1.01, &films, &rights, "leaves by the BSDF alone") > 0);
}

#[test]
fn relief_on_glass_equals_the_oracle() {
    let spp = if support::stress() { 16_384 } else { 2048 };
    let scene = glass_ball(Render { max_depth: 6, ..render(Integrator::Path) });
    let rights = right(&scene, 2, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, 2, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seeing(1.01, &films, &rights, "the ball of glass"), 4);
    let films = ours(&mut engine, &with(&scene, inside_out), 2, spp);
    assert!(differing(&differences(&films, &rights), "inside out") > 0, "heights inside out went unnoticed");
}

#[test]
fn a_lamp_with_holes_equals_the_oracle() {
    let spp = if support::stress() { 16_384 } else { 2048 };
    let scene = grille(render(Integrator::Path));
    let rights = right(&scene, 2, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, 2, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seeing(1.01, &films, &rights, "the wall under a lamp with holes"), 4);
}

#[test]
fn panes_with_and_without_relief_equal_the_oracle() {
    let spp = if support::stress() { 16_384 } else { 2048 };
    let scene = skylight(Render { max_depth: 4, ..render(Integrator::Path) });
    let rights = right(&scene, 2, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, 2, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seeing(1.01, &films, &rights, "the wall under panes"), 4);
    // Sampled straight through a pane of relief, light is that of a plain one.
    let library = planted("passes/trace/shadow", "passes = passes && !bent;", "passes = passes || bent;");
    let mut engine = Engine::open(support::gpu(), library, &scene.description).unwrap();
    let films = ours(&mut engine, &scene, 2, spp);
    assert!(differing(&differences(&films, &rights), "straight through relief") > 0, "it went unnoticed");
}

/// Valleys for hills.
fn inside_out(texture: &mut Texture) {
    if let Reading::Height { depth, .. } = &mut texture.reading {
        *depth = -*depth;
    }
}

#[test]
fn relief_on_a_smooth_ball_equals_the_oracle() {
    let spp = if support::stress() { 8192 } else { 1024 };
    let scene = ball(render(Integrator::Path));
    let rights = right(&scene, 2, spp);
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &scene.description).unwrap();
    let films = ours(&mut engine, &scene, 2, spp);
    let wrong = differences(&films, &rights);
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(seeing(1.01, &films, &rights, "the ball"), 4);
    let films = ours(&mut engine, &with(&scene, inside_out), 2, spp);
    assert!(differing(&differences(&films, &rights), "inside out") > 0, "heights inside out went unnoticed");
}
