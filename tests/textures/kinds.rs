//! Files of every kind, by the texels that they are read as.

use exr::prelude::write_rgb_file;
use glam::UVec2;
use image::ExtendedColorType as Colour;
use image::ImageFormat;
use lucerna::components::Texels;
use lucerna::image::Alpha;

use super::{encoded, file, read};

/// The size of most pictures here, and how many texels that is.
const SIZE: [u32; 2] = [5, 3];
const COUNT: usize = 15;

/// Bytes of a picture of so many a texel, each of its own value.
fn codes(bytes: usize) -> Vec<u8> {
    (0..COUNT * bytes).map(|at| (at * 4 + 3) as u8).collect()
}

#[test]
fn eight_bits_are_kept() {
    use ImageFormat::{Bmp, Png, Tga, Tiff, WebP};
    for (format, name) in [(Png, "a.png"), (Bmp, "a.bmp"), (Tga, "a.tga"), (Tiff, "a.tif"), (WebP, "a.webp")] {
        for (colour, channels) in [(Colour::Rgb8, 3), (Colour::Rgba8, 4)] {
            let codes = codes(channels);
            let (_folder, path) = file(name, &encoded(format, SIZE, colour, &codes));
            let picture = read(&path);
            assert_eq!(picture.image.size, UVec2::from(SIZE), "{name}");
            let texel = |code: &[u8]| [code[0], code[1], code[2], if channels == 4 { code[3] } else { 255 }];
            let right: Vec<[u8; 4]> = codes.chunks(channels).map(texel).collect();
            assert_eq!(picture.image.texels, Texels::Rgba8(right), "{name}");
            assert_eq!(picture.alpha == Alpha::Partial, channels == 4, "{name}");
            assert!(picture.warnings.is_empty() && picture.mended == 0, "{name}: {:?}", picture.warnings);
        }
    }
}

#[test]
fn grey_without_alpha_stays_one_channel() {
    for (format, name) in [(ImageFormat::Png, "a.png"), (ImageFormat::Tiff, "a.tif"), (ImageFormat::Tga, "a.tga")] {
        let (_folder, path) = file(name, &encoded(format, SIZE, Colour::L8, &codes(1)));
        let picture = read(&path);
        assert_eq!(picture.image.texels, Texels::Grey8(codes(1)), "{name}");
        assert_eq!(picture.alpha, Alpha::None);
    }
    let values: Vec<u16> = (0..COUNT as u16).map(|at| at * 4000 + 7).collect();
    for (format, name) in [(ImageFormat::Png, "a.png"), (ImageFormat::Tiff, "a.tif")] {
        let (_folder, path) = file(name, &encoded(format, SIZE, Colour::L16, bytemuck::cast_slice(&values)));
        assert_eq!(read(&path).image.texels, Texels::Grey16(values.clone()), "{name}");
    }
    let (_folder, path) = file("a.jpg", &encoded(ImageFormat::Jpeg, [16, 8], Colour::L8, &[77; 128]));
    let Texels::Grey8(texels) = read(&path).image.texels else { panic!("not grey") };
    assert!(texels.len() == 128 && texels.iter().all(|code| code.abs_diff(77) <= 1), "{texels:?}");
}

#[test]
fn grey_with_alpha_has_four_channels() {
    let (_folder, path) = file("a.png", &encoded(ImageFormat::Png, SIZE, Colour::La8, &codes(2)));
    let picture = read(&path);
    let right = codes(2).chunks(2).map(|texel| [texel[0], texel[0], texel[0], texel[1]]).collect();
    assert_eq!(picture.image.texels, Texels::Rgba8(right));
    assert_eq!(picture.alpha, Alpha::Partial);
    let opaque: Vec<u8> = codes(1).into_iter().flat_map(|code| [code, 255]).collect();
    let (_folder, path) = file("a.png", &encoded(ImageFormat::Png, SIZE, Colour::La8, &opaque));
    assert_eq!(read(&path).alpha, Alpha::Opaque);
}

#[test]
fn sixteen_bits_are_kept() {
    for (colour, channels) in [(Colour::La16, 2), (Colour::Rgb16, 3), (Colour::Rgba16, 4)] {
        let values: Vec<u16> = (0..COUNT * channels).map(|at| at as u16 * 1000 + 1).collect();
        let (_folder, path) = file("a.png", &encoded(ImageFormat::Png, SIZE, colour, bytemuck::cast_slice(&values)));
        let texel = |v: &[u16]| match *v {
            [l, a] => [l, l, l, a],
            [r, g, b] => [r, g, b, 65535],
            _ => [v[0], v[1], v[2], v[3]],
        };
        assert_eq!(read(&path).image.texels, Texels::Rgba16(values.chunks(channels).map(texel).collect()));
    }
}

/// A PNG file of the indices 0, 1, 2 in a row, with a palette and the alpha of its first colours.
fn palette(transparency: Option<&[u8]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 1);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Two);
    encoder.set_palette(vec![10, 20, 30, 40, 50, 60, 70, 80, 90]);
    if let Some(transparency) = transparency {
        encoder.set_trns(transparency.to_vec());
    }
    encoder.write_header().unwrap().write_image_data(&[0b0001_1000]).unwrap();
    bytes
}

