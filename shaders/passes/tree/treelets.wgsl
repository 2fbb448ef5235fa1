// Subtrees of up to TREELET_SIZE leaves whose parent has more, each joined anew from its leaves by a workgroup.

import package::gen::{LEAF_BIT, LeafBox, TREELET_SIZE, TreeletParams};
import package::passes::tree::clusters::{Cluster, join_clusters, nodes, numbers, store_cluster};

@group(0) @binding(0) var<storage, read> treelets: array<u32>;
@group(0) @binding(1) var<storage, read> boxes: array<LeafBox>;
@group(0) @binding(2) var<storage, read> params: TreeletParams;

const GROUP_SIZE = TREELET_SIZE;

@compute @workgroup_size(GROUP_SIZE)
fn build_treelets(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @if(!ballots) @builtin(local_invocation_index) lane: u32,
    @if(ballots) @builtin(subgroup_id) row: u32,
    @if(ballots) @builtin(subgroup_invocation_id) thread: u32,
) {
    @if(ballots) let lane = row * 32u + thread;
    let count = treelets[params.level];
    let stride = workgroups.x * workgroups.y;
    for (var i = workgroup.x + workgroup.y * workgroups.x; i < count; i += stride) {
        let root = treelets[params.first + i];
        let leaves = min(nodes[root].leaves, TREELET_SIZE);
        // A node over a range of leaves has the number of its first or of its last leaf (Karras 2012), and the split of its range says which.
        let from_first = (nodes[root].left & ~LEAF_BIT) >= root;
        let first = select(root + 1u - leaves, root, from_first);
        workgroupBarrier();
        if lane < leaves {
            let own = boxes[first + lane];
            store_cluster(lane, Cluster(LEAF_BIT | (first + lane), 1u, own.low.xyz, own.high.xyz));
            numbers[lane] = select(root - lane, root + lane, from_first);
        }
        workgroupBarrier();
        storageBarrier();
        join_clusters(leaves, lane);
    }
}
