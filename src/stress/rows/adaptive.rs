//! The mean of adaptive films, over many short ones.

use crate::components::{Adaptive, Render, Sampler};
use crate::scene::SceneDescription;
use crate::stats::summary::{mean, variance};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::uneven::{mean_of_speckled, speckled};
use crate::stress::tools::films::film_of_seed;

pub static ROW: Row = Row {
    name: "adaptive",
    holds: "the mean of a thousand short adaptive films is that of the scene, though samples are rare and bright",
    quantity: "standard errors from the exact mean",
    most: 4.0,
    unit: "films",
    sizes: [1_000, 2_000, 6_000],
    measure,
};

/// Samples a pixel: few beyond those that say where they go.
const SPP: u32 = 64;

/// A standard error of the mean above this part of it proves nothing.
const MOST_NOISE: f64 = 3e-4;

/// Films between two words about how far the row is. A film is some ten steps that each wait for the device, whatever that is.
const TOLD: u32 = 10;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let right = mean_of_speckled();
    let mut all = Measured::new(0.0, 0);
    let samplers = [Sampler::Pcg, Sampler::Sobol];
    let films = size.div_ceil(samplers.len() as u64) as u32;
    for (k, sampler) in samplers.into_iter().enumerate() {
        let plain = speckled();
        let render = Render { sampler, spp: SPP, adaptive: Adaptive::On, ..plain.render };
        let mut engine = lab.engine(&SceneDescription { render, ..plain })?;
        let mut means = Vec::new();
        for seed in 0..films {
            means.push(film_of_seed(&mut engine, seed)?.mean[0]);
            if seed % TOLD == 0 {
                lab.tell(k as u64 * u64::from(films) + u64::from(seed), samplers.len() as u64 * u64::from(films));
            }
        }
        let off = mean(&means) - right;
        let noise = (variance(&means).unwrap_or(f64::NAN) / f64::from(films)).sqrt();
        let note = format!(
            "{sampler:?}: {:.4} % off, with a standard error of {:.4} %",
            1e2 * off / right,
            1e2 * noise / right
        );
        let doubt = (noise > MOST_NOISE * right).then(|| "too much noise".to_owned());
        all = all.worst(Measured { doubt, ..Measured::new(off.abs() / noise, films.into()).noted(note) });
    }
    Ok(all)
}
