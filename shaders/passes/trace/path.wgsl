// Paths from the camera: integrator `Path`, which samples a light at every surface (`lights`, `sky_light`), or `Bsdf`, which
// finds light by hitting it. One sample of one pixel an invocation.
//
// begin, extend, shade and scatter are functions over one path state, and `trace_path` composes them.

import package::gen::{MaterialRecord, PathState, RadianceSample, SampleKey, TraceParams};
import package::gen::{Hit, Ray, Triangle, NO_CHANCE, NO_HIT, T_FAR};
import package::gen::{BAD_OVERFLOW, DIMENSIONS_PER_BOUNCE, NO_MATERIAL, SAMPLE_BAD};
import package::gen::{SLOT_CHOICES, SLOT_DIRECTION, SLOT_FILM};
@if(roulette) import package::gen::{ROULETTE_BOUNCE};
@if(dielectric && roulette) import package::gen::{MATERIAL_DIELECTRIC};
@if(dielectric && roulette) import package::lib::bsdf::dielectric::{eta_squared, interface_of};
@if(lights || sky_light) import package::gen::{SLOT_LIGHT_POINT};
@if(adaptive) import package::gen::{TileSample, TILE_LANES};
import package::lib::bsdf::mixture::{mixture_sample};
@if(alpha || thin) import package::lib::bsdf::straight::{is_straight};
@if(lens) import package::gen::{LENS_DIMENSIONS};
@if(!lens) import package::lib::camera::{camera_direction};
@if(lens) import package::lib::camera::{lens_ray};
import package::lib::fault::{fault_of};
import package::lib::intersect::{offset_ray_origin, triangle_normal};
@if(emitters) import package::lib::light::{emitted};
@if(lights) import package::lib::light::{power_heuristic};
import package::lib::math::{largest_of};
import package::lib::rng::{sample_2d};
@if(cutout) import package::lib::rng_pcg::{pcg_words};
@if(cutout) import package::gen::{CUTOUT_DIMENSIONS};
@if(emission_map) import package::passes::trace::emission::{emission_part};
@if(lights && emission_map) import package::passes::trace::emission::{mean_luminance};
@if(textures) import package::passes::trace::textured::{textured};
@if(textures || relief || emission_map) import package::passes::trace::footprint::{at_point, spread_by, texturing_at};
@if(lights) import package::lib::colour::{luminance};
@if(lights) import package::passes::trace::connect::{light_pdf};
@if(few_triangles) import package::passes::trace::few_boxes::{keep_boxes};
@if(probe_view || record) import package::lib::probe::{probe_bounce};
@if(record) import package::lib::record::{turn};
@if(adaptive) import package::lib::tiles::{place_in_tile, tile_corner};
@if(sources) import package::passes::trace::brought::{bring, note_found, note_sampled_arrives, note_scattered};
import package::passes::trace::materials::{load_material};
@if(record) import package::passes::trace::record::{begin_turn, end_turn, note_drawn, note_surface};
import package::passes::trace::scene::{load_leaf, scene_extent};
@if(reuse) import package::passes::trace::reuse::{begin_lending, end_lending, lend_on, lent};
@if(reuse) import package::passes::trace::reuse::{note_gather_point, note_lent_point};
@if(lights || sky_light) import package::passes::trace::shadow::{Connection, connect, is_needed, sees_light};
@if((lights || sky_light) && (alpha || thin)) import package::passes::trace::shadow::{pass_straight};
@if(sky || sky_light) import package::passes::trace::sky::{sky_found};
import package::passes::trace::surface::{Surface, shading_frame_at, surface_at};
@if(normals || relief) import package::lib::normals::{bent_to_viewer};
@if(normals || relief) import package::passes::trace::surface::{unbent_normal_at};
@if(thin && relief) import package::passes::trace::surface::{is_bent};
import package::passes::trace::traverse::{traverse};
import package::passes::trace::traverse_few::{traverse_few};

@group(0) @binding(2) var<storage, read> params: TraceParams;
@group(0) @binding(4) var<storage, read_write> radiance: array<RadianceSample>;
@if(adaptive) @group(0) @binding(29) var<storage, read> tile_samples: array<TileSample>;

