// Paths whose directions come from the BSDF alone: light is found by hitting it. One sample of one pixel an invocation.
//
// begin, extend and shade are functions over one path state, and the entry point composes them.

import package::gen::{MaterialRecord, PathState, RadianceSample, SampleKey, TraceParams};
import package::gen::{Hit, Ray, Triangle, NO_HIT, T_FAR};
import package::gen::{BAD_OVERFLOW, NO_MATERIAL, SAMPLE_BAD};
import package::gen::{DIMENSIONS_PER_BOUNCE, SLOT_DIRECTION, SLOT_FILM, SLOT_LOBE};
@if(roulette) import package::gen::{ROULETTE_BOUNCE, SLOT_ROULETTE};
@if(normals) import package::gen::{Shading};
import package::lib::bsdf::mixture::{Facing, mixture_sample};
import package::lib::camera::{camera_direction};
import package::lib::fault::{fault_of};
import package::lib::intersect::{offset_ray_origin, surface_point, triangle_normal};
@if(emitters) import package::lib::light::{emitted};
import package::lib::math::{largest_of};
import package::lib::rng::{sample_1d, sample_2d};
@if(normals) import package::lib::normals::{interpolate_normal};
import package::passes::trace::scene::{leaves};
import package::passes::trace::traverse::{closest_hit};

@group(0) @binding(2) var<storage, read> params: TraceParams;
@group(0) @binding(3) var<storage, read> materials: array<MaterialRecord>;
@group(0) @binding(4) var<storage, read_write> radiance: array<RadianceSample>;
@if(normals) @group(0) @binding(5) var<storage, read> shading: array<Shading>;

const LARGEST_F32: f32 = 0x1.fffffep+127;

fn dimension(state: ptr<function, PathState>, slot: u32) -> u32 {
    return (*state).bounce * DIMENSIONS_PER_BOUNCE + slot;
}

// Whether all channels are at least 0 and at most `largest`, and so numbers: by their bits, which for such are ordered as
// they are. If not, the path is over, and keeps the value to say what is wrong with it.
fn check(state: ptr<function, PathState>, value: vec3<f32>, largest: f32, material: u32) -> bool {
    let good = all(bitcast<vec3<u32>>(value) <= vec3<u32>(bitcast<u32>(largest)));
    if (!good) {
        (*state).faulty = 1u;
        (*state).fault_material = material;
        (*state).radiance = value;
    }
    return good;
}

// Adds radiance that arrives along the ray.
fn gather(state: ptr<function, PathState>, light: vec3<f32>, material: u32) -> bool {
    (*state).radiance += (*state).throughput * light;
    return check(state, (*state).radiance, params.largest, material);
}

// How the surface at a hit is seen. `raw` is the triangle's normal by its winding, of any length.
fn facing_at(triangle: Triangle, hit: Hit, raw: vec3<f32>, wo: vec3<f32>) -> Facing {
    let unit = normalize(raw / largest_of(abs(raw)));
    let from_behind = dot(unit, wo) < 0.0;
    let geometric = select(unit, -unit, from_behind);
    var shading_normal = geometric;
    @if(normals) {
        let smooth_normal = interpolate_normal(shading[triangle.index], hit.b1, hit.b2, geometric);
        // A smooth normal that the viewer is behind of has no mirror direction above the surface.
        shading_normal = select(geometric, smooth_normal, dot(smooth_normal, wo) > 0.0);
    }
    return Facing(wo, shading_normal, geometric, u32(from_behind));
}

// `pixel` in the whole film, `sample` a film sample: even ones belong to half 0, odd ones to half 1.
fn begin(pixel: vec2<u32>, sample: u32) -> PathState {
    var state: PathState;
    state.key = SampleKey(pixel.y * params.film_width + pixel.x, sample >> 1u, sample & 1u, params.seed);
    state.origin = params.position;
    state.direction = camera_direction(params, vec2<f32>(pixel) + sample_2d(state.key, SLOT_FILM));
    state.cone_spread = params.cone_spread;
    state.throughput = vec3<f32>(1.0);
    return state;
}

