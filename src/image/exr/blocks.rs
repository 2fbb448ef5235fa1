//! Pixels of an EXR file: only blocks that the wanted window touches are read and decoded, by several threads.

use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::Mutex;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates};
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::SampleType;
use exr::prelude::f16;

use super::{Channels, ExrFile};
use crate::components::Crop;
use crate::image::Pixel;
use crate::image::error::Fault;
use crate::image::tail::Tail;

/// Bytes of a block once decoded, at most: a file says the size of a block in 31 bits.
const MOST_BLOCK: u64 = 1 << 31;

/// Bytes of the blocks that all threads may hold at once, if that leaves one thread.
const MOST_AT_ONCE: u64 = 1 << 30;

/// Luminance of Rec.709's red and blue.
const LUMINANCE: [f32; 2] = [0.2126, 0.0722];

/// Where in a block the samples of a channel are.
#[derive(Clone, Copy, Debug)]
struct Samples {
    /// Bytes of the channels before it, for one pixel.
    before: usize,
    kind: SampleType,
}

/// Rows of the window that are in one row of blocks.
struct Band<'a, T> {
    /// Of the file's rows of blocks.
    index: u64,
    /// The first row and the first behind the last, in the file.
    rows: [u32; 2],
    pixels: &'a mut [T],
}

/// A block, where the wanted samples are in it, and how many bytes all samples of a pixel take.
struct Decoded<'a> {
    block: UncompressedBlock,
    samples: &'a [Samples],
    bytes: usize,
}

impl ExrFile {
    /// The pixels of a window of the data window, row by row.
    pub fn read(&self, path: &Path, window: Crop) -> Result<Vec<Pixel>, Fault> {
        self.read_as(path, window, |block, at| self.colour(block, at))
    }

    /// The same with alpha, as it is stored: colours are not divided by it. 1 where the file has none.
    pub fn read_with_alpha(&self, path: &Path, window: Crop) -> Result<Vec<[f32; 4]>, Fault> {
        let last = self.channels.indices().len();
        self.read_as(path, window, |block, at| {
            let [r, g, b] = self.colour(block, at);
            [r, g, b, if self.alpha.is_some() { block.value(last, at) } else { 1.0 }]
        })
    }

    /// What `pixel` makes of column and row of a block, for each pixel of a window.
    fn read_as<T: Copy + Default + Send>(
        &self,
        path: &Path,
        window: Crop,
        pixel: impl Fn(&Decoded, [usize; 2]) -> T + Sync,
    ) -> Result<Vec<T>, Fault> {
        let size = self.header().max_block_pixel_size();
        let block = [size.x() as u64, size.y() as u64];
        let area = block[0].min(self.size.x.into()) * block[1].min(self.size.y.into());
        let bytes = area.saturating_mul(self.header().channels.bytes_per_pixel as u64);
        if bytes > MOST_BLOCK {
            let what = format!("a block of its pixels takes {bytes} bytes");
            return Err(Fault::Unsupported { what, help: "write it with fewer channels, or in smaller tiles" });
        }
        let mut pixels = vec![T::default(); window.size().x as usize * window.size().y as usize];
        let bands = Mutex::new(bands(&mut pixels, window, block[1]).into_iter());
        let work = || -> Result<(), Fault> {
            let mut file = Tail::open(path)?;
            loop {
                let next = bands.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
                let Some(band) = next else { return Ok(()) };
                self.fill(&mut file, band, window, block[0], &pixel)?;
            }
        };
        let threads = std::thread::available_parallelism().map_or(1, |threads| threads.get() as u64);
        let threads = threads.min(MOST_AT_ONCE / bytes.max(1)).max(1);
        std::thread::scope(|scope| {
            let all: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            all.into_iter().try_for_each(|thread| thread.join().unwrap_or_else(|_| Err(damaged())))
        })?;
        Ok(pixels)
    }

