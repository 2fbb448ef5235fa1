//! The parts add up to the error that the film itself has: as two films tell it, one of which goes on where the other ends.

use lucerna::FilmImage;
use lucerna::cpu::sources::Way;
use lucerna::layout::film::FilmPixel;
use lucerna::systems::resources::Shot;

use super::{open, scene_with, surveyed};

/// Sums of a half of a pixel, and samples in them.
fn half(pixel: &FilmPixel, half: usize) -> ([f64; 3], f64) {
    let half = &pixel.halves[half];
    (half.sum.map(|sum| (u64::from(sum.y) << 32 | u64::from(sum.x)) as f64), f64::from(half.count))
}

/// The relMSE of the samples that the longer film has more, by the shorter one's radiance: of what their two halves differ by.
fn difference(short: &FilmImage, long: &FilmImage, exponent: i32) -> f64 {
    let mut sum = 0.0;
    for (pixel, more) in short.pixels.iter().zip(&long.pixels) {
        let [(a, m), (b, n)] = [half(pixel, 0), half(pixel, 1)];
        let means = [0, 1].map(|h| {
            let ((before, count), (after, more)) = (half(pixel, h), half(more, h));
            [0, 1, 2].map(|c| (after[c] - before[c]) / (more - count) * 2f64.powi(-exponent))
        });
        for c in 0..3 {
            let radiance = (a[c] + b[c]) / (m + n) * 2f64.powi(-exponent);
            sum += (0.5 * (means[0][c] - means[1][c])).powi(2) / (radiance * radiance + 0.01);
        }
    }
    sum / (3 * short.pixels.len()) as f64
}

#[test]
fn the_parts_add_up_to_what_two_films_differ_by() {
    let crop = ("film.crop", "(5, 37, 3, 27)");
    for (name, defines) in [
        ("cornell-data", &[][..]),
        ("glass", &[("render.sampler", "Pcg"), crop]),
        ("cornell-box", &[("render.reuse", "Tiles"), crop]),
        ("dining-room", &[("render.max_depth", "5")]),
    ] {
        let with = |spp: &'static str| {
            let all: Vec<_> = [("film.size", "(48, 32)"), ("render.spp", spp)].iter().chain(defines).copied().collect();
            scene_with(name, &all)
        };
        let mut engine = open(&with("32"));
        let short = engine.film().unwrap();
        let exponent = engine.read(|world| world.resource::<Shot>().exponent);
        let (survey, sources) = surveyed(&mut engine);
        let long = open(&with("64")).film().unwrap();
        let right = difference(&short, &long, exponent);
        assert_eq!((sources.samples, sources.pixels), (32, short.pixels.len() as u64));
        assert!(right > 0.0 && (sources.relmse / right - 1.0).abs() < 1e-4, "{name}: {} {right}", sources.relmse);
        for parts in [
            sources.ways.iter().map(|(_, share)| share.share).sum::<f64>(),
            sources.by_bounce.iter().map(|(_, share)| share.share).sum::<f64>(),
            sources.by_way.iter().map(|(_, share)| share.share).sum(),
            sources.by_light.iter().map(|(_, share)| share.share).sum(),
            sources.by_surface.iter().map(|(_, share)| share.share).sum(),
        ] {
            assert!((parts - 1.0).abs() < 1e-9, "{name}: {parts}");
        }
        let pixels: f64 = survey.map().pixels.iter().map(|pixel| pixel.error).sum();
        assert!((pixels / (3.0 * sources.pixels as f64) / sources.relmse - 1.0).abs() < 1e-9, "{name}");
        assert_eq!(sources.by_way.iter().any(|((way, _), _)| *way == Way::Reused), name == "cornell-box");
        assert_eq!(sources.dropped, 0);
    }
}
