//! Alpha of EXR pictures: which channel it is, and that it cuts holes as that of a PNG does.

use std::path::Path;
use std::time::Duration;

use exr::prelude::*;
use glam::{UVec2, Vec3};
use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::Engine;
use lucerna::components::{Channel, Environment, Reading, Texels};
use lucerna::image::{Alpha, Shown};
use lucerna::scene;
use lucerna::shader::Library;

use super::{encoded, read};
use crate::support;

/// Texels a row, and of all rows.
const WIDTH: usize = 7;
const COUNT: usize = 35;

fn value(channel: usize, at: usize) -> f32 {
    (channel * COUNT + at) as f32 / 128.0
}

/// Writes channels by name, each of the values of a function.
fn write(path: &Path, channels: &[(&str, &dyn Fn(usize) -> f32)], blocks: Blocks, kind: SampleType) {
    let samples = |of: &dyn Fn(usize) -> f32| match kind {
        SampleType::F16 => FlatSamples::F16((0..COUNT).map(|at| f16::from_f32(of(at))).collect()),
        SampleType::F32 => FlatSamples::F32((0..COUNT).map(of).collect()),
        SampleType::U32 => FlatSamples::U32((0..COUNT).map(|at| of(at) as u32).collect()),
    };
    let list = channels.iter().map(|(name, of)| AnyChannel::new(*name, samples(of))).collect();
    let encoding = Encoding { compression: Compression::ZIP1, blocks, line_order: LineOrder::Increasing };
    let size = (WIDTH, COUNT / WIDTH);
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(list));
    Image::from_layer(layer).write().to_file(path).unwrap();
}

/// Colours that go up from texel to texel, below a name, and an alpha of another name.
fn write_coloured(path: &Path, layer: &str, alpha: (&str, &dyn Fn(usize) -> f32), blocks: Blocks, kind: SampleType) {
    let colours: [Box<dyn Fn(usize) -> f32>; 3] =
        [0, 1, 2].map(|channel| -> Box<dyn Fn(usize) -> f32> { Box::new(move |at| value(channel, at)) });
    let names = ["R", "G", "B"].map(|name| format!("{layer}{name}"));
    let mut channels: Vec<(&str, &dyn Fn(usize) -> f32)> =
        names.iter().map(String::as_str).zip(colours.iter().map(|colour| &**colour)).collect();
    channels.push(alpha);
    write(path, &channels, blocks, kind);
}

fn texels(alpha: impl Fn(usize) -> f32) -> Texels {
    Texels::Float((0..COUNT).map(|at| [value(0, at), value(1, at), value(2, at), alpha(at)]).collect())
}

#[test]
fn alpha_is_read_beside_its_colours() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let alpha = |at: usize| (at % 5) as f32 / 4.0;
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 3))] {
        for kind in [SampleType::F16, SampleType::F32] {
            for (layer, name) in [("", "A"), ("", "a"), ("", "alpha"), ("beauty.", "beauty.A")] {
                write_coloured(&path, layer, (name, &alpha), blocks, kind);
                let picture = read(&path);
                assert_eq!(picture.image.texels, texels(alpha), "{layer}{name} {blocks:?} {kind:?}");
                assert_eq!((picture.alpha, picture.mended), (Alpha::Partial, 0));
            }
        }
    }
    // What a sky is lit by has no alpha.
    let [r, g, b] = Shown::read(&path).unwrap().pixels[8];
    assert_eq!([r, g, b], [0, 1, 2].map(|channel| value(channel, 8)));
}

#[test]
fn the_alpha_of_another_layer_does_not_count() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_coloured(&path, "", ("mask.A", &|_| 0.5), Blocks::ScanLines, SampleType::F32);
    let picture = read(&path);
    assert_eq!((picture.image.texels, picture.alpha), (texels(|_| 1.0), Alpha::None));
}

#[test]
fn alpha_that_says_nothing_is_opaque() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for (stored, says) in [(1.0, Alpha::Opaque), (0.0, Alpha::None)] {
        write_coloured(&path, "", ("A", &|_| stored), Blocks::ScanLines, SampleType::F16);
        let picture = read(&path);
        assert_eq!((picture.image.texels, picture.alpha), (texels(|_| 1.0), says), "{stored}");
    }
    write_coloured(&path, "", ("A", &|at| if at == 3 { f32::NAN } else { 1.0 }), Blocks::ScanLines, SampleType::F32);
    let picture = read(&path);
    let right = texels(|at| if at == 3 { 0.0 } else { 1.0 });
    assert_eq!((picture.image.texels, picture.alpha, picture.mended), (right, Alpha::Partial, 1));
}

#[test]
fn grey_pictures_have_alpha_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write(&path, &[("Y", &|at| value(0, at)), ("A", &|_| 0.25)], Blocks::ScanLines, SampleType::F32);
    let right = (0..COUNT).map(|at| [value(0, at), value(0, at), value(0, at), 0.25]).collect();
    assert_eq!(read(&path).image.texels, Texels::Float(right));
}

/// The film of a triangle with holes, whose map is that file.
fn film(folder: &Path, map: &str) -> Vec<[f32; 3]> {
    let obj = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    std::fs::write(folder.join("a.obj"), obj).unwrap();
    std::fs::write(folder.join("a.mtl"), format!("newmtl a\nKd 0.5 0.5 0.5\nmap_d {map}\n")).unwrap();
    let mut description = scene::load(&folder.join("a.obj"), &[]).unwrap().description;
    let readings: Vec<Reading> = description.textures.values().map(|texture| texture.reading).collect();
    assert_eq!(readings, [Reading::Number(Channel::Alpha)], "{map}");
    (description.film.size, description.render.spp) = (UVec2::new(24, 16), 8);
    description.environment = Some(Environment::Constant(Vec3::ONE));
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    while !engine.step(Duration::from_secs(1)).unwrap().finished {}
    engine.film().unwrap().rgb
}

#[test]
fn holes_are_those_of_a_png() {
    let folder = tempfile::tempdir().unwrap();
    let there = |at: usize| !at.is_multiple_of(3);
    let alpha = |at: usize| f32::from(u8::from(there(at)));
    write_coloured(&folder.path().join("a.exr"), "", ("A", &alpha), Blocks::ScanLines, SampleType::F16);
    let codes: Vec<u8> = (0..COUNT).flat_map(|at| [9, 9, 9, if there(at) { 255 } else { 0 }]).collect();
    let png = encoded(ImageFormat::Png, [WIDTH as u32, (COUNT / WIDTH) as u32], Colour::Rgba8, &codes);
    std::fs::write(folder.path().join("a.png"), png).unwrap();
    let (by_exr, by_png) = (film(folder.path(), "a.exr"), film(folder.path(), "a.png"));
    assert_eq!(by_exr, by_png);
    write_coloured(&folder.path().join("a.exr"), "", ("A", &|at| 0.5 * alpha(at)), Blocks::ScanLines, SampleType::F16);
    assert_ne!(film(folder.path(), "a.exr"), by_png);
}
