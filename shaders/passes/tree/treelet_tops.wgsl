// What joins treelets: subtrees of more leaves, each joined anew from the treelets below it by a workgroup.

import package::gen::{LEAF_BIT, Node, TREELET_SIZE, TreeletParams};
import package::passes::tree::clusters::{
    Cluster, bits_before, clear_bits, join_clusters, load_cluster, nodes, note_bits, numbers, store_cluster
};

@group(0) @binding(0) var<storage, read> treelets: array<u32>;
@group(0) @binding(2) var<storage, read> params: TreeletParams;

const GROUP_SIZE = TREELET_SIZE;
// No treelet is as deep: codes and indices make 96 levels at most, and a treelet below one 28.
const MAX_TURNS = 128u;

fn left_of(node: Node) -> Cluster {
    return Cluster(node.left, 0u, vec3(node.x.x, node.y.x, node.z.x), vec3(node.x.y, node.y.y, node.z.y));
}

fn right_of(node: Node) -> Cluster {
    return Cluster(node.right, 0u, vec3(node.x.z, node.y.z, node.z.z), vec3(node.x.w, node.y.w, node.z.w));
}

// The same with the number of its leaves.
fn counted(cluster: Cluster) -> Cluster {
    var found = cluster;
    found.leaves = 1u;
    if cluster.child < LEAF_BIT {
        found.leaves = nodes[cluster.child].leaves;
    }
    return found;
}

// Takes a tree apart until no cluster has more than `below` leaves: each that has becomes two, in its place. How many there are; 0 where there
// would be more than TREELET_SIZE.
fn take_apart(root: u32, below: u32, lane: u32) -> u32 {
    if lane == 0u {
        store_cluster(0u, counted(Cluster(root, 0u, vec3(0.0), vec3(0.0))));
    }
    var count = 1u;
    for (var turn = 0u; turn < MAX_TURNS; turn += 1u) {
        clear_bits(lane);
        workgroupBarrier();
        let own = load_cluster(min(lane, count - 1u));
        let opens = lane < count && own.leaves > below;
        note_bits(lane, false, opens);
        workgroupBarrier();
        let opened = bits_before(TREELET_SIZE).y;
        if opened == 0u {
            return count;
        }
        if count + opened > TREELET_SIZE {
            return 0u;
        }
        if lane < count {
            let before = bits_before(lane).y;
            if opens {
                let node = nodes[own.child];
                numbers[count - 1u + before] = own.child;
                store_cluster(lane + before, counted(left_of(node)));
                store_cluster(lane + before + 1u, counted(right_of(node)));
            } else {
                store_cluster(lane + before, own);
            }
        }
        count += opened;
        workgroupBarrier();
    }
    return 0u;
}

@compute @workgroup_size(GROUP_SIZE)
fn build_treelet_tops(
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
        workgroupBarrier();
        let clusters = take_apart(root, params.below, lane);
        storageBarrier();
        if clusters > 0u {
            join_clusters(clusters, lane);
        }
    }
}
