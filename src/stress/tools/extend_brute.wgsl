// extend without a tree: every leaf is tested, by the function that the walk uses.

import package::gen::{ExtendParams, Hit, Ray, LEAF_BIT, NO_HIT, NO_ROOT};
import package::lib::intersect::{prepare_query};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node, scene_extent};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> hits: array<Hit>;

@compute @workgroup_size(64)
fn extend_brute(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
                @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= params.count {
        return;
    }
    let ray = rays[index];
    var hit = Hit(ray.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    if params.root != NO_ROOT && !all(ray.direction == vec3(0.0)) {
        let query = prepare_query(ray, scene_extent(params.root), 0u);
        var count = 1u;
        if params.root < LEAF_BIT {
            count = load_node(params.root).leaves;
        }
        for (var leaf = 0u; leaf < count; leaf += 1u) {
            test_leaf(query, leaf, &hit);
        }
    }
    hits[index] = hit;
}
