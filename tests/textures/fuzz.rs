//! Files of every kind with mistakes in them: each is read or refused, without a panic, in the memory that its header declares.
//!
//! Memory is what the reading thread asks its allocator for, of whatever it uses. Blocks of EXR files are decoded by threads of their
//! own, whose memory is not seen here; it is bounded by `image/exr`.

use std::time::Duration;

use exr::prelude::*;
use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::image::TextureFile;

use super::encoded;
use crate::fuzz::held;
use crate::support::dice::Dice;
use crate::support::patience::thread_time;
use crate::support::stress;

/// Mutated files of each kind.
const CASES: usize = 1_000;
const STRESS_CASES: usize = 100_000;

/// Bytes that a decoder may take beside the picture, a second time the picture, and the file.
const BESIDE: u64 = 80 << 20;

/// A case takes milliseconds of the thread's own time; the largest that a few bytes of WebP may declare, some seconds.
const TIME: Duration = Duration::from_secs(30);

fn dice(dice: &mut Dice, below: usize) -> usize {
    (dice.unit() * below as f64) as usize
}

/// Bytes that look like a picture.
fn pixels(count: usize) -> Vec<u8> {
    (0..count as u32).map(|at| (at * 5 + (at.wrapping_mul(2_654_435_761) >> 28)) as u8).collect()
}

/// Small files of the image crate's formats.
fn files(format: ImageFormat, colours: &[(Colour, usize)]) -> Vec<Vec<u8>> {
    let file = |(colour, bytes): &(Colour, usize)| encoded(format, [21, 13], *colour, &pixels(21 * 13 * bytes));
    colours.iter().map(file).collect()
}

/// Files of runs, which the encoders don't write.
fn runs() -> Vec<Vec<u8>> {
    let packets = |bytes: &[u8]| [&[0x80 | 19][..], bytes, &[0x80 | 11], bytes].concat().repeat(4);
    let grey = [&[0, 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 8, 0, 8, 0][..], &packets(&[7])].concat();
    let colour = [&[0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 0, 8, 0, 24, 48][..], &packets(&[7, 8, 9])].concat();
    let mapped = [&[0, 1, 1, 0, 0, 2, 0, 24, 0, 0, 0, 0, 4, 0, 2, 0, 8, 32, 1, 2, 3, 4, 5, 6][..], &[0, 1].repeat(4)];
    vec![grey, colour, mapped.concat()]
}

fn hdr() -> Vec<Vec<u8>> {
    let header = b"#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 9\n".to_vec();
    let flat = [header.clone(), [128, 64, 32, 129].repeat(36)].concat();
    let line = [&[2, 2, 0, 9][..], &[128 + 9, 130].repeat(4)].concat();
    vec![flat, [header, line.repeat(4)].concat()]
}

fn exr() -> Vec<Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let colours = || SpecificChannels::rgb(|at: Vec2<usize>| (at.x() as f32, at.y() as f32 * 1.7, 0.3f32));
    let file = |compression, blocks| {
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let layer = Layer::new((17, 9), LayerAttributes::default(), encoding, colours());
        exr::image::write::WritableImage::write(&Image::from_layer(layer)).to_file(&path).unwrap();
        std::fs::read(&path).unwrap()
    };
    let tiles = Blocks::Tiles(Vec2(8, 4));
    let (lines, kinds) =
        (Blocks::ScanLines, [Compression::RLE, Compression::ZIP16, Compression::PIZ, Compression::B44]);
    let all = kinds.into_iter().flat_map(|kind| [(kind, lines), (kind, tiles)]);
    let all = all.chain([(Compression::Uncompressed, lines), (Compression::PXR24, tiles)]);
    all.map(|(compression, blocks)| file(compression, blocks)).collect()
}

/// The file with a few mistakes.
fn mutated(file: &[u8], random: &mut Dice) -> Vec<u8> {
    const TELLING: [u8; 8] = [0, 1, 0x7f, 0x80, 0xff, 0xfe, 0x10, 0x40];
    let mut bytes = file.to_vec();
    for _ in 0..1 + dice(random, 4) {
        if bytes.is_empty() {
            break;
        }
        // Half of them near the start, where headers are.
        let reach = if random.unit() < 0.5 { bytes.len().min(64) } else { bytes.len() };
        let at = dice(random, reach);
        match dice(random, 8) {
            0 | 1 => bytes[at] ^= 1 << dice(random, 8),
            2 => bytes[at] = (random.unit() * 256.0) as u8,
            3 | 4 => bytes[at] = TELLING[dice(random, 8)],
            5 => bytes.truncate(at),
            6 => drop(bytes.drain(at..(at + 1 + dice(random, 9)).min(file.len()).min(bytes.len()).max(at))),
            _ => {
                let from = dice(random, bytes.len());
                let part = bytes[from..(from + 1 + dice(random, 32)).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
        }
    }
    bytes
}

/// Makes the check sums of a PNG file right again, so that its decoder looks at what they guard.
fn resum(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4).map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]) as usize) {
        let Some(end) = at.checked_add(8).and_then(|start| start.checked_add(length)) else { return };
        if bytes.len() < end.saturating_add(4) {
            return;
        }
        let sum = crc(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

fn crc(bytes: &[u8]) -> u32 {
    let step = |sum: u32| if sum & 1 == 1 { 0xedb8_8320 ^ (sum >> 1) } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), |sum, _| step(sum)))
}

