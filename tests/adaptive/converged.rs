//! Tiles that have enough are in no dispatch, and a film that has is none.

use std::collections::BTreeMap;
use std::time::Duration;

use glam::UVec2;
use lucerna::Engine;
use lucerna::components::{Adaptive, Render};
use lucerna::cpu::allocation::Grid;
use lucerna::layout::adaptive::{TileTally, pack_tile};
use lucerna::layout::film::FilmPixel;
use lucerna::scene::SceneDescription;
use lucerna::stress::scenes::uneven::half_hard;
use lucerna::systems::resources::{PILOT_SPP, Tiles};

use super::{LONG, finish, open, trace};

/// A step of the smallest batch, once the governor has learnt what one takes: one sample of one tile.
const SHORT: Duration = Duration::from_nanos(1);

const SIDE: u32 = 48;

fn half_hard_engine(spp: u32) -> Engine {
    let description = half_hard(UVec2::splat(SIDE));
    let render = Render { adaptive: Adaptive::On, spp, ..description.render };
    open(&SceneDescription { render, ..description })
}

/// Samples that each tile of a film has, by its name in kernels.
fn counts(film: &[FilmPixel]) -> BTreeMap<u32, u32> {
    let tiles = (0..SIDE / 8).flat_map(|y| (0..SIDE / 8).map(move |x| UVec2::new(x, y)));
    let first = |tile: UVec2| &film[(8 * (tile.y * SIDE + tile.x)) as usize];
    let samples = |pixel: &FilmPixel| pixel.halves.iter().map(|half| half.count + half.bad).sum();
    tiles.map(|tile| (pack_tile(tile), samples(first(tile)))).collect()
}

fn ran(engine: &Engine, pass: &str) -> u64 {
    engine.dispatches().get(pass).copied().unwrap_or(0)
}

/// Batch by batch: the dispatches of a film are those of the tiles that it is dealt to, and no other's.
#[test]
fn a_tile_that_has_enough_is_in_no_dispatch() {
    let mut engine = half_hard_engine(PILOT_SPP);
    let pilot = counts(&finish(&mut engine, LONG).pixels);
    assert!(pilot.values().all(|count| *count == PILOT_SPP));
    engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.spp += 8));
    let (mut traced, mut dispatched) = (BTreeMap::<u32, u32>::new(), 0);
    loop {
        let before = ["path", "accumulate"].map(|pass| ran(&engine, pass));
        let finished = engine.step(SHORT).unwrap().finished;
        let after = ["path", "accumulate"].map(|pass| ran(&engine, pass));
        let runs = engine.read(|world| world.resource::<Tiles>().runs.clone());
        let expected = u64::from(!runs.is_empty());
        assert_eq!([after[0] - before[0], after[1] - before[1]], [expected; 2], "{runs:?}");
        dispatched += expected;
        for run in runs {
            *traced.entry(run.tile).or_default() += run.counts[0] + run.counts[1];
        }
        if finished {
            break;
        }
    }
    let film = counts(&engine.film().unwrap().pixels);
    let grown: BTreeMap<u32, u32> =
        film.iter().map(|(tile, count)| (*tile, count - pilot[tile])).filter(|(_, more)| *more > 0).collect();
    assert_eq!(traced, grown, "what was dispatched is what the film has more");
    let idle = engine.report().unwrap().tiles.unwrap().idle;
    assert_eq!(traced.len() as u32, film.len() as u32 - idle);
    assert!(idle >= 6, "{idle} tiles are quiet");
    // Each batch was as small as there are: of one tile.
    assert!(dispatched as usize >= traced.len() && dispatched <= u64::from(traced.values().sum::<u32>()));
}

/// The same number of samples for each tile that is noisy takes as many fewer batches as there are fewer such tiles.
#[test]
fn dispatches_fall_as_tiles_converge() {
    let grid = Grid::of(UVec2::ZERO, UVec2::splat(8 * 8));
    let batches = |noisy: usize| {
        let mut tiles = Tiles::of(grid.clone());
        for spp in [PILOT_SPP / 2, PILOT_SPP] {
            tiles.trace_all(spp);
            // Two tallies a tile, in its order; those around share what one tells, so noisy ones are together.
            let told = |at: usize| TileTally {
                error: if at / 2 < noisy { 1.0 } else { 0.0 },
                rays: 64.0,
                pixels: 64.0,
                ..TileTally::default()
            };
            let tallies: Vec<TileTally> = (0..tiles.tallies()).map(told).collect();
            tiles.hear(&tallies);
        }
        // The average at which noisy tiles have some 64 samples.
        let average = PILOT_SPP + (48 * noisy / grid.len()) as u32;
        let (mut spp, mut batches, mut pixels) = (PILOT_SPP, 0, 0);
        while spp < average {
            spp = tiles.aim(spp, 8, average);
            loop {
                let batch = tiles.list(4096);
                batches += u64::from(batch.runs > 0);
                pixels += batch.pixels;
                if batch.done {
                    break;
                }
                let none = vec![TileTally::default(); tiles.tallies()];
                tiles.hear(&none);
            }
        }
        // Nothing is left to do: no batch has anything in it.
        let more = tiles.list(4096);
        assert!(more.done && (more.samples, more.runs, more.pixels) == (0, 0, 0) && tiles.samples.is_empty());
        (batches, pixels)
    };
    let all: Vec<(u64, u64)> = [64, 32, 16].into_iter().map(batches).collect();
    println!("batches and samples of pixels, of 64, 32 and 16 noisy tiles: {all:?}");
    for pair in all.windows(2) {
        assert!(10 * pair[1].0 <= 7 * pair[0].0, "{all:?}");
        assert!(10 * pair[1].1 <= 6 * pair[0].1, "{all:?}");
    }
}

#[test]
fn a_film_that_has_enough_issues_no_dispatch() {
    let mut engine = half_hard_engine(24);
    finish(&mut engine, LONG);
    let still = |engine: &mut Engine| {
        let before = (engine.dispatches().clone(), engine.entered().clone(), engine.uploads().clone());
        for _ in 0..5 {
            let progress = engine.step(LONG).unwrap();
            assert!(progress.finished && progress.dispatches == 0);
        }
        assert_eq!((engine.dispatches().clone(), engine.entered().clone(), engine.uploads().clone()), before);
    };
    still(&mut engine);
    // Good enough, so left at what it has, though more are asked for.
    engine.rest(true);
    let traced = |engine: &Engine| engine.dispatches().get("path").copied();
    let before = traced(&engine);
    engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.spp = 1000));
    engine.step(LONG).unwrap();
    still(&mut engine);
    assert_eq!(traced(&engine), before);
    engine.rest(false);
    let more = trace(&mut engine, |render| render.spp = 32);
    assert!(more.pixels == finish(&mut half_hard_engine(32), LONG).pixels);
}
