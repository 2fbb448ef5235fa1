//! PNG: every depth and kind of colour, and what is told of other colours than sRGB's.

use std::path::PathBuf;

use lucerna::image::srgb::srgb_decode;
use png::{BitDepth, ColorType, Encoder};
use tempfile::TempDir;

use super::shown;

/// A kind of colour, a row of two pixels of it, and what it means.
type Case<'a> = (ColorType, BitDepth, &'a [u8], [[f32; 3]; 2]);

fn write(folder: &TempDir, data: &[u8], set: impl FnOnce(&mut Encoder<std::fs::File>)) -> PathBuf {
    let path = folder.path().join("a.png");
    let mut encoder = Encoder::new(std::fs::File::create(&path).unwrap(), 2, 1);
    set(&mut encoder);
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    path
}

#[test]
fn every_depth_and_colour_is_decoded_from_srgb() {
    let folder = tempfile::tempdir().unwrap();
    let light = |code: f64| srgb_decode(code) as f32;
    let bytes = |code: u8| light(f64::from(code) / 255.0);
    let cases: [Case; 10] = [
        (
            ColorType::Rgb,
            BitDepth::Eight,
            &[0, 128, 255, 10, 11, 12],
            [[0, 128, 255].map(bytes), [10, 11, 12].map(bytes)],
        ),
        (
            ColorType::Rgba,
            BitDepth::Eight,
            &[0, 128, 255, 0, 10, 11, 12, 9],
            [[0, 128, 255].map(bytes), [10, 11, 12].map(bytes)],
        ),
        (ColorType::Grayscale, BitDepth::Eight, &[7, 200], [[bytes(7); 3], [bytes(200); 3]]),
        (ColorType::GrayscaleAlpha, BitDepth::Eight, &[7, 1, 200, 2], [[bytes(7); 3], [bytes(200); 3]]),
        (ColorType::Grayscale, BitDepth::One, &[0b0100_0000], [[0.0; 3], [1.0; 3]]),
        (ColorType::Grayscale, BitDepth::Two, &[0b0110_0000], [[light(1.0 / 3.0); 3], [light(2.0 / 3.0); 3]]),
        (ColorType::Grayscale, BitDepth::Four, &[0x3c], [[light(0.2); 3], [light(0.8); 3]]),
        (ColorType::Indexed, BitDepth::Eight, &[1, 0], [[4, 5, 6].map(bytes), [1, 2, 3].map(bytes)]),
        (ColorType::Grayscale, BitDepth::Sixteen, &[0x80, 0x01, 0xff, 0xff], [[light(32769.0 / 65535.0); 3], [1.0; 3]]),
        (
            ColorType::Rgb,
            BitDepth::Sixteen,
            &[0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0],
            [[1.0, 0.0, 256.0].map(|c: f64| light(c / 65535.0)), [0.0; 3]],
        ),
    ];
    for (colour, depth, data, right) in cases {
        let path = write(&folder, data, |encoder| {
            encoder.set_color(colour);
            encoder.set_depth(depth);
            if colour == ColorType::Indexed {
                encoder.set_palette(vec![1, 2, 3, 4, 5, 6]);
            }
        });
        let found = shown(&path);
        assert_eq!(found.pixels, right, "{colour:?} {depth:?}");
        let alpha = found.notes.iter().any(|note| note.contains("alpha"));
        assert_eq!(alpha, matches!(colour, ColorType::Rgba | ColorType::GrayscaleAlpha));
        assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    }
}

#[test]
fn colours_that_are_not_those_of_srgb_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let told = |gamma: Option<u32>, srgb: bool| {
        let path = write(&folder, &[7, 200], |encoder| {
            encoder.set_color(ColorType::Grayscale);
            if let Some(gamma) = gamma {
                encoder.set_source_gamma(png::ScaledFloat::from_scaled(gamma));
            }
            if srgb {
                encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
            }
        });
        shown(&path).warnings
    };
    assert!(told(None, false).is_empty() && told(Some(45_455), false).is_empty() && told(None, true).is_empty());
    for gamma in [100_000, 55_556] {
        let told = told(Some(gamma), false);
        assert!(told.len() == 1 && told[0].contains("gAMA"), "{told:?}");
    }
}
