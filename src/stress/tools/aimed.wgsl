// Rays from within a closed mesh at points of its edges, and at its corners exactly. Counts those that hit nothing, and those that hit a
// triangle from `sound` on, which has no area.

import package::gen::{AimedParams, Hit, Ray, NO_HIT, T_FAR};
import package::lib::rng_pcg::{pcg4d};
import package::passes::trace::scene::{load_leaf};
import package::passes::trace::traverse::{closest_hit};

@group(0) @binding(2) var<storage, read> params: AimedParams;
@group(0) @binding(3) var<storage, read_write> aimed: array<atomic<u32>>;

fn unit(words: vec3<u32>) -> vec3<f32> {
    return vec3<f32>(words >> vec3<u32>(8u)) * 0x1p-24;
}

@compute @workgroup_size(64)
fn aim(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= params.count {
        return;
    }
    let drawn = pcg4d(vec4<u32>(params.first + index, 0u, 0u, params.seed));
    let place = pcg4d(vec4<u32>(params.first + index, 1u, 0u, params.seed));
    let triangle = load_leaf(drawn.x % params.leaves);
    var corners = array<vec3<f32>, 3>(triangle.a, triangle.b, triangle.c);
    let a = corners[drawn.y % 3u];
    let b = corners[(drawn.y + 1u) % 3u];
    let along = unit(drawn.zzz).x;
    let aim = select(mix(a, b, along), a, (drawn.w & 1u) == 0u);
    let origin = unit(place.xyz) * 0.8 - 0.4;
    let hit = closest_hit(Ray(origin, 0.0, aim - origin, T_FAR), params.root);
    if hit.triangle == NO_HIT {
        atomicAdd(&aimed[0], 1u);
    } else if hit.triangle >= params.sound {
        atomicAdd(&aimed[1], 1u);
    }
}
