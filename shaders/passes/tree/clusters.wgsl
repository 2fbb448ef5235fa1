// Clusters of a treelet, joined until there is one, by a workgroup: parallel locally-ordered clustering (Meister and Bittner 2018).
//
// A cluster is a subtree that is settled: for a treelet of leaves a leaf, else the root of a treelet below. They stand in the order of
// their codes, each looks at those up to TREELET_RADIUS places away, and two that are nearest to each other become one, in the place of
// the first. The nodes that join them get the numbers of those that did before, the root's the root's: what is above stays right.

import package::gen::{LEAF_BIT, Node, TREELET_LEAST_AREA, TREELET_LONGEST, TREELET_RADIUS, TREELET_SIZE, TREELET_TURNS};

// More than it takes to halve a treelet until one is left.
const MOST_HALVINGS = 16u;

@group(0) @binding(4) var<storage, read_write> nodes: array<Node>;

// The root of a subtree: a node, or LEAF_BIT and a leaf; how many leaves are below it; and its box.
struct Cluster {
    child: u32,
    leaves: u32,
    low: vec3<f32>,
    high: vec3<f32>,
}

// Boxes as bits, for words that are no numbers stand beside them: least corner and child, greatest corner and leaves.
var<workgroup> lows: array<vec4<u32>, TREELET_SIZE>;
var<workgroup> highs: array<vec4<u32>, TREELET_SIZE>;
// Half the surface of the box of each.
var<workgroup> areas: array<f32, TREELET_SIZE>;
// The place of the cluster that is nearest to each.
var<workgroup> nearest: array<u32, TREELET_SIZE>;
// The numbers of the nodes that are made, that of the root first: they are given from the last on.
var<workgroup> numbers: array<u32, TREELET_SIZE>;
// A bit for each place, by which it is counted how many there are before one.
@if(!ballots) var<workgroup> kept: array<atomic<u32>, TREELET_SIZE / 32u>;
@if(!ballots) var<workgroup> marked: array<atomic<u32>, TREELET_SIZE / 32u>;
// The same, kept and marked, where subgroups have 32 threads for certain: a ballot tells a word at once.
@if(ballots) var<workgroup> noted: array<vec2<u32>, TREELET_SIZE / 32u>;
// How many clusters a turn leaves, and how many nodes it made.
var<workgroup> turned: vec2<u32>;

// A product of two sides of a box; none where it is small. So it can't be fused with a sum, which would round another way.
fn area_product(a: f32, b: f32) -> f32 {
    let product = a * b;
    return select(product, 0.0, product < TREELET_LEAST_AREA);
}

// Half the surface of a box.
fn box_area(low: vec3<f32>, high: vec3<f32>) -> f32 {
    let size = min(high - low, vec3(TREELET_LONGEST));
    return area_product(size.x, size.y) + area_product(size.y, size.z) + area_product(size.z, size.x);
}

fn load_cluster(place: u32) -> Cluster {
    let low = lows[place];
    let high = highs[place];
    return Cluster(low.w, high.w, bitcast<vec3<f32>>(low.xyz), bitcast<vec3<f32>>(high.xyz));
}

fn store_cluster(place: u32, cluster: Cluster) {
    lows[place] = vec4(bitcast<vec3<u32>>(cluster.low), cluster.child);
    highs[place] = vec4(bitcast<vec3<u32>>(cluster.high), cluster.leaves);
    areas[place] = box_area(cluster.low, cluster.high);
}

// Empties the bits, before a barrier; ballots write all of a word.
fn clear_bits(lane: u32) {
    @if(!ballots) {
        if lane < TREELET_SIZE / 32u {
            atomicStore(&kept[lane], 0u);
            atomicStore(&marked[lane], 0u);
        }
    }
}

// Notes of each place whether it is kept, and is marked: all invocations together, where none has branched off since a barrier, between clear_bits() and a barrier.
fn note_bits(place: u32, is_kept: bool, is_marked: bool) {
    @if(ballots) {
        let bits = vec2(subgroupBallot(is_kept).x, subgroupBallot(is_marked).x);
        if (place & 31u) == 0u {
            noted[place >> 5u] = bits;
        }
    } @else {
        if is_kept {
            atomicOr(&kept[place >> 5u], 1u << (place & 31u));
        }
        if is_marked {
            atomicOr(&marked[place >> 5u], 1u << (place & 31u));
        }
    }
}

