//! Lookups of textures in f64, on the words and random numbers of the kernel: the twin of `lib/texture` and `passes/trace/textures`.

use glam::{DVec2, DVec3, DVec4, UVec2};

use crate::image::srgb::srgb_decode;
use crate::layout::texture::{
    CornerUvs, MOST_LOOKUPS, MaterialMaps, POINT, TEXEL_KIND, TEXEL_R8, TEXEL_R16, TEXEL_RGBA8, TEXEL_RGBA16F,
    TEXTURE_CHANNEL_SHIFT, TEXTURE_CLAMP_U, TEXTURE_CLAMP_V, TEXTURE_SRGB, Tangents, TextureRecord, texel_index,
};
use crate::layout::trace::luminance;

/// The golden section, as the kernel has it.
const GOLDEN: f64 = 0.618034_f32 as f64;

/// A footprint that covers more pictures than these along its axis is not followed.
const LONGEST: f64 = 65_536.0;

/// All that the kernel gets of textures; empty where there are none.
#[derive(Clone, Copy, Debug, Default)]
pub struct TextureSet<'a> {
    pub records: &'a [TextureRecord],
    pub words: &'a [u32],
    /// Of the materials.
    pub maps: &'a [MaterialMaps],
    /// Of the triangles, in scene order, as are the next two.
    pub uvs: &'a [CornerUvs],
    pub tangents: &'a [Tangents],
    pub mean_emission: &'a [f32],
}

/// A point of a surface as textures see it.
#[derive(Clone, Copy, Debug)]
pub struct TexturePoint {
    /// v up.
    pub uv: DVec2,
    /// Binary logarithm of the footprint's width across its long axis, in texture coordinates.
    pub width: f64,
    /// The long axis: by how much the footprint is longer than wide, in texture coordinates.
    pub along: DVec2,
}

/// A texel: its level, and column and row in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelPlace {
    pub level: u32,
    pub at: UVec2,
}

impl<'a> TextureSet<'a> {
    /// The textures of a material.
    pub fn maps(&self, material: u32) -> MaterialMaps {
        self.maps.get(material as usize).copied().unwrap_or_default()
    }

    /// The point of a triangle with weights of its second and third corner, without a footprint.
    pub fn point(&self, triangle: u32, b: [f64; 2]) -> TexturePoint {
        let uv = self.corners(triangle).a.as_dvec2() + self.change_of_uv(triangle, b);
        TexturePoint { uv, width: POINT.into(), along: DVec2::ZERO }
    }

    /// The same with a footprint: its short axis, scene units, and how the weights change along the long one.
    pub fn point_with(&self, triangle: u32, b: [f64; 2], width: f64, ahead: [f64; 2]) -> TexturePoint {
        let point = self.point(triangle, b);
        if width <= 0.0 {
            return point;
        }
        let along = self.change_of_uv(triangle, ahead);
        let along = if along.abs().max_element() < LONGEST { along } else { DVec2::ZERO };
        TexturePoint { width: width.max(1e-30).log2() + f64::from(self.corners(triangle).density), along, ..point }
    }

    fn corners(&self, triangle: u32) -> CornerUvs {
        self.uvs.get(triangle as usize).copied().unwrap_or_default()
    }

    /// By how much coordinates change with the weights of a triangle's second and third corner.
    fn change_of_uv(&self, triangle: u32, b: [f64; 2]) -> DVec2 {
        let corners = self.corners(triangle);
        b[0] * corners.b.as_dvec2() + b[1] * corners.c.as_dvec2()
    }

