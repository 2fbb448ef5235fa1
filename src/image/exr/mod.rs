//! EXR files of any program: half, float and integer channels, scan lines and tiles, one part or many.

mod blocks;
mod channels;

use std::io::{BufReader, Read, Seek};
use std::path::Path;

use channels::{Channels, Layer};
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Chromaticities, Compression, EnvironmentMap, Text};
use exr::meta::header::Header;
use glam::{IVec2, UVec2};

use super::error::Fault;
use super::tail::Tail;

/// The first bytes of a file.
pub const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The attribute that a render's metadata are in: a JSON object.
pub const METADATA: &str = "lucerna";

/// The bit of the version field that says that some part is deep.
const DEEP: u32 = 1 << 11;

/// The primaries and the white of Rec.709.
const REC_709: [f32; 8] = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329];

/// What the headers of an EXR file say about the part that is read.
#[derive(Debug)]
pub struct ExrFile {
    /// Of the data window, pixels.
    pub size: UVec2,
    /// Top left of the data window, from that of the display window.
    pub place: IVec2,
    /// Of the display window, pixels.
    pub shown: UVec2,
    /// What is left out.
    pub notes: Vec<String>,
    /// What may not be as it was meant.
    pub warnings: Vec<String>,
    meta: MetaData,
    part: usize,
    channels: Channels,
    /// Of the same layer, as an index of the part's list. Pictures of light have no use for it.
    alpha: Option<usize>,
    /// Bytes before the part's table of offsets.
    table: u64,
    /// Bytes before the first pixel of any part.
    start: u64,
    /// Bytes of the file.
    length: u64,
}

impl ExrFile {
    /// Reads the headers, and chooses what is read.
    pub fn open(path: &Path) -> Result<Self, Fault> {
        let mut file = Tail::open(path)?;
        let length = file.length()?;
        let (meta, end) = read_headers(&mut file)?;
        let Some((layer, others)) = channels::choose(&meta.headers) else { return Err(no_layer(&meta)) };
        let header = &meta.headers[layer.part];
        check(header, meta.requirements.is_multilayer())?;
        let after = |headers: &[Header]| {
            headers.iter().fold(end, |at, header| at.saturating_add((header.chunk_count as u64).saturating_mul(8)))
        };
        let at = header.own_attributes.layer_position;
        let window = header.shared_attributes.display_window;
        let mut file = Self {
            size: sides(header.layer_size),
            place: IVec2::new(at.x() - window.position.x(), at.y() - window.position.y()),
            shown: sides(window.size),
            notes: notes(header, &layer, meta.headers.len()),
            warnings: Vec::new(),
            part: layer.part,
            channels: layer.channels,
            alpha: layer.alpha,
            table: after(&meta.headers[..layer.part]),
            start: after(&meta.headers),
            length,
            meta,
        };
        file.warnings = file.warnings(&layer, &others);
        Ok(file)
    }

    /// Whether it has an alpha of its own.
    pub fn has_alpha(&self) -> bool {
        self.alpha.is_some()
    }

    /// The exposure, stops, that a render of ours was shown at.
    pub fn exposure(&self) -> Option<f32> {
        let attributes = &self.header().own_attributes.other;
        let Some(AttributeValue::Text(text)) = attributes.get(&Text::from(METADATA)) else { return None };
        let metadata: serde_json::Value = serde_json::from_str(&text.to_string()).ok()?;
        metadata.get("exposure")?.as_str()?.parse().ok().filter(|stops: &f32| stops.is_finite())
    }

    fn header(&self) -> &Header {
        &self.meta.headers[self.part]
    }

    fn warnings(&self, layer: &Layer, others: &[Layer]) -> Vec<String> {
        let mut warnings = Vec::new();
        if !others.is_empty() {
            let others: Vec<String> = others.iter().map(|other| format!("`{}`", other.name)).collect();
            warnings.push(format!("its layer `{}` is read, not {}", layer.name, others.join(", ")));
        }
        let header = self.header();
        if header.shared_attributes.chromaticities.is_some_and(|colours| !is_rec_709(&colours)) {
            warnings.push("its chromaticities are not those of Rec.709, and are taken as those".to_owned());
        }
        if header.own_attributes.environment_map == Some(EnvironmentMap::Cube) {
            let text =
                "it says that it is the six sides of a cube, which is not honoured: write it by longitude and latitude";
            warnings.push(text.to_owned());
        }
        warnings
    }
}

