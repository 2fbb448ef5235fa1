//! What adaptive films tell of their errors.

use lucerna::components::{Adaptive, Render, Sampler};
use lucerna::stats::metrics::relative_mse;
use lucerna::stats::summary::mean;

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
