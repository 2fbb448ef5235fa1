//! Pixels that are drawn on: sRGB, without clipping errors beyond the edges.

use std::io::Write;
use std::path::Path;

use glam::{IVec2, UVec2};

use crate::image::{SaveError, file};

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    pub min: UVec2,
    pub size: UVec2,
}

impl Rect {
    pub fn new(x: u32, y: u32, width: u32, height: u32) -> Self {
        Self { min: UVec2::new(x, y), size: UVec2::new(width, height) }
    }

    pub fn max(&self) -> UVec2 {
        self.min + self.size
    }
}

/// A picture in the making.
#[derive(Clone, Debug)]
pub struct Canvas {
    pub size: UVec2,
    /// Row by row from the top.
    pub pixels: Vec<[u8; 3]>,
}

/// Pixels from one line of a hatching to the next.
const HATCH: u32 = 12;

impl Canvas {
    pub fn new(size: UVec2, colour: [u8; 3]) -> Self {
        Self { size, pixels: vec![colour; size.x as usize * size.y as usize] }
    }

    /// The colour at a place; none beyond the edges.
    pub fn at(&self, at: UVec2) -> Option<[u8; 3]> {
        at.cmplt(self.size).all().then(|| self.pixels[self.index(at)])
    }

    /// Mixes a colour in, `cover` from 0 to 1. Beyond the edges nothing happens.
    pub fn mix(&mut self, at: IVec2, colour: [u8; 3], cover: f32) {
        let Ok(at) = UVec2::try_from(at) else { return };
        if at.cmplt(self.size).all() {
            let index = self.index(at);
            let mixed = |channel: usize| {
                let (below, above) = (f32::from(self.pixels[index][channel]), f32::from(colour[channel]));
                (below + (above - below) * cover.clamp(0.0, 1.0)).round() as u8
            };
            self.pixels[index] = [0, 1, 2].map(mixed);
        }
    }

    pub fn fill(&mut self, rect: Rect, colour: [u8; 3]) {
        self.each(rect, |_, pixel| *pixel = colour);
    }

    /// Diagonal lines, for what is not there.
    pub fn hatch(&mut self, rect: Rect, ground: [u8; 3], line: [u8; 3]) {
        self.each(rect, |at, pixel| *pixel = if (at.x + at.y) % HATCH < 2 { line } else { ground });
    }

    /// Puts a picture down with its top left corner there.
    pub fn put(&mut self, min: UVec2, size: UVec2, pixels: &[[u8; 3]]) {
        let width = size.x as usize;
        self.each(Rect { min, size }, |at, pixel| {
            let from = at - min;
            *pixel = pixels[from.y as usize * width + from.x as usize];
        });
    }

    /// Writes it as PNG, whole.
    pub fn write(&self, path: &Path) -> Result<(), SaveError> {
        file::write(path, |out| out.write_all(&self.png()?))
    }

    /// As the content of a PNG.
    pub fn png(&self) -> std::io::Result<Vec<u8>> {
        let mut content = Vec::new();
        let mut encoder = png::Encoder::new(&mut content, self.size.x, self.size.y);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        // Pictures of noise hardly get smaller by more effort.
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()?;
        Ok(content)
    }

    fn index(&self, at: UVec2) -> usize {
        at.y as usize * self.size.x as usize + at.x as usize
    }

    fn each(&mut self, rect: Rect, mut change: impl FnMut(UVec2, &mut [u8; 3])) {
        let end = rect.max().min(self.size);
        for y in rect.min.y..end.y {
            for x in rect.min.x..end.x {
                let index = self.index(UVec2::new(x, y));
                change(UVec2::new(x, y), &mut self.pixels[index]);
            }
        }
    }
}