/// Reads mutated files; says how many were accepted.
fn survive(name: &str, files: &[Vec<u8>], seed: u64) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    for bytes in files {
        std::fs::write(&path, bytes).unwrap();
        TextureFile::open(&path).and_then(TextureFile::read).unwrap_or_else(|error| panic!("{error}"));
    }
    let mut random = Dice(seed);
    let cases = if stress() { STRESS_CASES } else { CASES };
    let (mut accepted, mut most) = (0, 0);
    for case in 0..cases {
        let mut bytes = mutated(&files[dice(&mut random, files.len())], &mut random);
        if name == "a.png" && random.unit() < 0.75 {
            resum(&mut bytes);
        }
        std::fs::write(&path, &bytes).unwrap();
        let started = thread_time();
        let mut declared = 0;
        let read = || {
            let file = TextureFile::open(&path)?;
            declared = file.bytes;
            file.read()
        };
        let (result, memory) = held(read);
        accepted += usize::from(result.is_ok());
        let memory = memory as u64;
        let bound = 2 * declared + bytes.len() as u64 + BESIDE;
        assert!(memory <= bound, "{name}, case {case}: {memory} bytes where {bound} are declared");
        most = most.max(memory.saturating_sub(2 * declared));
        if let Some(time) = started.zip(thread_time()).map(|(before, after)| after - before) {
            assert!(time < TIME, "{name}, case {case}: {time:?}");
        }
    }
    println!("{name}: {cases} files, {accepted} read, at most {most} bytes beside twice the texels");
    // Mistakes that leave nothing readable would try nothing but the header.
    assert!(accepted * 50 > cases && accepted < cases, "{name}: {accepted} of {cases} are read");
}

#[test]
fn mutated_png() {
    let colours = [(Colour::Rgb8, 3), (Colour::Rgba8, 4), (Colour::L8, 1), (Colour::La8, 2), (Colour::Rgb16, 6)];
    survive("a.png", &files(ImageFormat::Png, &colours), 1);
}

#[test]
fn mutated_jpg() {
    let mut all = files(ImageFormat::Jpeg, &[(Colour::Rgb8, 3), (Colour::L8, 1)]);
    all.extend([include_bytes!("cmyk.jpg").to_vec(), include_bytes!("progressive.jpg").to_vec()]);
    survive("a.jpg", &all, 2);
}

#[test]
fn mutated_tga() {
    let mut all = files(ImageFormat::Tga, &[(Colour::Rgb8, 3), (Colour::Rgba8, 4), (Colour::L8, 1)]);
    all.extend(runs());
    survive("a.tga", &all, 3);
}

#[test]
fn mutated_bmp() {
    survive("a.bmp", &files(ImageFormat::Bmp, &[(Colour::Rgb8, 3), (Colour::Rgba8, 4), (Colour::L8, 1)]), 4);
}

#[test]
fn mutated_webp() {
    let mut all = files(ImageFormat::WebP, &[(Colour::Rgb8, 3), (Colour::Rgba8, 4)]);
    all.push(include_bytes!("lossy.webp").to_vec());
    survive("a.webp", &all, 5);
}

#[test]
fn mutated_tiff() {
    let colours = [(Colour::Rgb8, 3), (Colour::Rgba8, 4), (Colour::L8, 1), (Colour::L16, 2), (Colour::Rgb32F, 12)];
    let mut all = files(ImageFormat::Tiff, &colours);
    all.extend([include_bytes!("lzw.tif").to_vec(), include_bytes!("deflate.tif").to_vec()]);
    survive("a.tif", &all, 6);
}

#[test]
fn mutated_hdr() {
    survive("a.hdr", &hdr(), 7);
}

#[test]
fn mutated_exr() {
    survive("a.exr", &exr(), 8);
}