const LARGEST_F32: f32 = 0x1.fffffep+127;

// A bounce's numbers in [0, 1) that choose one of several.
struct Choices {
    lobe: f32,
    roulette: f32,
    // What the map of a light says.
    texel: f32,
}

fn dimension(state: ptr<function, PathState>, slot: u32) -> u32 {
    return (*state).bounce * DIMENSIONS_PER_BOUNCE + slot;
}

// Whether all channels are at least 0 and at most `largest`, and so numbers: by their bits, which for such are ordered as
// they are. If not, the path is over, and keeps the value to say what is wrong with it.
fn check(state: ptr<function, PathState>, value: vec3<f32>, largest: f32, material: u32) -> bool {
    let good = all(bitcast<vec3<u32>>(value) <= vec3<u32>(bitcast<u32>(largest)));
    if (!good) {
        (*state).fault = 1u + material;
        (*state).radiance = value;
    }
    return good;
}

// Adds to the pixel, and where paths are reused `lent_light` to what the path lends; whether the path is still good.
fn add_radiance(state: ptr<function, PathState>, light: vec3<f32>, @if(reuse) lent_light: vec3<f32>, material: u32) -> bool {
    (*state).radiance += light;
    @if(record) turn.added = light;
    @if(sources) bring(light);
    var good = check(state, (*state).radiance, params.largest, material);
    @if(reuse) {
        lent.radiance += lent_light;
        good = good && check(state, lent.radiance, params.largest, material);
    }
    return good;
}

// `pixel` in the whole film, `sample` a film sample: even ones belong to half 0, odd ones to half 1.
fn begin(pixel: vec2<u32>, sample: u32) -> PathState {
    var state: PathState;
    state.key = SampleKey(pixel.y * params.film_width + pixel.x, sample >> 1u, sample & 1u, params.seed);
    let at = vec2<f32>(pixel) + sample_2d(state.key, SLOT_FILM);
    @if(lens) {
        let ray = lens_ray(params, at, sample_2d(state.key, LENS_DIMENSIONS));
        state.origin = ray.origin;
        state.direction = ray.direction;
    } @else {
        state.origin = params.position;
        state.direction = camera_direction(params, at);
    }
    state.cone_spread = params.cone_spread;
    state.throughput = vec3<f32>(1.0);
    state.eta_scale = 1.0;
    return state;
}

fn segment_ray(state: PathState) -> Ray {
    return Ray(state.origin, 0.0, state.direction, T_FAR);
}

// The ray of a path: a segment of it, or a shadow ray.
fn extend(state: ptr<function, PathState>, ray: Ray, extent: f32, enough: f32) -> Hit {
    var chance = NO_CHANCE;
    @if(cutout) {
        chance = pcg_words((*state).key, CUTOUT_DIMENSIONS + (*state).rays).x | 1u;
    }
    (*state).rays += 1u;
    @if(few_triangles) {
        return traverse_few(ray, params.root, extent, enough, chance);
    } @else {
        return traverse(ray, params.root, extent, enough, chance);
    }
}

// Ends or scales the path so that its mean stays: it survives with the probability of its throughput's largest channel, as it would be
// outside of glass. What refraction took on the way in, it gives back on the way out: such a path is not dim. `u` decides.
@if(roulette)
fn survive(state: ptr<function, PathState>, surface: Surface, direction: vec3<f32>, u: f32) -> bool {
    @if(dielectric) {
        let crosses = dot(direction, surface.frame.geometric) < 0.0;
        if (crosses && (surface.material.flags & MATERIAL_DIELECTRIC) != 0u) {
            (*state).eta_scale /= eta_squared(interface_of(surface.material.ni, surface.frame.back_face != 0u));
        }
    }
    let played = (*state).bounce >= ROULETTE_BOUNCE;
    var most = (*state).throughput;
    @if(reuse) {
        // Somebody in the tile may see it all, however little this pixel does.
        most += lent.throughput;
    }
    let survival = select(1.0, min(1.0, largest_of(most) * (*state).eta_scale), played);
    (*state).throughput /= survival;
    @if(record) turn.survival = survival;
    @if(reuse) {
        lent.throughput /= survival;
    }
    return u < survival;
}

