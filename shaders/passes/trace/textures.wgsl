// Textures as every query reads them: bindings 10 to 13 are theirs, wherever they are used.

import package::gen::{CORNER_UVS_STRIDE, CornerUvs, MATERIAL_MAPS_STRIDE, MaterialMaps, TEXTURE_RECORD_STRIDE, TextureRecord};
import package::gen::{unpack_corner_uvs, unpack_material_maps, unpack_texture_record};
import package::gen::{POINT, TEXEL_KIND, TEXEL_R16, TEXEL_R8, TEXEL_RGBA16F, TEXEL_RGBA8, TEXEL_SLOPES, TEXTURE_SRGB};
import package::lib::colour::{srgb_decode};
import package::lib::texture::{TexelPlace, TexturePoint, channel_of, draw_texel, lookups_along, point_along, texel_index, two_halves};

@group(0) @binding(10) var<storage, read> uvs: array<vec4<u32>>;
@group(0) @binding(11) var<storage, read> textures: array<vec4<u32>>;
@group(0) @binding(12) var<storage, read> texels: array<u32>;
@group(0) @binding(13) var<storage, read> material_maps: array<vec4<u32>>;

// The golden section: its multiples' fractions lie evenly in [0, 1), wherever they begin.
const GOLDEN: f32 = 0.618034;

fn load_maps(material: u32) -> MaterialMaps {
    let at = MATERIAL_MAPS_STRIDE * material;
    return unpack_material_maps(material_maps[at], material_maps[at + 1u], material_maps[at + 2u]);
}

fn load_uvs(triangle: u32) -> CornerUvs {
    let at = CORNER_UVS_STRIDE * triangle;
    return unpack_corner_uvs(uvs[at], uvs[at + 1u]);
}

// The record of a map, which is not none.
fn load_texture(map: u32) -> TextureRecord {
    let at = TEXTURE_RECORD_STRIDE * (map - 1u);
    return unpack_texture_record(textures[at], textures[at + 1u], textures[at + 2u]);
}

// The point of a triangle with weights b1 and b2 of its second and third corner, without a footprint.
fn texture_point(corners: CornerUvs, b1: f32, b2: f32) -> TexturePoint {
    return TexturePoint(corners.a, b1 * corners.b + b2 * corners.c, POINT, vec2<f32>(0.0));
}

// A texel, decoded: linear colour and alpha, or slopes.
fn load_texel(t: TextureRecord, place: TexelPlace) -> vec4<f32> {
    let index = texel_index(place);
    let first = t.first + texels[t.first + place.level];
    var texel = vec4<f32>(0.0);
    switch t.format & TEXEL_KIND {
        case TEXEL_RGBA8: {
            texel = unpack4x8unorm(texels[first + index]);
        }
        case TEXEL_R8: {
            texel = vec4<f32>(vec3<f32>(f32((texels[first + (index >> 2u)] >> (8u * (index & 3u))) & 0xffu) / 255.0), 1.0);
        }
        case TEXEL_R16: {
            texel = vec4<f32>(vec3<f32>(f32((texels[first + (index >> 1u)] >> (16u * (index & 1u))) & 0xffffu) / 65535.0), 1.0);
        }
        case TEXEL_RGBA16F: {
            let at = first + 2u * index;
            texel = vec4<f32>(two_halves(texels[at]), two_halves(texels[at + 1u]));
        }
        case TEXEL_SLOPES: {
            texel = vec4<f32>(two_halves(texels[first + index]), 0.0, 1.0);
        }
        default: {
        }
    }
    if ((t.format & TEXTURE_SRGB) != 0u) {
        texel = vec4<f32>(srgb_decode(texel.rgb), texel.w);
    }
    return texel;
}

// A colour of a map, which is not none; at least 0: the mean of texels along the footprint, for light is linear in colours. `u` draws them.
fn look_up_colour(map: u32, point: TexturePoint, u: f32) -> vec3<f32> {
    let t = load_texture(map);
    let count = lookups_along(t, point);
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < count; i++) {
        let place = draw_texel(t, point_along(point, i, count), fract(u + f32(i) * GOLDEN));
        sum += max(t.base + t.gain * load_texel(t, place).rgb, vec3<f32>(0.0));
    }
    return sum / f32(count);
}

// A number of a map, which is not none; at least 0.
fn look_up_number(map: u32, point: TexturePoint, u: f32) -> f32 {
    let t = load_texture(map);
    return max(t.base + t.gain * channel_of(t, load_texel(t, draw_texel(t, point, u))), 0.0);
}
