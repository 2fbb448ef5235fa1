//! The passes of adaptive films against their twins.

use glam::{UVec2, Vec3};
use lucerna::cpu::allocation::Grid;
use lucerna::cpu::film::accumulate_tiles;
use lucerna::cpu::tally::tally;
use lucerna::gpu::Runtime;
use lucerna::layout::adaptive::{PixelMark, TILE_LANES, TallyParams, TallyRun, TileRun, TileSample, TileTally};
use lucerna::layout::film::{AccumulateParams, FilmCounters, FilmPixel};
use lucerna::layout::trace::{BAD_NAN, RadianceSample, SAMPLE_BAD, TraceParams};
use lucerna::passes::film::ACCUMULATE;
use lucerna::passes::trace::{GATHER, PATH};
use lucerna::passes::{Recording, adaptive, film};
use lucerna::shader::{Features, Library, Linked};

use crate::support;
use crate::support::dice::Dice;

const EXPONENT: i32 = 40;

/// A window that cuts tiles at all of its sides.
fn window() -> TraceParams {
    TraceParams {
        film_width: 70,
        film_height: 50,
        window_x: 5,
        window_y: 11,
        window_width: 43,
        window_height: 26,
        ..TraceParams::default()
    }
}

fn grid(params: &TraceParams) -> Grid {
    Grid::of(UVec2::new(params.window_x, params.window_y), UVec2::new(params.window_width, params.window_height))
}

/// A device with an empty film of the window.
fn rig(params: &TraceParams) -> Runtime {
    let mut rig = support::rig();
    rig.set_features(&["adaptive"]);
    let pixels = params.window_width * params.window_height;
    for (name, bytes) in film::buffers(pixels.into()).into_iter().chain(adaptive::buffers(pixels.into())) {
        rig.reserve(name, bytes).unwrap();
    }
    let mut recording = Recording::default();
    film::record_reset(&mut recording, pixels);
    adaptive::record_reset(&mut recording, pixels);
    rig.play(&recording).unwrap();
    rig
}

/// A batch of some samples of every second tile, and what they are.
fn batch(params: &TraceParams, first: u32, dice: &mut Dice) -> (Vec<TileSample>, Vec<TileRun>, Vec<RadianceSample>) {
    let grid = grid(params);
    let (mut samples, mut runs) = (Vec::new(), Vec::new());
    for tile in (0..grid.len()).step_by(2) {
        let counts = [0, 1].map(|half| (tile as u32 + half) % 4);
        let tile = grid.packed(tile);
        runs.push(TileRun { tile, first: samples.len() as u32, counts });
        for half in 0..2 {
            let numbers = (0..counts[half as usize]).map(|i| TileSample { tile, sample: first + 2 * i + half });
            samples.extend(numbers);
        }
    }
    let mut arrive = |_| {
        let value = |dice: &mut Dice| (dice.unit() * 20.0 - 15.0).exp2() as f32;
        let rgb = Vec3::new(value(dice), value(dice), value(dice));
        let info = 1 + (dice.unit() * 9.0) as u32;
        match dice.unit() < 0.02 {
            true => RadianceSample { rgb: Vec3::new(BAD_NAN as f32, 3.0, 5.0), info: info | SAMPLE_BAD },
            false => RadianceSample { rgb, info },
        }
    };
    let radiance = (0..samples.len() as u32 * TILE_LANES).map(&mut arrive).collect();
    (samples, runs, radiance)
}

