//! EXR: numbers, compressions, blocks and windows.

use std::path::Path;

use exr::image::write::WritableImage;
use exr::image::{Levels, RipMaps};
use exr::math::RoundingMode;
use exr::meta::{mip_map_levels, rip_map_levels};
use exr::prelude::*;
use glam::{IVec2, UVec2};
use lucerna::components::Crop;
use lucerna::image::{PictureFile, Shown};

use super::{picture, refused, shown, value};

const SIZE: UVec2 = UVec2::new(9, 7);

/// R, G and B of the pattern as one kind of number.
fn samples(kind: SampleType, channel: usize) -> FlatSamples {
    let values = picture(SIZE).into_iter().map(move |pixel| pixel[channel]);
    match kind {
        SampleType::F16 => FlatSamples::F16(values.map(f16::from_f32).collect()),
        SampleType::F32 => FlatSamples::F32(values.collect()),
        SampleType::U32 => FlatSamples::U32(values.map(|value| value as u32).collect()),
    }
}

fn colours(kind: SampleType) -> AnyChannels<FlatSamples> {
    let channel = |(name, index)| AnyChannel::new(name, samples(kind, index));
    AnyChannels::sort([("R", 0), ("G", 1), ("B", 2)].map(channel).into_iter().collect())
}

/// Writes the pattern with its top left pixel at `place` of a display window from `origin`.
fn write(path: &Path, kind: SampleType, encoding: Encoding, place: IVec2, (origin, size): (IVec2, UVec2)) {
    let attributes = LayerAttributes { layer_position: Vec2(place.x, place.y), ..LayerAttributes::default() };
    let mut image =
        Image::from_layer(Layer::new((SIZE.x as usize, SIZE.y as usize), attributes, encoding, colours(kind)));
    image.attributes.display_window = IntegerBounds::new((origin.x, origin.y), (size.x as usize, size.y as usize));
    image.write().to_file(path).unwrap();
}

/// The pixels as the library's own reader of images has them.
fn by_library(path: &Path) -> Vec<[f32; 3]> {
    let image = read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| pixels[at.y() * *width + at.x()] = [r, g, b],
    );
    image.unwrap().layer_data.channel_data.pixels.1
}

fn encoding(compression: Compression, blocks: Blocks, line_order: LineOrder) -> Encoding {
    Encoding { compression, blocks, line_order }
}

#[test]
fn every_number_compression_and_kind_of_block_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let compressions = [
        (Compression::Uncompressed, 0.0),
        (Compression::RLE, 0.0),
        (Compression::ZIP1, 0.0),
        (Compression::ZIP16, 0.0),
        (Compression::PIZ, 0.0),
        // 24 bits of a float.
        (Compression::PXR24, 1e-4),
        (Compression::B44, 0.0),
        (Compression::B44A, 0.0),
    ];
    let blocks = [
        (Blocks::ScanLines, LineOrder::Increasing),
        (Blocks::ScanLines, LineOrder::Decreasing),
        (Blocks::Tiles(Vec2(4, 3)), LineOrder::Increasing),
        (Blocks::Tiles(Vec2(64, 64)), LineOrder::Unspecified),
    ];
    for (compression, tolerance) in compressions {
        for (blocks, order) in blocks {
            for kind in [SampleType::F16, SampleType::F32, SampleType::U32] {
                write(&path, kind, encoding(compression, blocks, order), IVec2::ZERO, (IVec2::ZERO, SIZE));
                let found = shown(&path);
                assert!(found.size == SIZE && found.notes.is_empty() && found.warnings.is_empty(), "{found:?}");
                // B44 loses much of halves as unlike as these: what is left is for the library to say.
                let lossy = matches!(compression, Compression::B44 | Compression::B44A) && kind == SampleType::F16;
                let right = if lossy { by_library(&path) } else { picture(SIZE) };
                for (found, right) in found.pixels.iter().flatten().zip(right.iter().flatten()) {
                    let right = if kind == SampleType::U32 { right.trunc() } else { *right };
                    assert!(
                        (found - right).abs() <= tolerance * (right + 1.0),
                        "{compression:?} {blocks:?} {kind:?}: {found} {right}"
                    );
                }
            }
        }
    }
}

