//! Textures to records and words: levels, formats, tiles.

mod emission;
mod maps;
mod pyramid;
mod source;

use glam::{UVec2, Vec2};
use half::f16;

pub use emission::{MeanEmission, brightest, mean_emission};
pub use maps::pack_maps;

use crate::components::{Channel, Reading, Texels, Texture, Wrap};
use crate::image::srgb::srgb_encode;
use crate::layout::texture::{
    TEXEL_R8, TEXEL_R16, TEXEL_RGBA8, TEXEL_RGBA16F, TEXEL_SLOPES, TEXTURE_CHANNEL_SHIFT, TEXTURE_CLAMP_U,
    TEXTURE_CLAMP_V, TEXTURE_FLIP_GREEN, TEXTURE_SRGB, TILE, TextureRecord, level_count, level_texels, texel_index,
};
use pyramid::Level;
pub use source::Source;

/// Texels a side, at most: a record has 16 bits for each.
const MOST: u32 = 65_536;

/// The kind of texels that a texture becomes, and the channel that is a number.
fn kind(texture: &Texture) -> (u32, Channel) {
    match (texture.reading, &texture.image.texels) {
        (Reading::Height { channel, .. }, _) => (TEXEL_SLOPES, channel),
        (Reading::Number(channel), Texels::Float(_)) => (TEXEL_RGBA16F, channel),
        (Reading::Number(_), Texels::Grey8(_)) => (TEXEL_R8, Channel::Red),
        // A single channel is all that is kept.
        (Reading::Number(Channel::Luminance), Texels::Rgba8(_)) => (TEXEL_R16, Channel::Red),
        (Reading::Number(_), Texels::Rgba8(_)) => (TEXEL_R8, Channel::Red),
        (Reading::Number(_), Texels::Grey16(_) | Texels::Rgba16(_)) => (TEXEL_R16, Channel::Red),
        (_, Texels::Grey8(_)) => (TEXEL_R8, Channel::Red),
        (_, Texels::Grey16(_)) => (TEXEL_R16, Channel::Red),
        (_, Texels::Rgba8(_)) => (TEXEL_RGBA8, Channel::Red),
        (_, Texels::Rgba16(_) | Texels::Float(_)) => (TEXEL_RGBA16F, Channel::Red),
    }
}

/// Words of so many texels.
fn words_of(kind: u32, texels: u64) -> u64 {
    match kind {
        TEXEL_R8 => texels / 4,
        TEXEL_R16 => texels / 2,
        TEXEL_RGBA16F => texels * 2,
        _ => texels,
    }
}

/// Sizes of the levels that are kept when the first `halvings` are left out; the last always is.
fn kept_sizes(size: UVec2, halvings: u32) -> impl Iterator<Item = UVec2> {
    let first = halvings.min(level_count(size) - 1);
    (first..level_count(size)).map(move |level| UVec2::new(size.x >> level, size.y >> level).max(UVec2::ONE))
}

/// Words that a texture takes without its first `halvings` levels.
pub fn words(texture: &Texture, halvings: u32) -> u64 {
    let kind = kind(texture).0;
    kept_sizes(texture.image.size, halvings).map(|size| 1 + words_of(kind, level_texels(size))).sum()
}

/// How often a texture is halved at least, so that no side has more than `most` texels.
pub fn halvings(texture: &Texture, most: u32) -> u32 {
    let longest = texture.image.size.max_element();
    (0..u32::BITS - 1).find(|halvings| longest >> halvings <= most.clamp(1, MOST)).unwrap_or(0)
}

