//! Tallies to weights to numbers of samples.

use glam::{UVec2, Vec3};
use lucerna::cpu::allocation::{Grid, PILOT, Plan, end_of, heeded, next_tally, round_of, share, weights};
use lucerna::layout::adaptive::{TileTally, unpack_tile};

use crate::support::dice::Dice;

fn grid(tiles: u32) -> Grid {
    Grid::of(UVec2::ZERO, UVec2::new(8 * tiles, 8))
}

/// A plan after the first samples, with weights from 0.001 to 16.
fn plan(tiles: u32, dice: &mut Dice) -> Plan {
    let weights = (0..tiles).map(|_| (0.001 * 16_000f64.powf(dice.unit())) as f32).collect();
    Plan { have: vec![PILOT; tiles as usize], weights }
}

#[test]
fn a_grid_has_the_blocks_of_the_whole_film_that_a_window_touches() {
    let grid = Grid::of(UVec2::new(5, 16), UVec2::new(12, 9));
    assert_eq!(grid.pixels, [3 * 8, 8 * 8, 8, 3, 8, 1]);
    assert_eq!(grid.all_pixels(), 12 * 9);
    let places: Vec<UVec2> = (0..grid.len()).map(|tile| unpack_tile(grid.packed(tile))).collect();
    assert_eq!(places, [(0, 2), (1, 2), (2, 2), (0, 3), (1, 3), (2, 3)].map(UVec2::from));
    let mut around: Vec<usize> = grid.around(2).collect();
    around.sort_unstable();
    assert_eq!(around, [1, 4, 5]);
    assert!(Grid::of(UVec2::ZERO, UVec2::ZERO).is_empty());
}

/// What makes a film that goes on equal one that was to go there at once.
#[test]
fn no_tile_has_fewer_samples_for_a_greater_average() {
    let mut dice = Dice(1);
    for tiles in [1, 2, 7, 300] {
        let plan = plan(tiles, &mut dice);
        let pixels: Vec<u32> = (0..tiles).map(|_| 1 + (dice.unit() * 64.0) as u32).collect();
        let all: u64 = pixels.iter().map(|pixels| u64::from(*pixels)).sum();
        let mut before = plan.have.clone();
        for average in PILOT..=end_of(0) {
            let counts = plan.counts(&pixels, average);
            assert!(counts.iter().zip(&before).all(|(count, before)| count >= before), "{tiles} tiles, {average}");
            assert!(counts.iter().all(|count| *count >= share(average)));
            let dealt: u64 = counts.iter().zip(&pixels).map(|(count, pixels)| u64::from(count * pixels)).sum();
            assert!(dealt <= all * u64::from(average), "{tiles} tiles, {average}: {dealt} of {all} pixels");
            // Next to nothing is left: less than a tile's worth.
            assert!(dealt + 64 > all * u64::from(average), "{tiles} tiles, {average}: {dealt} of {all} pixels");
            before = counts;
        }
    }
}

/// Taking samples from one tile for another makes the film no better, where tiles are as those around them.
#[test]
fn samples_go_where_they_lessen_the_error_most() {
    const TILES: usize = 12;
    // In groups of three alike, of which the one in the middle is looked at.
    let kinds = [(0.3, 2.0), (1.3, 4.0), (0.6, 3.0), (2.5, 2.5)];
    let of = |tile: usize| kinds[tile / 3];
    let tally = |tile: usize| {
        let (variance, rays) = of(tile);
        let (error, rays) = ((64.0 * variance) as f32, (64.0 * 8.0 * rays) as f32);
        TileTally { error, rays, pixels: 64.0, ..TileTally::default() }
    };
    let tallies: Vec<TileTally> = (0..TILES).map(tally).collect();
    let weights = weights(&grid(TILES as u32), &tallies);
    let middle: Vec<f64> = weights.iter().skip(1).step_by(3).map(|weight| f64::from(*weight)).collect();
    let error = |weights: &[f64]| -> f64 {
        // For as many rays as there are.
        let spent: f64 = weights.iter().zip(&kinds).map(|(n, (_, rays))| n * rays).sum();
        weights.iter().zip(&kinds).map(|(n, (variance, _))| variance / n).sum::<f64>() * spent
    };
    let best = error(&middle);
    for tile in 0..middle.len() {
        for factor in [0.9, 1.1] {
            let mut other = middle.clone();
            other[tile] *= factor;
            assert!(error(&other) > best, "tile {tile} times {factor}");
        }
    }
    assert!(error(&vec![1.0; middle.len()]) > 1.01 * best);
}

#[test]
fn weights_are_numbers_whatever_is_told() {
    let grid = grid(6);
    let quiet = TileTally { rays: 64.0, mean: Vec3::ONE, pixels: 64.0, ..TileTally::default() };
    assert_eq!(weights(&grid, &[quiet; 6]), [1.0; 6], "where nothing is noisy, all is alike");
    assert_eq!(weights(&grid, &[]), [1.0; 6], "where nothing is told, too");
    let mut tallies = [quiet; 6];
    tallies[0].error = f32::INFINITY;
    tallies[1].error = f32::NAN;
    tallies[2].error = 1e37;
    tallies[5].error = 1e-3;
    let weights = weights(&grid, &tallies);
    assert!(weights.iter().all(|weight| (1e-3..=16.0).contains(weight)), "{weights:?}");
    // What is rare, the tile beside it may meet, too.
    assert!(weights[3] > 0.1 * weights[2] && weights[2] > weights[3] && weights[5] < 0.01, "{weights:?}");
}

#[test]
fn every_tile_has_what_a_round_heeds_before_it_begins() {
    assert_eq!((round_of(9), round_of(end_of(0)), round_of(end_of(0) + 1)), (0, 0, 1));
    for round in 0..12 {
        assert_eq!((round_of(end_of(round)), round_of(end_of(round) + 1)), (round, round + 1));
        assert_eq!(share(end_of(round)), heeded(round + 1));
        let told = next_tally(heeded(round) - 1);
        assert_eq!(told, heeded(round), "it is tallied, and so is its half");
        assert_eq!(next_tally(heeded(round) / 2 - 1), heeded(round) / 2);
    }
    assert_eq!(heeded(0), PILOT);
    for average in [u32::MAX, 1 << 30] {
        assert!(end_of(round_of(average)) >= average);
    }
}
