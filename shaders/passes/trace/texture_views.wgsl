// What views show of textures.

import package::gen::{Hit, TEXEL_KIND, TEXEL_SLOPES, Triangle};
import package::lib::texture::{level_of, nearest_texel};
import package::passes::trace::textures::{load_maps, load_texel, load_texture, load_uvs, look_up_colour, texture_point};

// Half of the way between two texels: the nearest, as far as one number says.
const MIDDLE: f32 = 0.5;

fn uv_at(triangle: Triangle, hit: Hit) -> vec2<f32> {
    let point = texture_point(load_uvs(triangle.index), hit.b1, hit.b2);
    return fract(point.corner) + point.offset;
}

// The reflectances, times what their maps say there.
fn textured_albedo(kd: vec3<f32>, ks: vec3<f32>, triangle: Triangle, hit: Hit) -> vec3<f32> {
    let maps = load_maps(triangle.material);
    let point = texture_point(load_uvs(triangle.index), hit.b1, hit.b2);
    var diffuse = kd;
    var specular = ks;
    if (maps.diffuse != 0u) {
        diffuse *= look_up_colour(maps.diffuse, point, MIDDLE);
    }
    if (maps.specular != 0u) {
        specular *= look_up_colour(maps.specular, point, MIDDLE);
    }
    return diffuse + specular;
}

// The texel of the material's first map, as light; black without any. Slopes are shown about a grey.
fn texel_at(triangle: Triangle, hit: Hit) -> vec3<f32> {
    let map = load_maps(triangle.material).shown;
    if (map == 0u) {
        return vec3<f32>(0.0);
    }
    let t = load_texture(map);
    let point = texture_point(load_uvs(triangle.index), hit.b1, hit.b2);
    let texel = load_texel(t, nearest_texel(t, point)).rgb;
    return select(texel, 0.5 + 0.5 * t.gain * texel, (t.format & TEXEL_KIND) == TEXEL_SLOPES);
}

// The level of the material's first map, for a footprint of such a width, scene units; 0 without any.
fn level_at(triangle: Triangle, hit: Hit, width: f32) -> f32 {
    let map = load_maps(triangle.material).shown;
    if (map == 0u) {
        return 0.0;
    }
    let corners = load_uvs(triangle.index);
    var point = texture_point(corners, hit.b1, hit.b2);
    point.width = log2(max(width, 1e-30)) + corners.density;
    return level_of(load_texture(map), point);
}
