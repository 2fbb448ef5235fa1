//! A robust mean beside the film's: the numbers that it is made of, what is made of them, and that the film has nothing of it.

use std::path::Path;
use std::time::Duration;

use glam::{UVec2, Vec3};
use lucerna::cpu::film::fixed_point;
use lucerna::cpu::robust::{add_blocks, robust_film, robust_mean, set_block};
use lucerna::engine::RobustFilm;
use lucerna::gpu::Runtime;
use lucerna::layout::film::{FilmHalf, ROBUST_BLOCKS, RobustPixel};
use lucerna::layout::trace::{RadianceSample, SAMPLE_BAD, TraceParams, luminance};
use lucerna::passes::{Recording, blocks, film};
use lucerna::scene;
use lucerna::shader::Library;
use lucerna::{Engine, FilmImage};

use crate::support;
use crate::support::dice::Dice;
use crate::support::plant::planted;

const SIZE: UVec2 = UVec2::new(9, 7);
const EXPONENT: i32 = 30;
const BLOCKS: usize = ROBUST_BLOCKS as usize;

fn params(first_sample: u32, layers: u32) -> TraceParams {
    let size = SIZE;
    TraceParams {
        film_width: 20,
        window_x: 3,
        window_y: 2,
        window_width: size.x,
        window_height: size.y,
        first_sample,
        layers,
        ..TraceParams::default()
    }
}

/// Samples of some layers, a few of them bad, and some as bright as others.
fn samples(layers: u32) -> Vec<RadianceSample> {
    let mut dice = Dice(3);
    let mut sample = || {
        let rgb = Vec3::splat((8.0 * dice.unit()).floor() as f32 * 0.3);
        let info = if dice.unit() < 0.05 { SAMPLE_BAD } else { 1 };
        RadianceSample { rgb: if dice.unit() < 0.03 { Vec3::NAN } else { rgb }, info }
    };
    (0..layers * SIZE.x * SIZE.y).map(|_| sample()).collect()
}

/// The blocks of the samples, which come in batches of so many layers.
fn traced(library: Library, all: &[RadianceSample], cuts: &[u32]) -> Vec<RobustPixel> {
    let mut rig = Runtime::new(support::gpu(), library);
    let pixels = SIZE.x * SIZE.y;
    for (name, bytes) in blocks::buffers(pixels.into()) {
        rig.reserve(name, bytes).unwrap();
    }
    let mut first = 0;
    for (batch, layers) in cuts.iter().enumerate() {
        let own = &all[(first * pixels) as usize..((first + layers) * pixels) as usize];
        rig.upload("radiance", own).unwrap();
        let mut recording = Recording::default();
        if batch == 0 {
            blocks::record_reset(&mut recording, pixels);
        }
        let params = params(first, *layers);
        blocks::record(&mut recording, &film::accumulate_params(&params, EXPONENT, &params));
        rig.play(&recording).unwrap();
        first += layers;
    }
    rig.read_some("blocks", pixels as usize).unwrap()
}

fn twin(all: &[RadianceSample], layers: u32) -> Vec<RobustPixel> {
    let mut blocks = vec![RobustPixel::default(); (SIZE.x * SIZE.y) as usize];
    let params = params(0, layers);
    add_blocks(&mut blocks, all, &film::accumulate_params(&params, EXPONENT, &params));
    blocks
}

#[test]
fn blocks_are_the_twins_however_the_samples_are_cut() {
    let all = samples(40);
    let right = twin(&all, 40);
    let cuts: [&[u32]; 3] = [&[40], &[1, 16, 7, 16], &[1; 40]];
    for cut in cuts {
        assert_eq!(traced(Library::shipped(), &all, cut), right, "{cut:?}");
    }
    assert!(right.iter().all(|pixel| pixel.brightest > 0.0 && pixel.counts.iter().all(|count| *count <= 3)));
    for (right_text, wrong) in [
        ("sample % ROBUST_BLOCKS", "layer % ROBUST_BLOCKS"),
        ("bright > blocks", "bright >= blocks"),
        ("if ((arrived.info & SAMPLE_BAD) != 0u)", "if (false)"),
    ] {
        let library = planted("passes/film/blocks", right_text, wrong);
        assert_ne!(traced(library, &all, cuts[1]), right, "{wrong} went unnoticed");
    }
}

/// A pixel whose blocks have such means, red alone, of four samples each.
fn pixel_of(means: &[f64]) -> RobustPixel {
    let mut pixel = RobustPixel::default();
    for (number, mean) in means.iter().enumerate() {
        let sum = 4 * fixed_point(*mean as f32, EXPONENT).unwrap();
        let red = UVec2::new(sum as u32, (sum >> 32) as u32);
        set_block(&mut pixel, number, &FilmHalf { sum: [red, UVec2::ZERO, UVec2::ZERO], count: 4, bad: 0 });
    }
    pixel
}

/// The robust mean by its definition: Gini's coefficient as half the mean difference of all pairs, by the mean.
fn by_definition(means: &[f64]) -> f64 {
    let n = means.len() as f64;
    let sum: f64 = means.iter().sum();
    let pairs: f64 = means.iter().flat_map(|a| means.iter().map(move |b| (a - b).abs())).sum();
    let gini = if sum > 0.0 { pairs / (2.0 * n * sum) } else { 0.0 };
    let mut sorted = means.to_vec();
    sorted.sort_by(f64::total_cmp);
    let trimmed = ((gini * n / 2.0 + 1e-9).floor() as usize).min((means.len() - 1) / 2);
    let kept = &sorted[trimmed..means.len() - trimmed];
    kept.iter().sum::<f64>() / kept.len() as f64
}

