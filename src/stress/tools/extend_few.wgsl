// The closest hits of two triangles and more as paths find them in scenes of at most 32.

import package::gen::{ExtendParams, Hit, Ray, NO_CHANCE};
import package::passes::trace::few_boxes::{keep_boxes};
import package::passes::trace::scene::{scene_extent};
import package::passes::trace::traverse_few::{traverse_few};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> hits: array<Hit>;

@compute @workgroup_size(64)
fn extend_few(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    keep_boxes(params.root, lane, 64u);
    let index = id.x + id.y * groups.x * 64u;
    if index < params.count {
        hits[index] = traverse_few(rays[index], params.root, scene_extent(params.root), 0.0, NO_CHANCE);
    }
}