#[test]
fn palettes_keep_their_transparency() {
    let (_folder, path) = file("a.png", &palette(Some(&[0, 128])));
    let picture = read(&path);
    assert_eq!(picture.image.texels, Texels::Rgba8(vec![[10, 20, 30, 0], [40, 50, 60, 128], [70, 80, 90, 255]]));
    assert_eq!(picture.alpha, Alpha::Partial);
    let (_folder, path) = file("a.png", &palette(None));
    let picture = read(&path);
    assert_eq!(picture.image.texels, Texels::Rgba8(vec![[10, 20, 30, 255], [40, 50, 60, 255], [70, 80, 90, 255]]));
    assert_eq!(picture.alpha, Alpha::None);
}

#[test]
fn one_colour_that_is_transparent_is_alpha() {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_trns(vec![0, 1, 0, 2, 0, 3]);
    encoder.write_header().unwrap().write_image_data(&[1, 2, 3, 4, 5, 6]).unwrap();
    let (_folder, path) = file("a.png", &bytes);
    assert_eq!(read(&path).image.texels, Texels::Rgba8(vec![[1, 2, 3, 0], [4, 5, 6, 255]]));
}

#[test]
fn jpegs_are_close_to_what_was_written() {
    let bytes = [200, 100, 50].repeat(64);
    let (_folder, path) = file("a.jpeg", &encoded(ImageFormat::Jpeg, [8, 8], Colour::Rgb8, &bytes));
    let Texels::Rgba8(texels) = read(&path).image.texels else { panic!("not RGB") };
    let near = |texel: &[u8; 4]| texel.iter().zip([200, 100, 50, 255]).all(|(code, right)| code.abs_diff(right) <= 3);
    assert!(texels.len() == 64 && texels.iter().all(near), "{texels:?}");
}

/// What Pillow writes for a picture of 8x8 pixels of cyan 255, magenta 0, yellow 0 and black 64.
const CMYK: &[u8] = include_bytes!("cmyk.jpg");

#[test]
fn the_inks_of_a_jpeg_become_colours() {
    let (_folder, path) = file("a.jpg", CMYK);
    let Texels::Rgba8(texels) = read(&path).image.texels else { panic!("not RGB") };
    let near = |texel: &[u8; 4]| texel.iter().zip([0, 191, 191, 255]).all(|(code, right)| code.abs_diff(right) <= 4);
    assert!(texels.len() == 64 && texels.iter().all(near), "{texels:?}");
}

#[test]
fn floats_are_kept_and_what_is_no_value_is_mended() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let pixels =
        [(0.5, 1.5, 3000.0), (f32::NAN, 1.0, f32::INFINITY), (-1.0, 2.0, 1e9), (0.0, -0.0, 65504.0), (1.0, 1.0, 1.0)];
    write_rgb_file(&path, 5, 1, |x, _| pixels[x]).unwrap();
    let picture = read(&path);
    let right = [[0.5, 1.5, 3000.0], [0.0, 1.0, 65504.0], [0.0, 2.0, 65504.0], [0.0, 0.0, 65504.0], [1.0; 3]];
    assert_eq!(picture.image.texels, Texels::Float(right.map(|[r, g, b]| [r, g, b, 1.0]).to_vec()));
    assert_eq!((picture.mended, picture.alpha), (2, Alpha::None));
    let (_folder, path) =
        file("a.hdr", &[&b"#?RADIANCE\nEXPOSURE=2\n\n-Y 1 +X 2\n"[..], &[128, 64, 32, 129, 0, 0, 0, 0]].concat());
    assert_eq!(read(&path).image.texels, Texels::Float(vec![[0.5, 0.25, 0.125, 1.0], [0.0, 0.0, 0.0, 1.0]]));
    let values: Vec<f32> = (0..12).map(|at| at as f32 * 0.5 - 0.5).collect();
    let bytes = encoded(ImageFormat::Tiff, [4, 1], Colour::Rgb32F, bytemuck::cast_slice(&values));
    let (_folder, path) = file("a.tiff", &bytes);
    let picture = read(&path);
    let right = values.chunks(3).map(|v| [v[0].max(0.0), v[1], v[2], 1.0]).collect();
    assert_eq!((picture.image.texels, picture.mended), (Texels::Float(right), 1));
}

#[test]
fn contents_count_and_not_names() {
    let bytes = encoded(ImageFormat::Png, SIZE, Colour::L8, &codes(1));
    for name in ["a.jpg", "a.tga", "a", "a.exr"] {
        let (_folder, path) = file(name, &bytes);
        assert_eq!(read(&path).image.texels, Texels::Grey8(codes(1)), "{name}");
    }
    // TGA has nothing that tells it.
    let bytes = encoded(ImageFormat::Tga, SIZE, Colour::L8, &codes(1));
    let (_folder, path) = file("A.TGA", &bytes);
    assert_eq!(read(&path).image.texels, Texels::Grey8(codes(1)));
}

#[test]
fn alpha_that_no_program_wrote_does_not_count() {
    let zeros: Vec<u8> = codes(3).chunks(3).flat_map(|c| [c[0], c[1], c[2], 0]).collect();
    let (_folder, path) = file("a.tga", &encoded(ImageFormat::Tga, SIZE, Colour::Rgba8, &zeros));
    let picture = read(&path);
    let Texels::Rgba8(texels) = picture.image.texels else { panic!("not RGBA") };
    assert!(picture.alpha == Alpha::None && texels.iter().all(|texel| texel[3] == 255));
}
