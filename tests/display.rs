//! The film as a picture, against its twin.

use glam::{UVec2, Vec3};
use lucerna::cpu::display::display;
use lucerna::cpu::film::fixed_point;
use lucerna::gpu::Runtime;
use lucerna::image::srgb::srgb_encode;
use lucerna::layout::film::{FilmHalf, FilmPixel};
use lucerna::passes::Recording;
use lucerna::passes::film;

use crate::support;

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

fn picture(rig: &mut Runtime, pixels: &[FilmPixel], exponent: i32, exposure: f32) -> Vec<u32> {
    rig.upload("film", pixels).unwrap();
    rig.upload("picture", &vec![0u32; pixels.len()]).unwrap();
    let mut recording = Recording::default();
    film::record_display(&mut recording, pixels.len() as u32, exponent, exposure);
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
            let right = display(&film, &film::display_params(count, exponent, exposure));
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
