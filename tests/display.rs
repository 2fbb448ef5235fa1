//! The film as a picture, against its twin.

use glam::{UVec2, Vec3};
use lucerna::cpu::display::{display, error};
use lucerna::cpu::film::fixed_point;
use lucerna::cpu::tone::toned;
use lucerna::gpu::Runtime;
use lucerna::image::srgb::{srgb_byte, srgb_encode};
use lucerna::layout::film::{DisplayParams, FilmHalf, FilmPixel, TONE_AGX, TONE_NEUTRAL, TONE_NONE};
use lucerna::passes::Recording;
use lucerna::passes::film::{self, Look};
use lucerna::passes::lattice::{COARSEST, Lattice, corners};

use crate::support;
use crate::support::dice::Dice;

/// A film whose halves hold `counts` samples of mean `rgb`.
fn pixel(rgb: Vec3, counts: [u32; 2], exponent: i32) -> FilmPixel {
    let half = |count: u32| FilmHalf {
        sum: rgb.to_array().map(|v| {
            let sum = fixed_point(v, exponent).unwrap() * u64::from(count);
            UVec2::new(sum as u32, (sum >> 32) as u32)
        }),
        count,
        bad: 0,
    };
    FilmPixel { halves: counts.map(half) }
}

/// Of a film of one row whose pixels are all there.
fn params(pixels: u32, exponent: i32, exposure: f32) -> DisplayParams {
    let look = Look { exposure, ..Look::default() };
    film::display_params(UVec2::new(pixels, 1), Lattice::default(), exponent, look)
}

fn picture(rig: &mut Runtime, pixels: &[FilmPixel], exponent: i32, exposure: f32) -> Vec<u32> {
    rig.upload("film", pixels).unwrap();
    rig.upload("picture", &vec![0u32; pixels.len()]).unwrap();
    let mut recording = Recording::default();
    film::record_display(&mut recording, &params(pixels.len() as u32, exponent, exposure));
    rig.play(&recording).unwrap();
    rig.read_some("picture", pixels.len()).unwrap()
}

/// Greatest difference of two pictures' channels, and how many words differ.
fn compare(a: &[u32], b: &[u32]) -> (u8, usize) {
    let bytes = a.iter().flat_map(|w| w.to_le_bytes()).zip(b.iter().flat_map(|w| w.to_le_bytes()));
    (bytes.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0), a.iter().zip(b).filter(|(a, b)| a != b).count())
}

#[test]
fn every_size_equals_the_twin() {
    let mut rig = support::rig();
    for count in [1u32, 3, 15, 255, 256, 257, 5000] {
        for (exponent, exposure) in [(40, 0.0), (40, 2.5), (37, -1.0), (-70, -100.0), (110, 70.0)] {
            let film: Vec<_> = (0..count)
                .map(|i| {
                    let v = (i as f32 + 0.5) / count as f32 * 2f32.powi(40 - exponent);
                    pixel(Vec3::new(v, 0.5 * v, 1.5 * v), [i % 3, 1 + i % 2], exponent)
                })
                .collect();
            let got = picture(&mut rig, &film, exponent, exposure);
            let right = display(&film, &params(count, exponent, exposure));
            // A value within a rounding of a code's edge may fall on either side: 1 code, in f32 about 1 in 5,000.
            let (most, words) = compare(&got, &right);
            assert!(most <= 1 && words <= 2 + count as usize / 500, "{count} at {exposure}: {words} words, by {most}");
        }
    }
}

#[test]
fn codes_are_those_of_srgb() {
    let mut rig = support::rig();
    // Every code's own linear value comes back as that code, and 18 % grey is 118.
    let linear = |code: u32| {
        let e = f64::from(code) / 255.0;
        (if e <= 0.04045 { e / 12.92 } else { ((e + 0.055) / 1.055).powf(2.4) }) as f32
    };
    let film: Vec<_> = (0..256).map(|code| pixel(Vec3::splat(linear(code)), [1, 1], 40)).collect();
    let got = picture(&mut rig, &film, 40, 0.0);
    assert!(got.iter().zip(0u32..).all(|(&word, code)| word == 0xff00_0000 | (code * 0x01_0101)), "{got:x?}");
    assert_eq!((srgb_encode(0.18) * 255.0).round(), 118.0);
    // Brighter than white is white, a pixel without samples black, and a stop doubles.
    let film = [pixel(Vec3::splat(7.0), [3, 2], 40), FilmPixel::default(), pixel(Vec3::splat(0.25), [1, 0], 40)];
    let got = picture(&mut rig, &film, 40, 2.0);
    assert_eq!(got, [0xffff_ffff, 0xff00_0000, 0xffff_ffff]);
}

