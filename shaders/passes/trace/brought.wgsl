// What the rays of a path bring its pixel, each with the way that its light came: for who asks where a film's error comes from.
//
// The way is told by the last choice of a direction on it: the surface where a light was sampled, or where the BSDF drew the direction that found
// one. Mirrors and glass behind that choice have no density to choose by, and what is passed straight on is no surface here.

import package::gen::{Contribution, TraceParams, NO_HIT, NO_MATERIAL};
import package::gen::{LIGHT_POINT, LIGHT_SKY, WAY_FOUND, WAY_SAMPLED, WAY_SEEN};
@if(sun) import package::gen::{LIGHT_SUN};
@if(sun) import package::lib::sun::{sun_covers};

// What each of the paths brings first, then what each brings second, and so on.
@group(0) @binding(24) var<storage, read_write> brought: array<Contribution>;

// The way of light that the path finds from here on.
var<private> found: Contribution;

// The way of the light that was sampled last.
var<private> sampled: Contribution;

// That of the two which is added next.
var<private> arriving: Contribution;

// The row of the point light that was drawn last.
var<private> point: u32;

// Which of the paths this is, and of how many.
var<private> place: u32;
var<private> paths: u32;

// Contributions so far, those included that there was no room for.
var<private> brought_count: u32;

// A path begins, at the camera.
fn begin_bringing(at: u32, count: u32) {
    found = Contribution();
    found.surface = NO_MATERIAL;
    found.through = NO_MATERIAL;
    found.way = WAY_SEEN;
    sampled = found;
    arriving = found;
    place = at;
    paths = count;
    brought_count = 0u;
}

// Light arrives at the pixel. None is no contribution.
fn bring(light: vec3<f32>) {
    if (all(light == vec3<f32>(0.0))) {
        return;
    }
    if (brought_count < arrayLength(&brought) / paths) {
        var one = arriving;
        one.rgb = light;
        brought[brought_count * paths + place] = one;
    }
    brought_count += 1u;
}

// Of sky and sun, what is seen in a direction.
fn light_beyond(params: TraceParams, direction: vec3<f32>) -> u32 {
    @if(sun) {
        if (sun_covers(params.sun_direction, params.sun_chord_squared, direction)) {
            return LIGHT_SUN;
        }
    }
    return LIGHT_SKY;
}

// What is added next was found at the end of the path's ray.
fn note_found(params: TraceParams, triangle: u32, direction: vec3<f32>) {
    arriving = found;
    arriving.light = triangle;
    if (triangle == NO_HIT) {
        arriving.light = light_beyond(params, direction);
    }
}

// The point light of a row was drawn.
fn note_point(row: u32) {
    point = row;
}

// A surface of a material has sampled a light: `ends` where a ray to it does, which has no triangle if it is a point.
fn note_sampled(params: TraceParams, material: u32, triangle: u32, ends: bool, direction: vec3<f32>) {
    sampled.surface = material;
    sampled.bounce = found.bounce + 1u;
    sampled.way = WAY_SAMPLED;
    sampled.light = triangle;
    if (triangle == NO_HIT) {
        sampled.light = select(light_beyond(params, direction), LIGHT_POINT + point, ends);
    }
}

// What is added next is of the light that was sampled last.
fn note_sampled_arrives() {
    arriving = sampled;
}

// The path goes on from a surface of a material, in a direction that was drawn with such a density: 0 where its lobe has no other.
fn note_scattered(material: u32, pdf: f32, straight: bool) {
    if (straight) {
        return;
    }
    found.bounce += 1u;
    if (pdf > 0.0) {
        found.surface = material;
        found.through = NO_MATERIAL;
        found.way = WAY_FOUND;
    } else {
        found.through = material;
    }
}