/// A texture's record, but for its first word, and its words without its first `halvings` levels.
pub fn pack(texture: &Texture, halvings: u32) -> (TextureRecord, Vec<u32>) {
    let (kind, channel) = kind(texture);
    let sizes: Vec<UVec2> = kept_sizes(texture.image.size, halvings).collect();
    let mut words = Vec::with_capacity(self::words(texture, halvings) as usize);
    let mut offset = sizes.len() as u64;
    for size in &sizes {
        words.push(offset as u32);
        offset += words_of(kind, level_texels(*size));
    }
    let source = Source::new(texture);
    let (size, skipped) = (texture.image.size, level_count(texture.image.size) - sizes.len() as u32);
    let srgb = texture.reading == Reading::Colour;
    let rgba = |x: u32, y: u32| source.rgba(x, y);
    match kind {
        TEXEL_SLOPES => {
            let slopes = slopes(texture, &source, channel);
            let word = |[u, v]: [f32; 2]| f16_word(u, v);
            pack_levels(size, &|x, y| slopes.at(x, y), skipped, |size, at| pack_texels(size, at, &mut words, word));
        }
        TEXEL_R8 | TEXEL_R16 => {
            let of = if let Reading::Number(channel) = texture.reading { channel } else { Channel::Red };
            let (bits, most) = if kind == TEXEL_R8 { (8, 255.0) } else { (16, 65_535.0) };
            let code = |value: f32| code(value, srgb, most);
            let first = |x: u32, y: u32| [source.channel(of, x, y)];
            pack_levels(size, &first, skipped, |size, at| pack_codes(size, at, &mut words, bits, code));
        }
        TEXEL_RGBA8 => {
            let word = |[r, g, b, a]: [f32; 4]| {
                let [r, g, b] = [r, g, b].map(|value| code(value, srgb, 255.0));
                r | g << 8 | b << 16 | code(a, false, 255.0) << 24
            };
            pack_levels(size, &rgba, skipped, |size, at| pack_texels(size, at, &mut words, word));
        }
        _ => pack_levels(size, &rgba, skipped, |size, at| pack_pairs(size, at, &mut words)),
    }
    (record(texture, sizes[0], sizes.len() as u32, kind, channel), words)
}

/// Reads a texel of a level.
type Fetch<'a, const C: usize> = &'a dyn Fn(u32, u32) -> [f32; C];

/// Packs all levels of a picture but for so many.
fn pack_levels<const C: usize>(
    size: UVec2,
    first: &(impl Fn(u32, u32) -> [f32; C] + Sync),
    skipped: u32,
    mut pack: impl FnMut(UVec2, Fetch<C>),
) {
    if skipped == 0 {
        pack(size, first);
    }
    let mut last: Option<Level<C>> = None;
    for number in 1..level_count(size) {
        let level = last.as_ref().map_or_else(|| Level::halved(size, first), Level::next);
        if number >= skipped {
            pack(level.size, &|x, y| level.at(x, y));
        }
        last = Some(level);
    }
}

/// Calls with each texel and its place among those of its level.
fn each<const C: usize>(size: UVec2, at: Fetch<C>, mut put: impl FnMut(usize, [f32; C])) {
    for y in 0..size.y {
        for x in 0..size.x {
            put(texel_index(UVec2::new(x, y), size.x) as usize, at(x, y));
        }
    }
}

/// Adds a level of a word a texel.
fn pack_texels<const C: usize>(size: UVec2, at: Fetch<C>, words: &mut Vec<u32>, word: impl Fn([f32; C]) -> u32) {
    let start = words.len();
    words.resize(start + level_texels(size) as usize, 0);
    each(size, at, |index, value| words[start + index] = word(value));
}

/// Adds a level of two words a texel: four f16.
fn pack_pairs(size: UVec2, at: Fetch<4>, words: &mut Vec<u32>) {
    let start = words.len();
    words.resize(start + 2 * level_texels(size) as usize, 0);
    each(size, at, |index, [r, g, b, a]| {
        words[start + 2 * index] = f16_word(r, g);
        words[start + 2 * index + 1] = f16_word(b, a);
    });
}

