// What is seen first through the middle of every pixel, instead of the film.

import package::gen::{Hit, Ray, Triangle, ViewParams, NO_HIT, T_FAR};
import package::gen::{VIEW_ALBEDO, VIEW_COST, VIEW_DEPTH, VIEW_MATERIAL, VIEW_MOST_STEPS, VIEW_NORMAL};
@if(textures || relief || emission_map || cutout) import package::passes::trace::texture_views::{level_at, texel_at, textured_albedo, uv_at};
import package::gen::{MATERIAL_RECORD_KD, MATERIAL_RECORD_KS, MATERIAL_RECORD_STRIDE, material_record_kd, material_record_ks};
@if(normals) import package::gen::{Shading};
@if(textures || relief || emission_map || cutout) import package::gen::{VIEW_MOST_LEVELS, VIEW_TEXEL, VIEW_UV};
import package::lib::camera::{camera_direction};
import package::lib::colour::{srgb8};
import package::lib::intersect::{triangle_normal};
import package::lib::math::{largest_of};
@if(normals) import package::lib::normals::{facing, interpolate_normal};
import package::passes::trace::materials::{materials};
import package::passes::trace::scene::{load_leaf};
import package::passes::trace::traverse::{closest_hit};

@group(0) @binding(2) var<storage, read> params: ViewParams;
@group(0) @binding(4) var<storage, read_write> picture: array<u32>;
@if(normals) @group(0) @binding(5) var<storage, read> shading: array<Shading>;

const BLACK: u32 = 0xff000000u;

// Bytes as they are, not encoded: numbers and not light.
fn word(bytes: vec3<u32>) -> u32 {
    return bytes.x | bytes.y << 8u | bytes.z << 16u | BLACK;
}

// The same of numbers from 0 to 1.
fn codes(v: vec3<f32>) -> u32 {
    return word(vec3<u32>(clamp(v, vec3<f32>(0.0), vec3<f32>(1.0)) * 255.0 + 0.5));
}

fn albedo(triangle: Triangle, hit: Hit) -> vec3<f32> {
    let at = MATERIAL_RECORD_STRIDE * triangle.material;
    var kd = material_record_kd(materials[at + MATERIAL_RECORD_KD]);
    var ks = material_record_ks(materials[at + MATERIAL_RECORD_KS]);
    @if(textures || relief || emission_map || cutout) {
        return textured_albedo(kd, ks, triangle, hit);
    }
    return kd + ks;
}

// Turned to where the ray came from; smooth where the triangle has normals of its own.
fn normal_at(triangle: Triangle, hit: Hit, direction: vec3<f32>) -> vec3<f32> {
    let area_normal = triangle_normal(triangle.a, triangle.b, triangle.c);
    let unit = normalize(area_normal / largest_of(abs(area_normal)));
    let geometric = select(unit, -unit, dot(unit, direction) > 0.0);
    var normal = geometric;
    @if(normals) {
        normal = facing(interpolate_normal(shading[triangle.index], hit.b1, hit.b2, geometric), geometric);
    }
    return normal;
}

// A colour that is not dark, from a hash of the material's index (PCG: O'Neill 2014).
fn material_colour(index: u32) -> vec3<u32> {
    let state = index * 747796405u + 2891336453u;
    let mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    let hash = (mixed >> 22u) ^ mixed;
    return vec3<u32>(64u) + ((vec3<u32>(hash) >> vec3<u32>(0u, 8u, 16u)) & vec3<u32>(0xffu)) * 3u / 4u;
}

// From black by red and yellow to white.
fn heat(part: u32, most: u32) -> vec3<u32> {
    let v = min(part, most) * 768u / most;
    return min(max(vec3<u32>(v), vec3<u32>(0u, 256u, 512u)) - vec3<u32>(0u, 256u, 512u), vec3<u32>(255u));
}

// Of textures: where they are looked up, what is found, and at which level.
@if(textures || relief || emission_map || cutout)
fn texture_view(triangle: Triangle, hit: Hit) -> u32 {
    if (params.mode == VIEW_UV) {
        return codes(vec3<f32>(fract(uv_at(triangle, hit)), 0.0));
    }
    if (params.mode == VIEW_TEXEL) {
        return srgb8(texel_at(triangle, hit));
    }
    let level = level_at(triangle, hit, params.trace_params.cone_spread * hit.t);
    return word(heat(u32(level * 64.0), VIEW_MOST_LEVELS * 64u));
}

fn seen(hit: Hit, direction: vec3<f32>) -> u32 {
    if (hit.triangle == NO_HIT) {
        return BLACK;
    }
    let triangle = load_leaf(hit.leaf);
    var colour = BLACK;
    switch params.mode {
        case VIEW_ALBEDO: {
            colour = srgb8(albedo(triangle, hit));
        }
        case VIEW_NORMAL: {
            colour = codes(0.5 * normal_at(triangle, hit, direction) + 0.5);
        }
        case VIEW_DEPTH: {
            colour = codes(vec3<f32>(params.reach / (params.reach + hit.t)));
        }
        case VIEW_MATERIAL: {
            colour = word(material_colour(triangle.material));
        }
        case VIEW_COST: {
            colour = word(heat(hit.steps, VIEW_MOST_STEPS));
        }
        default: {
            @if(textures || relief || emission_map || cutout) {
                colour = texture_view(triangle, hit);
            }
        }
    }
    return colour;
}

@compute @workgroup_size(8, 8)
fn view(@builtin(global_invocation_id) id: vec3<u32>) {
    let trace_params = params.trace_params;
    if (id.x >= trace_params.window_width || id.y >= trace_params.window_height) {
        return;
    }
    let middle = vec2<f32>(id.xy + vec2<u32>(trace_params.window_x, trace_params.window_y)) + 0.5;
    let direction = camera_direction(trace_params, middle);
    let hit = closest_hit(Ray(trace_params.position, 0.0, direction, T_FAR), trace_params.root);
    picture[id.y * trace_params.window_width + id.x] = seen(hit, direction);
}
