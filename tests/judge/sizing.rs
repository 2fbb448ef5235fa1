//! How large the judge's films are, and of how many samples.

use glam::UVec2;
use lucerna::app::judge::sizing::{FIRST_SPP, fits, halved, pixels, resized, spp};
use lucerna::components::{Crop, Film};

fn film(x: u32, y: u32) -> Film {
    Film { size: UVec2::new(x, y), ..Film::default() }
}

#[test]
fn films_are_halved_down_to_a_thousand_pixels_and_keep_their_shape() {
    let sizes = |film: Film| halved(film).iter().map(|film| film.size.to_array()).collect::<Vec<_>>();
    assert_eq!(sizes(film(512, 512)), [[32, 32], [64, 64], [128, 128], [256, 256], [512, 512]]);
    assert_eq!(sizes(film(192, 144)), [[48, 36], [96, 72], [192, 144]]);
    assert_eq!(sizes(film(24, 24)), [[24, 24]]);
    assert_eq!(sizes(film(1, 1)), [[1, 1]]);
    for (x, y) in [(16_384, 16_384), (16_384, 1), (1000, 7), (1921, 1081)] {
        let films = halved(film(x, y));
        assert_eq!(films.last(), Some(&film(x, y)));
        assert!(pixels(&films[0]) < 5 << 10 && films.iter().all(|film| film.size.min_element() > 0), "{x}x{y}");
    }
}

#[test]
fn a_crop_stays_where_it_is() {
    for crop in [[0, 0, 512, 512], [100, 200, 300, 512], [511, 511, 512, 512], [0, 3, 512, 4]] {
        let [x0, y0, x1, y1] = crop;
        let crop = Crop { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) };
        for (exponent, half) in halved(Film { crop: Some(crop), ..film(512, 512) }).iter().rev().enumerate() {
            let (scale, window) = (1u32 << exponent, half.window());
            assert!(window.max.cmple(half.size).all() && window.min.cmplt(window.max).all(), "{window:?}");
            assert!((window.min * scale).cmple(crop.min).all() && (window.max * scale).cmpge(crop.max).all());
        }
    }
}

/// Whatever a sample costs: films are large and of many samples where the time is enough for 192 of each, and of one sample where
/// it is not.
#[test]
fn the_time_is_enough_for_what_is_chosen() {
    for exponent in -10..=-2 {
        let cost = 10f64.powi(exponent);
        for seconds in [1.0, 10.0, 30.0, 3600.0] {
            let films = halved(film(512, 512));
            let chosen = films.iter().rev().find(|film| fits(film, FIRST_SPP, cost, seconds)).unwrap_or(&films[0]);
            let samples = spp(chosen, cost, seconds);
            let taken = 192.0 * pixels(chosen) as f64 * f64::from(samples) * cost;
            assert!(samples == 1 || taken <= seconds, "{samples} spp of {chosen:?}");
            assert!(samples.is_power_of_two() && (samples == 1024 || 4.0 * taken > seconds), "{samples} of {chosen:?}");
        }
    }
}

#[test]
fn a_resized_picture_shows_the_same() {
    let picture: Vec<[f32; 3]> = (0..6).map(|i| [i as f32; 3]).collect();
    let reds = |to: UVec2| resized(&picture, UVec2::new(3, 2), to).iter().map(|pixel| pixel[0]).collect::<Vec<_>>();
    assert_eq!(reds(UVec2::new(3, 2)), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(reds(UVec2::new(6, 2)), [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 5.0, 5.0]);
    assert_eq!(reds(UVec2::new(1, 1)), [0.0]);
}
