//! PNG files of any depth and colour, decoded from sRGB.

use std::io::BufReader;
use std::path::Path;

use glam::UVec2;
use png::{ColorType, Decoder, Info, Limits, Reader, Transformations};

use super::Pixel;
use super::error::Fault;
use super::srgb::srgb_decode;
use super::tail::Tail;
use crate::components::Crop;

/// The first bytes of a file.
pub const MAGIC: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Bytes that a decoder may take beside the pixels.
const MOST_BYTES: usize = 256 << 20;

/// Of primaries and curve, as a cICP chunk numbers those of sRGB.
const CICP_SRGB: [u8; 2] = [1, 13];

/// What sRGB's curve is nearest to.
const GAMMA: f32 = 1.0 / 2.2;

/// What a file says before its pixels.
pub struct Header {
    pub size: UVec2,
    pub notes: Vec<String>,
    pub warnings: Vec<String>,
}

/// Reads all up to the pixels.
pub fn read_header(path: &Path) -> Result<Header, Fault> {
    let mut file = Tail::open(path)?;
    let reader = decoder(&mut file).read_info();
    let header = reader.map(|reader| Header {
        size: UVec2::new(reader.info().width, reader.info().height),
        notes: notes(&reader),
        warnings: warnings(reader.info()),
    });
    header.map_err(|error| file.fault(error))
}

/// The pixels of a window, row by row.
pub fn read(path: &Path, window: Crop) -> Result<Vec<Pixel>, Fault> {
    let mut file = Tail::open(path)?;
    let pixels = decode(&mut file, window);
    pixels.map_err(|error| file.fault(error))
}

/// Palettes and fewer than 8 bits come as 8 bits.
fn decoder(file: &mut Tail) -> Decoder<BufReader<&mut Tail>> {
    let mut decoder = Decoder::new_with_limits(BufReader::new(file), Limits { bytes: MOST_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder
}

fn decode(file: &mut Tail, window: Crop) -> Result<Vec<Pixel>, png::DecodingError> {
    let mut reader = decoder(file).read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or(png::DecodingError::LimitsExceeded)?];
    let frame = reader.next_frame(&mut bytes)?;
    reader.finish()?;
    let channels = frame.color_type.samples();
    let wide = frame.bit_depth == png::BitDepth::Sixteen;
    let most: u16 = if wide { u16::MAX } else { u8::MAX.into() };
    let table: Vec<f32> = (0..=most).map(|code| srgb_decode(f64::from(code) / f64::from(most)) as f32).collect();
    let pixel = |row: &[u8], x: u32| -> Pixel {
        let channel = |channel: usize| {
            let at = x as usize * channels + channel;
            let code = if wide { u16::from_be_bytes([row[2 * at], row[2 * at + 1]]) } else { row[at].into() };
            table[usize::from(code)]
        };
        if channels < 3 { [channel(0); 3] } else { [0, 1, 2].map(channel) }
    };
    let rows = bytes.chunks_exact(frame.line_size).take(window.max.y as usize).skip(window.min.y as usize);
    Ok(rows.flat_map(|row| (window.min.x..window.max.x).map(move |x| pixel(row, x))).collect())
}

fn notes(reader: &Reader<BufReader<&mut Tail>>) -> Vec<String> {
    let mut notes = Vec::new();
    let (colour, depth) = reader.output_color_type();
    if matches!(colour, ColorType::GrayscaleAlpha | ColorType::Rgba) {
        notes.push("alpha is ignored".to_owned());
    }
    if depth != png::BitDepth::Sixteen {
        notes.push("8-bit sRGB, rounded and clipped at 1: z sees that too".to_owned());
    }
    if reader.info().icc_profile.is_some() {
        notes.push("its colour profile is not honoured: it is taken as sRGB".to_owned());
    }
    notes
}

/// Colours that the file says are others than sRGB's.
fn warnings(info: &Info) -> Vec<String> {
    if let Some(points) = &info.coding_independent_code_points {
        let same = [points.color_primaries, points.transfer_function] == CICP_SRGB;
        return if same {
            Vec::new()
        } else {
            vec!["its cICP says other colours than sRGB, and is not honoured".to_owned()]
        };
    }
    let gamma = info.gama_chunk.filter(|_| info.srgb.is_none() && info.icc_profile.is_none());
    match gamma.map(png::ScaledFloat::into_value).filter(|gamma| (gamma - GAMMA).abs() > 0.01) {
        Some(gamma) => vec![format!("its gAMA says {gamma}, not sRGB, and is not honoured")],
        None => Vec::new(),
    }
}
