// Light sampling (next-event estimation): a light drawn for a surface, and the density with which that is done.

import package::gen::{TraceParams, NO_HIT};
@if(lights && point_lights) import package::gen::{PointLightRecord, unpack_point_light_record};
@if(lights) import package::gen::{LIGHT_RECORD_STRIDE, LightRecord, MATERIAL_ONE_SIDED, MaterialRecord, unpack_light_record};
@if(lights) import package::gen::{LIGHT_RECORD_END, LIGHT_RECORD_FIRST, light_record_end, light_record_first};
@if(lights) import package::lib::cdf::{bucket_of, count_buckets, left_over};
@if(sky_light) import package::lib::cdf::{stretched};
@if(lights) import package::lib::intersect::{triangle_normal};
@if(lights) import package::lib::colour::{luminance};
@if(lights) import package::lib::light::{kept_from_edges, light_area_pdf, light_point, light_weights};
@if(lights) import package::lib::math::{largest_of};
@if(lights && point_lights) import package::lib::point::{point_intensity};
@if(sources && point_lights) import package::passes::trace::brought::{note_point};
@if(lights && emission_map) import package::passes::trace::emission::{emission_at};
@if(sun) import package::lib::sun::{sun_covers};
@if(sky_light && sun) import package::lib::sun::{sun_point};
@if(sky_light) import package::passes::trace::sky::{draw_sky, sky_pdf};
@if(sky_light && sun) import package::passes::trace::sky::{sky_radiance};

@if(lights) @group(0) @binding(6) var<storage, read> lights: array<vec4<u32>>;

// By four words, as nodes are read.
@if(lights)
fn load_light(index: u32) -> LightRecord {
    let at = LIGHT_RECORD_STRIDE * index;
    return unpack_light_record(lights[at], lights[at + 1u], lights[at + 2u], lights[at + 3u]);
}

@if(lights && point_lights)
fn load_point(index: u32) -> PointLightRecord {
    let at = LIGHT_RECORD_STRIDE * index;
    return unpack_point_light_record(lights[at], lights[at + 1u], lights[at + 2u], lights[at + 3u]);
}

// How far from the way to a light, as part of it, the t may be at which its own test finds it: many roundings, unless the light is so
// edge-on that it sends next to nothing.
const AROUND_LIGHT: f32 = 0x1p-12;

// What is hit nearer than this part of the way to a point light hides it: a surface that the point lies in, by many roundings, does not.
@if(lights && point_lights) const BEFORE_POINT: f32 = 1.0 - 0x1p-20;

// Light that arrives at a point from one drawn direction.
struct LightSample {
    // Unit length.
    direction: vec3<f32>,
    // By solid angle, of lights, sky and sun together; 0 where nothing arrives. Of a point light the probability with which it is drawn,
    // times the square of the distance: so `radiance` by this is what arrives, as of the others.
    pdf: f32,
    // Of a point light, its intensity.
    radiance: vec3<f32>,
    // The triangle that sends it, or NO_HIT.
    triangle: u32,
    // Where it leaves that triangle, or the point light.
    point: vec3<f32>,
    // How far a ray to it goes, as part of the way: to just beyond it, so that its triangle is hit, or to just before it. 0 for sky and sun,
    // which are nowhere.
    end: f32,
}

// The density by solid angle of a direction of unit length that meets a light of normal `area_normal`, of any length, at distance `t`.
@if(lights)
fn solid_angle_pdf(area_pdf: f32, area_normal: vec3<f32>, direction: vec3<f32>, t: f32) -> f32 {
    let size = largest_of(abs(area_normal));
    // A triangle without area is never hit, and is no light; one seen edge-on is hit by rounding alone.
    let cos_light = max(abs(dot(normalize(area_normal / max(size, 1e-37)), direction)), 1e-12);
    return area_pdf * (t * t / cos_light);
}

// The density with which draw_light() draws a direction that was found to meet a surface at distance `t`, whose triangle has a luminance
// of `mean` on average.
@if(lights)
fn light_pdf(params: TraceParams, material: MaterialRecord, mean: f32, area_normal: vec3<f32>, direction: vec3<f32>, t: f32) -> f32 {
    let sides = select(2u, 1u, (material.flags & MATERIAL_ONE_SIDED) != 0u);
    return solid_angle_pdf(light_area_pdf(mean, sides, params.light_density), area_normal, direction, t);
}

// A point light has no surface: what is drawn of it could have been found by no ray.
@if(lights && point_lights)
fn is_point(light: LightSample) -> bool {
    return light.triangle == NO_HIT && light.end > 0.0;
}

@if(lights && point_lights)
fn draw_point(params: TraceParams, position: vec3<f32>, light: PointLightRecord) -> LightSample {
    let offset = light.position - position;
    let t = length(offset);
    // A surface that the light lies in gets nothing from it where it is.
    if (t == 0.0) {
        return LightSample(vec3<f32>(0.0), 0.0, vec3<f32>(0.0), NO_HIT, light.position, BEFORE_POINT);
    }
    let direction = offset / t;
    let pdf = light.power * params.point_density * (t * t);
    return LightSample(direction, pdf, point_intensity(light, -direction), NO_HIT, light.position, BEFORE_POINT);
}

@if(lights)
fn light_end(index: u32) -> f32 {
    return light_record_end(lights[LIGHT_RECORD_STRIDE * index + LIGHT_RECORD_END]);
}