#[test]
fn any_part_of_a_file_is_read_by_itself() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 3))] {
        let encoding = encoding(Compression::ZIP16, blocks, LineOrder::Increasing);
        write(&path, SampleType::F32, encoding, IVec2::ZERO, (IVec2::ZERO, SIZE));
        for (min, max) in [((0, 0), (9, 7)), ((3, 2), (5, 6)), ((8, 6), (9, 7)), ((0, 3), (9, 4)), ((4, 4), (4, 4))] {
            let window = Crop { min: UVec2::from(min), max: UVec2::from(max) };
            let found = PictureFile::open(&path).unwrap().read(window).unwrap();
            let all = (min.1..max.1).flat_map(|y| (min.0..max.0).map(move |x| (x, y)));
            let right: Vec<[f32; 3]> = all.map(|(x, y)| [0, 1, 2].map(|c| value(x.into(), y.into(), c))).collect();
            assert_eq!(found, right, "{blocks:?} {window:?}");
        }
    }
}

#[test]
fn of_many_levels_the_largest_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let size = (SIZE.x as usize, SIZE.y as usize);
    let level = |kept: bool, area: usize, channel: usize| {
        FlatSamples::F32(if kept {
            picture(SIZE).iter().map(|pixel| pixel[channel]).collect()
        } else {
            vec![-7.0; area]
        })
    };
    for round in [RoundingMode::Down, RoundingMode::Up] {
        let mip = |channel| {
            let levels = mip_map_levels(round, Vec2(size.0, size.1));
            let level_data = levels.map(|(index, size)| level(index == 0, size.area(), channel)).collect();
            Levels::Mip { rounding_mode: round, level_data }
        };
        let rip = |channel| {
            let levels: Vec<_> = rip_map_levels(round, Vec2(size.0, size.1)).collect();
            let level_count = levels.last().map(|(index, _)| Vec2(index.x() + 1, index.y() + 1)).unwrap();
            let map_data =
                levels.into_iter().map(|(index, size)| level(index == Vec2(0, 0), size.area(), channel)).collect();
            Levels::Rip { rounding_mode: round, level_data: RipMaps { map_data, level_count } }
        };
        let channels: [&dyn Fn(usize) -> Levels<FlatSamples>; 2] = [&mip, &rip];
        for levels in channels {
            let channel = |(name, index)| AnyChannel::new(name, levels(index));
            let channels = AnyChannels::sort([("R", 0), ("G", 1), ("B", 2)].map(channel).into_iter().collect());
            let encoding = encoding(Compression::ZIP1, Blocks::Tiles(Vec2(4, 4)), LineOrder::Increasing);
            let layer = Layer::new(size, LayerAttributes::default(), encoding, channels);
            Image::from_layer(layer).write().to_file(&path).unwrap();
            assert_eq!(shown(&path).pixels, picture(SIZE));
        }
    }
}

/// The data window's corner from that of the display window, and the display window's size.
#[test]
fn pixels_are_where_the_windows_say() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for (place, size, told) in [
        (IVec2::new(2, 3), UVec2::new(20, 12), "the rest is black"),
        (IVec2::new(-2, -1), UVec2::new(4, 5), "left out"),
        (IVec2::new(-4, 2), UVec2::new(9, 7), "left out, and the rest is black"),
        (IVec2::new(0, 3), UVec2::new(9, 20), "the rest is black"),
        (IVec2::new(30, 0), UVec2::new(12, 12), "none of them"),
        (IVec2::new(-9, 0), UVec2::new(3, 3), "none of them"),
        (IVec2::ZERO, SIZE, ""),
    ] {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(2, 3))] {
            // Neither window need begin at 0,0.
            for origin in [IVec2::ZERO, IVec2::new(-1000, 77), IVec2::new(400_000_000, -400_000_000)] {
                let encoding = encoding(Compression::ZIP16, blocks, LineOrder::Increasing);
                write(&path, SampleType::F32, encoding, origin + place, (origin, size));
                let found = shown(&path);
                assert_eq!(found.size, size);
                for (index, pixel) in found.pixels.iter().enumerate() {
                    let at = IVec2::new(index as i32 % size.x as i32, index as i32 / size.x as i32) - place;
                    let inside = at.min_element() >= 0 && at.x < SIZE.x as i32 && at.y < SIZE.y as i32;
                    let right = [0, 1, 2].map(|c| if inside { value(at.x.into(), at.y.into(), c) } else { 0.0 });
                    assert_eq!(*pixel, right, "{place} {size} {at}");
                }
                assert_eq!(found.warnings.len(), usize::from(!told.is_empty()), "{:?}", found.warnings);
                assert!(found.warnings.iter().all(|warning| warning.contains(told)), "{:?}", found.warnings);
                let source = PictureFile::open(&path).unwrap();
                assert_eq!((source.size, source.place), (SIZE, Some(place)));
                assert_eq!(source.read_all().unwrap(), picture(SIZE));
            }
        }
    }
}