// Draws a new direction from the BSDF of the surface at the end of the ray. Whether the path goes on.
fn scatter(state: ptr<function, PathState>, surface: Surface, choices: Choices) -> bool {
    let u = sample_2d((*state).key, dimension(state, SLOT_DIRECTION));
    let drawn = mixture_sample(surface.material, surface.frame, choices.lobe, u);
    @if(record) note_drawn(u, drawn);
    var alive: bool;
    @if(reuse) {
        let parts = lend_on(*state, surface, drawn);
        (*state).throughput = parts.own;
        lent.throughput = parts.lent;
        alive = check(state, (*state).throughput, LARGEST_F32, surface.index) && check(state, lent.throughput, LARGEST_F32, surface.index);
        alive = alive && largest_of(max((*state).throughput, lent.throughput)) > 0.0;
        lent.begins = (*state).bounce == 0u && drawn.pdf > 0.0 && params.keeps == 0u;
    } @else {
        (*state).throughput *= drawn.weight;
        alive = check(state, (*state).throughput, LARGEST_F32, surface.index);
        alive = alive && largest_of((*state).throughput) > 0.0;
    }
    @if(roulette) {
        alive = alive && survive(state, surface, drawn.direction, choices.roulette);
    }
    if (alive) {
        (*state).origin = offset_ray_origin(surface.position, surface.error, surface.frame.geometric, drawn.direction);
        (*state).cone_width += (*state).cone_spread * surface.t;
        @if(textures || relief || emission_map) {
            (*state).cone_spread = spread_by(*state, surface.curvature, drawn, params.cone_part);
        }
        (*state).direction = drawn.direction;
        @if(alpha || thin) {
            var straight = is_straight(surface.material, surface.frame.wo, drawn);
            @if(thin && relief) {
                straight = straight && !surface.bent;
            }
            @if(sources) note_scattered(surface.index, drawn.pdf, straight);
            // Light sampling goes straight on there too: what lies behind is weighted as if nothing were in between.
            (*state).pdf = select(drawn.pdf, (*state).pdf, straight);
            (*state).passed = select(0.0, (*state).passed + surface.t, straight);
        } @else {
            @if(sources) note_scattered(surface.index, drawn.pdf, false);
            (*state).pdf = drawn.pdf;
        }
        (*state).bounce += 1u;
    }
    return alive;
}

// What arrives along the ray from its end, times the part of it that this way of finding it counts for. `mean` is the luminance by which the
// triangle is sampled as a light.
fn incident_radiance(state: ptr<function, PathState>, hit: Hit, material: MaterialRecord, mean: f32, area_normal: vec3<f32>) -> vec3<f32> {
    var light = vec3<f32>(0.0);
    if (hit.triangle == NO_HIT) {
        @if(environment) {
            light = params.environment;
        }
        @if(record) turn.emitted = light;
        @if(sky || sky_light) {
            light = sky_found(params, (*state).direction, (*state).pdf);
        }
    } else {
        @if(emitters) {
            light = emitted(material, dot(area_normal, (*state).direction) > 0.0);
        }
        @if(record) turn.emitted = light;
        @if(lights) {
            if ((*state).pdf > 0.0) {
                var distance = hit.t;
                @if(alpha || thin) {
                    distance += (*state).passed;
                }
                @if(record) turn.found_pdf = light_pdf(params, material, mean, area_normal, (*state).direction, distance);
                light *= power_heuristic((*state).pdf, light_pdf(params, material, mean, area_normal, (*state).direction, distance));
            }
        }
    }
    return light;
}

// What happened at the end of a ray: where the path goes on, and the shadow ray that comes first.
struct Shaded {
    alive: bool,
    @if(lights || sky_light) connection: Connection,
}

