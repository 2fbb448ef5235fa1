//! The sizes that textures may have.

use glam::UVec2;
use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::components::{Texels, TextureImage};
use lucerna::image::{Codes, halve};

use super::{encoded, file, read, refused};
use crate::fuzz::held;

/// A TGA file of runs of one colour, red to alpha.
fn runs(size: [u16; 2], [r, g, b, a]: [u8; 4]) -> Vec<u8> {
    let [w, h] = size.map(u16::to_le_bytes);
    let mut bytes = vec![0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, w[0], w[1], h[0], h[1], 32, 8];
    let mut left = usize::from(size[0]) * usize::from(size[1]);
    while left > 0 {
        let run = left.min(128);
        bytes.extend([0x80 | (run - 1) as u8, b, g, r, a]);
        left -= run;
    }
    bytes
}

#[test]
fn a_texture_of_16k_is_read_in_the_memory_of_its_texels() {
    let (_folder, path) = file("a.tga", &runs([16_384, 16_384], [1, 2, 3, 4]));
    let (picture, most) = held(|| read(&path));
    assert_eq!(picture.image.size, UVec2::splat(16_384));
    let Texels::Rgba8(texels) = &picture.image.texels else { panic!("not RGBA") };
    assert!(texels.len() == 1 << 28 && texels.iter().all(|texel| *texel == [1, 2, 3, 4]));
    assert!(most < (1 << 30) + (1 << 20), "{most} bytes for 1 GiB");
}

#[test]
fn the_smallest_and_the_longest_are_read() {
    for size in [[1, 1], [1, 4096], [4096, 1], [1, 32_768]] {
        let texels: Vec<u8> = (0..size[0] * size[1]).flat_map(|at| [at as u8, (at >> 8) as u8, 7]).collect();
        let (_folder, path) = file("a.png", &encoded(ImageFormat::Png, size, Colour::Rgb8, &texels));
        let picture = read(&path).image;
        let right = texels.chunks(3).map(|c| [c[0], c[1], c[2], 255]).collect();
        assert_eq!((picture.size, picture.texels), (size.into(), Texels::Rgba8(right)));
    }
}

/// The header of a PNG file that says this, and the first bytes of its pixels.
fn header(size: [u32; 2], depth: png::BitDepth, colour: png::ColorType) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_depth(depth);
    encoder.set_color(colour);
    drop(encoder.write_header().unwrap());
    bytes.truncate(33);
    bytes.extend(b"\0\0\x40\0IDAT\x78\x01");
    bytes
}

#[test]
fn what_is_too_large_is_refused_by_its_header() {
    for (size, depth, colour, words) in [
        ([40_000, 10], png::BitDepth::Eight, png::ColorType::Rgb, "too large"),
        ([1, 32_769], png::BitDepth::Eight, png::ColorType::Grayscale, "a side has 1 to 32768"),
        ([32_768, 32_768], png::BitDepth::Sixteen, png::ColorType::Rgb, "8.0 GiB of memory"),
        ([32_768, 32_768], png::BitDepth::Eight, png::ColorType::Rgba, "cut short"),
        ([16_384, 16_384], png::BitDepth::Eight, png::ColorType::Rgba, "cut short"),
    ] {
        let (_folder, path) = file("a.png", &header(size, depth, colour));
        let (text, most) = held(|| refused(&path));
        assert!(text.contains(words), "{text}");
        assert!(most < 4 << 20, "{size:?}: {most} bytes");
    }
    let (_folder, path) = file("a.hdr", b"#?RADIANCE\n\n-Y 32768 +X 32768\n");
    assert!(refused(&path).contains("16.0 GiB"));
    let (_folder, path) = file("a.tga", &runs([65_535, 1], [0; 4]));
    assert!(refused(&path).contains("65535x1"));
}

#[test]
fn halves_are_means_of_light_where_codes_are_srgb() {
    let image = |w, h, texels| TextureImage { size: UVec2::new(w, h), texels };
    let checker = image(2, 2, Texels::Rgba8(vec![[0, 0, 0, 0], [255; 4], [255; 4], [0, 0, 0, 0]]));
    // Half of the light is code 188; alpha is no light.
    assert_eq!(halve(&checker, 1, Codes::Srgb), image(1, 1, Texels::Rgba8(vec![[188, 188, 188, 128]])));
    assert_eq!(halve(&checker, 1, Codes::Linear), image(1, 1, Texels::Rgba8(vec![[128; 4]])));
    let grey = image(4, 1, Texels::Grey16(vec![0, 65535, 100, 300]));
    assert_eq!(halve(&grey, 1, Codes::Linear), image(2, 1, Texels::Grey16(vec![32768, 200])));
    // Five texels to two: the middle one is half in each.
    let odd = image(5, 1, Texels::Grey8(vec![10, 20, 90, 40, 50]));
    assert_eq!(halve(&odd, 1, Codes::Linear), image(2, 1, Texels::Grey8(vec![30, 54])));
    let long = image(1, 4, Texels::Float(vec![[1.0; 4], [3.0; 4], [5.0; 4], [7.0; 4]]));
    assert_eq!(halve(&long, 5, Codes::Srgb), image(1, 1, Texels::Float(vec![[4.0; 4]])));
    // One colour stays what it is.
    for code in 0..=255 {
        let plain = image(7, 3, Texels::Rgba8(vec![[code; 4]; 21]));
        assert_eq!(halve(&plain, 1, Codes::Srgb), image(3, 1, Texels::Rgba8(vec![[code; 4]; 3])));
    }
}
