//! A member in a race, and the engine that traces its films.

use std::time::Duration;

use bevy_ecs::change_detection::DetectChangesMut;
use glam::UVec2;

use crate::app::shared::key::scene_key;
use crate::app::variants::code::Codes;
use crate::app::variants::stage::Stage;
use crate::app::variants::survey::{Subject, Survey};
use crate::app::variants::watcher::Watcher;
use crate::components::Render;
use crate::engine::EngineError;
use crate::stats::blocks::Grid;
use crate::stats::efficiency::{pair_error, weights};
use crate::stats::equal_means::MeansTest;

/// Tracing between two polls of signals.
const STEP: Duration = Duration::from_millis(100);

/// Probability that a member of equal means is called wrong.
const ALPHA: f64 = 1e-3;

/// Mean radiance of a film's pixels, and what it took.
pub struct Shot {
    pub radiance: Vec<[f32; 3]>,
    /// Of tracing.
    pub seconds: f64,
    pub rays: u64,
    pub bad_samples: u64,
}

/// A member.
pub struct Racer<'s> {
    pub subject: &'s Subject,
    /// Its number in the family.
    pub index: usize,
    /// Of what its picture is to be, whatever estimates it.
    pub picture_key: String,
    /// Of the squared errors of pixels, so that every block counts alike.
    pub weights: Vec<[f32; 3]>,
    /// The same, of a relMSE.
    plain: Vec<[f32; 3]>,
    /// Sum of the relMSE of one film, over pairs of them.
    relmse: f64,
    /// What is wrong with it.
    pub error: Option<String>,
    /// All films, summed.
    sum: Vec<[f64; 3]>,
    films: u32,
    /// Samples a pixel, seconds, rays, and samples that were no numbers, of all of them.
    pub spp: u32,
    pub seconds: f64,
    pub rays: u64,
    pub bad_samples: u64,
    means: Option<MeansTest>,
    /// The member that its means were compared with last.
    compared_with: usize,
}

impl<'s> Racer<'s> {
    /// The member of a number; none where it is broken, or is the reference's own film.
    pub fn new(survey: &'s Survey, index: usize) -> Option<Self> {
        let subject = survey.found[index].as_ref().ok().filter(|subject| !subject.is_reference)?;
        Some(Self {
            subject,
            index,
            picture_key: scene_key(&subject.description),
            weights: Vec::new(),
            plain: Vec::new(),
            relmse: 0.0,
            error: None,
            sum: Vec::new(),
            films: 0,
            spp: 0,
            seconds: 0.0,
            rays: 0,
            bad_samples: 0,
            means: None,
            compared_with: index,
        })
    }

    pub fn name(&self) -> &str {
        &self.subject.member.name
    }

    /// Pixels of a film.
    pub fn size(&self) -> UVec2 {
        self.subject.description.film.window().size()
    }

    /// Makes squared errors relative, by films that do not count.
    pub fn weigh(&mut self, pair: &[Shot; 2]) {
        self.weights = weights(&pair[0].radiance, &pair[1].radiance);
        self.plain = self.weights.clone();
    }

    /// Films that count begin.
    pub fn begin(&mut self, grid: Grid) {
        self.sum = vec![[0.0; 3]; self.weights.len()];
        self.means = Some(MeansTest::new(grid, ALPHA));
    }

    /// Squared relative error of every block.
    pub fn block_errors(&self, pair: &[Shot; 2], block_of: &[usize], count: usize) -> Vec<f64> {
        let (mut errors, mut channels) = (vec![0.0; count], vec![0.0; count]);
        let films = pair[0].radiance.iter().zip(&pair[1].radiance).zip(&self.weights);
        for (((x, y), weight), block) in films.zip(block_of) {
            for c in 0..3 {
                errors[*block] += 0.5 * (f64::from(x[c]) - f64::from(y[c])).powi(2) * f64::from(weight[c]);
                channels[*block] += 1.0;
            }
        }
        errors.iter().zip(channels).map(|(error, channels)| error / f64::max(channels, 1.0)).collect()
    }

