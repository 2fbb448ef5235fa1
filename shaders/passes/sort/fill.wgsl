// Pairs to sort: key = a hash of the index, 63 bits; payload = the index. One in 16 repeats the key of an earlier pair, so
// that an unstable sort shows.

import package::gen::{SortParams, SORT_THREADS};

@group(0) @binding(0) var<storage, read> params: SortParams;
@group(0) @binding(1) var<storage, read_write> keys: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> payload: array<u32>;

/// PCG's output permutation over one step of its generator (Jarzynski and Olano 2020).
fn pcg(seed: u32) -> u32 {
    let state = seed * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

@compute @workgroup_size(SORT_THREADS)
fn fill(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = (group.x + group.y * groups.x) * SORT_THREADS + thread;
    if index >= params.count {
        return;
    }
    let low = pcg(select(index, index / 2u, index % 16u == 15u));
    keys[index] = vec2<u32>(low, pcg(low ^ 0x9e3779b9u) & 0x7fffffffu);
    payload[index] = index;
}