fn noted_bits(word: u32) -> vec2<u32> {
    @if(ballots) {
        return noted[word];
    } @else {
        return vec2(atomicLoad(&kept[word]), atomicLoad(&marked[word]));
    }
}

// How many places before one are kept, and are marked.
fn bits_before(place: u32) -> vec2<u32> {
    var count = vec2(0u);
    // All words, so that none waits for another.
    for (var word = 0u; word < TREELET_SIZE / 32u; word += 1u) {
        let before = max(place, word * 32u) - word * 32u;
        let below = select((1u << (before & 31u)) - 1u, 0xffffffffu, before >= 32u);
        count += countOneBits(noted_bits(word) & vec2(below));
    }
    return count;
}

// The place of the cluster that is nearest to that at a place: where the box of both has least surface beyond those of either. Of two as near
// ones, the pair whose places differ in lower bits, then the first: so all clusters order pairs in one way, and the best of all pairs is
// nearest to each other.
fn nearest_to(place: u32, count: u32) -> u32 {
    let own = load_cluster(place);
    let own_area = areas[place];
    var best = vec3(0xffffffffu);
    var found = place;
    // A fixed number of rounds, so that none waits for the box of another.
    for (var step = 0u; step < 2u * TREELET_RADIUS; step += 1u) {
        let away = (step >> 1u) + 1u;
        let exists = select((place + away) < count, (place >= away), (step & 1u) != 0u);
        let other = select(place, select(place + away, place - away, (step & 1u) != 0u), exists);
        let low = min(own.low, bitcast<vec3<f32>>(lows[other].xyz));
        let high = max(own.high, bitcast<vec3<f32>>(highs[other].xyz));
        let both = box_area(low, high);
        let key = vec3(bitcast<u32>((both - own_area) + (both - areas[other])), place ^ other, min(place, other));
        let less = key.x < best.x || (key.x == best.x && (key.y < best.y || (key.y == best.y && key.z < best.z)));
        if other != place && less {
            best = key;
            found = other;
        }
    }
    return found;
}

// Makes a node of two clusters.
fn join(left: Cluster, right: Cluster, number: u32) -> Cluster {
    nodes[number].x = vec4(left.low.x, left.high.x, right.low.x, right.high.x);
    nodes[number].y = vec4(left.low.y, left.high.y, right.low.y, right.high.y);
    nodes[number].z = vec4(left.low.z, left.high.z, right.low.z, right.high.z);
    nodes[number].left = left.child;
    nodes[number].right = right.child;
    nodes[number].leaves = left.leaves + right.leaves;
    // A node has one parent, so this word of it is written once, and the rest of it by whoever made it.
    if left.child < LEAF_BIT {
        nodes[left.child].parent = number;
    }
    if right.child < LEAF_BIT {
        nodes[right.child].parent = number;
    }
    return Cluster(number, left.leaves + right.leaves, min(left.low, right.low), max(left.high, right.high));
}

// Joins the first `clusters` places, which all invocations call with the same number after a barrier, until one is left.
fn join_clusters(clusters: u32, lane: u32) {
    var count = clusters;
    // Numbers that are left.
    var free = clusters - 1u;
    // Each turn joins at least the best pair, and the last turns join each with its neighbour.
    for (var turn = 0u; turn < TREELET_TURNS + MOST_HALVINGS && count > 1u; turn += 1u) {
        clear_bits(lane);
        if lane < count {
            if turn < TREELET_TURNS {
                nearest[lane] = nearest_to(lane, count);
            } else {
                nearest[lane] = min(lane ^ 1u, count - 1u);
            }
        }
        workgroupBarrier();
        let other = nearest[min(lane, count - 1u)];
        let mutual = nearest[other] == lane;
        let stays = lane < count && (!mutual || lane <= other);
        let joins = lane < count && mutual && lane < other;
        note_bits(lane, stays, joins);
        var own: Cluster;
        var partner: Cluster;
        if lane < count {
            own = load_cluster(lane);
            partner = load_cluster(other);
        }
        workgroupBarrier();
        if stays {
            let before = bits_before(lane);
            if joins {
                own = join(own, partner, numbers[free - 1u - before.y]);
            }
            store_cluster(before.x, own);
        }
        if lane == 0u {
            turned = bits_before(TREELET_SIZE);
        }
        workgroupBarrier();
        count = turned.x;
        free -= turned.y;
    }
}