    /// Decodes a row of blocks as far as the window goes.
    fn fill<T>(
        &self,
        file: &mut Tail,
        band: Band<T>,
        window: Crop,
        width: u64,
        pixel: &impl Fn(&Decoded, [usize; 2]) -> T,
    ) -> Result<(), Fault> {
        let (samples, bytes) = (self.samples(), self.header().channels.bytes_per_pixel);
        let columns = u64::from(window.min.x) / width..=u64::from(window.max.x - 1) / width;
        for column in columns {
            let decoded = Decoded { block: self.block(file, column, band.index)?, samples: &samples, bytes };
            let block = &decoded.block;
            let first = (column * width) as u32;
            let from = window.min.x.max(first);
            let end = window.max.x.min(first.saturating_add(block.index.pixel_size.x() as u32));
            for y in band.rows[0]..band.rows[1] {
                let row = (y - band.rows[0]) as usize * window.size().x as usize;
                for x in from..end {
                    let at = [(x - first) as usize, y as usize - block.index.pixel_position.y()];
                    band.pixels[row + (x - window.min.x) as usize] = pixel(&decoded, at);
                }
            }
        }
        Ok(())
    }

    /// Reads and decodes one block of the largest level.
    fn block(&self, file: &mut Tail, column: u64, row: u64) -> Result<UncompressedBlock, Fault> {
        let header = self.header();
        let (columns, width) = (u64::from(self.size.x), header.max_block_pixel_size().x() as u64);
        // The largest level is the first of the table, row by row, in whatever order blocks are written.
        let entry = self.table.saturating_add(8 * (row * columns.div_ceil(width) + column));
        let [low, high] = words(file, entry)?;
        let mut at = u64::from(low) | u64::from(high) << 32;
        if at < self.start || at >= self.length {
            // Writers put the table last: a file that they did not finish has zeros.
            return Err(Fault::CutShort);
        }
        if self.meta.requirements.is_multilayer() {
            let [part] = words(file, at)?;
            expect(part as usize == self.part)?;
            at += 4;
        }
        let compressed_block = match header.blocks {
            BlockDescription::ScanLines => {
                let [y, bytes] = words(file, at)?;
                let height = header.compression.scan_lines_per_block() as i64;
                let first = i64::from(header.own_attributes.layer_position.y()) + row as i64 * height;
                expect(i64::from(y as i32) == first)?;
                let compressed_pixels_le = self.content(file, bytes)?;
                CompressedBlock::ScanLine(CompressedScanLineBlock { y_coordinate: y as i32, compressed_pixels_le })
            }
            BlockDescription::Tiles(_) => {
                let [x, y, level_x, level_y, bytes] = words(file, at)?;
                expect([u64::from(x), u64::from(y)] == [column, row] && [level_x, level_y] == [0, 0])?;
                let tile_index = Vec2(x as usize, y as usize);
                let coordinates = TileCoordinates { tile_index, level_index: Vec2(0, 0) };
                let compressed_pixels_le = self.content(file, bytes)?;
                CompressedBlock::Tile(CompressedTileBlock { coordinates, compressed_pixels_le })
            }
        };
        let chunk = Chunk { layer_index: self.part, compressed_block };
        UncompressedBlock::decompress_chunk(chunk, &self.meta, false).map_err(|error| Fault::Broken(error.to_string()))
    }

    /// The compressed bytes of a block, from where the file is read.
    fn content(&self, file: &mut Tail, bytes: u32) -> Result<Vec<u8>, Fault> {
        let at = file.stream_position().map_err(Fault::Open)?;
        expect(i32::try_from(bytes).is_ok())?;
        if u64::from(bytes) > self.length - at.min(self.length) {
            return Err(Fault::CutShort);
        }
        let mut content = vec![0; bytes as usize];
        file.read_exact(&mut content).map_err(unread)?;
        Ok(content)
    }

