//! The judge: two engines on one device, one by the old shaders and one by the new, whose films of independent seeds are
//! compared. Knows no command line, so that a window can run it between frames.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use glam::UVec2;

use super::look::{End, Estimator, Look};
use crate::app::stage::Stage;
use crate::components::Render;
use crate::cpu::blocks::Grid;
use crate::cpu::efficiency::{Ratio, Trial, averages, pair_error, weights};
use crate::cpu::equal_means::{MeansTest, block_side};
use crate::gpu::Gpu;
use crate::passes::table::TABLE;
use crate::passes::{extend, lint};
use crate::scene::SceneDescription;
use crate::shader::{Features, Library, ShaderError};
use crate::systems::EngineError;

/// Films of each at the first look; each later one is at twice as many.
const FIRST_LOOK: usize = 4;

/// Films of each before a narrow interval may end it.
const LEAST_FILMS: usize = 64;

/// Half an interval's width by the ratio that is narrow enough.
const NARROW: f64 = 0.05;

/// Films of each that the time is to be enough for, where the samples of one are not given.
const FILMS: f64 = 256.0;

/// Of judging, where nothing else is asked for.
pub const SECONDS: f64 = 30.0;

/// Samples a pixel of the film that tells the speed, the first that counts being another.
const TRIAL_SPP: u32 = 4;

/// Samples of the pilot film, by those of a film.
const PILOT: u32 = 4;

/// Why nothing was judged.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum JudgeError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Shader(#[from] ShaderError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Engine(#[from] EngineError),
    #[error("stopped before it was judged")]
    Stopped,
}

/// How to judge.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Samples a pixel of each film; `None` chooses a power of two by the time.
    pub spp: Option<u32>,
    /// Wall clock, after warm-up; `None` is no limit where there is one to the films, else half a minute.
    pub seconds: Option<f64>,
    /// Films of each, at most; `None` is no limit.
    pub films: Option<u32>,
    /// Probability that equal means are called different, over the whole run.
    pub alpha: f64,
    /// Other seeds give other films.
    pub seed: u32,
}

/// One estimator.
struct Side {
    stage: Stage,
    /// Samples that were no numbers, over all films.
    bad_samples: u64,
}

/// Mean radiance of a film's pixels, and what it took.
struct Shot {
    radiance: Vec<[f32; 3]>,
    /// Of its batches, from submission to end.
    seconds: f64,
}

impl Side {
    /// Traces a film from its first sample to its last.
    fn film(&mut self, seed: u32, spp: u32, stop: &AtomicBool) -> Result<Shot, JudgeError> {
        let before = self.stage.report()?.seconds_trace;
        self.stage.set(Render { seed, spp, ..self.stage.render });
        while !self.stage.step()?.finished {
            if stop.load(Ordering::Relaxed) {
                return Err(JudgeError::Stopped);
            }
        }
        let report = self.stage.report()?;
        self.bad_samples += report.bad_samples;
        Ok(Shot { radiance: self.stage.radiance()?, seconds: report.seconds_trace - before })
    }
}

/// Judges the new shaders by the old ones.
///
/// Both get films of equally many samples by turns, so that whatever drifts hits both. Equal samples and not equal time: a
/// film of stratified samples is worth less at 15 than at 16, so that times would have a say in errors.
pub struct Judge {
    /// The old one first.
    sides: [Side; 2],
    plan: Plan,
    changed: bool,
    /// Pixels of the picture.
    size: UVec2,
    /// Samples a pixel of a film; 0 before warm-up.
    spp: u32,
    /// Of the pixels' squared errors, by a pilot film of each: what counts is independent of them.
    weights: Vec<[f32; 3]>,
    test: MeansTest,
    trials: Vec<Trial>,
    /// Films of each, summed; the old one first.
    sums: [Vec<[f32; 3]>; 2],
    next_look: usize,
    begin: Instant,
    /// Films begun so far, of both: each has a seed of its own.
    films: u32,
    stop: Arc<AtomicBool>,
}

impl Judge {
    /// Opens the scene twice, by the old and by the new shaders, and compares their code. The old ones are compiled for that:
    /// which code a scene runs is known once it is packed.
    pub fn open(
        gpu: &Arc<Gpu>,
        [old, new]: [&Library; 2],
        description: &SceneDescription,
        plan: Plan,
    ) -> Result<Self, JudgeError> {
        let side =
            |library| Ok::<_, EngineError>(Side { stage: Stage::open(gpu, library, description)?, bad_samples: 0 });
        let mut sides = [side(old)?, side(new)?];
        let stop = Arc::new(AtomicBool::new(false));
        sides[0].film(plan.seed, 1, &stop)?;
        let changed = is_changed(old, new, &sides[0].stage.features())?;
        let size = description.film.window().size();
        let test = MeansTest::new(Grid::new(size, block_side(size)), plan.alpha);
        Ok(Self {
            sides,
            plan,
            changed,
            size,
            spp: 0,
            weights: Vec::new(),
            test,
            trials: Vec::new(),
            sums: [Vec::new(), Vec::new()],
            next_look: FIRST_LOOK,
            begin: Instant::now(),
            films: 1,
            stop,
        })
    }

    /// Whether the scene runs other code by the new shaders, beyond comments and white space.
    pub fn changed(&self) -> bool {
        self.changed
    }

    /// Samples a pixel of a film; 0 before warm-up.
    pub fn spp(&self) -> u32 {
        self.spp
    }