@if(lights)
fn light_first(bucket: u32) -> u32 {
    return light_record_first(lights[LIGHT_RECORD_STRIDE * bucket + LIGHT_RECORD_FIRST]);
}

// A light of the table by its power, and what is left of the number: of a light with a share s of all power one of s * 2^24 places. Its probability
// is off by 2^-24 at most, up or down by chance.
@if(lights)
struct LightPick {
    index: u32,
    rest: f32,
}

@if(lights)
fn pick_light(params: TraceParams, u: f32) -> LightPick {
    let bucket = bucket_of(u, params.lights);
    var low = light_first(bucket);
    var high = params.lights - 1u;
    if (bucket + 1u < count_buckets(params.lights)) {
        high = light_first(bucket + 1u);
    }
    while (low < high) {
        let middle = (low + high) / 2u;
        if (u < light_end(middle)) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    var start = 0.0;
    if (low > 0u) {
        start = light_end(low - 1u);
    }
    return LightPick(low, left_over(u, start, light_end(low)));
}

// A light of the table, and a point of it. Numbers that are evenly spread are so over all of a lamp, of however many triangles it is made.
@if(lights)
fn draw_from_table(params: TraceParams, position: vec3<f32>, u: vec2<f32>, texel: f32) -> LightSample {
    let drawn = pick_light(params, u.x);
    let index = drawn.index;
    let light = load_light(index);
    @if(lights && point_lights) {
        if (light.triangle == NO_HIT) {
            @if(sources) note_point(index);
            return draw_point(params, position, load_point(index));
        }
    }
    return draw_triangle(params, position, light, vec2<f32>(drawn.rest, u.y), texel);
}

@if(lights)
fn draw_triangle(params: TraceParams, position: vec3<f32>, light: LightRecord, u: vec2<f32>, texel: f32) -> LightSample {
    let weights = light_weights(u);
    let drawn_point = light_point(light, weights);
    let area_normal = triangle_normal(light.a, light.b, light.c);
    // What rounding of the point and of the ray to it is a part of.
    let reach = distance(drawn_point, position) + largest_of(abs(drawn_point));
    let point = kept_from_edges(light, drawn_point, reach);
    let offset = point - position;
    let t = length(offset);
    if (t == 0.0) {
        return LightSample(vec3<f32>(0.0), 0.0, vec3<f32>(0.0), light.triangle, point, 0.0);
    }
    let direction = offset / t;
    let one_sided = light.shrink < 0.0;
    let lit = !one_sided || dot(area_normal, direction) < 0.0;
    let area_pdf = light_area_pdf(luminance(light.emission), select(2u, 1u, one_sided), params.light_density);
    let pdf = solid_angle_pdf(area_pdf, area_normal, direction, t);
    // A speck, or a light so edge-on that rays to it meet its neighbour by their rounding: the shadow ray ends just before it.
    let cos_light = abs(dot(normalize(area_normal / largest_of(abs(area_normal))), direction));
    let is_speck = abs(light.shrink) * reach > 0.5 * cos_light;
    let end = 1.0 + select(AROUND_LIGHT, -AROUND_LIGHT, is_speck);
    var radiance = light.emission;
    @if(lights && emission_map) {
        radiance = emission_at(light, weights, texel);
    }
    return LightSample(direction, select(0.0, pdf, lit), radiance, light.triangle, point, end);
}

// Light of the sky as it arrives from beyond the scene: where the sun is, with its own.
@if(sky_light)
fn from_beyond(params: TraceParams, direction: vec3<f32>, sky: vec3<f32>) -> LightSample {
    var pdf = sky_pdf(sky, params.sky_density);
    var radiance = sky;
    @if(sun) {
        if (sun_covers(params.sun_direction, params.sun_chord_squared, direction)) {
            pdf += params.sun_density;
            radiance += params.sun_radiance;
        }
    }
    return LightSample(direction, pdf, radiance, NO_HIT, vec3<f32>(0.0), 0.0);
}

@if(sky_light)
fn draw_from_sky(params: TraceParams, u: vec2<f32>) -> LightSample {
    let drawn = draw_sky(params, u);
    return from_beyond(params, drawn.direction, drawn.radiance);
}

@if(sky_light && sun)
fn draw_from_sun(params: TraceParams, u: vec2<f32>) -> LightSample {
    let direction = sun_point(params.sun_direction, params.sun_chord_squared, u);
    return from_beyond(params, direction, sky_radiance(params, direction));
}

// Of sky and sun: `u.x` is from `light_share` on.
@if(sky_light)
fn draw_from_beyond(params: TraceParams, u: vec2<f32>) -> LightSample {
    @if(sun) {
        if (u.x < params.sun_end) {
            return draw_from_sun(params, vec2<f32>(stretched(u.x, params.light_share, params.sun_end), u.y));
        }
    }
    return draw_from_sky(params, vec2<f32>(stretched(u.x, params.sun_end, 1.0), u.y));
}

// Light at a position. `u` chooses the light, and what is left of it the point there; `texel` what its map says.
@if(lights || sky_light)
fn draw_light(params: TraceParams, position: vec3<f32>, u: vec2<f32>, texel: f32) -> LightSample {
    @if(lights && sky_light) {
        if (u.x >= params.light_share) {
            return draw_from_beyond(params, u);
        }
        return draw_from_table(params, position, vec2<f32>(stretched(u.x, 0.0, params.light_share), u.y), texel);
    }
    @if(lights && !sky_light) {
        return draw_from_table(params, position, u, texel);
    }
    @if(!lights) {
        return draw_from_beyond(params, u);
    }
}
