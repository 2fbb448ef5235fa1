//! Films of one size and of as many samples each, by both estimators: what is compared with each other.

use super::side::Shot;
use super::sizing::pixels;
use crate::components::Film;
use crate::stats::blocks::Grid;
use crate::stats::efficiency::{Ratio, Trial, averages, pair_error, weights};
use crate::stats::equal_means::{Means, MeansTest, block_side};

/// Two films of each, traced by turns, so that a drift of the clock is the same for both.
pub struct Round {
    pub old: [Shot; 2],
    pub new: [Shot; 2],
}

/// What is known of one estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    /// Of one film.
    pub relmse: f64,
    /// Of tracing one film.
    pub seconds: f64,
}

pub struct Series {
    pub film: Film,
    /// Samples a pixel.
    pub spp: u32,
    /// Of the pixels' squared errors, by other films: what counts is independent of them.
    weights: Vec<[f32; 3]>,
    test: MeansTest,
    trials: Vec<Trial>,
    /// Films of each, summed; the old one first.
    sums: [Vec<[f32; 3]>; 2],
    /// Wall clock of all that was added.
    pub seconds: f64,
}

impl Series {
    /// `pilot` is a picture by each, in the film's pixels; `alpha` is the probability of any false alarm.
    pub fn new(film: Film, spp: u32, pilot: &[Vec<[f32; 3]>; 2], alpha: f64) -> Self {
        let size = film.window().size();
        let weights = weights(&pilot[0], &pilot[1]);
        let sums = [0, 1].map(|_| vec![[0.0; 3]; weights.len()]);
        let test = MeansTest::new(Grid::new(size, block_side(size)), alpha);
        Self { film, spp, weights, test, trials: Vec::new(), sums, seconds: 0.0 }
    }

    /// Films of each.
    pub fn films(&self) -> usize {
        2 * self.trials.len()
    }

    /// Whether there are films enough to say anything of means.
    pub fn tells(&self) -> bool {
        self.test.tells()
    }

    /// What analyses have left of alpha.
    pub fn alpha_left(&self) -> f64 {
        self.test.alpha_left()
    }

    pub fn add(&mut self, Round { old, new }: &Round) {
        self.test.add(&old[0].radiance, &new[0].radiance);
        self.test.add(&old[1].radiance, &new[1].radiance);
        let error = |[x, y]: &[Shot; 2]| pair_error(&x.radiance, &y.radiance, &self.weights);
        let seconds = |[x, y]: &[Shot; 2]| 0.5 * (x.seconds + y.seconds);
        self.trials.push(Trial { relmse: [error(old), error(new)], seconds: [seconds(old), seconds(new)] });
        for (sums, films) in self.sums.iter_mut().zip([old, new]) {
            for film in films {
                let sums = sums.as_flattened_mut().iter_mut();
                sums.zip(film.radiance.as_flattened()).for_each(|(sum, value)| *sum += value);
            }
        }
    }

    /// Spends part of alpha.
    pub fn analyse(&mut self) -> Means {
        self.test.look()
    }

    /// Efficiency of the new by that of the old; `None` where films have no noise, or there are fewer than four.
    pub fn ratio(&self) -> Option<Ratio> {
        Ratio::of(&self.trials)
    }

    /// The old one first.
    pub fn estimators(&self) -> [Estimator; 2] {
        [0, 1].map(|which| {
            let (relmse, seconds) = averages(&self.trials, which);
            Estimator { relmse, seconds }
        })
    }

    /// Mean radiance of all films by the old and by the new shaders, row by row from the top of the window.
    pub fn pictures(&self) -> [Vec<[f32; 3]>; 2] {
        let films = self.films().max(1) as f32;
        self.sums.each_ref().map(|sums| sums.iter().map(|sum| sum.map(|channel| channel / films)).collect())
    }

    /// What a sample of a pixel took, with all that is done about it, seconds.
    pub fn cost(&self) -> f64 {
        let samples = 2.0 * self.films() as f64 * f64::from(self.spp) * pixels(&self.film) as f64;
        self.seconds / samples.max(1.0)
    }
}
