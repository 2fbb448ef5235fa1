//! The judge: two engines on one device, one by the old shaders and one by the new, whose films of independent seeds are
//! compared. Knows no command line, so that a window can run it between frames.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::UVec2;

use super::analysis::{Analysis, End, Verdict};
use super::clock::{Clock, Control};
use super::error::JudgeError;
use super::series::{Round, Series};
use super::side::{Shot, Side};
use super::sizing::{FIRST_SPP, fits, halved, is_cheap, pixels, resized, spp};
use crate::components::Film;
use crate::gpu::Gpu;
use crate::passes::table::TABLE;
use crate::scene::SceneDescription;
use crate::shader::{Features, Library};

/// Films of each at the first analysis; each later one is at twice as many.
const FIRST_ANALYSIS: usize = 4;

/// Films of each before a narrow interval may end it.
const LEAST_FILMS: usize = 64;

/// Half an interval's width by the ratio that is narrow enough.
const NARROW: f64 = 0.05;

/// Of judging, by default.
pub const SECONDS: f64 = 30.0;

/// The least difference of the whole picture that is to be found before anything else is said, by default.
pub const WITHIN: f64 = 0.005;

/// How to judge.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Samples a pixel of each film; `None` chooses a power of two by the time.
    pub spp: Option<u32>,
    /// The scene's film is as it is to be, and no smaller one will do.
    pub whole: bool,
    /// From when the time counts.
    pub begin: Instant,
    /// Wall clock, compiling included; `None` is no limit where there is one to the films, else half a minute.
    pub seconds: Option<f64>,
    /// Films of each, at most; `None` is no limit.
    pub films: Option<u32>,
    /// Probability that equal means are called different, over the whole run.
    pub alpha: f64,
    /// The least difference of the whole picture that is to be found before anything is said of efficiency, relative.
    pub within: f64,
    /// Other seeds give other films.
    pub seed: u32,
    /// Tracing between two looks at whether it is to stop or rest.
    pub batch: Duration,
}

/// What the next films are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// To compile, and to learn what a sample costs.
    WarmUp,
    /// The smallest ones: what is badly wrong shows in no time.
    Scout,
    /// Larger ones, to learn what they cost.
    Grow,
    /// To be judged.
    Judge,
}

/// Judges the new shaders by the old ones.
///
/// Both get films of equally many samples by turns, so that whatever drifts hits both. Equal samples and not equal time: a
/// film of stratified samples is worth less at 15 than at 16, so that times would have a say in errors.
pub struct Judge {
    /// The old one first.
    sides: [Side; 2],
    plan: Plan,
    clock: Clock,
    changed: bool,
    /// From the smallest to that of the scene, and which of them is traced.
    films: Vec<Film>,
    level: usize,
    purpose: Purpose,
    /// What is compared now.
    series: Series,
    next_analysis: usize,
    /// Films begun so far, of both: each has a seed of its own.
    begun: u32,
}

impl Judge {
    /// Opens the scene twice, by the old and by the new shaders, and compares their code. The old ones are compiled for that:
    /// which code a scene runs is known once it is packed. `control` makes all that follows give up, with [`JudgeError::Stopped`], or rest.
    pub fn open(
        gpu: &Arc<Gpu>,
        [old, new]: [&Library; 2],
        description: &SceneDescription,
        plan: Plan,
        control: impl Into<Control>,
    ) -> Result<Self, JudgeError> {
        let control = control.into();
        // Both with limited loops, as edited code has them: else code of this binary would seem the faster for it.
        let side = |library: &Library| Side::open(gpu, &library.clone().with_limited_loops(), description, plan.batch);
        let mut sides = [side(old)?, side(new)?];
        let films = halved(description.film);
        // What is compiled first is to be compiled whatever the time is.
        let untimed = Clock::new(plan.begin, None, control.clone());
        sides[0].film(films[0], plan.seed, 1, &untimed).map_err(JudgeError::of_old)?;
        let changed = is_changed(old, new, &sides[0].features())?;
        let seconds = plan.seconds.or(plan.films.is_none().then_some(SECONDS));
        let clock = Clock::new(plan.begin, seconds, control);
        let black = vec![[0.0; 3]; pixels(&films[0]) as usize];
        let series = Series::new(films[0], 1, &[black.clone(), black], plan.alpha);
        let (level, purpose, next_analysis, begun) = (0, Purpose::WarmUp, FIRST_ANALYSIS, 1);
        Ok(Self { sides, plan, clock, changed, films, level, purpose, series, next_analysis, begun })
    }

