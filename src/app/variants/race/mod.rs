//! `--race`: members compete by efficiency, 1 / (relMSE x seconds), and those end early that are certain to lose.
//!
//! A round is two films of every member that is in the race, of as many samples and of seeds of their own, in another order each time: what
//! the two say of the error of one is without bias. Every block of the picture counts alike ([`even_weights`]).

mod racer;
mod report;

use std::collections::BTreeMap;
use std::time::Instant;

pub use report::text;

use super::arguments::VariantsArguments;
use super::stage::Stage;
use super::survey::Survey;
use super::watcher::Watcher;
use crate::app::Failure;
use crate::engine::EngineError;
use crate::gpu::Gpu;
use crate::stats::blocks::Grid;
use crate::stats::efficiency::pair_error;
use crate::stats::equal_means::block_side;
use crate::stats::race::{Lap, Lost, Race, even_weights};
use racer::{Racer, Shooter};

/// Samples a pixel of a film, at first and at most, where `--spp` says nothing.
const SPP: [u32; 2] = [4, 64];

/// Means are looked at after so many rounds, and after twice as many, and so on.
const FIRST_LOOK: u32 = 8;

/// A film that takes less says little of time.
const LEAST_SECONDS: f64 = 0.02;

/// A race that was run.
pub struct Raced<'s> {
    pub racers: Vec<Racer<'s>>,
    pub race: Race,
    /// Who left, in that order.
    pub lost: Vec<Lost>,
    pub rounds: u32,
    /// Part of the time of all rounds by all members that was not spent.
    pub saved: f64,
    /// Members whose means differ from those of another member of the same picture, and which that is.
    pub wrong: BTreeMap<usize, usize>,
    pub adapter: String,
    pub interrupted: bool,
    pub spp: u32,
}

/// Runs a race among the members of an order.
pub fn run<'s>(
    survey: &'s Survey,
    order: &[usize],
    arguments: &VariantsArguments,
    watcher: &Watcher,
) -> Result<Raced<'s>, Failure> {
    let mut racers: Vec<Racer> = order.iter().filter_map(|index| Racer::new(survey, *index)).collect();
    let [first, others @ ..] = &racers[..] else { return Err(too_few()) };
    if others.is_empty() {
        return Err(too_few());
    }
    let size = first.size();
    if let Some(other) = others.iter().find(|racer| racer.size() != size) {
        let message = format!("--race: {} and {} have pictures of other sizes", first.name(), other.name());
        return Err(Failure::usage(message, "give all of them one --size"));
    }
    let grid = Grid::new(size, block_side(size));
    let mut stage = Stage::open(Gpu::open()?, &survey.codes, first.subject).map_err(Failure::engine)?;
    stage.engine.on_compiling(watcher.compiling());
    let adapter = stage.adapter.clone();
    let mut shooter = Shooter::new(stage, &survey.codes, watcher);
    let spp = match arguments.flags.spp.first() {
        Some(spp) => *spp,
        None => spp(&mut shooter, &racers[0]).map_err(Failure::engine)?,
    };
    let mut race = Race::new(racers.len(), arguments.alpha);
    let ready = pilot(&mut shooter, &mut racers, &mut race, spp, grid).map_err(Failure::engine)?;
    let mut result = Raced {
        racers,
        race,
        lost: Vec::new(),
        rounds: 0,
        saved: 0.0,
        wrong: BTreeMap::new(),
        adapter,
        interrupted: !ready,
        spp,
    };
    if ready {
        rounds(&mut shooter, &mut result, arguments).map_err(Failure::engine)?;
    }
    result.finish(arguments.rounds);
    Ok(result)
}

fn too_few() -> Failure {
    Failure::usage("--race: fewer than two members can run", "name more with --only, or leave it away")
}

/// As many samples as make a film last. The first film does not count: some drivers compile meanwhile.
fn spp(shooter: &mut Shooter, racer: &Racer) -> Result<u32, EngineError> {
    let mut spp = SPP[0];
    shooter.film(racer, spp)?;
    while spp < SPP[1] {
        match shooter.film(racer, spp)? {
            Some(shot) if shot.seconds < LEAST_SECONDS => spp *= 2,
            _ => break,
        }
    }
    Ok(spp)
}

