// The environment's pixels, and a direction drawn by their radiance.

@if(sky_light) import package::gen::{CdfEntry};
import package::gen::{TraceParams};
@if(sky_light) import package::lib::cdf::{bucket_of, count_buckets, left_over};
import package::lib::colour::{luminance};
@if(sky_light) import package::lib::light::{power_heuristic};
@if(record) import package::lib::record::{turn};
import package::lib::sky::{sky_cell};
@if(sky_light) import package::lib::sky::{sky_direction};
@if(sun) import package::lib::sun::{sun_covers};

@group(0) @binding(7) var<storage, read> sky: array<vec4<f32>>;
@if(sky_light) @group(0) @binding(8) var<storage, read> sky_cdf: array<CdfEntry>;

// A direction of the scene as the picture has it. Of a picture that is not turned, the same to the bit.
fn to_picture(params: TraceParams, direction: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(params.sky_x, direction), dot(params.sky_y, direction), dot(params.sky_z, direction));
}

// And back.
@if(sky_light)
fn to_scene(params: TraceParams, direction: vec3<f32>) -> vec3<f32> {
    return params.sky_x * direction.x + params.sky_y * direction.y + params.sky_z * direction.z;
}

// Radiance that arrives from a direction.
fn sky_radiance(params: TraceParams, direction: vec3<f32>) -> vec3<f32> {
    let cell = sky_cell(to_picture(params, direction), vec2<u32>(params.sky_width, params.sky_height));
    return sky[cell.y * params.sky_width + cell.x].rgb;
}

// Density by solid angle with which a direction of such radiance is drawn; `density` is that of unit luminance.
@if(sky_light)
fn sky_pdf(radiance: vec3<f32>, density: f32) -> f32 {
    return luminance(radiance) * density;
}

// What arrives from sky and sun along a direction, times the part of it that finding it so counts for; `pdf` is the density with which
// the direction was drawn, 0 where it could have been no other.
fn sky_found(params: TraceParams, direction: vec3<f32>, pdf: f32) -> vec3<f32> {
    var light = sky_radiance(params, direction);
    @if(sky_light) var asked = sky_pdf(light, params.sky_density);
    @if(sun) let covered = sun_covers(params.sun_direction, params.sun_chord_squared, direction);
    @if(sun) light += select(vec3<f32>(0.0), params.sun_radiance, covered);
    @if(sun && sky_light) asked += select(0.0, params.sun_density, covered);
    @if(record) turn.emitted = light;
    @if(sky_light) {
        @if(record) turn.found_pdf = asked;
        if (pdf > 0.0) {
            light *= power_heuristic(pdf, asked);
        }
    }
    return light;
}

@if(sky_light)
struct SkySample {
    // Unit length.
    direction: vec3<f32>,
    radiance: vec3<f32>,
}

// An index drawn from the `count` entries from `first` on, and the uniform number that is left over.
@if(sky_light)
struct EntrySample {
    index: u32,
    rest: f32,
}

@if(sky_light)
fn draw_entry(first: u32, count: u32, u: f32) -> EntrySample {
    let bucket = bucket_of(u, count);
    var low = sky_cdf[first + bucket].first;
    var high = count - 1u;
    if (bucket + 1u < count_buckets(count)) {
        high = sky_cdf[first + bucket + 1u].first;
    }
    while (low < high) {
        let middle = (low + high) / 2u;
        if (u < sky_cdf[first + middle].end) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    var start = 0.0;
    if (low > 0u) {
        start = sky_cdf[first + low - 1u].end;
    }
    return EntrySample(low, left_over(u, start, sky_cdf[first + low].end));
}

@if(sky_light)
fn draw_sky(params: TraceParams, u: vec2<f32>) -> SkySample {
    let size = vec2<u32>(params.sky_width, params.sky_height);
    let row = draw_entry(0u, size.y, u.y);
    let column = draw_entry(size.y + row.index * size.x, size.x, u.x);
    let cell = vec2<u32>(column.index, row.index);
    let direction = sky_direction(cell, size, vec2<f32>(column.rest, row.rest));
    return SkySample(to_scene(params, direction), sky[cell.y * size.x + cell.x].rgb);
}
