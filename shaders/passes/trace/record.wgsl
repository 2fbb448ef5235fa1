// The rays of a path that is replayed, in order: where each goes, and what comes of it.

import package::gen::{Hit, PathState, PathTurn, Probed, Ray, NO_HIT, NO_MATERIAL};
import package::gen::{MOST_PROBED_OF_TURN};
import package::gen::{RAY_SEGMENT, RAY_SHADOW, TURN_DRAWN, TURN_GOES_ON, TURN_SURFACE};
import package::lib::bsdf::frame::{BsdfSample};
import package::lib::probe::{probed_count, probed_of_turn};
import package::lib::record::{turn};
import package::passes::trace::scene::{load_leaf};
@if(reuse) import package::passes::trace::reuse::{lent};
import package::passes::trace::surface::{Surface};

@group(0) @binding(22) var<storage, read_write> turns: array<PathTurn>;
@group(0) @binding(28) var<storage, read_write> probed: array<Probed>;

// Rays so far, those included that there was no room for.
var<private> turn_count: u32;

// Numbers that code has shown so far, and how many of them are kept.
var<private> probed_all: u32;
var<private> probed_kept: u32;

// A ray was traced.
fn begin_turn(state: PathState, ray: Ray, hit: Hit, is_shadow_ray: bool) {
    turn = PathTurn();
    turn.kind = select(RAY_SEGMENT, RAY_SHADOW, is_shadow_ray);
    turn.origin = ray.origin;
    turn.direction = ray.direction;
    turn.t = hit.t;
    turn.b1 = hit.b1;
    turn.b2 = hit.b2;
    turn.triangle = hit.triangle;
    turn.material = NO_MATERIAL;
    if (hit.triangle != NO_HIT) {
        turn.material = load_leaf(hit.leaf).material;
    }
    turn.bounce = state.bounce;
    turn.throughput = state.throughput;
    turn.pdf = state.pdf;
    turn.survival = 1.0;
    turn.light_triangle = NO_HIT;
    @if(reuse) {
        turn.lent = lent.throughput;
    }
}

// The path goes through a surface there.
fn note_surface(surface: Surface) {
    turn.done |= TURN_SURFACE;
    turn.position = surface.position;
    turn.geometric = surface.frame.geometric;
    turn.shading = surface.frame.shading;
    turn.back_face = surface.frame.back_face;
}

// The surface drew a direction, by `u`.
fn note_drawn(u: vec2<f32>, drawn: BsdfSample) {
    turn.done |= TURN_DRAWN;
    turn.drawn_u = u;
    turn.drawn_direction = drawn.direction;
    turn.drawn_pdf = drawn.pdf;
    turn.drawn_weight = drawn.weight;
}

// All that comes of the ray is known.
fn end_turn(state: PathState) {
    if (turn.kind == RAY_SEGMENT && state.bounce > turn.bounce) {
        turn.done |= TURN_GOES_ON;
    }
    turn.radiance = state.radiance;
    turn.fault = state.fault;
    if (turn_count < arrayLength(&turns)) {
        turns[turn_count] = turn;
    }
    keep_probed();
    turn_count += 1u;
}

// Keeps what code has shown of itself since the last ray was traced, as far as there is room.
fn keep_probed() {
    @if(record) {
        for (var i = 0u; i < min(probed_count, MOST_PROBED_OF_TURN); i++) {
            if (probed_kept < arrayLength(&probed)) {
                probed[probed_kept] = probed_of_turn[i];
                probed[probed_kept].turn = turn_count;
                probed_kept += 1u;
            }
        }
        probed_all += probed_count;
        probed_count = 0u;
    }
}