/// Two films of each that do not count: they compile, and say how blocks are to be weighed. Members that break leave. False after a signal.
fn pilot(
    shooter: &mut Shooter,
    racers: &mut [Racer],
    race: &mut Race,
    spp: u32,
    grid: Grid,
) -> Result<bool, EngineError> {
    let block_of = blocks(&grid);
    let count = (grid.count.x * grid.count.y) as usize;
    let (mut errors, mut pairs) = (vec![0.0; count], 0.0);
    for (number, racer) in racers.iter_mut().enumerate() {
        let pair = match shooter.pair(racer, spp) {
            Ok(Some(pair)) => pair,
            Ok(None) => return Ok(false),
            Err(error) => {
                racer.error = Some(error.to_string());
                race.remove(number);
                continue;
            }
        };
        racer.weigh(&pair);
        pairs += 1.0;
        for (error, own) in errors.iter_mut().zip(racer.block_errors(&pair, &block_of, count)) {
            *error += own;
        }
    }
    errors.iter_mut().for_each(|error| *error /= f64::max(pairs, 1.0));
    for racer in racers.iter_mut() {
        racer.weights = even_weights(&racer.weights, &errors, |pixel| block_of[pixel]);
        racer.begin(grid);
    }
    Ok(true)
}

/// Rounds until one member is left, or there are as many as were wanted, or the time is over.
fn rounds(shooter: &mut Shooter, result: &mut Raced, arguments: &VariantsArguments) -> Result<(), EngineError> {
    let begin = Instant::now();
    let is_over = || arguments.flags.time.last().is_some_and(|seconds| begin.elapsed().as_secs_f64() >= *seconds);
    while result.rounds < arguments.rounds && result.race.alive().count() > 1 && !is_over() {
        let mut alive: Vec<usize> = result.race.alive().collect();
        // Whoever is first in one round is last in another.
        let turn = result.rounds as usize % alive.len();
        alive.rotate_left(turn);
        let mut laps = vec![None; result.racers.len()];
        let mut films = Vec::new();
        for number in alive {
            let racer = &mut result.racers[number];
            match shooter.pair(racer, result.spp) {
                Ok(Some(pair)) => {
                    let error = pair_error(&pair[0].radiance, &pair[1].radiance, &racer.weights);
                    let seconds = 0.5 * (pair[0].seconds + pair[1].seconds);
                    laps[number] = Some(Lap { error, seconds });
                    films.push((number, pair));
                }
                Ok(None) => {
                    result.interrupted = true;
                    return Ok(());
                }
                Err(error) => {
                    racer.error = Some(error.to_string());
                    result.race.remove(number);
                }
            }
        }
        result.rounds += 1;
        result.compare(&films);
        if result.rounds >= FIRST_LOOK && result.rounds.is_power_of_two() {
            result.leave_wrong();
        }
        let lost = result.race.add(&laps);
        result.lost.extend(lost);
        for (number, pair) in films {
            result.racers[number].add(&pair, result.spp);
        }
        shooter.round_is_over();
    }
    Ok(())
}

impl Raced<'_> {
    /// The means of films of the same picture, against those of the first member of it that ran in this round.
    fn compare(&mut self, films: &[(usize, [racer::Shot; 2])]) {
        let mut ran: Vec<&(usize, [racer::Shot; 2])> = films.iter().collect();
        ran.sort_by_key(|(number, _)| *number);
        for (number, new) in &ran {
            let alike = |other: usize| self.racers[other].picture_key == self.racers[*number].picture_key;
            let first = ran.iter().find(|(other, _)| alike(*other));
            if let Some((first, old)) = first.filter(|(first, _)| first != number) {
                self.racers[*number].compare(*first, old, new);
            }
        }
    }

    /// Members that are wrong leave, before they can end others by being fast.
    fn leave_wrong(&mut self) {
        for (number, racer) in self.racers.iter_mut().enumerate() {
            if let Some(other) = racer.differs() {
                self.wrong.insert(number, other);
                self.race.remove(number);
            }
        }
    }

    /// Looks at means a last time, and adds up what was saved of `rounds`, or of as many as there was time for.
    fn finish(&mut self, rounds: u32) {
        self.leave_wrong();
        let rounds = if self.race.alive().count() <= 1 { rounds } else { self.rounds };
        let (mut spent, mut planned) = (0.0, 0.0);
        for number in 0..self.racers.len() {
            if let Some(lap) = self.race.average(number) {
                spent += lap.seconds * f64::from(self.race.rounds(number));
                planned += lap.seconds * f64::from(rounds);
            }
        }
        self.saved = if planned > 0.0 { 1.0 - spent / planned } else { 0.0 };
    }
}

/// The number of the block that each pixel is in.
fn blocks(grid: &Grid) -> Vec<usize> {
    let mut list = vec![0; grid.size.x as usize * grid.size.y as usize];
    for y in 0..grid.count.y {
        for x in 0..grid.count.x {
            let (min, max) = grid.bounds(glam::UVec2::new(x, y));
            for row in min.y..max.y {
                let first = (row * grid.size.x) as usize;
                list[first + min.x as usize..first + max.x as usize].fill((y * grid.count.x + x) as usize);
            }
        }
    }
    list
}