    /// Samples of all pixels of a film of each.
    pub fn samples(&self) -> u64 {
        2 * u64::from(self.spp) * u64::from(self.size.x) * u64::from(self.size.y)
    }

    /// Compiles, warms the device up and chooses the samples of a film. [`advance`](Self::advance) begins with it; who wants
    /// to show that apart calls it before.
    pub fn warm_up(&mut self) -> Result<(), JudgeError> {
        let timed = self.shoot(0, TRIAL_SPP)?.seconds;
        let fit = self.plan.seconds.unwrap_or(SECONDS) / (2.0 * FILMS) * f64::from(TRIAL_SPP) / timed.max(1e-9);
        let spp = self.plan.spp.unwrap_or_else(|| 1 << fit.log2().floor().clamp(1.0, 10.0) as u32);
        let [old, new] = [0, 1].map(|which| self.shoot(which, spp.saturating_mul(PILOT)));
        self.weights = weights(&old?.radiance, &new?.radiance);
        self.sums = [0, 1].map(|_| vec![[0.0; 3]; self.weights.len()]);
        self.sides.iter_mut().for_each(|side| side.bad_samples = 0);
        (self.begin, self.spp) = (Instant::now(), spp);
        Ok(())
    }

    /// Traces two more films of each, and looks at all there are if it is time to.
    pub fn advance(&mut self) -> Result<Option<Look>, JudgeError> {
        if self.spp == 0 {
            self.warm_up()?;
        }
        // New, old, old, new: a drift of the clock is the same for both.
        let first = self.shoot(1, self.spp)?;
        let [old, other] = [self.shoot(0, self.spp)?, self.shoot(0, self.spp)?];
        let last = self.shoot(1, self.spp)?;
        self.test.add(&old.radiance, &first.radiance);
        self.test.add(&other.radiance, &last.radiance);
        let error = |x: &Shot, y: &Shot| pair_error(&x.radiance, &y.radiance, &self.weights);
        self.trials.push(Trial {
            relmse: [error(&old, &other), error(&first, &last)],
            seconds: [0.5 * (old.seconds + other.seconds), 0.5 * (first.seconds + last.seconds)],
        });
        for (which, film) in [(0, &old), (0, &other), (1, &first), (1, &last)] {
            let sums = self.sums[which].as_flattened_mut().iter_mut();
            sums.zip(film.radiance.as_flattened()).for_each(|(sum, value)| *sum += value);
        }
        let due = self.limit_reached().is_some() || 2 * self.trials.len() >= self.next_look;
        Ok(due.then(|| self.look()))
    }

    /// Looks at all films there are. Each look spends part of alpha.
    pub fn look(&mut self) -> Look {
        let films = 2 * self.trials.len();
        while self.next_look <= films {
            self.next_look *= 2;
        }
        let means = self.test.look();
        let ratio = Ratio::of(&self.trials);
        let narrow = films >= LEAST_FILMS && ratio.is_some_and(|ratio| ratio.spread() <= NARROW);
        let ended = match means.differ() {
            true => Some(End::Differ),
            false if narrow => Some(End::Narrow),
            false => self.limit_reached(),
        };
        let estimator = |which: usize| {
            let (relmse, seconds) = averages(&self.trials, which);
            Estimator { relmse, seconds, bad_samples: self.sides[which].bad_samples }
        };
        Look { films, spp: self.spp, means, ratio, old: estimator(0), new: estimator(1), ended }
    }

    /// Mean radiance of all films by the old and by the new shaders, row by row from the top of the window.
    pub fn pictures(&self) -> [Vec<[f32; 3]>; 2] {
        let films = (2 * self.trials.len()).max(1) as f32;
        self.sums.each_ref().map(|sums| sums.iter().map(|sum| sum.map(|channel| channel / films)).collect())
    }

    /// Gives up, with [`JudgeError::Stopped`], as soon as this is set.
    pub fn stop_by(&mut self, stop: Arc<AtomicBool>) {
        self.stop = stop;
    }

    fn limit_reached(&self) -> Option<End> {
        let films = 2 * self.trials.len();
        let seconds = self.plan.seconds.or(self.plan.films.is_none().then_some(SECONDS));
        match films {
            // From fewer films no interval can be told.
            _ if films < FIRST_LOOK => None,
            _ if self.plan.films.is_some_and(|most| films >= most as usize) => Some(End::Films),
            _ if seconds.is_some_and(|most| self.begin.elapsed().as_secs_f64() >= most) => Some(End::Time),
            _ => None,
        }
    }

    /// A film of a seed that no other film of either has.
    fn shoot(&mut self, which: usize, spp: u32) -> Result<Shot, JudgeError> {
        // An odd factor: all multiples modulo 2^32 differ.
        let seed = self.plan.seed.wrapping_add(self.films.wrapping_mul(0x9e37_79b9));
        self.films = self.films.wrapping_add(1);
        self.sides[which].film(seed, spp, &self.stop)
    }
}

/// Links all that an engine runs by both; fails on what is wrong with either.
fn is_changed(old: &Library, new: &Library, features: &Features) -> Result<bool, ShaderError> {
    let aside = [&extend::EXTEND, &extend::OCCLUDED, &lint::LINT].map(|pass| pass.module);
    let mut changed = false;
    for pass in TABLE.iter().filter(|pass| !aside.contains(&pass.module)) {
        changed |= old.link(pass.module, features)?.fingerprint() != new.link(pass.module, features)?.fingerprint();
    }
    Ok(changed)
}
