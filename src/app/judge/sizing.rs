//! How large films are to be, and of how many samples, by what a sample costs and the time there is. Pure numbers.

use glam::UVec2;

use crate::components::{Crop, Film};

/// Films of each that the time is to be enough for: three times the 64 that are wanted, since costs are estimates, and a machine
/// may come to be busier.
const FILMS: f64 = 192.0;

/// Samples a pixel that a film has before it becomes larger: as many as the sampler spreads evenly in a first round.
pub const FIRST_SPP: u32 = 4;

/// Samples a pixel of a film, at most, where the time chooses.
const MOST_SPP: f64 = 1024.0;

/// Pixels that the smallest film has at least: 32x32.
const LEAST_PIXELS: u64 = 32 * 32;

/// A film of a size that is not chosen is tried out where four of them take at most this part of the time.
const TRY_OUT: f64 = 1.0 / 16.0;

/// Pixels that are traced.
pub fn pixels(film: &Film) -> u64 {
    let size = film.window().size();
    u64::from(size.x) * u64::from(size.y)
}

/// The film itself and every half of it, the smallest first: each shows the same picture, in as many pixels as are left.
pub fn halved(film: Film) -> Vec<Film> {
    let mut films = vec![film];
    for exponent in 1..14 {
        let size = film.size.map(|side| side.div_ceil(1 << exponent));
        let crop = film
            .crop
            .map(|crop| Crop { min: crop.min >> exponent, max: crop.max.map(|side| side.div_ceil(1 << exponent)) });
        let half = Film { size, crop, ..film };
        if pixels(&half) < LEAST_PIXELS {
            break;
        }
        films.push(half);
    }
    films.reverse();
    films
}

/// Whether enough films of each fit into so many seconds. `cost` is what a sample of a pixel takes, seconds.
pub fn fits(film: &Film, spp: u32, cost: f64, seconds: f64) -> bool {
    2.0 * FILMS * pixels(film) as f64 * f64::from(spp) * cost <= seconds
}

/// Whether four films can be traced only to learn their cost.
pub fn is_cheap(film: &Film, spp: u32, cost: f64, seconds: f64) -> bool {
    4.0 * pixels(film) as f64 * f64::from(spp) * cost <= TRY_OUT * seconds
}

/// The largest power of two of samples a pixel of which enough films fit; 1 where none do.
pub fn spp(film: &Film, cost: f64, seconds: f64) -> u32 {
    let fit = seconds / (2.0 * FILMS * pixels(film) as f64 * cost.max(1e-15));
    1 << fit.clamp(1.0, MOST_SPP).log2().floor() as u32
}

/// A picture in other pixels, each the nearest there is.
pub fn resized(picture: &[[f32; 3]], from: UVec2, to: UVec2) -> Vec<[f32; 3]> {
    let near = |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(from) / u64::from(to.max(1))) as usize;
    let row = |y: u32| {
        let first = near(y, from.y, to.y) * from.x as usize;
        (0..to.x).map(move |x| picture[first + near(x, from.x, to.x)])
    };
    (0..to.y).flat_map(row).collect()
}