/// The headers, and how many bytes they take.
fn read_headers(file: &mut Tail) -> Result<(MetaData, u64), Fault> {
    let mut start = [0; 8];
    file.read_exact(&mut start).map_err(|error| file.fault(error))?;
    file.rewind().map_err(Fault::Open)?;
    let mut buffered = BufReader::new(&mut *file);
    let meta = MetaData::read_from_buffered(&mut buffered, false);
    let end = buffered.stream_position();
    let flags = u32::from_le_bytes([start[4], start[5], start[6], start[7]]);
    match meta {
        Ok(meta) if meta.requirements.has_deep_data && meta.headers.len() == 1 => Err(deep()),
        Ok(meta) => Ok((meta, end.map_err(Fault::Open)?)),
        // Headers of deep parts may have what the library does not know.
        Err(_) if flags & DEEP != 0 => Err(deep()),
        Err(error) => Err(file.fault(error)),
    }
}

/// Why nothing of a file can be read.
fn no_layer(meta: &MetaData) -> Fault {
    if meta.headers.iter().any(|header| header.deep) {
        return deep();
    }
    if meta.headers.is_empty() {
        return Fault::Broken("it has no parts".to_owned());
    }
    let all = meta.headers.iter().flat_map(|header| &header.channels.list);
    Fault::Channels(all.map(|channel| channel.name.to_string()).collect::<Vec<_>>().join(", "))
}

fn deep() -> Fault {
    let what = "is a deep picture: its pixels have many samples each".to_owned();
    Fault::Unsupported { what, help: "flatten it to one colour a pixel, and write that" }
}

/// Refuses what the library does not decode, and what does not fit together.
fn check(header: &Header, parts: bool) -> Result<(), Fault> {
    let subsampled = header.channels.list.iter().filter(|channel| channel.sampling != Vec2(1, 1));
    let subsampled: Vec<String> = subsampled.map(|channel| channel.name.to_string()).collect();
    if !subsampled.is_empty() {
        let what = format!("its channels {} are subsampled", subsampled.join(", "));
        return Err(Fault::Unsupported {
            what,
            help: "write it as RGB, with a sample in each channel for every pixel",
        });
    }
    if matches!(header.compression, Compression::HTJ2K32 | Compression::HTJ2K256) {
        let what = format!("its {} is not read", header.compression);
        return Err(Fault::Unsupported { what, help: "write it with another compression, such as ZIP or PIZ" });
    }
    header.validate(parts, &mut false, false).map_err(|error| Fault::Broken(error.to_string()))
}

fn sides(size: Vec2<usize>) -> UVec2 {
    let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
    UVec2::new(side(size.x()), side(size.y()))
}

fn is_rec_709(colours: &Chromaticities) -> bool {
    let Chromaticities { red, green, blue, white } = colours;
    let found = [red, green, blue, white].into_iter().flat_map(|colour| [colour.x(), colour.y()]);
    found.zip(REC_709).all(|(found, right)| (found - right).abs() < 2e-3)
}

/// What of the file is left out, and how the rest becomes colours.
fn notes(header: &Header, layer: &Layer, parts: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let used = layer.channels.indices();
    let others = header.channels.list.iter().enumerate().filter(|(index, _)| !used.contains(index));
    let others: Vec<String> = others.map(|(_, channel)| channel.name.to_string()).collect();
    if !others.is_empty() {
        notes.push(format!("its channels {} are ignored", others.join(", ")));
    }
    match layer.channels {
        Channels::Colour(_) => {}
        Channels::Chroma(_) => notes.push("its luminance and chroma are turned into Rec.709 colours".to_owned()),
        Channels::Luminance(_) => notes.push("it is grey".to_owned()),
    }
    if parts > 1 {
        notes.push(format!("part {} of its {parts} parts is read", layer.part + 1));
    }
    notes
}