    /// Whether the scene runs other code by the new shaders, beyond comments and white space.
    pub fn changed(&self) -> bool {
        self.changed
    }

    /// The film that is traced now: the scene's, or a smaller one.
    pub fn film(&self) -> Film {
        self.series.film
    }

    /// Samples a pixel of a film.
    pub fn spp(&self) -> u32 {
        self.series.spp
    }

    /// Films of each that are compared so far.
    pub fn films(&self) -> usize {
        self.series.films()
    }

    /// Seconds until the time is over; `None` where films alone end it.
    pub fn seconds_left(&self) -> Option<f64> {
        self.clock.left()
    }

    /// Traces two more films of each, and analyses all there are if it is time to.
    pub fn advance(&mut self) -> Result<Option<Analysis>, JudgeError> {
        if self.purpose == Purpose::WarmUp {
            return self.warm_up();
        }
        if self.purpose == Purpose::Scout && self.series.tells() {
            self.settle();
        }
        let begin = self.clock.elapsed();
        let Some(round) = self.round()? else { return Ok(Some(self.analyse())) };
        self.series.add(&round);
        self.series.seconds += self.clock.elapsed() - begin;
        let due = match self.purpose {
            Purpose::Grow => {
                self.settle();
                false
            }
            Purpose::Scout => self.series.tells(),
            Purpose::WarmUp | Purpose::Judge => self.series.films() >= self.next_analysis,
        };
        Ok((due || self.limit_reached().is_some()).then(|| self.analyse()))
    }

    /// Analyses all films there are. Each analysis spends part of alpha.
    pub fn analyse(&mut self) -> Analysis {
        let films = self.series.films();
        while self.next_analysis <= films {
            self.next_analysis *= 2;
        }
        let means = self.series.analyse();
        let ratio = self.series.ratio();
        let mut analysis = Analysis {
            films,
            spp: self.series.spp,
            size: self.size(),
            within: self.plan.within,
            verdict: Verdict::of(&means, self.plan.within, ratio, self.series.estimators()),
            means,
            bad_samples: self.sides.each_ref().map(|side| side.bad_samples),
            seconds: [self.clock.elapsed(), self.series.seconds],
            ended: None,
        };
        let narrow = films >= LEAST_FILMS && ratio.is_none_or(|ratio| ratio.spread() <= NARROW);
        analysis.ended = match analysis.means.differ() {
            true => Some(End::Differ),
            false if self.purpose == Purpose::Judge && narrow && analysis.is_fine() => Some(End::Narrow),
            false => self.limit_reached(),
        };
        analysis
    }

    /// Mean radiance of all films by the old and by the new shaders, row by row from the top of the film's window.
    pub fn pictures(&self) -> [Vec<[f32; 3]>; 2] {
        self.series.pictures()
    }

    fn size(&self) -> UVec2 {
        self.series.film.window().size()
    }

    fn limit_reached(&self) -> Option<End> {
        let most = self.plan.films.filter(|_| self.purpose == Purpose::Judge);
        match self.clock.left() {
            Some(0.0) => Some(End::Time),
            _ if most.is_some_and(|most| self.series.films() >= most as usize) => Some(End::Films),
            _ => None,
        }
    }

