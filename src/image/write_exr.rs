//! Writes EXR files: linear 32-bit floats, R, G and B, losslessly compressed. A crop is the data window within the whole picture's
//! display window. The metadata are one text attribute: a JSON object in UTF-8. (Several attributes would be written in the order of a
//! hash map, another one in each run.)

use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};

use exr::block::writer::{ChunksWriter, ParallelBlocksCompressor, SequentialBlocksCompressor};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::error::UnitResult;
use exr::image::write::WritableImage;
use exr::image::{Encoding, Image, Layer, SpecificChannels};
use exr::math::Vec2;
use exr::meta::Headers;
use exr::meta::attribute::{AttributeValue, IntegerBounds, Text};
use exr::meta::header::LayerAttributes;

use super::exr::METADATA;
use super::source::{Frame, Metadata, Source, Strip, Told};

/// Bytes within which the attributes of a header of ours end.
const MOST_HEADER: u64 = 1 << 20;

/// Writes the rows as they come. Room is left in the header for metadata that are known at the end.
pub fn write_exr(frame: &Frame, source: &mut dyn Source, out: &mut BufWriter<&File>) -> io::Result<()> {
    let (text, later) = match source.metadata() {
        Told::Now(metadata) => (json(metadata), None),
        Told::AtTheEnd(most) => (" ".repeat(most), Some(most)),
    };
    let written = exr::block::write(&mut *out, headers(frame, &text), true, |meta, chunks| {
        let block_rows = meta.headers[0].compression.scan_lines_per_block();
        if let Some(parallel) = chunks.parallel_blocks_compressor(&meta) {
            return Blocks::new(frame, block_rows, Compressor::Parallel(parallel)).write(source);
        }
        let sequential = chunks.sequential_blocks_compressor(&meta);
        Blocks::new(frame, block_rows, Compressor::Sequential(sequential)).write(source)
    });
    written.map_err(|error| match error {
        exr::error::Error::Io(source) => source,
        other => io::Error::other(other),
    })?;
    match (later, source.metadata()) {
        (Some(most), Told::Now(metadata)) => fill_in(out, most, &json(metadata)),
        _ => Ok(()),
    }
}

fn json(metadata: &Metadata) -> String {
    let metadata: serde_json::Map<_, _> =
        metadata.iter().map(|(key, value)| ((*key).to_owned(), value.as_str().into())).collect();
    serde_json::Value::Object(metadata).to_string()
}

fn headers(frame: &Frame, text: &str) -> Headers {
    let size = frame.window.size();
    let mut attributes = LayerAttributes {
        layer_position: Vec2(signed(frame.window.min.x), signed(frame.window.min.y)),
        software_name: Some(Text::from(concat!("Lucerna ", env!("CARGO_PKG_VERSION")))),
        ..LayerAttributes::default()
    };
    attributes.other.insert(Text::from(METADATA), AttributeValue::Text(Text::from_slice_unchecked(text.as_bytes())));
    let channels = SpecificChannels::rgb(|_: Vec2<usize>| (0f32, 0f32, 0f32));
    let layer = Layer::new((size.x as usize, size.y as usize), attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.display_window = IntegerBounds::new((0, 0), (frame.size.x as usize, frame.size.y as usize));
    image.write().infer_meta_data()
}

/// A pixel coordinate, which is at most [`Film::MAX_SIDE`](crate::components::Film::MAX_SIDE).
fn signed(coordinate: u32) -> i32 {
    i32::try_from(coordinate).unwrap_or(i32::MAX)
}

/// By as many threads as there are processors, or by this one.
enum Compressor<'w, W: ChunksWriter> {
    Parallel(ParallelBlocksCompressor<'w, W>),
    Sequential(SequentialBlocksCompressor<'w, W>),
}

/// Rows to the file's blocks of rows.
struct Blocks<'w, W: ChunksWriter> {
    width: usize,
    height: usize,
    /// Rows of every block but the last.
    block_rows: usize,
    compressor: Compressor<'w, W>,
    /// Blocks that were written.
    written: usize,
    /// Pixels of a block that is not full yet.
    begun: Vec<[f32; 3]>,
}

impl<'w, W: ChunksWriter> Blocks<'w, W> {
    fn new(frame: &Frame, block_rows: usize, compressor: Compressor<'w, W>) -> Self {
        let size = frame.window.size();
        let (width, height) = (size.x as usize, size.y as usize);
        Self { width, height, block_rows, compressor, written: 0, begun: Vec::new() }
    }

    fn write(mut self, source: &mut dyn Source) -> UnitResult {
        while let Some(Strip { linear, .. }) = source.strip()? {
            self.add(linear)?;
        }
        while self.written * self.block_rows < self.height {
            let black = vec![[0.0; 3]; self.next_rows() * self.width - self.begun.len()];
            self.add(&black)?;
        }
        Ok(())
    }

    /// Rows of the block that is next.
    fn next_rows(&self) -> usize {
        self.block_rows.min(self.height - self.written * self.block_rows)
    }

    fn add(&mut self, mut pixels: &[[f32; 3]]) -> UnitResult {
        while !pixels.is_empty() && self.written * self.block_rows < self.height {
            let whole = self.next_rows() * self.width;
            let taken = (whole - self.begun.len()).min(pixels.len());
            let (now, later) = pixels.split_at(taken);
            pixels = later;
            if self.begun.is_empty() && taken == whole {
                self.put(now)?;
                continue;
            }
            self.begun.extend_from_slice(now);
            if self.begun.len() == whole {
                let block = std::mem::take(&mut self.begun);
                self.put(&block)?;
            }
        }
        Ok(())
    }

    /// Writes a block: for each row its B, its G, then its R, as the channels' names are ordered.
    fn put(&mut self, pixels: &[[f32; 3]]) -> UnitResult {
        let mut data = Vec::with_capacity(size_of_val(pixels));
        for row in pixels.chunks(self.width) {
            for channel in [2, 1, 0] {
                data.extend(row.iter().flat_map(|pixel| pixel[channel].to_ne_bytes()));
            }
        }
        let index = BlockIndex {
            layer: 0,
            pixel_position: Vec2(0, self.written * self.block_rows),
            pixel_size: Vec2(self.width, pixels.len() / self.width),
            level: Vec2(0, 0),
        };
        let block = UncompressedBlock { index, data };
        let place = self.written;
        self.written += 1;
        match &mut self.compressor {
            Compressor::Parallel(compressor) => compressor.add_block_to_compression_queue(place, block),
            Compressor::Sequential(compressor) => compressor.compress_block(place, block),
        }
    }
}

/// Writes metadata into the room that was left for them, `most` bytes; none where they don't fit.
fn fill_in(out: &mut BufWriter<&File>, most: usize, text: &str) -> io::Result<()> {
    if text.len() > most {
        return Ok(());
    }
    out.flush()?;
    let mut file: &File = out.get_ref();
    file.rewind()?;
    let mut start = Vec::new();
    file.take(MOST_HEADER).read_to_end(&mut start)?;
    // An attribute is its name, its type, the number of its bytes, and those.
    let name = [METADATA.as_bytes(), b"\0string\0", &(most as u32).to_le_bytes()].concat();
    if let Some(at) = start.windows(name.len()).position(|bytes| bytes == name) {
        let mut file: &File = out.get_ref();
        file.seek(SeekFrom::Start((at + name.len()) as u64))?;
        file.write_all(text.as_bytes())?;
    }
    Ok(())
}
