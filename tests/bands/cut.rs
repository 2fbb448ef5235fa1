//! Where a film is cut: into whole rows, all of them once, as many as an array holds.

use glam::UVec2;
use lucerna::app::render::bands::Bands;
use lucerna::components::Crop;
use lucerna::layout::film::FilmPixel;

const PIXEL: u64 = size_of::<FilmPixel>() as u64;

fn window(min: [u32; 2], max: [u32; 2]) -> Crop {
    Crop { min: min.into(), max: max.into() }
}

/// All bands, from the top.
fn all(bands: Bands, window: Crop) -> Vec<Crop> {
    let mut found = Vec::new();
    let mut first = window.min.y;
    while let Some(band) = bands.band(first) {
        assert!(band.max.y > first, "a band without rows: {band:?}");
        first = band.max.y;
        found.push(band);
    }
    found
}

#[test]
fn what_fits_is_one_band() {
    let window = window([3, 5], [67, 69]);
    let bytes = 64 * 64 * PIXEL;
    assert_eq!(all(Bands::of(window, bytes), window), [window]);
    assert_eq!(all(Bands::of(window, u64::MAX), window), [window]);
    assert!(all(Bands::of(window, bytes - 1), window).len() > 1);
    // A film of a gigabyte is one band as well, where an array may have that.
    let large = Crop { min: UVec2::ZERO, max: UVec2::splat(4096) };
    assert_eq!(all(Bands::of(large, 1 << 30), large), [large]);
}

#[test]
fn bands_are_all_rows_once_and_fit() {
    for (min, max) in [([0, 0], [64, 64]), ([3, 5], [67, 70]), ([0, 7], [1, 8]), ([0, 0], [16_384, 16_384])] {
        let window = window(min, max);
        let row = u64::from(max[0] - min[0]) * PIXEL;
        for rows in [1, 2, 7, 8, 9, 16, 31, 64] {
            let most = rows * row;
            let bands = all(Bands::of(window, most), window);
            assert_eq!((bands[0].min, bands[bands.len() - 1].max), (window.min, window.max));
            for (band, next) in bands.iter().zip(&bands[1..]) {
                assert_eq!((band.max.y, band.min.x, band.max.x), (next.min.y, window.min.x, window.max.x));
                // Blocks of reused paths are not cut, where a whole one fits.
                assert!(rows < 8 || band.max.y.is_multiple_of(8), "{rows}: {band:?}");
            }
            assert!(bands.iter().all(|band| u64::from(band.size().y) * row <= most), "{rows}: {bands:?}");
            assert!(bands.len() as u64 <= u64::from(max[1] - min[1]).div_ceil(rows.saturating_sub(7).max(1)) + 1);
        }
    }
}

#[test]
fn an_array_of_no_row_still_has_one() {
    let window = window([0, 0], [64, 3]);
    assert_eq!(all(Bands::of(window, 1), window).len(), 3);
}

#[test]
fn bands_are_halved_down_to_a_row() {
    let window = window([0, 0], [64, 64]);
    let mut bands = Bands::of(window, u64::MAX);
    let mut heights = vec![64];
    while bands.halve() {
        heights.push(bands.band(0).unwrap().size().y);
        assert_eq!(all(bands, window).iter().map(|band| band.size().y).sum::<u32>(), 64);
    }
    assert_eq!(heights, [64, 32, 16, 8, 4, 2, 1]);
}