    /// Compiles the new shaders too, and traces a film of each to learn what a sample costs.
    fn warm_up(&mut self) -> Result<Option<Analysis>, JudgeError> {
        let film = self.films[0];
        // The first of them compiles.
        let (Some(_), Some(old)) = (self.shoot(1, film, 1)?, self.shoot(0, film, 1)?) else {
            return Ok(Some(self.analyse()));
        };
        let begin = self.clock.elapsed();
        let Some(new) = self.shoot(1, film, 1)? else { return Ok(Some(self.analyse())) };
        self.sides.iter_mut().for_each(|side| side.bad_samples = 0);
        let cost = (self.clock.elapsed() - begin) / pixels(&film) as f64;
        let pilot = [old.radiance, new.radiance];
        self.series = Series::new(film, 1, &pilot, self.plan.alpha);
        self.purpose = Purpose::Scout;
        if self.plan.whole {
            self.choose(cost, pilot);
        }
        Ok(None)
    }

    /// Goes on from what was traced by now to what the time is enough for.
    fn settle(&mut self) {
        self.choose(self.series.cost(), self.series.pictures());
    }

    /// Larger films while enough of them fit, then as many samples as fit. `cost` is what a sample of a pixel takes, and `pilot` a picture by each.
    fn choose(&mut self, cost: f64, pilot: [Vec<[f32; 3]>; 2]) {
        let seconds = self.clock.left().unwrap_or(SECONDS);
        let last = self.films.len() - 1;
        let next = (self.level + 1).min(last);
        let first_spp = self.plan.spp.unwrap_or(FIRST_SPP);
        let grows = match self.plan.whole {
            true => is_cheap(&self.films[next], first_spp, cost, seconds),
            false => fits(&self.films[next], first_spp, cost, seconds),
        };
        if self.level < last && grows {
            return self.begin(Purpose::Grow, next, first_spp, pilot);
        }
        let level = if self.plan.whole { last } else { self.level };
        let spp = self.plan.spp.unwrap_or_else(|| spp(&self.films[level], cost, seconds));
        // The scout's films count on where they are as they are to be.
        if self.purpose == Purpose::Scout && (level, spp) == (self.level, self.series.spp) {
            self.purpose = Purpose::Judge;
            return;
        }
        self.begin(Purpose::Judge, level, spp, pilot);
    }

    /// Begins films of another kind, with what is left of alpha.
    fn begin(&mut self, purpose: Purpose, level: usize, spp: u32, pilot: [Vec<[f32; 3]>; 2]) {
        let film = self.films[level];
        let (from, to) = (self.size(), film.window().size());
        let pilot = pilot.map(|picture| resized(&picture, from, to));
        self.series = Series::new(film, spp, &pilot, self.series.alpha_left());
        (self.purpose, self.level, self.next_analysis) = (purpose, level, FIRST_ANALYSIS);
    }

    /// New, old, old, new: a drift of the clock is the same for both. `None` if the time is over before that.
    fn round(&mut self) -> Result<Option<Round>, JudgeError> {
        let (film, spp) = (self.series.film, self.series.spp);
        let mut shots = Vec::with_capacity(4);
        for which in [1, 0, 0, 1] {
            let Some(shot) = self.shoot(which, film, spp)? else { return Ok(None) };
            shots.push(shot);
        }
        let Ok([first, old, other, last]) = <[Shot; 4]>::try_from(shots) else { return Ok(None) };
        Ok(Some(Round { old: [old, other], new: [first, last] }))
    }

    /// A film of a seed that no other film of either has.
    fn shoot(&mut self, which: usize, film: Film, spp: u32) -> Result<Option<Shot>, JudgeError> {
        // An odd factor: all multiples modulo 2^32 differ.
        let seed = self.plan.seed.wrapping_add(self.begun.wrapping_mul(0x9e37_79b9));
        self.begun = self.begun.wrapping_add(1);
        self.sides[which].film(film, seed, spp, &self.clock)
    }
}

/// Links all that an engine runs by both; fails on what is wrong with either.
fn is_changed(old: &Library, new: &Library, features: &Features) -> Result<bool, JudgeError> {
    let mut changed = false;
    for pass in TABLE.iter().filter(|pass| !pass.makes.is_empty()) {
        let old = old.link(pass.module, features).map_err(JudgeError::OldShader)?;
        changed |= !old.is_same(&new.link(pass.module, features)?);
    }
    Ok(changed)
}