fn extend(state: ptr<function, PathState>) -> Hit {
    (*state).rays += 1u;
    return closest_hit(Ray((*state).origin, 0.0, (*state).direction, T_FAR), params.root);
}

// Ends or scales the path so that its mean stays: it survives with the probability of its throughput's largest channel.
@if(roulette)
fn survive(state: ptr<function, PathState>) -> bool {
    let played = (*state).bounce >= ROULETTE_BOUNCE;
    let survival = select(1.0, min(1.0, largest_of((*state).throughput)), played);
    (*state).throughput /= survival;
    return sample_1d((*state).key, dimension(state, SLOT_ROULETTE)) < survival;
}

// Draws a new direction from the BSDF of the surface at the end of the ray. Whether the path goes on.
fn scatter(
    state: ptr<function, PathState>,
    hit: Hit,
    triangle: Triangle,
    material: MaterialRecord,
    raw: vec3<f32>,
) -> bool {
    let facing = facing_at(triangle, hit, raw, -(*state).direction);
    let drawn = mixture_sample(
        material,
        facing,
        sample_1d((*state).key, dimension(state, SLOT_LOBE)),
        sample_2d((*state).key, dimension(state, SLOT_DIRECTION)),
    );
    (*state).throughput *= drawn.weight;
    var alive = check(state, (*state).throughput, LARGEST_F32, triangle.material);
    alive = alive && largest_of((*state).throughput) > 0.0;
    @if(roulette) {
        alive = alive && survive(state);
    }
    if (alive) {
        let at = surface_point(triangle.a, triangle.b, triangle.c, hit.b1, hit.b2);
        (*state).origin = offset_ray_origin(at.position, at.error, facing.geometric, drawn.direction);
        (*state).direction = drawn.direction;
        (*state).cone_width += (*state).cone_spread * hit.t;
        (*state).bounce += 1u;
    }
    return alive;
}

// What happens at the end of the ray: light is gathered, a new direction drawn. Whether the path goes on.
//
// Written with one way out, for each early one costs lavapipe's compiler masks over all that follows.
fn shade(state: ptr<function, PathState>, hit: Hit) -> bool {
    let missed = hit.triangle == NO_HIT;
    // Of a ray that missed: leaf 0, not used.
    let triangle = leaves[hit.leaf];
    let material = materials[triangle.material];
    let raw = triangle_normal(triangle.a, triangle.b, triangle.c);
    var sky = vec3<f32>(0.0);
    @if(environment) {
        sky = params.environment;
    }
    var shine = vec3<f32>(0.0);
    @if(emitters) {
        shine = emitted(material, dot(raw, (*state).direction) > 0.0);
    }
    var alive = gather(state, select(shine, sky, missed), select(triangle.material, NO_MATERIAL, missed));
    if (alive && !missed && (*state).bounce + 1u < params.max_depth) {
        alive = scatter(state, hit, triangle, material, raw);
    } else {
        alive = false;
    }
    return alive;
}

// What a path that has ended leaves for the film.
fn finish(state: ptr<function, PathState>) -> RadianceSample {
    if ((*state).faulty != 0u) {
        let kind = fault_of((*state).radiance);
        let origin = vec3<u32>(select(kind, BAD_OVERFLOW, kind == 0u), (*state).bounce, (*state).fault_material);
        return RadianceSample(vec3<f32>(origin), (*state).rays | SAMPLE_BAD);
    }
    return RadianceSample((*state).radiance, (*state).rays);
}

@compute @workgroup_size(8, 8)
fn path(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= params.window_width || id.y >= params.window_height || id.z >= params.layers) {
        return;
    }
    var state = begin(id.xy + vec2<u32>(params.window_x, params.window_y), params.first_sample + id.z);
    for (var segment = 0u; segment < params.max_depth; segment++) {
        let hit = extend(&state);
        if (!shade(&state, hit)) {
            break;
        }
    }
    radiance[(id.z * params.window_height + id.y) * params.window_width + id.x] = finish(&state);
}
