//! How far the tiles of an adaptive film have come.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

use super::film::TileBatch;
use crate::cpu::allocation::{Grid, PILOT, Plan, end_of, heeded, next_tally, round_of, weights};
use crate::layout::adaptive::{TallyRun, TileRun, TileSample, TileTally};

/// Film samples, an average pixel, at which tiles begin to have different numbers.
pub const PILOT_SPP: u32 = 2 * PILOT;

/// Samples of half a tile in one batch, at most.
const MOST_AT_ONCE: u32 = 1024;

/// The tiles of an adaptive film; of any other, none.
#[derive(Resource, Default, Clone, Debug)]
pub struct Tiles {
    grid: Grid,
    /// What comes of what the halves have told, for each half.
    plans: [Plan; 2],
    /// Samples by tile that each half has.
    traced: [Vec<u32>; 2],
    /// And those that it is to have next.
    wanted: [Vec<u32>; 2],
    /// The tile that a batch begins with.
    next: usize,
    /// What each half has told, by the number of samples that were heeded.
    told: BTreeMap<u32, [Vec<TileTally>; 2]>,
    /// What the last batch is to tell.
    asked: Vec<Asked>,
    /// What the batch of this run of the schedule traces, and tallies.
    pub samples: Vec<TileSample>,
    pub runs: Vec<TileRun>,
    pub tally_runs: Vec<TallyRun>,
}

/// A half of a tile, and how many samples of it are tallied.
#[derive(Clone, Copy, Debug)]
struct Asked {
    tile: usize,
    half: usize,
    count: u32,
}

/// What came of the choosing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileCounts {
    pub tiles: u32,
    /// Samples a pixel: of the tile that has fewest, of one in the middle, and of the one that has most.
    pub least: u32,
    pub median: u32,
    pub most: u32,
    /// Tiles that got none in the film's last round, for they had enough.
    pub idle: u32,
}

impl Tiles {
    /// Of a film that begins.
    pub fn of(grid: Grid) -> Self {
        let none = || vec![0; grid.len()];
        let (traced, wanted) = ([none(), none()], [none(), none()]);
        Self { grid, traced, wanted, ..Self::default() }
    }

    /// Every pixel has so many film samples: still the same number.
    pub fn trace_all(&mut self, spp: u32) {
        for half in 0..2 {
            self.traced[half].fill(average(spp, half));
        }
        self.tally_runs.clear();
        for tile in 0..self.grid.len() {
            (0..2).for_each(|half| self.tally(tile, half));
        }
    }

    /// Whether a film of so many samples, that have all the same number, is to be tallied.
    pub fn is_tallied(spp: u32) -> bool {
        spp == PILOT_SPP || spp == PILOT_SPP / 2
    }

    /// Samples of all pixels.
    pub fn all_samples(&self) -> u64 {
        let of = |traced: &Vec<u32>| -> u64 {
            traced.iter().zip(&self.grid.pixels).map(|(count, pixels)| u64::from(*count) * u64::from(*pixels)).sum()
        };
        self.traced.iter().map(of).sum()
    }

    /// How many tallies the last batch has left on the device.
    pub fn tallies(&self) -> usize {
        self.asked.len()
    }

    /// Takes up those.
    pub fn hear(&mut self, tallies: &[TileTally]) {
        for (asked, tally) in std::mem::take(&mut self.asked).into_iter().zip(tallies) {
            let none = || vec![TileTally::default(); self.grid.len()];
            self.told.entry(asked.count).or_insert_with(|| [none(), none()])[asked.half][asked.tile] = *tally;
        }
    }

    /// The average to go for from `spp` film samples on, about `more` further and `most` at most, where all that was wanted is traced.
    pub fn aim(&mut self, spp: u32, more: u32, most: u32) -> u32 {
        let begins = |round: u32| if round == 0 { PILOT } else { end_of(round - 1) };
        let round = round_of(spp / 2 + 1);
        if spp == 2 * begins(round) {
            self.begin_round(round);
        }
        let goal = spp.saturating_add(more.max(1)).min(most).min(end_of(round).saturating_mul(2));
        for half in 0..2 {
            self.wanted[half] = self.plans[half].counts(&self.grid.pixels, average(goal, half));
        }
        self.next = 0;
        goal
    }

