//! Radiance HDR files: the header of any program, all eight orientations, and what the file says was done to its pixels undone.
//!
//! The image crate decodes the scan lines; it knows one orientation, and neither EXPOSURE nor COLORCORR.
//! Header after Ward 1994, "The RADIANCE picture file format" (radiance-online.org, `refer/filefmts.pdf`).

use std::io::{BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::Path;

use glam::UVec2;
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;

use super::Pixel;
use super::error::Fault;
use super::tail::Tail;
use crate::components::Crop;

/// The first bytes of most files; what follows is the name of a program, most often `RADIANCE` or `RGBE`.
pub const MAGIC: &[u8] = b"#?";

const FORMAT: &str = "32-bit_rle_rgbe";

/// Bytes of a header, at most.
const MOST_HEADER: u64 = 1 << 20;

/// Primaries and white point that count as Rec.709's: its own, and Radiance's default.
const PRIMARIES: [[f32; 8]; 2] =
    [[0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329], [0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 0.333, 0.333]];

/// Whether a file that begins so is one: by its magic, or by a line that names the format.
pub fn is_hdr(start: &[u8]) -> bool {
    let mut lines = start.split(|byte| *byte == b'\n').take_while(|line| !line.trim_ascii().is_empty());
    start.starts_with(MAGIC) || lines.any(|line| line.starts_with(b"FORMAT=32-bit_rle_"))
}

/// The header of a file.
#[derive(Debug)]
pub struct HdrFile {
    pub size: UVec2,
    /// What may not be as it was meant.
    pub warnings: Vec<String>,
    order: Order,
    /// What the channels are divided by.
    exposure: [f64; 3],
    /// Bytes before the pixels.
    start: u64,
}

/// How scan lines lie in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Order {
    /// A scan line is a column.
    columns: bool,
    right_to_left: bool,
    bottom_to_top: bool,
}

impl HdrFile {
    pub fn open(path: &Path) -> Result<Self, Fault> {
        let mut file = Tail::open(path)?;
        let mut header = Self {
            size: UVec2::ZERO,
            warnings: Vec::new(),
            order: Order { columns: false, right_to_left: false, bottom_to_top: false },
            exposure: [1.0; 3],
            start: 0,
        };
        let mut reader = BufReader::new(&mut file).take(MOST_HEADER);
        loop {
            let line = header.line(&mut reader)?;
            // What a program before the last one wrote is indented, and was accounted for by the last one.
            match line.split_once('=') {
                _ if line.is_empty() => break,
                Some((key, value)) if !line.starts_with('#') => header.set(key.trim_end(), value.trim())?,
                _ => {}
            }
        }
        let resolution = header.line(&mut reader)?;
        (header.size, header.order) = orientation(&resolution)
            .ok_or_else(|| Fault::Broken(format!("`{resolution}` is not its size, such as `-Y 512 +X 1024`")))?;
        Ok(header)
    }

