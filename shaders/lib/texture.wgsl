// Where a lookup falls in a texture, and what a word of it says. One texel a lookup: it and its level are drawn with the weights of
// trilinear filtering (Pharr, Wronski, Salvi, Fajardo: Filtering After Shading with Stochastic Texture Filtering, 2024), so that the mean is
// the filtered value.

import package::gen::{MOST_LOOKUPS, TEXTURE_CHANNEL_SHIFT, TEXTURE_CLAMP_U, TEXTURE_CLAMP_V, TextureRecord};
import package::lib::colour::{luminance};

// A point of a surface as textures see it.
struct TexturePoint {
    // Of the triangle's first corner, v up, and from there to the point: apart, so that large coordinates keep their digits.
    corner: vec2<f32>,
    offset: vec2<f32>,
    // Binary logarithm of the footprint's width across its long axis, in texture coordinates.
    width: f32,
    // The long axis: by how much the footprint is longer than wide, in texture coordinates.
    along: vec2<f32>,
}

struct TexelPlace {
    level: u32,
    at: vec2<u32>,
    // Texels of the level.
    size: vec2<u32>,
}

// The point in the picture, whose upper left corner is (0, 0) and lower right (1, 1): within it, where the texture repeats.
fn point_in_picture(t: TextureRecord, point: TexturePoint) -> vec2<f32> {
    let clamps = vec2<bool>((t.format & TEXTURE_CLAMP_U) != 0u, (t.format & TEXTURE_CLAMP_V) != 0u);
    let corner = point.corner * t.scale + t.offset;
    let at = select(fract(corner), corner, clamps) + point.offset * t.scale;
    return select(fract(at), clamp(at, vec2<f32>(0.0), vec2<f32>(1.0)), clamps);
}

// One of two by the weight of the second: which, and what is left of the uniform number.
struct Pick {
    second: bool,
    rest: f32,
}

fn pick_of_two(weight: f32, u: f32) -> Pick {
    let second = u < weight;
    let rest = select((u - weight) / (1.0 - weight), u / weight, second);
    return Pick(second, min(rest, 0x1.fffffep-1));
}

// A texel for a point, by one number.
fn draw_texel(t: TextureRecord, point: TexturePoint, u: f32) -> TexelPlace {
    let lod = level_of(t, point);
    let coarser = pick_of_two(lod - floor(lod), u);
    let level = u32(lod) + u32(coarser.second);
    let first = vec2<u32>((t.size & 0xffffu) + 1u, (t.size >> 16u) + 1u);
    let size = max(first >> vec2<u32>(level), vec2<u32>(1u));
    let p = point_in_picture(t, point) * vec2<f32>(size) - 0.5;
    let cell = floor(p);
    let right = pick_of_two(p.x - cell.x, coarser.rest);
    let lower = pick_of_two(p.y - cell.y, right.rest);
    let at = vec2<i32>(cell) + vec2<i32>(vec2<u32>(u32(right.second), u32(lower.second)));
    let most = vec2<i32>(size) - 1;
    // No texel is farther beyond the picture than one.
    let clamps = vec2<bool>((t.format & TEXTURE_CLAMP_U) != 0u, (t.format & TEXTURE_CLAMP_V) != 0u);
    let around = select(select(at, vec2<i32>(0), at > most), most, at < vec2<i32>(0));
    return TexelPlace(level, vec2<u32>(select(around, clamp(at, vec2<i32>(0), most), clamps)), size);
}

// The place of a texel in its level: tiles of 8x8, in Morton order within.
fn texel_index(place: TexelPlace) -> u32 {
    let tile = (place.at.y >> 3u) * ((place.size.x + 7u) >> 3u) + (place.at.x >> 3u);
    let v = (place.at & vec2<u32>(1u)) | ((place.at & vec2<u32>(2u)) << vec2<u32>(1u)) | ((place.at & vec2<u32>(4u)) << vec2<u32>(2u));
    return tile * 64u + (v.x | (v.y << 1u));
}

// The channel of a texel that is a number.
fn channel_of(t: TextureRecord, texel: vec4<f32>) -> f32 {
    switch t.format >> TEXTURE_CHANNEL_SHIFT {
        case 0u: { return texel.x; }
        case 1u: { return texel.y; }
        case 2u: { return texel.z; }
        case 3u: { return texel.w; }
        default: { return luminance(texel.rgb); }
    }
}

// Two f16 of a word, the lower first; those below 6e-5 may be 0. WGSL's own unpack2x16float is not on every adapter.
fn two_halves(word: u32) -> vec2<f32> {
    let bits = vec2<u32>(word & 0xffffu, word >> 16u);
    let magnitude = bitcast<vec2<f32>>((bits & vec2<u32>(0x7fffu)) << vec2<u32>(13u)) * 0x1p112;
    return select(magnitude, -magnitude, (bits & vec2<u32>(0x8000u)) != vec2<u32>(0u));
}

// The texel of the whole picture that a point is in.
fn nearest_texel(t: TextureRecord, point: TexturePoint) -> TexelPlace {
    let size = vec2<u32>((t.size & 0xffffu) + 1u, (t.size >> 16u) + 1u);
    return TexelPlace(0u, min(vec2<u32>(point_in_picture(t, point) * vec2<f32>(size)), size - 1u), size);
}

// How many lookups a long footprint is worth: one a texel that lies along it, of the level that its width asks for.
fn lookups_along(t: TextureRecord, point: TexturePoint) -> u32 {
    let size = vec2<f32>(f32(t.size & 0xffffu), f32(t.size >> 16u)) + 1.0;
    let texels = length(point.along * t.scale * size) * exp2(-level_of(t, point));
    return u32(clamp(ceil(texels), 1.0, f32(MOST_LOOKUPS)));
}

// One of several lookups spread evenly along a footprint.
fn point_along(point: TexturePoint, number: u32, count: u32) -> TexturePoint {
    let place = (f32(number) + 0.5) / f32(count) - 0.5;
    return TexturePoint(point.corner, point.offset + place * point.along, point.width, vec2<f32>(0.0));
}

// The level that a footprint asks for.
fn level_of(t: TextureRecord, point: TexturePoint) -> f32 {
    return clamp(point.width + t.density, 0.0, f32(t.levels - 1u));
}