    /// Where the samples of a pixel are, in the order of [`Channels`]; alpha last, if there is any.
    fn samples(&self) -> Vec<Samples> {
        let list = &self.header().channels.list;
        let bytes = |end: usize| list[..end].iter().map(|channel| channel.sample_type.bytes_per_sample()).sum();
        let samples = |index: &usize| Samples { before: bytes(*index), kind: list[*index].sample_type };
        self.channels.indices().iter().chain(&self.alpha).map(samples).collect()
    }

    /// The colour at column and row of a block.
    fn colour(&self, block: &Decoded, at: [usize; 2]) -> Pixel {
        let value = |channel: usize| block.value(channel, at);
        match self.channels {
            Channels::Colour(_) => [0, 1, 2].map(value),
            Channels::Luminance(_) => [value(0); 3],
            Channels::Chroma(_) => {
                let [y, ry, by] = [0, 1, 2].map(value);
                let (r, b) = ((ry + 1.0) * y, (by + 1.0) * y);
                let g = (y - LUMINANCE[0] * r - LUMINANCE[1] * b) / (1.0 - LUMINANCE[0] - LUMINANCE[1]);
                [r, g, b]
            }
        }
    }
}

impl Decoded<'_> {
    /// A sample of a pixel: that of one of the wanted channels.
    fn value(&self, channel: usize, at: [usize; 2]) -> f32 {
        sample(&self.block, self.bytes, self.samples[channel], at)
    }
}

/// The rows of a window by the rows of blocks, of so many pixels each, that they are in.
fn bands<T>(pixels: &mut [T], window: Crop, height: u64) -> Vec<Band<'_, T>> {
    let mut rest = pixels;
    let indices = u64::from(window.min.y) / height..=u64::from(window.max.y - 1) / height;
    let band = |index: u64| {
        let clamp = |row: u64| row.clamp(window.min.y.into(), window.max.y.into()) as u32;
        let rows = [clamp(index * height), clamp((index + 1) * height)];
        let (pixels, others) =
            std::mem::take(&mut rest).split_at_mut((rows[1] - rows[0]) as usize * window.size().x as usize);
        rest = others;
        Band { index, rows, pixels }
    };
    indices.map(band).collect()
}

/// A sample as a number. A block has line by line, and in a line channel by channel; its pixels take `bytes` each.
fn sample(block: &UncompressedBlock, bytes: usize, Samples { before, kind }: Samples, [x, y]: [usize; 2]) -> f32 {
    let at = (y * bytes + before) * block.index.pixel_size.x() + x * kind.bytes_per_sample();
    let four = || block.data.get(at..at + 4).and_then(|bytes| bytes.try_into().ok()).unwrap_or([0; 4]);
    match kind {
        SampleType::F16 => {
            let two = block.data.get(at..at + 2).and_then(|bytes| bytes.try_into().ok()).unwrap_or([0; 2]);
            f16::from_ne_bytes(two).to_f32()
        }
        SampleType::F32 => f32::from_ne_bytes(four()),
        SampleType::U32 => u32::from_ne_bytes(four()) as f32,
    }
}

/// Little-endian words at a place in the file.
fn words<const N: usize>(file: &mut Tail, at: u64) -> Result<[u32; N], Fault> {
    file.seek(SeekFrom::Start(at)).map_err(Fault::Open)?;
    let mut words = [[0; 4]; N];
    file.read_exact(words.as_flattened_mut()).map_err(unread)?;
    Ok(words.map(u32::from_le_bytes))
}

fn unread(error: std::io::Error) -> Fault {
    if error.kind() == ErrorKind::UnexpectedEof { Fault::CutShort } else { Fault::Open(error) }
}

/// What the library could not even refuse.
fn damaged() -> Fault {
    Fault::Broken("its compressed pixels are damaged".to_owned())
}

fn expect(right: bool) -> Result<(), Fault> {
    if right { Ok(()) } else { Err(Fault::Broken("its table of offsets leads to other blocks".to_owned())) }
}
