// Sets the first `count` words of a buffer to one value.

import package::gen::{ClearParams};

@group(0) @binding(0) var<storage, read> params: ClearParams;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;

@compute @workgroup_size(256)
fn clear(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let i = (group.x + group.y * groups.x) * 256u + local;
    if (i < params.count) {
        words[i] = params.value;
    }
}
