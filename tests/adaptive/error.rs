//! What adaptive films tell of their errors, and that only the mean of halves is right.

use lucerna::components::{Adaptive, Render, Sampler};
use lucerna::cpu::film::pixel_mean;
use lucerna::scene::SceneDescription;
use lucerna::stats::metrics::relative_mse;
use lucerna::stats::summary::{mean, variance};
use lucerna::stress::scenes::uneven::{mean_of_speckled, speckled};
use lucerna::systems::resources::Shot;

use super::{describe, open, trace};

/// Of no film that is compared with it.
const REFERENCE_SEED: u32 = 0x9e37_79b9;

const FILMS: u32 = 6;

#[test]
fn films_of_scenes_tell_their_true_error() {
    for name in ["cornell-box", "teapot"] {
        let mut engine = open(&describe(name, &[("film.size", "(32,32)")]));
        let reference = trace(&mut engine, |render| {
            (render.adaptive, render.seed, render.spp) = (Adaptive::Off, REFERENCE_SEED, 2048);
        });
        for (sampler, spp) in [(Sampler::Sobol, 32), (Sampler::Pcg, 64)] {
            let films = (0..FILMS).map(|seed| {
                let film = trace(&mut engine, |render| {
                    *render = Render { adaptive: Adaptive::On, seed, spp, sampler, ..*render };
                });
                (film.error.relmse, relative_mse(&film.rgb, &reference.rgb) - reference.error.relmse)
            });
            let (told, right): (Vec<f64>, Vec<f64>) = films.unzip();
            let (told, right) = (mean(&told), mean(&right));
            println!("{name}, {sampler:?}, {spp} spp: told {told:.2e}, true {right:.2e}, {:.2}", told / right);
            assert!((0.75..1.35).contains(&(told / right)), "{name}, {sampler:?}, {spp} spp: {:.2}", told / right);
        }
    }
}

/// The row `adaptive` of stress holds the mean of halves to the scene's. The mean of all samples by their number is another, for the values of each half
/// have settled how much the other would count.
#[test]
fn the_mean_of_all_samples_by_their_number_would_be_wrong() {
    const RUNS: u32 = 400;
    let scene = speckled();
    let render = Render { sampler: Sampler::Pcg, spp: 64, adaptive: Adaptive::On, ..scene.render };
    let mut engine = open(&SceneDescription { render, ..scene });
    let (mut by_halves, mut by_samples) = (Vec::new(), Vec::new());
    for seed in 0..RUNS {
        let film = trace(&mut engine, |render| render.seed = seed);
        let exponent = engine.read(|world| world.resource::<Shot>().exponent);
        by_halves.push(film.mean[0]);
        let all: Vec<f64> = film.pixels.iter().map(|pixel| pixel_mean(pixel, exponent).0[0]).collect();
        by_samples.push(mean(&all));
    }
    let z = |means: &[f64]| {
        let noise = (variance(means).unwrap() / f64::from(RUNS)).sqrt();
        (mean(means) - mean_of_speckled()) / noise
    };
    println!("by halves {:.1}, by samples {:.1} standard errors off", z(&by_halves), z(&by_samples));
    assert!(z(&by_halves).abs() < 4.0);
    assert!(z(&by_samples).abs() > 6.0);
}