// What happens at the end of the ray: its radiance is added, a light is sampled, a new direction drawn.
//
// Written with one way out, for each early one costs lavapipe's compiler masks over all that follows.
fn shade(state: ptr<function, PathState>, hit: Hit, @if(reuse) place: u32) -> Shaded {
    let missed = hit.triangle == NO_HIT;
    // Of a ray that missed: leaf 0, not used.
    let triangle = load_leaf(hit.leaf);
    var material = load_material(triangle.material);
    let area_normal = triangle_normal(triangle.a, triangle.b, triangle.c);
    var mean = 0.0;
    @if(lights) {
        mean = luminance(material.emission);
    }
    @if(textures || relief || emission_map) let texturing = texturing_at(*state, triangle, hit, area_normal);
    @if(emission_map) {
        if (texturing.maps.emission != 0u) {
            // Where light sampling could have found it, it is looked up as there: without a footprint.
            let point = at_point(texturing.point, (*state).pdf > 0.0);
            material.emission *= emission_part(triangle.material, point, texturing.others.y);
            @if(lights) {
                mean = mean_luminance(triangle.index);
            }
        }
    }
    let light = incident_radiance(state, hit, material, mean, area_normal);
    var shaded: Shaded;
    let material_seen = select(triangle.material, NO_MATERIAL, missed);
    @if(sources) note_found(params, hit.triangle, (*state).direction);
    shaded.alive = add_radiance(state, (*state).throughput * light, @if(reuse) lent.throughput * light, material_seen);
    if (shaded.alive && !missed && (*state).bounce + 1u < params.max_depth) {
        var frame = shading_frame_at(triangle, hit, area_normal, -(*state).direction);
        var normal = frame.shading;
        @if(relief) {
            normal = unbent_normal_at(triangle, hit, frame, texturing);
        }
        @if(normals && !relief) {
            normal = unbent_normal_at(triangle, hit, frame);
        }
        @if(normals || relief) {
            frame.shading = bent_to_viewer(normal, frame.geometric, frame.wo);
        }
        @if(textures) {
            material = textured(material, texturing.maps, texturing.point, texturing.colours);
        }
        var surface = surface_at(triangle, hit, material, frame);
        @if(record) note_surface(surface);
        @if(reuse) {
            if ((*state).bounce == 0u && params.keeps == 0u) {
                note_gather_point(place, surface);
            }
            if (lent.begins) {
                note_lent_point(place, *state, surface, triangle.index, normal);
            }
        }
        let u = sample_2d((*state).key, dimension(state, SLOT_CHOICES));
        var choices = Choices(u.x, u.y, 0.0);
        @if(record) turn.choices = u;
        @if(thin && relief) {
            surface.bent = is_bent(material, texturing.maps);
        }
        @if(textures || relief || emission_map) {
            surface.curvature = texturing.curvature;
            choices.texel = texturing.others.z;
        }
        @if(lights || sky_light) {
            let point = sample_2d((*state).key, dimension(state, SLOT_LIGHT_POINT));
            shaded.connection = connect(params, *state, surface, point, choices.texel);
        }
        shaded.alive = scatter(state, surface, choices);
    } else {
        shaded.alive = false;
    }
    return shaded;
}

// What a path that has ended leaves for the film.
fn finish(state: ptr<function, PathState>) -> RadianceSample {
    if ((*state).fault != 0u) {
        let kind = fault_of((*state).radiance);
        let origin = vec3<u32>(select(kind, BAD_OVERFLOW, kind == 0u), (*state).bounce, (*state).fault - 1u);
        return RadianceSample(vec3<f32>(origin), (*state).rays | SAMPLE_BAD);
    }
    return RadianceSample((*state).radiance, (*state).rays);
}