    /// The record of a map, which is not none.
    pub fn record(&self, map: u32) -> &'a TextureRecord {
        &self.records[map as usize - 1]
    }

    /// A colour of a map: the mean of texels along the footprint.
    pub fn colour(&self, map: u32, point: TexturePoint, u: f64) -> DVec3 {
        let t = self.record(map);
        let count = lookups_along(t, point);
        let one = |i: u32| {
            let uv = point.uv + ((f64::from(i) + 0.5) / f64::from(count) - 0.5) * point.along;
            let place = draw_texel(t, TexturePoint { uv, ..point }, (u + f64::from(i) * GOLDEN).fract());
            (f64::from(t.base) + f64::from(t.gain) * self.texel(t, place).truncate()).max(DVec3::ZERO)
        };
        (0..count).map(one).sum::<DVec3>() / f64::from(count)
    }

    /// A number of a map.
    pub fn number(&self, map: u32, point: TexturePoint, u: f64) -> f64 {
        let t = self.record(map);
        let texel = self.texel(t, draw_texel(t, point, u));
        let value = match t.format >> TEXTURE_CHANNEL_SHIFT {
            channel @ 0..4 => texel[channel as usize],
            _ => f64::from(luminance(texel.truncate().as_vec3())),
        };
        (f64::from(t.base) + f64::from(t.gain) * value).max(0.0)
    }

    /// A texel, decoded.
    pub fn texel(&self, t: &TextureRecord, place: TexelPlace) -> DVec4 {
        let index = texel_index(place.at, t.level_size(place.level).x);
        let first = t.first + self.words[(t.first + place.level) as usize];
        let word = |offset: u32| self.words[(first + offset) as usize];
        let byte = |word: u32, number: u32| f64::from(word >> (8 * number) & 0xff) / 255.0;
        let grey = |value: f64| DVec4::new(value, value, value, 1.0);
        let texel = match t.format & TEXEL_KIND {
            TEXEL_RGBA8 => DVec4::from_array([0, 1, 2, 3].map(|number| byte(word(index), number))),
            TEXEL_R8 => grey(byte(word(index / 4), index % 4)),
            TEXEL_R16 => grey(f64::from(word(index / 2) >> (16 * (index % 2)) & 0xffff) / 65_535.0),
            TEXEL_RGBA16F => {
                let [r, g] = halves(word(2 * index));
                let [b, a] = halves(word(2 * index + 1));
                DVec4::new(r, g, b, a)
            }
            _ => {
                let [u, v] = halves(word(index));
                DVec4::new(u, v, 0.0, 1.0)
            }
        };
        match t.format & TEXTURE_SRGB {
            0 => texel,
            _ => texel.truncate().map(srgb_decode).extend(texel.w),
        }
    }

    /// Whether a point of a triangle with holes is there, by two numbers in [0, 1).
    pub fn is_there(&self, material: u32, triangle: u32, b: [f64; 2], u: [f64; 2]) -> bool {
        let maps = self.maps(material);
        maps.opacity == 0 || u[1] < f64::from(maps.coverage) * self.number(maps.opacity, self.point(triangle, b), u[0])
    }
}

/// Two f16 of a word, the lower first.
fn halves(word: u32) -> [f64; 2] {
    [word, word >> 16].map(|bits| half::f16::from_bits(bits as u16).to_f64())
}

/// A texel for a point, by one number: the level and the texel are drawn with the weights of trilinear filtering.
pub fn draw_texel(t: &TextureRecord, point: TexturePoint, u: f64) -> TexelPlace {
    let mut rest = u;
    let mut second = |weight: f64| {
        let second = rest < weight;
        rest = if second { rest / weight } else { (rest - weight) / (1.0 - weight) };
        u32::from(second)
    };
    let lod = level_of(t, point);
    let level = lod as u32 + second(lod.fract());
    let size = t.level_size(level);
    let clamps = clamps(t);
    let at = point_in_picture(t, point);
    let mut axis = |axis: usize| {
        let most = i64::from(size[axis]);
        let place = at[axis] * most as f64 - 0.5;
        let texel = place.floor() as i64 + i64::from(second(place - place.floor()));
        if clamps[axis] { texel.clamp(0, most - 1) as u32 } else { texel.rem_euclid(most) as u32 }
    };
    TexelPlace { level, at: UVec2::new(axis(0), axis(1)) }
}

/// How many lookups a long footprint is worth: one a texel that lies along it, of the level that its width asks for.
fn lookups_along(t: &TextureRecord, point: TexturePoint) -> u32 {
    let long = (point.along * t.scale.as_dvec2() * t.level_size(0).as_dvec2()).length();
    (long / level_of(t, point).exp2()).ceil().clamp(1.0, f64::from(MOST_LOOKUPS)) as u32
}

/// The level that a footprint asks for.
pub fn level_of(t: &TextureRecord, point: TexturePoint) -> f64 {
    (point.width + f64::from(t.density)).clamp(0.0, f64::from(t.levels - 1))
}

/// The texel of the whole picture that a point is in.
pub fn nearest_texel(t: &TextureRecord, point: TexturePoint) -> TexelPlace {
    let size = t.level_size(0);
    TexelPlace { level: 0, at: (point_in_picture(t, point) * size.as_dvec2()).as_uvec2().min(size - 1) }
}

/// Whether the picture does not repeat, along u and v.
fn clamps(t: &TextureRecord) -> [bool; 2] {
    [TEXTURE_CLAMP_U, TEXTURE_CLAMP_V].map(|flag| t.format & flag != 0)
}

/// The point in the picture, from its upper left corner: within it, each side 0 to 1.
fn point_in_picture(t: &TextureRecord, point: TexturePoint) -> DVec2 {
    let at = point.uv * t.scale.as_dvec2() + t.offset.as_dvec2();
    let [u, v] = clamps(t);
    let within = |at: f64, clamps: bool| if clamps { at.clamp(0.0, 1.0) } else { at - at.floor() };
    DVec2::new(within(at.x, u), within(at.y, v))
}