/// Overwrites the last or first corner of a window in a header.
fn patch(bytes: &[u8], window: &str, corner: usize, to: IVec2) -> Vec<u8> {
    let name = [window.as_bytes(), b"\0box2i\0"].concat();
    let at = bytes.windows(name.len()).position(|part| part == name).unwrap() + name.len() + 4 + 8 * corner;
    let mut patched = bytes.to_vec();
    patched[at..at + 4].copy_from_slice(&to.x.to_le_bytes());
    patched[at + 4..at + 8].copy_from_slice(&to.y.to_le_bytes());
    patched
}

#[test]
fn extreme_windows_take_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 4))] {
        for compression in [Compression::Uncompressed, Compression::ZIP16, Compression::PIZ] {
            let encoding = encoding(compression, blocks, LineOrder::Increasing);
            write(&path, SampleType::F32, encoding, IVec2::ZERO, (IVec2::ZERO, SIZE));
            let bytes = std::fs::read(&path).unwrap();
            for extreme in [16_384, 1 << 20, (1 << 29) - 1, (1 << 30) - 3, 1 << 30, i32::MAX - 1, i32::MAX] {
                std::fs::write(&path, patch(&bytes, "displayWindow", 1, IVec2::splat(extreme))).unwrap();
                let error = Shown::read(&path).expect_err("too large to be shown").to_string();
                assert!(error.contains("too large") || error.contains("display window"), "{error}");
                std::fs::write(&path, patch(&bytes, "dataWindow", 1, IVec2::splat(extreme))).unwrap();
                PictureFile::open(&path).expect_err("too large to be read");
                Shown::read(&path).expect_err("its pixels are not there");
                std::fs::write(&path, patch(&bytes, "dataWindow", 0, IVec2::splat(-extreme))).unwrap();
                Shown::read(&path).expect_err("its pixels are not there");
            }
        }
    }
}

#[test]
fn a_part_of_a_huge_data_window_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let (width, height) = (40, 20_000);
    let value = |x: usize, y: usize| (x as f32, y as f32, 1.0);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| value(at.x(), at.y()));
    let layer = Layer::new((width, height), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.display_window = IntegerBounds::new((10, 19_000), (4, 3));
    image.write().to_file(&path).unwrap();
    assert!(PictureFile::open(&path).unwrap_err().to_string().contains("40x20000"));
    let found = shown(&path);
    let right: Vec<[f32; 3]> =
        (19_000..19_003).flat_map(|y| (10..14).map(move |x| [x as f32, y as f32, 1.0])).collect();
    assert_eq!(found.pixels, right);
}

#[test]
fn what_the_library_does_not_decode_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let encoding = encoding(Compression::Uncompressed, Blocks::ScanLines, LineOrder::Increasing);
    write(&path, SampleType::F32, encoding, IVec2::ZERO, (IVec2::ZERO, SIZE));
    let bytes = std::fs::read(&path).unwrap();
    let replaced = |name: &[u8], skip: usize, by: &[u8]| {
        let at = bytes.windows(name.len()).position(|part| part == name).unwrap() + name.len() + skip;
        let mut patched = bytes.clone();
        patched[at..at + by.len()].copy_from_slice(by);
        std::fs::write(&path, patched).unwrap();
        refused(&path)
    };
    // Behind a channel's name: type, pLinear, then the sampling of x and y.
    let subsampled = replaced(b"chlist\0", 4 + 2 + 8, &[2, 0, 0, 0, 2, 0, 0, 0]);
    assert!(subsampled.contains("channels B are subsampled"), "{subsampled}");
    for (compression, word) in [(10, "j2k"), (11, "j2k"), (77, "compression")] {
        let text = replaced(b"compression\0compression\0", 4, &[compression]);
        assert!(text.to_lowercase().contains(word), "{compression}: {text}");
    }
    // Versions and flags of the future.
    for version in [3u8, 9] {
        std::fs::write(&path, [&bytes[..4], &[version], &bytes[5..]].concat()).unwrap();
        assert!(refused(&path).contains("version"), "{}", refused(&path));
    }
    std::fs::write(&path, [&bytes[..4], &[2, 0x40, 0, 0], &bytes[8..]].concat()).unwrap();
    refused(&path);
    // Deep, by the version's flag and by the type of the part.
    std::fs::write(&path, [&bytes[..4], &[2, 0x08, 0, 0], &bytes[8..]].concat()).unwrap();
    assert!(refused(&path).contains("deep"), "{}", refused(&path));
    let flat = b"type\0string\0\x0d\0\0\0scanlineimage";
    let at = bytes.windows(flat.len()).position(|part| part == flat).unwrap();
    let deep = b"type\0string\0\x0c\0\0\0deepscanline";
    std::fs::write(&path, [&bytes[..at], deep, &bytes[at + flat.len()..]].concat()).unwrap();
    assert!(refused(&path).contains("deep"), "{}", refused(&path));
}
