// Rays in, closest hits out.

import package::gen::{ExtendParams, Hit, Ray};
import package::passes::trace::traverse::{closest_hit};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> hits: array<Hit>;

@compute @workgroup_size(64)
fn extend(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= params.count {
        return;
    }
    hits[index] = closest_hit(rays[index], params.root);
}