#[test]
fn planted_fireflies_are_left_out_as_the_definition_says() {
    let mut dice = Dice(11);
    for flies in [0, 1, 3, 6] {
        for spread in [0.0, 0.1, 0.5] {
            let mut means: Vec<f64> = (0..BLOCKS).map(|_| 1.0 + spread * (dice.unit() - 0.5)).collect();
            means.iter_mut().take(flies).for_each(|mean| *mean += 200.0);
            let found = robust_mean(&pixel_of(&means), EXPONENT).unwrap();
            let right = by_definition(&means);
            assert!((found.robust[0] - right).abs() < 1e-5, "{flies}, {spread}: {found:?} {right}");
            assert!((found.plain[0] - means.iter().sum::<f64>() / BLOCKS as f64).abs() < 1e-5);
            assert_eq!(found.parts, flies > 0, "{flies}, {spread}: {found:?}");
            // As many as Gini's coefficient of so many has left out at the bright end.
            if (1..=3).contains(&flies) {
                assert!((found.robust[0] - 1.0).abs() < 0.5, "{flies} fireflies are left out: {found:?}");
            }
        }
    }
    // Few blocks say nothing of each other, and none nothing at all.
    let few = robust_mean(&pixel_of(&[1.0, 1.0, 90.0]), EXPONENT).unwrap();
    assert!(few.robust == few.plain && !few.parts);
    assert_eq!(robust_mean(&RobustPixel::default(), EXPONENT), None);
}

#[test]
fn a_film_names_its_worst_pixels() {
    let steady: Vec<f64> = (0..BLOCKS).map(|block| 1.0 + 0.01 * block as f64).collect();
    let mut pixels = vec![pixel_of(&steady); 200];
    for (index, bright) in [(7, 30.0), (90, 900.0), (150, 9.0)] {
        let mut means = steady.clone();
        means[4] = bright;
        pixels[index] = RobustPixel { brightest: bright as f32, sample: 20, ..pixel_of(&means) };
    }
    pixels[3] = RobustPixel::default();
    let film = robust_film(&pixels, EXPONENT);
    assert_eq!(film.worst.iter().map(|worst| worst.index).collect::<Vec<_>>(), [90, 7, 150]);
    assert_eq!((film.worst[0].brightest, film.worst[0].sample), (900.0, 20));
    assert!((film.parted - 3.0 / 199.0).abs() < 1e-12 && film.parts.iter().filter(|parts| **parts).count() == 3);
    assert!(film.plain > film.robust && film.rgb[3] == [0.0; 3]);
}

const STEP: Duration = Duration::from_secs(5);

fn open(name: &str, spp: &str) -> Engine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron");
    let defines =
        [("film.size", "(48, 32)"), ("render.spp", spp)].map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&path, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
    Engine::open(support::gpu(), Library::shipped(), &description).unwrap()
}

fn finish(engine: &mut Engine, step: Duration) -> (FilmImage, Option<RobustFilm>) {
    while !engine.step(step).unwrap().finished {}
    (engine.film().unwrap(), engine.robust_film().unwrap())
}

#[test]
fn the_film_is_the_same_with_and_without() {
    for name in ["cornell-box", "glass"] {
        let mut engine = open(name, "32");
        let (without, none) = finish(&mut engine, STEP);
        assert!(none.is_none() && !engine.dispatches().contains_key(blocks::BLOCKS.name));
        engine.set_robust(true);
        let (with, robust) = finish(&mut engine, STEP);
        assert_eq!(with.pixels, without.pixels, "{name}");
        assert!(engine.dispatches()[blocks::BLOCKS.name] > 0);
        let mut cut = open(name, "32");
        cut.set_robust(true);
        // A row at a time, once the governor has learnt what a row takes.
        assert_eq!(finish(&mut cut, Duration::from_nanos(1)), (with, robust), "{name}: however it was cut");
        engine.set_robust(false);
        assert!(finish(&mut engine, STEP).1.is_none());
    }
}

#[test]
fn on_a_clean_scene_both_means_agree() {
    let (film, robust) = {
        let mut engine = open("teapot-daylight", "256");
        engine.set_robust(true);
        finish(&mut engine, STEP)
    };
    let robust = robust.unwrap();
    let mean: f64 =
        film.rgb.iter().map(|rgb| f64::from(luminance(Vec3::from_array(*rgb)))).sum::<f64>() / film.rgb.len() as f64;
    assert!((robust.plain / mean - 1.0).abs() < 1e-5, "the plain mean is the film's: {} {mean}", robust.plain);
    assert!((robust.robust / mean - 1.0).abs() < 0.02, "{} {mean}", robust.robust);
    assert!(robust.parted < 0.02, "{}", robust.parted);
}

#[test]
fn the_brightest_sample_of_the_worst_pixel_can_be_replayed() {
    let mut engine = open("cornell-box-original", "64");
    engine.set_robust(true);
    let robust = finish(&mut engine, STEP).1.unwrap();
    assert!(!robust.worst.is_empty() && robust.robust < robust.plain, "{} {}", robust.robust, robust.plain);
    for worst in &robust.worst {
        let pixel = UVec2::new(worst.index as u32 % 48, worst.index as u32 / 48);
        let replay = engine.replay(pixel, worst.sample).unwrap().unwrap();
        assert_eq!(luminance(replay.film.rgb), worst.brightest, "{worst:?}");
    }
}
