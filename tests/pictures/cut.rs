//! Files that are cut short at any byte say so; others that are wrong are refused without a panic.

use exr::prelude::*;

use lucerna::image::Shown;

use super::refused;

/// Small files of every kind that the reader decodes.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    let mut files = Vec::new();
    let colours = || SpecificChannels::rgb(|at: Vec2<usize>| (at.x() as f32, at.y() as f32 * 1.7, 0.3f32));
    let blocks = [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 3))];
    for (name, compression, blocks) in [
        ("flat EXR", Compression::Uncompressed, blocks[0]),
        ("RLE EXR", Compression::RLE, blocks[0]),
        ("ZIP EXR", Compression::ZIP16, blocks[0]),
        ("PIZ EXR", Compression::PIZ, blocks[1]),
        ("PXR24 EXR", Compression::PXR24, blocks[1]),
    ] {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let layer = Layer::new((7, 5), LayerAttributes::default(), encoding, colours());
        exr::image::write::WritableImage::write(&Image::from_layer(layer)).to_file(&path).unwrap();
        files.push((name, std::fs::read(&path).unwrap()));
    }
    let halves = || ["B", "G", "R"].map(|name| AnyChannel::new(name, FlatSamples::F16(vec![f16::from_f32(0.7); 35])));
    let part = |name: &str| {
        let encoding = Encoding { compression: Compression::B44, blocks: blocks[0], line_order: LineOrder::Increasing };
        Layer::new((7, 5), LayerAttributes::named(name), encoding, AnyChannels::sort(halves().into_iter().collect()))
    };
    // The part that is read is the last, so that all before it is needed.
    let parts: Layers<_> = [part("other"), part("beauty")].into_iter().collect();
    Image::from_layers(ImageAttributes::with_size((7, 5)), parts).write().to_file(&path).unwrap();
    files.push(("EXR of parts", std::fs::read(&path).unwrap()));
    for (name, colour) in [("grey PNG", image::ColorType::L8), ("deep PNG", image::ColorType::Rgba16)] {
        let bytes = vec![77; 5 * 3 * usize::from(colour.bytes_per_pixel())];
        image::save_buffer_with_format(&path, &bytes, 5, 3, colour, image::ImageFormat::Png).unwrap();
        files.push((name, std::fs::read(&path).unwrap()));
    }
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 9\n".to_vec();
    files.push(("flat HDR", [header.clone(), [128, 64, 32, 129].repeat(18)].concat()));
    let line = [&[2, 2, 0, 9][..], &[128 + 9, 130].repeat(4)].concat();
    files.push(("HDR of runs", [header, line.repeat(2)].concat()));
    files
}

#[test]
fn a_file_that_is_cut_short_anywhere_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cut");
    for (name, bytes) in files() {
        std::fs::write(&path, &bytes).unwrap();
        super::shown(&path);
        for length in 0..bytes.len() {
            std::fs::write(&path, &bytes[..length]).unwrap();
            let text = refused(&path);
            let word = if length == 0 { "empty" } else { "cut short" };
            assert!(text.contains(word), "{name} of {} bytes, {length} of them: {text}", bytes.len());
        }
    }
}

#[test]
fn a_file_that_a_program_did_not_finish_is_cut_short() {
    let (_, mut bytes) = files().remove(0);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    // Five lines: their table of offsets goes before the pixels, and has zeros until the end.
    let pixels = 5 * (4 + 4 + 7 * 3 * 4);
    let table = bytes.len() - pixels - 5 * 8;
    bytes[table + 3 * 8..table + 5 * 8].fill(0);
    std::fs::write(&path, bytes).unwrap();
    assert!(refused(&path).contains("cut short"));
}

#[test]
fn files_with_wrong_bytes_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong");
    for (_, bytes) in files() {
        for at in 0..bytes.len() {
            let mut wrong = bytes.clone();
            wrong[at] = [0x00, 0xff, bytes[at] ^ 0x40, bytes[at].wrapping_add(1)][at % 4];
            std::fs::write(&path, wrong).unwrap();
            match Shown::read(&path) {
                Ok(shown) => assert_eq!(shown.pixels.len(), shown.size.element_product() as usize),
                Err(error) => assert!(miette::Diagnostic::help(&error).is_some(), "{error}"),
            }
        }
    }
}

#[test]
fn what_is_no_picture_is_said_to_be_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    for content in [&b"no picture"[..], b"GIF89a", b"\xff\xd8\xff\xe0", b"%!PS", b"P6 1 1 255 abc"] {
        std::fs::write(&path, content).unwrap();
        assert!(refused(&path).contains("no picture"), "{}", refused(&path));
    }
    assert!(refused(folder.path()).contains("is a folder"));
    assert!(refused(&folder.path().join("none")).contains("can't open"));
}
