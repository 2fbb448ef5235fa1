// Rays in, 1 out where anything lies between a ray's ends, else 0.

import package::gen::{ExtendParams, Ray};
import package::passes::trace::traverse::{any_hit};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> occlusion: array<u32>;

@compute @workgroup_size(64)
fn occluded(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= params.count {
        return;
    }
    occlusion[index] = select(0u, 1u, any_hit(rays[index], params.root));
}
