// Shadow rays: to a light that is sampled, and on through what lets its light straight on.

import package::gen::{Hit, PathState, Ray, TraceParams, NO_HIT, T_FAR};
@if(lights || sky_light) import package::lib::bsdf::mixture::{mixture_evaluate};
@if(alpha || thin) import package::lib::bsdf::straight::{lets_through, passed_straight};
import package::lib::intersect::{offset_ray_origin};
@if(alpha || thin) import package::lib::intersect::{surface_point, triangle_normal};
@if(lights || sky_light) import package::lib::light::{power_heuristic};
@if(lights || sky_light) import package::lib::math::{largest_of};
@if(record && (lights || sky_light)) import package::lib::record::{note_light, turn};
@if(lights || sky_light) import package::passes::trace::connect::{AROUND_LIGHT, draw_light};
@if(lights && point_lights) import package::passes::trace::connect::{is_point};
@if(sources && (lights || sky_light)) import package::passes::trace::brought::{note_sampled};
@if(alpha || thin) import package::passes::trace::materials::{load_material};
@if(reuse && (lights || sky_light)) import package::passes::trace::reuse::{parts_of};
@if(alpha || thin) import package::passes::trace::scene::{load_leaf};
import package::passes::trace::surface::{Surface};
@if((normals || relief) && (alpha || thin)) import package::passes::trace::surface::{mesh_shading_normal};
@if(alpha || thin) import package::passes::trace::surface::{shading_frame_at};
@if(thin && relief) import package::passes::trace::surface::{is_bent};
@if(thin && relief) import package::passes::trace::textures::{load_maps};

// A sampled light and the shadow ray to it. The light is seen if no other triangle comes before it in the order of hits, as for a
// path's segment: so both ways of finding a light see the same scene, however close to the light something lies.
@if(lights || sky_light)
struct Connection {
    // To just beyond the light, just before a point or a speck of one, or without end to the sky.
    ray: Ray,
    // What is hit nearer than this hides the light for certain, and ends the traversal; 0 where it may let light through.
    enough: f32,
    // What it adds to the pixel if that is seen; 0 where no shadow ray is needed.
    light: vec3<f32>,
    // And to what the path lends.
    @if(reuse) lent: vec3<f32>,
    // The light's triangle, or NO_HIT.
    triangle: u32,
    // The ray ends before the light, or nowhere: nothing is hit where nothing hides it.
    ends_before: bool,
    // How many surfaces it may yet pass straight on.
    @if(alpha || thin) passes: u32,
    // To a light without extent.
    @if(lights && point_lights && thin && relief) to_point: bool,
}

// Draws a point of a light, or a direction of the sky, and weights what it sends here against finding it by sampling the BSDF: `u` chooses the
// light and the point on it, `texel` what its map says there.
@if(lights || sky_light)
fn connect(params: TraceParams, state: PathState, surface: Surface, u: vec2<f32>, texel: f32) -> Connection {
    let drawn = draw_light(params, surface.position, u, texel);
    let at = mixture_evaluate(surface.material, surface.frame, drawn.direction);
    @if(record) note_light(u, drawn.direction, drawn.pdf, drawn.radiance, drawn.triangle, at.value, at.pdf);
    @if(sources) note_sampled(params, surface.index, drawn.triangle, drawn.end > 0.0, drawn.direction);
    var light = vec3<f32>(0.0);
    @if(reuse) var lent_light = vec3<f32>(0.0);
    if (drawn.pdf > 0.0 && at.pdf > 0.0) {
        var weight = power_heuristic(drawn.pdf, at.pdf);
        @if(lights && point_lights) {
            weight = select(weight, 1.0, is_point(drawn));
        }
        @if(record) turn.light_weight = weight;
        let arriving = drawn.radiance * (weight / drawn.pdf);
        @if(reuse) {
            let parts = parts_of(state, surface, drawn.direction, at.value, 1.0);
            light = parts.own * arriving;
            lent_light = parts.lent * arriving;
        } @else {
            light = state.throughput * at.value * arriving;
        }
    }
    let origin = offset_ray_origin(surface.position, surface.error, surface.frame.geometric, drawn.direction);
    var connection: Connection;
    connection.light = light;
    @if(reuse) {
        connection.lent = lent_light;
    }
    connection.triangle = drawn.triangle;
    connection.ends_before = drawn.end < 1.0;
    if (drawn.end == 0.0) {
        connection.ray = Ray(origin, 0.0, drawn.direction, T_FAR);
        connection.enough = T_FAR;
    } else {
        let offset = drawn.point - origin;
        // Of unit length like the ray of a segment, whose t is rounded so.
        let far = max(length(offset), 0x1p-100);
        connection.ray = Ray(origin, 0.0, offset / far, far * drawn.end);
        connection.enough = far * (1.0 - AROUND_LIGHT);
    }
    @if(alpha || thin) {
        // What comes first may let it pass, as often as a path of this depth could.
        connection.enough = 0.0;
        connection.passes = params.max_depth - 2u - state.bounce;
        @if(lights && point_lights && thin && relief) {
            connection.to_point = is_point(drawn);
        }
    }
    return connection;
}

// Whether the light would add anything.
@if(lights || sky_light)
fn is_needed(connection: Connection) -> bool {
    var most = connection.light;
    @if(reuse) {
        most = max(most, connection.lent);
    }
    return largest_of(most) > 0.0;
}

// Whether what a shadow ray has hit, or missed, leaves its light to be seen. One that misses a light it was to hit has met a hole of it.
@if(lights || sky_light)
fn sees_light(connection: Connection, hit: Hit) -> bool {
    return hit.triangle == connection.triangle || (hit.triangle == NO_HIT && connection.ends_before);
}

// Takes a shadow ray on through what it has hit, weighted by what goes straight on there; whether anything does. A relief would change what a
// pane lets through: there, lights but points are left to paths.
@if((lights || sky_light) && (alpha || thin))
fn pass_straight(connection: ptr<function, Connection>, hit: Hit) -> bool {
    let ray = (*connection).ray;
    let triangle = load_leaf(hit.leaf);
    let material = load_material(triangle.material);
    var passes = (*connection).passes > 0u && lets_through(material);
    @if(thin && relief) {
        var bent = is_bent(material, load_maps(triangle.material));
        @if(lights && point_lights) {
            bent = bent && !(*connection).to_point;
        }
        passes = passes && !bent;
    }
    if (!passes) {
        return false;
    }
    let area_normal = triangle_normal(triangle.a, triangle.b, triangle.c);
    var frame = shading_frame_at(triangle, hit, area_normal, -ray.direction);
    @if(normals || relief) {
        frame.shading = mesh_shading_normal(triangle, hit, frame);
    }
    let at = surface_point(triangle.a, triangle.b, triangle.c, hit.b1, hit.b2);
    let origin = offset_ray_origin(at.position, at.error, frame.geometric, ray.direction);
    let t_max = ray.t_max - dot(origin - ray.origin, ray.direction);
    let passed = passed_straight(material, dot(frame.wo, frame.shading));
    (*connection).light *= passed;
    @if(reuse) {
        (*connection).lent *= passed;
    }
    (*connection).passes -= 1u;
    (*connection).ray = Ray(origin, 0.0, ray.direction, t_max);
    return is_needed(*connection) && t_max > 0.0;
}