/// Adds a level of several texels a word, of so many bits each.
fn pack_codes(size: UVec2, at: Fetch<1>, words: &mut Vec<u32>, bits: usize, code: impl Fn(f32) -> u32) {
    let start = words.len();
    let per_word = 32 / bits;
    words.resize(start + level_texels(size) as usize / per_word, 0);
    each(size, at, |index, [value]| words[start + index / per_word] |= code(value) << (bits * (index % per_word)));
}

fn code(value: f32, srgb: bool, most: f32) -> u32 {
    let value = value.clamp(0.0, 1.0);
    ((if srgb { srgb_encode(value.into()) as f32 } else { value }) * most + 0.5) as u32
}

/// Two numbers as f16, the first lowest.
fn f16_word(low: f32, high: f32) -> u32 {
    let bits = |v: f32| u32::from(f16::from_f32(v.clamp(-65_504.0, 65_504.0)).to_bits());
    bits(low) | bits(high) << 16
}

/// By how much heights grow along u and v, in heights of white by widths of the picture: central differences.
fn slopes(texture: &Texture, source: &Source, channel: Channel) -> Level<2> {
    let size = texture.image.size;
    let heights = Level::of(size, &|x, y| [source.channel(channel, x, y)]);
    let beside = |at: u32, by: i64, most: u32, wrap: Wrap| match wrap {
        Wrap::Repeat => (i64::from(at) + by).rem_euclid(i64::from(most)) as u32,
        Wrap::Clamp => (i64::from(at) + by).clamp(0, i64::from(most) - 1) as u32,
    };
    let width = size.x as f32;
    Level::of(size, &|x, y| {
        let height = |dx: i64, dy: i64| {
            let (x, y) = (beside(x, dx, size.x, texture.wrap[0]), beside(y, dy, size.y, texture.wrap[1]));
            heights.at(x, y)[0]
        };
        // v grows upwards, rows downwards.
        [0.5 * width * (height(1, 0) - height(-1, 0)), 0.5 * width * (height(0, -1) - height(0, 1))]
    })
}

fn record(texture: &Texture, size: UVec2, levels: u32, kind: u32, channel: Channel) -> TextureRecord {
    let Texture { reading, wrap, scale, offset, gain, base, .. } = texture;
    let number = match channel {
        Channel::Red => 0,
        Channel::Green => 1,
        Channel::Blue => 2,
        Channel::Alpha => 3,
        Channel::Luminance => 4,
    };
    let coded = matches!(kind, TEXEL_RGBA8 | TEXEL_R8 | TEXEL_R16) && *reading == Reading::Colour;
    let flags = [
        (TEXTURE_SRGB, coded),
        (TEXTURE_CLAMP_U, wrap[0] == Wrap::Clamp),
        (TEXTURE_CLAMP_V, wrap[1] == Wrap::Clamp),
        (TEXTURE_FLIP_GREEN, *reading == Reading::Normal { flip_green: true }),
    ];
    let (gain, base) = match reading {
        Reading::Height { depth, .. } => (*depth, 0.0),
        Reading::Normal { .. } => (1.0, 0.0),
        Reading::Colour | Reading::Number(_) => (*gain, *base),
    };
    let texels = f64::from(size.x) * f64::from(size.y) * f64::from((scale.x * scale.y).abs());
    TextureRecord {
        // Rows go down, and v up.
        scale: Vec2::new(scale.x, -scale.y),
        offset: Vec2::new(offset.x, 1.0 - offset.y),
        gain,
        base,
        first: 0,
        size: (size.x - 1) | (size.y - 1) << 16,
        format: flags.iter().filter(|(_, on)| *on).fold(kind, |all, (flag, _)| all | flag)
            | number << TEXTURE_CHANNEL_SHIFT,
        levels,
        density: (0.5 * texels.max(1e-30).log2()) as f32,
        pad: 0,
    }
}

const _: () = assert!((TILE * TILE).is_multiple_of(4), "codes fill whole words");
