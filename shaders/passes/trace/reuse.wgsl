// Reuse of paths (Bekaert, Sbert, Halton: Accelerating Path Tracing by Re-Using Paths, 2002): what a path lends to the other pixels of its tile.
//
// A path's first surface is x, and where the direction that it draws there leads is y. What the diffuse lobe of y sends on looks the same
// from everywhere, so it is kept apart from the path's own radiance, as light that all pixels of the tile gather (passes/trace/gather). A tile is
// one pixel of each quad of a block of 8 by 8 of the whole film.

import package::gen::{GatherPoint, LentPoint, MaterialRecord, PathState};
import package::gen::{NO_HIT, NO_MATERIAL};
@if(cutout) import package::gen::{CUTOUT_DIMENSIONS};
import package::lib::bsdf::frame::{BsdfSample};
@if(cutout) import package::lib::rng_pcg::{pcg_words};
@if(ggx || phong || coat) import package::lib::bsdf::mixture::{mixture_seen_from_anywhere};
import package::lib::intersect::{offset_ray_origin};
import package::lib::math::{largest_of};
import package::passes::trace::surface::{Surface};

@group(0) @binding(19) var<storage, read_write> gather_points: array<GatherPoint>;
@group(0) @binding(20) var<storage, read_write> lent_points: array<LentPoint>;
@if(textures) @group(0) @binding(21) var<storage, read_write> gather_materials: array<MaterialRecord>;

// The part of a path that it lends, from y on: beside the path's own throughput and radiance, which are of the rest.
struct Lent {
    // What a unit of radiance along the ray adds to what the diffuse lobe of y sends on; 0 before y.
    throughput: vec3<f32>,
    // Sent on so far.
    radiance: vec3<f32>,
    // The path lends from its next surface on.
    begins: bool,
}

var<private> lent: Lent;

// A path begins, and so far has nothing to lend. `place` is that of the pixel's record.
fn begin_lending(place: u32) {
    lent = Lent(vec3<f32>(0.0), vec3<f32>(0.0), false);
    gather_points[place].material = NO_MATERIAL;
    lent_points[place].triangle = NO_HIT;
}

// Notes where a pixel gathers: at x, on the side that the camera sees.
fn note_gather_point(place: u32, surface: Surface) {
    let normal = surface.frame.geometric;
    let origin = offset_ray_origin(surface.position, surface.error, normal, normal);
    gather_points[place] = GatherPoint(origin, surface.index, surface.frame.wo, 0u, surface.frame.shading, 0u, normal, surface.frame.back_face);
    @if(textures) {
        gather_materials[place] = surface.material;
    }
}

// Notes y, as a path arrived at it with `state`; `normal` is that which the surface is shaded by, before it is bent to its viewer.
fn note_lent_point(place: u32, state: PathState, surface: Surface, triangle: u32, normal: vec3<f32>) {
    lent_points[place].position = surface.position;
    lent_points[place].triangle = triangle;
    lent_points[place].geometric = surface.frame.geometric;
    lent_points[place].weight = state.throughput;
    @if(normals || relief) {
        lent_points[place].normal = normal;
    }
    @if(cutout) {
        lent_points[place].chance = pcg_words(state.key, CUTOUT_DIMENSIONS + state.rays - 1u).x | 1u;
    }
}

// Notes what y sends on, once the path has ended.
fn end_lending(place: u32, good: bool) {
    lent_points[place].radiance = lent.radiance;
    if (!good || largest_of(lent.radiance) == 0.0) {
        lent_points[place].triangle = NO_HIT;
    }
}

// What of a BSDF's value, f * cos, in a direction is the path's own, and what it lends.
struct Parts {
    own: vec3<f32>,
    lent: vec3<f32>,
}

// Of what a surface of the path sends on: `weight` is f * cos by `pdf`.
fn parts_of(state: PathState, surface: Surface, direction: vec3<f32>, weight: vec3<f32>, pdf: f32) -> Parts {
    if (!lent.begins) {
        return Parts(state.throughput * weight, lent.throughput * weight);
    }
    @if(ggx || phong || coat) {
        let diffuse = min(mixture_seen_from_anywhere(surface.material, surface.frame, direction) / pdf, weight);
        return Parts(state.throughput * (weight - diffuse), diffuse);
    } @else {
        return Parts(vec3<f32>(0.0), weight);
    }
}

// Of a direction that y has drawn. The path goes on for both.
fn lend_on(state: PathState, surface: Surface, drawn: BsdfSample) -> Parts {
    // A lobe of a single direction is seen from one place.
    if (lent.begins && drawn.pdf == 0.0) {
        return Parts(state.throughput * drawn.weight, vec3<f32>(0.0));
    }
    return parts_of(state, surface, drawn.direction, drawn.weight, drawn.pdf);
}