    /// What each half has told by now is what the other heeds.
    fn begin_round(&mut self, round: u32) {
        let told = self.told.remove(&heeded(round)).unwrap_or_default();
        self.told.retain(|count, _| *count > heeded(round));
        for half in 0..2 {
            let weights = weights(&self.grid, &told[1 - half]);
            self.plans[half] = Plan { have: self.traced[half].clone(), weights };
        }
    }

    /// Lists about `most` samples of pixels that are wanted: some of each tile that lacks some, from the one on at which the last batch ended. A
    /// half of a tile is left where it is to be tallied: its next samples are another batch's.
    pub fn list(&mut self, most: u64) -> TileBatch {
        self.samples.clear();
        self.runs.clear();
        self.tally_runs.clear();
        let mut pixels = 0;
        let most_tiles = (most / 64).clamp(1, u64::from(u32::MAX)) as usize;
        let count = self.grid.len();
        for _ in 0..count {
            if self.samples.len() >= most_tiles {
                break;
            }
            let tile = self.next;
            self.next = (self.next + 1) % count;
            let room = (most_tiles - self.samples.len()) as u32;
            pixels += self.list_tile(tile, room);
        }
        let done = self.traced == self.wanted;
        TileBatch { samples: self.samples.len() as u32, runs: self.runs.len() as u32, pixels, asked: most, done }
    }

    /// The same of one tile: `room` of its samples at most. Returns the samples of pixels.
    fn list_tile(&mut self, tile: usize, room: u32) -> u64 {
        let first = self.samples.len() as u32;
        let mut counts = [0; 2];
        for half in 0..2 {
            let from = self.traced[half][tile];
            let left = room - counts[0];
            let end = self.wanted[half][tile].min(next_tally(from)).min(from + MOST_AT_ONCE.min(left));
            counts[half] = end.saturating_sub(from);
            let sample = |index: u32| TileSample { tile: self.grid.packed(tile), sample: 2 * index + half as u32 };
            self.samples.extend((from..end).map(sample));
            if end > from {
                self.traced[half][tile] = end;
                self.tally(tile, half);
            }
        }
        if counts != [0; 2] {
            self.runs.push(TileRun { tile: self.grid.packed(tile), first, counts });
        }
        u64::from(counts[0] + counts[1]) * u64::from(self.grid.pixels[tile])
    }

    /// Has a half of a tile tallied, if it is where it is to be.
    fn tally(&mut self, tile: usize, half: usize) {
        let count = self.traced[half][tile];
        if count > 0 && next_tally(count - 1) == count {
            self.tally_runs.push(TallyRun { tile: self.grid.packed(tile), half: half as u32 });
            self.asked.push(Asked { tile, half, count });
        }
    }

    /// What came of it; none where all tiles have the same number.
    pub fn counts(&self) -> Option<TileCounts> {
        if self.plans[0].have.is_empty() {
            return None;
        }
        let tiles = self.grid.len();
        let mut counts: Vec<u32> = (0..tiles).map(|tile| self.traced[0][tile] + self.traced[1][tile]).collect();
        let idle =
            (0..tiles).filter(|tile| (0..2).all(|half| self.traced[half][*tile] == self.plans[half].have[*tile]));
        let idle = idle.count() as u32;
        counts.sort_unstable();
        let (least, median, most) = (counts[0], counts[tiles / 2], counts[tiles - 1]);
        Some(TileCounts { tiles: tiles as u32, least, median, most, idle })
    }
}

/// Samples of a half where a pixel has `spp` of both.
fn average(spp: u32, half: usize) -> u32 {
    (spp + 1 - half as u32) / 2
}