    /// Two films that count.
    pub fn add(&mut self, pair: &[Shot; 2], spp: u32) {
        self.relmse += pair_error(&pair[0].radiance, &pair[1].radiance, &self.plain);
        for shot in pair {
            for (sum, pixel) in self.sum.iter_mut().zip(&shot.radiance) {
                *sum = std::array::from_fn(|c| sum[c] + f64::from(pixel[c]));
            }
            self.films += 1;
            self.spp += spp;
            self.seconds += shot.seconds;
            self.rays += shot.rays;
            self.bad_samples += shot.bad_samples;
        }
    }

    /// Two films of another member of the same picture, by its number in the race, and two of this one.
    pub fn compare(&mut self, other: usize, old: &[Shot; 2], new: &[Shot; 2]) {
        self.compared_with = other;
        if let Some(means) = &mut self.means {
            for (old, new) in old.iter().zip(new) {
                means.add(&old.radiance, &new.radiance);
            }
        }
    }

    /// The member that it was compared with, if its mean is another. Each look spends part of [`ALPHA`].
    pub fn differs(&mut self) -> Option<usize> {
        let differs = self.means.as_mut().is_some_and(|means| means.tells() && means.look().differ());
        differs.then_some(self.compared_with)
    }

    /// Films that count.
    pub fn films(&self) -> u32 {
        self.films
    }

    /// relMSE of the mean of all films.
    pub fn relmse(&self) -> f64 {
        let films = f64::from(self.films.max(1));
        self.relmse / (0.5 * films) / films
    }

    /// Mean radiance of all films; none before the first.
    pub fn picture(&self) -> Option<Vec<[f32; 3]>> {
        let films = f64::from(self.films);
        (self.films > 0).then(|| self.sum.iter().map(|sum| sum.map(|channel| (channel / films) as f32)).collect())
    }
}

/// Traces films of members, each of a seed that no other has.
pub struct Shooter<'s> {
    stage: Stage,
    codes: &'s Codes,
    watcher: &'s Watcher,
    begun: u32,
}

impl<'s> Shooter<'s> {
    pub fn new(stage: Stage, codes: &'s Codes, watcher: &'s Watcher) -> Self {
        Self { stage, codes, watcher, begun: 0 }
    }

    /// Two films; none after a signal.
    pub fn pair(&mut self, racer: &Racer, spp: u32) -> Result<Option<[Shot; 2]>, EngineError> {
        let Some(first) = self.film(racer, spp)? else { return Ok(None) };
        Ok(self.film(racer, spp)?.map(|second| [first, second]))
    }

    /// A film; none after a signal.
    pub fn film(&mut self, racer: &Racer, spp: u32) -> Result<Option<Shot>, EngineError> {
        // An odd factor: all multiples modulo 2^32 differ.
        let seed = racer.subject.description.render.seed.wrapping_add(self.begun.wrapping_mul(0x9e37_79b9));
        self.begun = self.begun.wrapping_add(1);
        let render = Render { seed, spp, ..racer.subject.description.render };
        self.stage.put(self.codes, racer.subject, render)?;
        let engine = &mut self.stage.engine;
        engine.edit(|world| {
            for mut held in world.query::<&mut Render>().iter_mut(world) {
                held.set_if_neq(render);
            }
        });
        while !engine.step(STEP)?.finished {
            if self.watcher.interrupt.requested() {
                return Ok(None);
            }
        }
        let report = engine.report()?;
        let (seconds, radiance) = (engine.film_seconds(), engine.radiance()?);
        let stopped = self.watcher.interrupt.requested();
        let shot = Shot { radiance, seconds, rays: report.rays, bad_samples: report.bad_samples };
        Ok(Some(shot).filter(|_| !stopped))
    }

    pub fn round_is_over(&self) {
        self.watcher.end();
    }
}
