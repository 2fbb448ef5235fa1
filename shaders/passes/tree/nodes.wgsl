// The binary radix tree over the sorted codes (Karras 2012, "Maximizing Parallelism in the Construction of BVHs,
// Octrees, and k-d Trees"), each node with the boxes of its two children.
//
// A thread finds the range of its node and where that splits, and queries the pyramid for the boxes of both halves. No
// thread reads what another one of this dispatch writes, so nothing depends on the order in which they run but the order of the roots in
// `treelets`, on which nothing does.

import package::gen::{
    BuildParams, LEAF_BIT, LeafBox, NO_ROOT, Node, SORT_IN_BACK, SortPlan, TREELET_GROWTH, TREELET_LEVELS, TREELET_SIZE
};

@group(0) @binding(0) var<storage, read> sort_plan: SortPlan;
@group(0) @binding(1) var<storage, read> keys: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> keys_back: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> boxes: array<LeafBox>;
@group(0) @binding(4) var<storage, read_write> nodes: array<Node>;
@group(0) @binding(5) var<storage, read> params: BuildParams;
@group(0) @binding(6) var<storage, read_write> treelets: array<atomic<u32>>;

const GROUP_SIZE = 256u;
// More than the bits of an index: no range takes more steps to find, no pyramid has more levels.
const MAX_STEPS = 32u;

// A node's leaves: `first` to `last`, the left child's up to and with `split`.
struct Range {
    first: u32,
    last: u32,
    split: u32,
}

fn sorted_code(leaf: u32, in_back: bool) -> vec2<u32> {
    if (in_back) {
        return keys_back[leaf];
    }
    return keys[leaf];
}

// The leaf that others are compared with.
struct Origin {
    leaf: i32,
    code: vec2<u32>,
    in_back: bool,
}

// Length of the common prefix with another leaf, equal codes being ordered by their indices; -1 outside.
fn prefix(origin: Origin, other: i32) -> i32 {
    if (other < 0 || other >= i32(params.count)) {
        return -1;
    }
    let differing = origin.code ^ sorted_code(u32(other), origin.in_back);
    if (differing.y != 0u) {
        return i32(countLeadingZeros(differing.y));
    }
    if (differing.x != 0u) {
        return 32 + i32(countLeadingZeros(differing.x));
    }
    return 64 + i32(countLeadingZeros(u32(origin.leaf) ^ u32(other)));
}

fn range_of(node: i32, in_back: bool) -> Range {
    let origin = Origin(node, sorted_code(u32(node), in_back), in_back);
    // The range goes towards the neighbour that has more in common, as far as there is more than with the other one.
    let after = prefix(origin, node + 1);
    let before = prefix(origin, node - 1);
    let direction = select(-1, 1, after > before);
    let outside = min(after, before);
    var reach = 2;
    for (var i = 0u; i < MAX_STEPS && prefix(origin, node + reach * direction) > outside; i++) {
        reach <<= 1u;
    }
    var length = 0;
    for (var stride = reach >> 1u; stride > 0; stride >>= 1u) {
        if (prefix(origin, node + (length + stride) * direction) > outside) {
            length += stride;
        }
    }
    // The split is behind the last leaf that has more in common with this end than the other end has.
    let end = node + length * direction;
    let shared_bits = prefix(origin, end);
    var split = 0;
    var stride = length;
    for (var i = 0u; i < MAX_STEPS && stride > 1; i++) {
        stride = (stride + 1) >> 1u;
        if (prefix(origin, node + (split + stride) * direction) > shared_bits) {
            split += stride;
        }
    }
    let left_end = node + split * direction + min(direction, 0);
    return Range(u32(min(node, end)), u32(max(node, end)), u32(left_end));
}

// The box of the leaves from `first` up to, but without, `end`: at most two runs of each level.
fn box_of(first: u32, end: u32) -> LeafBox {
    let huge = vec4<f32>(3.4028234e38);
    var result = LeafBox(huge, -huge);
    var begin = first;
    var stop = end;
    var level_start = 0u;
    var level_count = params.count;
    for (var level = 0u; level < MAX_STEPS && begin < stop; level++) {
        if ((begin & 1u) != 0u) {
            let run = boxes[level_start + begin];
            result = LeafBox(min(result.low, run.low), max(result.high, run.high));
            begin += 1u;
        }
        if ((stop & 1u) != 0u) {
            stop -= 1u;
            let run = boxes[level_start + stop];
            result = LeafBox(min(result.low, run.low), max(result.high, run.high));
        }
        begin >>= 1u;
        stop >>= 1u;
        level_start += level_count;
        level_count >>= 1u;
    }
    return result;
}

// Lists a node as the root of a treelet of each level whose largest subtrees it is one of. `above` is the number of its parent's leaves.
fn list_treelet(node: u32, leaves: u32, above: u32) {
    var before = 2u;
    var limit = TREELET_SIZE;
    var first = TREELET_LEVELS;
    for (var level = 0u; level < TREELET_LEVELS && limit < above && before < params.count; level += 1u) {
        if leaves > before && leaves <= limit {
            let place = atomicAdd(&treelets[level], 1u);
            atomicStore(&treelets[first + place], node);
        }
        first += params.count / (before + 1u);
        before = limit;
        limit *= TREELET_GROWTH;
    }
}

@compute @workgroup_size(GROUP_SIZE)
fn build_nodes(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let node = (workgroup.x + workgroup.y * workgroups.x) * GROUP_SIZE + lane;
    if (node + 1u >= params.count) {
        return;
    }
    let range = range_of(i32(node), sort_plan.result == SORT_IN_BACK);
    let left_is_leaf = range.split == range.first;
    let right_is_leaf = range.split + 1u == range.last;
    let left = box_of(range.first, range.split + 1u);
    let right = box_of(range.split + 1u, range.last + 1u);
    nodes[node].x = vec4<f32>(left.low.x, left.high.x, right.low.x, right.high.x);
    nodes[node].y = vec4<f32>(left.low.y, left.high.y, right.low.y, right.high.y);
    nodes[node].z = vec4<f32>(left.low.z, left.high.z, right.low.z, right.high.z);
    nodes[node].left = select(0u, LEAF_BIT, left_is_leaf) | range.split;
    nodes[node].right = select(0u, LEAF_BIT, right_is_leaf) | (range.split + 1u);
    nodes[node].leaves = range.last - range.first + 1u;
    // A parent's word is written by the parent's thread alone, and it is a word of its own: no race.
    let leaves = range.last - range.first + 1u;
    if (node == 0u) {
        nodes[node].parent = NO_ROOT;
        list_treelet(node, leaves, 0xffffffffu);
    }
    if (!left_is_leaf) {
        nodes[range.split].parent = node;
        list_treelet(range.split, range.split - range.first + 1u, leaves);
    }
    if (!right_is_leaf) {
        nodes[range.split + 1u].parent = node;
        list_treelet(range.split + 1u, range.last - range.split, leaves);
    }
}