#[test]
fn each_corner_is_spread_over_its_block() {
    let mut rig = support::rig();
    // What is no corner is red, and never seen.
    let red = pixel(Vec3::new(1.0, 0.0, 0.0), [1, 0], 40);
    for size in [UVec2::new(37, 21), UVec2::new(16, 16), UVec2::new(1, 50), UVec2::new(300, 2)] {
        for level in 0..=COARSEST {
            let shift = corners(level).shift;
            let place = |i: u32| UVec2::new(i % size.x, i / size.x);
            let grey = |at: UVec2| Vec3::new(0.0, at.x as f32 / 400.0, at.y as f32 / 60.0);
            let is_corner = |at: UVec2| (at >> shift) << shift == at;
            let film: Vec<_> = (0..size.x * size.y)
                .map(|i| if is_corner(place(i)) { pixel(grey(place(i)), [1, 0], 40) } else { red })
                .collect();
            rig.upload("film", &film).unwrap();
            rig.upload("picture", &vec![0u32; film.len()]).unwrap();
            let params = film::display_params(size, corners(level), 40, Look::default());
            let mut recording = Recording::default();
            film::record_display(&mut recording, &params);
            rig.play(&recording).unwrap();
            let got: Vec<u32> = rig.read_some("picture", film.len()).unwrap();
            assert!(got.iter().all(|word| word & 0xff == 0), "{size} at level {level}");
            let whole: Vec<_> =
                (0..size.x * size.y).map(|i| pixel(grey((place(i) >> shift) << shift), [1, 0], 40)).collect();
            let right = picture(&mut rig, &whole, 40, 0.0);
            assert_eq!(got, right, "{size} at level {level}");
            assert!(compare(&got, &display(&film, &params)).0 <= 1);
        }
    }
}

/// A grey ramp and strong colours, from far below to far above white.
fn lights() -> Vec<Vec3> {
    let hues = [Vec3::ONE, Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, 0.3, 0.05), Vec3::new(0.02, 0.6, 1.0)];
    (-10..=16).flat_map(|stops| hues.map(|hue| hue * 2f32.powf(0.5 * stops as f32))).collect()
}

#[test]
fn tone_curves_equal_the_twin_and_none_is_what_it_was() {
    let mut rig = support::rig();
    let film: Vec<_> = lights().into_iter().map(|light| pixel(light, [1, 1], 40)).collect();
    let count = film.len() as u32;
    let mut pictures = Vec::new();
    for tone in [TONE_NONE, TONE_AGX, TONE_NEUTRAL] {
        for exposure in [0.0, -3.0, 60.0] {
            let look = Look { exposure, tone };
            let params = film::display_params(UVec2::new(count, 1), Lattice::default(), 40, look);
            rig.upload("film", &film).unwrap();
            rig.upload("picture", &vec![0u32; film.len()]).unwrap();
            let mut recording = Recording::default();
            film::record_display(&mut recording, &params);
            rig.play(&recording).unwrap();
            let got: Vec<u32> = rig.read_some("picture", film.len()).unwrap();
            // The curves are in f32 there: a value near a code's edge may fall on either side.
            let (most, words) = compare(&got, &display(&film, &params));
            assert!(most <= 1 && words <= film.len() / 10, "{look:?}: {words} words, by {most}");
            // So bright that all of it is white.
            if exposure < 60.0 {
                pictures.push(got);
            }
        }
    }
    let plain = |light: &Vec3| light.to_array().map(|v| u32::from(srgb_byte(v.into())));
    let word = |[r, g, b]: [u32; 3]| 0xff00_0000 | b << 16 | g << 8 | r;
    let (most, words) = compare(&pictures[0], &lights().iter().map(plain).map(word).collect::<Vec<_>>());
    assert!(most <= 1 && words <= 2, "without a curve: {words} words, by {most}");
    for (i, a) in pictures.iter().enumerate() {
        for b in &pictures[..i] {
            assert!(compare(a, b).1 > film.len() / 4, "two of the pictures are the same");
        }
    }
}

