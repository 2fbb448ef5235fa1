//! A lamp whose edge covers little of the pixels that it runs through: one half of such a pixel has met it, the other has not.

use glam::UVec2;
use lucerna::cpu::film::pixel_mean;
use lucerna::cpu::film_error::{Place, film_error};
use lucerna::layout::film::FilmPixel;
use lucerna::scene::generate::SplitMix;
use lucerna::stats::summary::mean;

use super::model::{EXPONENT, pixel_of};

const SIDE: usize = 48;
const SPP: usize = 44;

/// Radiance of the lamp, and of what is around.
const LAMP: f64 = 17.0;
const AROUND: f64 = 0.1;

/// How much of a pixel of the lamp's edge the lamp covers.
const COVERED: f64 = 0.04;

/// Part of a pixel that the lamp covers.
fn covered(at: usize) -> f64 {
    let (x, y) = (at % SIDE, at / SIDE);
    match ((12..36).contains(&x), y) {
        (true, 15) => COVERED,
        (true, 16..20) => 1.0,
        _ => 0.0,
    }
}

fn truth(at: usize) -> f64 {
    AROUND + covered(at) * (LAMP - AROUND)
}

/// Samples are spread evenly, so a half has met the lamp as often as it should have, or once more; what is around is noisy by a tenth.
fn pixel(at: usize, random: &mut SplitMix) -> FilmPixel {
    let met = [0, 1].map(|_| (SPP as f64 / 2.0 * covered(at) + random.unit()) as usize);
    let sample = |number: usize| if number / 2 < met[number % 2] { LAMP } else { AROUND * random.range(0.9, 1.1) };
    pixel_of(&(0..SPP).map(sample).map(|value| [value; 3]).collect::<Vec<_>>())
}

#[test]
fn slivers_of_a_lamp_are_measured_by_those_beside_them() {
    let films = (0..40).map(|seed| {
        let mut random = SplitMix(seed);
        let film: Vec<FilmPixel> = (0..SIDE * SIDE).map(|at| pixel(at, &mut random)).collect();
        let told = film_error(&film, Place { min: UVec2::ZERO, width: SIDE }, EXPONENT);
        let error = |(at, pixel): (usize, &FilmPixel)| {
            (pixel_mean(pixel, EXPONENT).0[0] - truth(at)).powi(2) / (truth(at).powi(2) + 0.01)
        };
        (told, film.iter().enumerate().map(error).sum::<f64>() / film.len() as f64)
    });
    let films: Vec<_> = films.collect();
    let told = mean(&films.iter().map(|(told, _)| told.relmse).collect::<Vec<_>>());
    let right = mean(&films.iter().map(|(_, right)| *right).collect::<Vec<_>>());
    let above = films.iter().filter(|(told, right)| *right > told.bound).count();
    println!("told by true {:.2}, {above} of 40 above the bound", told / right);
    // Measured by themselves, such pixels tell seven times their error.
    assert!((0.8..2.5).contains(&(told / right)), "told by true {:.2}", told / right);
    assert!(above < 6, "{above} of 40 above the bound");
}
