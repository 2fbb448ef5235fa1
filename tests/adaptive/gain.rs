//! What adaptive films save, where one half of the picture is easy and the other hard.

use glam::UVec2;
use lucerna::components::Adaptive;
use lucerna::stats::metrics::relative_mse;
use lucerna::stats::summary::mean;
use lucerna::stress::scenes::uneven::half_hard;

use super::{open, trace};

const SIDE: u32 = 64;
const SPP: u32 = 192;
const FILMS: u32 = 4;

/// Of no film that is compared with it.
const REFERENCE_SEED: u32 = 0x9e37_79b9;

/// Errors fall as 1 / samples, and so as 1 / rays: by so much rays are fewer for the same error, by how much error times rays is less.
#[test]
fn an_easy_and_a_hard_half_take_far_fewer_rays() {
    let mut engine = open(&half_hard(UVec2::splat(SIDE)));
    let reference = trace(&mut engine, |render| (render.seed, render.spp) = (REFERENCE_SEED, 40 * SPP));
    let mut of = |adaptive: Adaptive| {
        let films = (0..FILMS).map(|seed| {
            let film = trace(&mut engine, |render| {
                (render.seed, render.spp, render.adaptive) = (seed, SPP, adaptive);
            });
            let error = relative_mse(&film.rgb, &reference.rgb) - reference.error.relmse;
            (error, film.error.relmse, engine.report().unwrap().rays as f64)
        });
        let films: Vec<(f64, f64, f64)> = films.collect();
        let column = |of: fn(&(f64, f64, f64)) -> f64| mean(&films.iter().map(of).collect::<Vec<_>>());
        (column(|film| film.0), column(|film| film.1), column(|film| film.2))
    };
    let (plain, adaptive) = (of(Adaptive::Off), of(Adaptive::On));
    let fewer = plain.0 * plain.2 / (adaptive.0 * adaptive.2);
    println!("relMSE, told, rays: plain {plain:?}, adaptive {adaptive:?}: {fewer:.2} times fewer rays");
    assert!(fewer > 1.6, "{fewer:.2} times fewer rays");
    assert!((0.8..1.25).contains(&(adaptive.1 / adaptive.0)), "told {:.2e}, true {:.2e}", adaptive.1, adaptive.0);
}