// One sample of a pixel of the whole film; `place` is that of its record of what it gathers and lends.
fn trace_path(pixel: vec2<u32>, sample: u32, @if(reuse) place: u32) -> RadianceSample {
    let extent = scene_extent(params.root);
    @if(reuse) {
        begin_lending(place);
    }
    var state = begin(pixel, sample);
    @if(lights || sky_light) {
        // Segments and shadow rays take turns in one loop, so that traversal is compiled once.
        var ray = segment_ray(state);
        var is_shadow_ray = false;
        var alive = true;
        var connection: Connection;
        var most = 2u * params.max_depth;
        @if(alpha || thin) {
            // A shadow ray of bounce b goes on at most max_depth - 2 - b times.
            most += params.max_depth * params.max_depth / 2u;
        }
        for (var i = 0u; i < most; i++) {
            @if(probe_view || record) probe_bounce = select(state.bounce, probe_bounce, is_shadow_ray);
            let hit = extend(&state, ray, extent, select(0.0, connection.enough, is_shadow_ray));
            @if(record) begin_turn(state, ray, hit, is_shadow_ray);
            if (is_shadow_ray) {
                @if(record) turn.throughput = connection.light;
                let seen = sees_light(connection, hit);
                if (seen) {
                    @if(sources) note_sampled_arrives();
                    alive = add_radiance(&state, connection.light, @if(reuse) connection.lent, NO_MATERIAL) && alive;
                }
                is_shadow_ray = false;
                @if(alpha || thin) {
                    is_shadow_ray = !seen && pass_straight(&connection, hit);
                }
            } else {
                let shaded = shade(&state, hit, @if(reuse) place);
                alive = shaded.alive;
                connection = shaded.connection;
                is_shadow_ray = state.fault == 0u && is_needed(connection);
            }
            @if(record) end_turn(state);
            if (!alive && !is_shadow_ray) {
                break;
            }
            ray = segment_ray(state);
            if (is_shadow_ray) {
                ray = connection.ray;
            }
        }
    }
    @if(!lights && !sky_light) {
        for (var segment = 0u; segment < params.max_depth; segment++) {
            @if(probe_view || record) probe_bounce = state.bounce;
            let hit = extend(&state, segment_ray(state), extent, 0.0);
            @if(record) begin_turn(state, segment_ray(state), hit, false);
            let alive = shade(&state, hit, @if(reuse) place).alive;
            @if(record) end_turn(state);
            if (!alive) {
                break;
            }
        }
    }
    @if(reuse) {
        end_lending(place, state.fault == 0u);
    }
    return finish(&state);
}

// What a kernel that traces paths does first, with all its `lanes` invocations a workgroup.
fn prepare_workgroup(lane: u32, lanes: u32) {
    @if(few_triangles) {
        keep_boxes(params.root, lane, lanes);
    }
}

// What an invocation traces.
struct Task {
    // Of the whole film.
    pixel: vec2<u32>,
    // Of the film.
    sample: u32,
    // Where it is in the batch.
    place: u32,
    exists: bool,
}

// Of a batch of layers of a rectangle.
fn task_of(id: vec3<u32>) -> Task {
    let pixel = (id.xy << vec2<u32>(params.column_shift, params.row_shift)) + vec2<u32>(params.window_x, params.window_y);
    let place = (id.z * params.window_height + id.y) * params.window_width + id.x;
    let exists = id.x < params.window_width && id.y < params.window_height && id.z < params.layers;
    return Task(pixel, params.first_sample + id.z, place, exists);
}

// Of a batch of tiles: the workgroups are numbered, each has a sample of one.
@if(adaptive)
fn task_in_tile(number: u32, lane: u32) -> Task {
    let listed = tile_samples[min(number, params.tile_samples - 1u)];
    let pixel = tile_corner(listed.tile) + place_in_tile(lane);
    @if(reuse) {
        // All of the tile, whatever is kept of it: its pixels need each other.
        let exists = all(pixel < vec2<u32>(params.film_width, params.film_height));
        return Task(pixel, listed.sample, number * TILE_LANES + lane, number < params.tile_samples && exists);
    } @else {
        let place = pixel - vec2<u32>(params.window_x, params.window_y);
        let exists = all(place < vec2<u32>(params.window_width, params.window_height));
        return Task(pixel, listed.sample, number * TILE_LANES + lane, number < params.tile_samples && exists);
    }
}

@compute @workgroup_size(8, 8)
fn path(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
    @if(adaptive) @builtin(workgroup_id) group: vec3<u32>,
    @if(adaptive) @builtin(num_workgroups) groups: vec3<u32>,
) {
    prepare_workgroup(lane, 64u);
    var task = task_of(id);
    @if(adaptive) {
        if (params.tile_samples > 0u) {
            task = task_in_tile(group.x + group.y * groups.x, lane);
        }
    }
    if (!task.exists) {
        return;
    }
    let sample = trace_path(task.pixel, task.sample, @if(reuse) task.place);
    radiance[params.first_layer * params.window_height * params.window_width + task.place] = sample;
}
