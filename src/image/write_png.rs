//! Writes PNG files: 8-bit sRGB of the window, with the metadata as text.

use std::io::{self, Write};

use png::text_metadata::{ITXtChunk, TEXtChunk};
use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};

use super::source::{Frame, Source, Told};

/// Bytes of a chunk of pixels.
const CHUNK: usize = 1 << 20;

/// Pixels that are packed at once.
const PIECE: usize = 1 << 16;

/// Writes the rows as they come. Metadata that are known at the end are text behind the pixels, which PNG allows.
pub fn write_png(frame: &Frame, source: &mut dyn Source, out: &mut impl Write) -> io::Result<()> {
    let size = frame.window.size();
    let mut encoder = Encoder::new(out, size.x, size.y);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    // Pictures of noise hardly get smaller by more effort.
    encoder.set_compression(Compression::Fast);
    let before = matches!(source.metadata(), Told::Now(_));
    if let Told::Now(metadata) = source.metadata() {
        for (key, value) in metadata {
            let (key, value) = ((*key).to_owned(), value.clone());
            // A tEXt chunk is Latin-1; names of files need not be.
            match value.is_ascii() {
                true => encoder.add_text_chunk(key, value)?,
                false => encoder.add_itxt_chunk(key, value)?,
            }
        }
    }
    let mut writer = encoder.write_header()?;
    let mut rows = writer.stream_writer_with_size(CHUNK)?;
    let mut left = u64::from(size.x) * u64::from(size.y) * 3;
    while let Some(strip) = source.strip()? {
        for piece in strip.display.chunks(PIECE) {
            let bytes: Vec<u8> = piece.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
            rows.write_all(&bytes)?;
            left = left.saturating_sub(bytes.len() as u64);
        }
    }
    io::copy(&mut io::Read::take(io::repeat(0), left), &mut rows)?;
    rows.finish()?;
    if let (false, Told::Now(metadata)) = (before, source.metadata()) {
        for (key, value) in metadata {
            match value.is_ascii() {
                true => writer.write_text_chunk(&TEXtChunk::new(*key, value.as_str()))?,
                false => writer.write_text_chunk(&ITXtChunk::new(*key, value.as_str()))?,
            }
        }
    }
    writer.finish()?;
    Ok(())
}