#[test]
fn tiles_are_added_and_tallied_as_by_the_twins() {
    let params = window();
    let mut rig = rig(&params);
    let mut dice = Dice(9);
    let pixels = (params.window_width * params.window_height) as usize;
    let (mut twin, mut marks) = (vec![FilmPixel::default(); pixels], vec![PixelMark::default(); pixels]);
    let (mut rays, mut bad) = (0, 0);
    for round in 0..3 {
        let (samples, runs, radiance) = batch(&params, 8 * round, &mut dice);
        let adding = film::accumulate_params(&params, EXPONENT, &params);
        let adding = AccumulateParams { runs: runs.len() as u32, ..adding };
        let counted = accumulate_tiles(&mut twin, &radiance, (&samples, &runs), &adding);
        (rays, bad) = (rays + counted.rays, bad + counted.bad.len());
        let grid = grid(&params);
        let halves = (0..grid.len()).flat_map(|tile| [0, 1].map(|half| (tile, half)));
        let tally_runs: Vec<TallyRun> = halves.map(|(tile, half)| TallyRun { tile: grid.packed(tile), half }).collect();
        let tallying = TallyParams {
            window_x: params.window_x,
            window_y: params.window_y,
            window_width: params.window_width,
            window_height: params.window_height,
            runs: tally_runs.len() as u32,
            scale: 2f32.powi(-EXPONENT),
        };
        for (name, bytes) in adaptive::tally_buffers(tally_runs.len() as u64) {
            rig.reserve(name, bytes).unwrap();
        }
        rig.upload("tile_samples", &samples).unwrap();
        rig.upload("tile_runs", &runs).unwrap();
        rig.upload("radiance", &radiance).unwrap();
        rig.upload("tally_runs", &tally_runs).unwrap();
        let mut recording = Recording::default();
        adaptive::record_accumulate(&mut recording, &adding);
        adaptive::record_tally(&mut recording, &tallying);
        rig.play(&recording).unwrap();
        assert!(rig.read_some::<FilmPixel>("film", pixels).unwrap() == twin, "round {round}");
        let counters: FilmCounters = rig.read_one("counters", 0).unwrap();
        assert_eq!((u64::from(counters.rays_lo.0), counters.bad.0 as usize), (rays, bad), "round {round}");
        let held: Vec<PixelMark> = rig.read_some("marks", pixels).unwrap();
        for (mark, held) in marks.iter_mut().zip(&held) {
            (0..2).for_each(|half| mark.halves[half].rays = held.halves[half].rays);
        }
        let of_all: u64 = held.iter().flat_map(|mark| mark.halves.map(|half| u64::from(half.rays))).sum();
        assert_eq!(of_all, rays, "every ray is some pixel's");
        let right = tally(&twin, &mut marks, &tally_runs, &tallying);
        let got: Vec<TileTally> = rig.read_some("tallies", tally_runs.len()).unwrap();
        for (got, right) in got.iter().zip(&right) {
            assert_eq!((got.pixels, got.rays), (right.pixels, right.rays), "round {round}");
            // Sums of 64 in single precision.
            let near = |got: f32, right: f32| (got - right).abs() <= 1e-5 * right;
            let means = (got.mean - right.mean).abs().max_element() <= 1e-5 * right.mean.max_element();
            assert!(means && near(got.error, right.error), "{got:?} {right:?}");
        }
        let all: f32 = right.iter().map(|tally| tally.pixels).sum();
        assert_eq!(all, 2.0 * pixels as f32);
    }
    assert!(bad > 20, "{bad}");
}

#[test]
fn where_films_are_not_adaptive_the_kernels_have_nothing_of_it() {
    let library = Library::shipped();
    for pass in [&PATH, &GATHER, &ACCUMULATE] {
        let [without, with] = ["reuse", "adaptive"].map(|feature| {
            let features: Features = [feature.to_owned()].into();
            library.link(pass.module, &features).unwrap()
        });
        let of_it = |linked: &Linked| {
            let names = linked.module.global_variables.iter().filter_map(|(_, variable)| variable.name.clone());
            names.filter(|name| ["tile_samples", "tile_runs", "marks"].contains(&name.as_str())).count()
        };
        assert!(of_it(&without) == 0 && of_it(&with) > 0, "{}", pass.name);
        let imports = |linked: &Linked| linked.imports.contains("lib/tiles");
        assert!(!imports(&without) && imports(&with), "{}", pass.name);
    }
}