    /// The next line of the header.
    fn line(&mut self, reader: &mut impl BufRead) -> Result<String, Fault> {
        let mut line = Vec::new();
        reader.read_until(b'\n', &mut line).map_err(Fault::Open)?;
        self.start += line.len() as u64;
        match line.pop() {
            Some(b'\n') => Ok(String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(&line)).into_owned()),
            _ if self.start < MOST_HEADER => Err(Fault::CutShort),
            _ => Err(Fault::Broken("its header has no end".to_owned())),
        }
    }

    /// Takes up a line `KEY=value`.
    fn set(&mut self, key: &str, value: &str) -> Result<(), Fault> {
        let numbers: Option<Vec<f64>> = value.split_whitespace().map(|number| number.parse().ok()).collect();
        let numbers = numbers.unwrap_or_default();
        let above_zero = |number: &f64| *number > 0.0 && number.is_finite();
        match (key, numbers.as_slice()) {
            ("FORMAT", _) if value == FORMAT => {}
            ("FORMAT", _) if value == "32-bit_rle_xyze" => {
                let what = "its pixels are CIE XYZ (FORMAT=32-bit_rle_xyze), not RGB".to_owned();
                return Err(Fault::Unsupported { what, help: "turn it into RGB with Radiance's `ra_xyze -r`" });
            }
            ("FORMAT", _) => {
                let what = format!("its FORMAT is `{value}`");
                return Err(Fault::Unsupported { what, help: "write it with FORMAT=32-bit_rle_rgbe" });
            }
            ("EXPOSURE", [exposure]) if above_zero(exposure) => self.divide([*exposure; 3]),
            ("COLORCORR", [r, g, b]) if [r, g, b].into_iter().all(above_zero) => self.divide([*r, *g, *b]),
            ("EXPOSURE" | "COLORCORR", _) => {
                return Err(Fault::Broken(format!("its {key} `{value}` is not made of numbers above 0")));
            }
            ("GAMMA", [gamma]) if *gamma != 1.0 => {
                self.warnings.push(format!("its GAMMA of {gamma} is not undone: pixels are taken as linear"));
            }
            ("PRIMARIES", primaries) if !PRIMARIES.iter().any(|known| alike(primaries, known)) => {
                self.warnings.push("its PRIMARIES are not those of Rec.709, and are taken as those".to_owned());
            }
            _ => {}
        }
        Ok(())
    }

    fn divide(&mut self, by: [f64; 3]) {
        self.exposure = std::array::from_fn(|channel| self.exposure[channel] * by[channel]);
    }

    /// The pixels of a window, row by row.
    pub fn read(&self, path: &Path, window: Crop) -> Result<Vec<Pixel>, Fault> {
        let mut file = Tail::open(path)?;
        let lines = self.scan_lines(&mut file).map_err(|error| file.fault(error))?;
        let width = if self.order.columns { self.size.y } else { self.size.x } as usize;
        let pixel = |x: u32, y: u32| {
            let x = if self.order.right_to_left { self.size.x - 1 - x } else { x } as usize;
            let y = if self.order.bottom_to_top { self.size.y - 1 - y } else { y } as usize;
            let pixel = if self.order.columns { lines[x * width + y] } else { lines[y * width + x] };
            std::array::from_fn(|channel| (f64::from(pixel[channel]) / self.exposure[channel]) as f32)
        };
        Ok((window.min.y..window.max.y).flat_map(|y| (window.min.x..window.max.x).map(move |x| pixel(x, y))).collect())
    }

    /// All scan lines as the file has them, decoded as if they were rows from the top.
    fn scan_lines(&self, file: &mut Tail) -> image::ImageResult<Vec<Pixel>> {
        file.seek(SeekFrom::Start(self.start))?;
        let [length, lines] = if self.order.columns { [self.size.y, self.size.x] } else { self.size.to_array() };
        let header = Cursor::new(format!("#?RADIANCE\n\n-Y {lines} +X {length}\n"));
        let mut pixels = vec![[0.0; 3]; length as usize * lines as usize];
        HdrDecoder::new(header.chain(BufReader::new(file)))?.read_image(bytemuck::cast_slice_mut(&mut pixels))?;
        Ok(pixels)
    }
}

/// `-Y 512 +X 1024`: scan lines from the top, each from the left; the first axis is that along which scan lines follow each other.
fn orientation(line: &str) -> Option<(UVec2, Order)> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [first, lines, second, length] = words[..] else { return None };
    let (lines, length) = (lines.parse().ok()?, length.parse().ok()?);
    let (columns, x, y) = match (first, second) {
        ("-Y" | "+Y", "-X" | "+X") => (false, second, first),
        ("-X" | "+X", "-Y" | "+Y") => (true, first, second),
        _ => return None,
    };
    let size = if columns { UVec2::new(lines, length) } else { UVec2::new(length, lines) };
    Some((size, Order { columns, right_to_left: x == "-X", bottom_to_top: y == "+Y" }))
}

fn alike(found: &[f64], known: &[f32; 8]) -> bool {
    found.len() == known.len() && found.iter().zip(known).all(|(found, known)| (found - f64::from(*known)).abs() < 5e-3)
}