#[test]
fn tone_curves_are_what_their_sources_say() {
    let grey = |v: f64, tone| toned([v; 3], tone)[0];
    for tone in [TONE_AGX, TONE_NEUTRAL] {
        // Grey stays grey, black is black, brighter is never darker, and nothing is brighter than white.
        let ramp: Vec<[f64; 3]> = (-60..60).map(|stops| toned([2f64.powf(0.25 * f64::from(stops)); 3], tone)).collect();
        assert!(ramp.iter().all(|[r, g, b]| (r - g).abs() < 1e-3 && (g - b).abs() < 1e-3), "{tone}");
        assert!(
            ramp.is_sorted_by(|a, b| a[1] <= b[1] + 1e-12) && ramp[119][1] < 1.001 && ramp[119][1] > 0.99,
            "{tone}"
        );
        assert!(grey(0.0, tone).abs() < 1e-3 && grey(f64::INFINITY, tone) > 0.99, "{tone}");
    }
    // AgX leaves middle grey, 0.18, near a display's; and 16.5 stops fit: what is 4 above it is not yet white.
    assert!((0.18..0.23).contains(&grey(0.18, TONE_AGX)), "{}", grey(0.18, TONE_AGX));
    assert!((0.75..0.9).contains(&grey(0.18 * 16.0, TONE_AGX)), "{}", grey(0.18 * 16.0, TONE_AGX));
    // A blue light that is strong fades to white instead of staying blue.
    let blue = toned([0.0, 0.0, 50.0], TONE_AGX);
    assert!(blue[0] > 0.3 && blue[1] > 0.3, "{blue:?}");
    // Neutral takes off the reflection of dielectrics, 0.04, below 0.8 and compresses above, by the specification's own formula at 2.
    assert!((grey(0.5, TONE_NEUTRAL) - 0.46).abs() < 1e-12 && (grey(0.8, TONE_NEUTRAL) - 0.76).abs() < 1e-12);
    assert!((grey(2.0, TONE_NEUTRAL) - (1.0 - 0.24f64.powi(2) / (1.96 + 1.0 - 1.52))).abs() < 1e-12);
    // A saturated colour below it keeps its hue exactly.
    let [r, g, b] = toned([0.6, 0.3, 0.2], TONE_NEUTRAL);
    assert!((r - 0.56).abs() < 1e-12 && (g - 0.26).abs() < 1e-12 && (b - 0.16).abs() < 1e-12);
}

/// What the two halves say of a picture's error is what it is.
#[test]
fn the_error_of_a_picture_is_told_by_its_halves() {
    let (size, light) = (UVec2::new(256, 256), 0.2);
    let mut dice = Dice(5);
    let mut noisy = |spread: f64| -> Vec<FilmPixel> {
        let mut half = || pixel(Vec3::splat((light + spread * (dice.unit() - 0.5)) as f32), [1, 0], 40).halves[0];
        (0..size.x * size.y).map(|_| FilmPixel { halves: [half(), half()] }).collect()
    };
    for (exposure, tone) in [(0.0, TONE_NONE), (1.0, TONE_AGX)] {
        let params = film::display_params(size, Lattice::default(), 40, Look { exposure, tone });
        let right = display(&[pixel(Vec3::splat(light as f32), [1, 1], 40)], &DisplayParams { pixels: 1, ..params })[0];
        let film = noisy(0.05);
        let words = display(&film, &params);
        let squares = words.iter().map(|word| f64::from((word & 0xff) as i32 - (right & 0xff) as i32).powi(2));
        let real = (squares.sum::<f64>() / words.len() as f64).sqrt();
        let told = error(&film, &params);
        // To codes it is rounded, of which the film knows nothing.
        assert!((told / (real * real - 1.0 / 12.0).sqrt() - 1.0).abs() < 0.1, "{told} instead of {real}");
        assert_eq!(error(&[pixel(Vec3::ONE, [3, 0], 40)], &params), f64::INFINITY);
        assert!(error(&noisy(0.0), &params) < 1e-3);
    }
}
