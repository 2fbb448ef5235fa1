//! What a half is dealt, over many rounds, is of the other half's making alone.

use std::collections::BTreeMap;

use glam::{UVec2, Vec3};
use lucerna::cpu::allocation::Grid;
use lucerna::layout::adaptive::TileTally;
use lucerna::systems::resources::{Batch, PILOT_SPP, TileBatch, Tiles};

use crate::support::dice::Dice;

const SIZE: UVec2 = UVec2::new(37, 21);

/// Samples by tile and half.
type Counts = BTreeMap<(u32, usize), u32>;

/// What a half of a tile tells when it has so many samples: a number of the seed of its half.
fn told(seed: u64, tile: u32, count: u32) -> TileTally {
    let mut dice = Dice(seed ^ u64::from(tile) << 32 ^ u64::from(count));
    // As the square of a mean's error falls, and with rare bright ones.
    let error = dice.firefly(0.1, 30.0).abs() * dice.unit() / f64::from(count);
    let (rays, mean) = (64.0 * f64::from(count) * (2.0 + 3.0 * dice.unit()), 64.0 * (0.1 + dice.unit()));
    let (error, rays, mean) = (error as f32, rays as f32, Vec3::splat(mean as f32));
    TileTally { error, rays, mean, pixels: 64.0, ..TileTally::default() }
}

/// Drives tiles to some averages one after the other, `most` samples of pixels a batch; gives what there was at each.
fn drive(seeds: [u64; 2], averages: &[u32], most: u64) -> Vec<Counts> {
    let mut tiles = Tiles::of(Grid::of(UVec2::new(3, 5), SIZE));
    let mut counts = Counts::new();
    let hear = |tiles: &mut Tiles, counts: &Counts| {
        let runs = tiles.tally_runs.clone();
        assert_eq!(tiles.tallies(), runs.len());
        let of = |run: &lucerna::layout::adaptive::TallyRun| {
            let half = run.half as usize;
            told(seeds[half], run.tile, counts[&(run.tile, half)])
        };
        let all: Vec<TileTally> = runs.iter().map(of).collect();
        tiles.hear(&all);
    };
    for spp in [PILOT_SPP / 2, PILOT_SPP] {
        assert!(Tiles::is_tallied(spp));
        tiles.trace_all(spp);
        for run in &tiles.tally_runs {
            counts.insert((run.tile, run.half as usize), spp / 2);
        }
        hear(&mut tiles, &counts);
    }
    let (mut spp, mut all) = (PILOT_SPP, Vec::new());
    for target in averages {
        while spp < *target {
            spp = tiles.aim(spp, 1 + (most / u64::from(SIZE.element_product())) as u32, *target);
            loop {
                let batch = tiles.list(most);
                for run in &tiles.runs {
                    for half in 0..2 {
                        let count = counts.get_mut(&(run.tile, half)).unwrap();
                        let listed =
                            &tiles.samples[run.first as usize + if half == 1 { run.counts[0] as usize } else { 0 }..];
                        for sample in &listed[..run.counts[half] as usize] {
                            assert_eq!((sample.tile, sample.sample), (run.tile, 2 * *count + half as u32));
                            *count += 1;
                        }
                    }
                }
                hear(&mut tiles, &counts);
                if batch.done {
                    break;
                }
            }
        }
        all.push(counts.clone());
    }
    all
}

fn of_half(counts: &Counts, half: usize) -> Vec<u32> {
    counts.iter().filter(|((_, of), _)| *of == half).map(|(_, count)| *count).collect()
}

const AVERAGES: [u32; 6] = [17, 60, 256, 300, 700, 2100];

/// The argument of `cpu/allocation`, put to the test: with other values of its own, in every round, a half has the same numbers.
#[test]
fn what_a_half_is_dealt_does_not_depend_on_itself_in_any_round() {
    for half in 0..2 {
        let with = |own: u64| {
            let mut seeds = [77, 78];
            seeds[half] = own;
            drive(seeds, &AVERAGES, 4096)
        };
        let first = with(5);
        for own in [6, 7] {
            let other = with(own);
            for (k, average) in AVERAGES.iter().enumerate() {
                assert_eq!(of_half(&first[k], half), of_half(&other[k], half), "half {half}, {average} spp");
                let apart = of_half(&first[k], 1 - half) != of_half(&other[k], 1 - half);
                assert!(apart || *average < 20, "half {half} is not heeded at {average} spp");
            }
        }
    }
}

#[test]
fn what_is_dealt_does_not_depend_on_the_way_there() {
    let right = drive([1, 2], &AVERAGES, 1 << 40);
    let last = AVERAGES[AVERAGES.len() - 1];
    for most in [1, 700, 100_000] {
        assert_eq!(drive([1, 2], &AVERAGES, most), right, "{most} samples a batch");
        assert_eq!(drive([1, 2], &[last], most).last(), right.last(), "at once");
    }
}

#[test]
fn all_that_is_to_be_dealt_is() {
    let pixels = f64::from(SIZE.element_product());
    let grid = Grid::of(UVec2::new(3, 5), SIZE);
    for (counts, average) in drive([1, 2], &AVERAGES, 10_000).iter().zip(AVERAGES) {
        let of = |tile: usize| (0..2).map(|half| counts[&(grid.packed(tile), half)]).sum::<u32>();
        let dealt: f64 = (0..grid.len()).map(|tile| f64::from(of(tile)) * f64::from(grid.pixels[tile])).sum();
        let part = dealt / (pixels * f64::from(average));
        assert!((0.98..=1.0).contains(&part), "{average} spp: {part} of it");
        assert!(counts.values().min() < counts.values().max(), "{average} spp");
    }
}

/// Nothing is learnt of such a batch, or the next one would be as small, and a film of a hundred batches one of thousands.
#[test]
fn what_is_left_of_a_round_is_told_by_what_was_asked_for() {
    let batch = |pixels| Batch {
        tiles: Some(TileBatch { samples: 1, runs: 1, pixels, asked: 100, done: true }),
        ..Batch::default()
    };
    assert_eq!([0, 24, 25, 100].map(|pixels| batch(pixels).is_remainder()), [true, true, false, false]);
    assert!(!Batch { rows: 1, layers: 1, ..Batch::default() }.is_remainder(), "of rows");
}
