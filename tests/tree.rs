//! Leaves, pyramid and nodes against their CPU twins, which find the same tree another way; and the judge of trees itself.

use glam::Vec3;
use lucerna::cpu::morton;
use lucerna::cpu::tree::{self, Tree};
use lucerna::cpu::tree_check::{TreeFault, TreeMeasure, measure};
use lucerna::gpu::Runtime;
use lucerna::layout::tree::{BuildParams, LEAF_BIT, LeafBox, NO_ROOT, Node, Triangle, node_count, root};
use lucerna::passes::tree::pyramid::pyramid_boxes;
use lucerna::passes::tree::{PLAN, lbvh};
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::scene::generate::SplitMix;
use lucerna::shader::Library;
use lucerna::stress::tools::forest::{download, spoil};

use crate::morton::{SIZES, cloud, clustered, point, rig_for, triangle};
use crate::support;

/// Builds on the GPU, judges the tree, and compares it with the CPU's.
fn check(rig: &mut Runtime, what: &str, triangles: &[Triangle]) -> TreeMeasure {
    let n = triangles.len() as u32;
    rig.upload("triangles", triangles).unwrap();
    let mut recording = Recording::default();
    spoil(&mut recording, n);
    lbvh::record(&mut recording, n, morton::core_of(triangles));
    rig.play(&recording).unwrap();
    let found = download(rig, n).unwrap();
    assert_same(&found, &tree::build(triangles), what);
    if n <= MOST_PYRAMID {
        check_pyramid(rig, what, &found.leaves);
    }
    measure(&found.leaves, &found.nodes).unwrap_or_else(|fault| panic!("{n} triangles, {what}: {fault}"))
}

/// More boxes are not downloaded: three dispatches of the pyramid are had with fewer.
const MOST_PYRAMID: u32 = 1 << 20;

fn check_pyramid(rig: &Runtime, what: &str, leaves: &[Triangle]) {
    let expected = tree::pyramid(leaves);
    assert_eq!(expected.len(), pyramid_boxes(leaves.len() as u32) as usize);
    let found: Vec<LeafBox> = rig.read_some("boxes", expected.len()).unwrap();
    let wrong = found.iter().zip(&expected).position(|(a, b)| a != b);
    assert_eq!(wrong, None, "first box that differs in the pyramid over {}, {what}", leaves.len());
}

fn assert_same(found: &Tree, expected: &Tree, what: &str) {
    let n = expected.leaves.len();
    let leaf = found.leaves.iter().zip(&expected.leaves).position(|(a, b)| a != b);
    assert_eq!(leaf, None, "first leaf that differs, of {n}, {what}");
    let node = found.nodes.iter().zip(&expected.nodes).position(|(a, b)| a != b);
    if let Some(node) = node {
        panic!("{n} triangles, {what}: node {node} is {:?}, not {:?}", found.nodes[node], expected.nodes[node]);
    }
}

#[test]
fn trees_of_every_size_equal_the_cpu() {
    let mut rig = rig_for(131_073);
    for n in SIZES {
        check(&mut rig, "random", &cloud(n, 0.02, |_, random| point(random)));
        if n < 1000 {
            check(&mut rig, "all equal", &cloud(n, 0.0, |_, _| Vec3::ONE));
        }
    }
}

#[test]
fn clustered_centroids_make_a_deep_tree() {
    let found = check(&mut rig_for(100_000), "clustered", &clustered(100_000));
    // 63 bits of the code, 17 of the index.
    assert!((30..=80).contains(&found.depth), "{}", found.depth);
}

#[test]
fn the_tree_of_karras_is_found() {
    // Figure 3 of the paper.
    let codes = [0b00001, 0b00010, 0b00100, 0b00101, 0b10011, 0b11000, 0b11001, 0b11110];
    let leaves = cloud(8, 0.1, |_, random| point(random));
    let children: Vec<(u32, u32)> = tree::nodes(&codes, &leaves).iter().map(|n| (n.left, n.right)).collect();
    let leaf = |i: u32| LEAF_BIT | i;
    let expected =
        [(3, 4), (leaf(0), leaf(1)), (leaf(2), leaf(3)), (1, 2), (leaf(4), 5), (6, leaf(7)), (leaf(5), leaf(6))];
    assert_eq!(children, expected);
}

#[test]
fn roots_are_named_by_size() {
    assert_eq!([0, 1, 2, 1000].map(root), [NO_ROOT, LEAF_BIT, 0, 0]);
    assert_eq!([0, 1, 2, 1000].map(node_count), [0, 0, 1, 999]);
}

#[test]
fn sorting_by_code_is_what_makes_the_tree_cheap() {
    let triangles = cloud(4096, 0.01, |_, random| point(random));
    let sorted = tree::build(&triangles);
    let sorted = measure(&sorted.leaves, &sorted.nodes).unwrap().sah;
    let unsorted = measure(&triangles, &tree::nodes(&[0; 4096], &triangles)).unwrap().sah;
    // A tree over points in any order has boxes about as large as the scene's near its leaves: thousands of visits.
    assert!(sorted * 10.0 < unsorted, "{sorted} against {unsorted}");
}

#[test]
fn the_cost_of_a_known_tree_is_right() {
    // Two unit squares face to face, a metre apart: half areas 1 and 1 under a root of half area 3.
    let square = |index, x| triangle(index, Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, 1.0), Vec3::new(x, 1.0, 0.0));
    let tree = tree::build(&[square(0, 0.0), square(1, 1.0)]);
    let found = measure(&tree.leaves, &tree.nodes).unwrap();
    assert_eq!(found.depth, 1);
    // Boxes are a millionth larger than what they hold.
    assert!((found.sah - (3.0 + 1.0 + 1.0) / 3.0).abs() < 1e-5, "{}", found.sah);
}

#[test]
fn faults_of_a_tree_are_found() {
    let sound = tree::build(&cloud(100, 0.1, |_, random| point(random)));
    let fault_of = |spoil: &dyn Fn(&mut Tree)| {
        let mut tree = sound.clone();
        spoil(&mut tree);
        measure(&tree.leaves, &tree.nodes).unwrap_err()
    };
    let mut random = SplitMix(1);
    for _ in 0..100 {
        let at = (random.next_u64() % 99) as usize;
        let up = |x: f32| x.next_up();
        assert!(matches!(fault_of(&|t| t.nodes[at].x.x = up(t.nodes[at].x.x)), TreeFault::Box { .. }));
        assert!(matches!(fault_of(&|t| t.nodes[at].z.w = up(t.nodes[at].z.w)), TreeFault::Box { .. }));
        assert!(matches!(fault_of(&|t| t.nodes[at].leaves += 1), TreeFault::LeafCount { .. }));
        assert!(matches!(fault_of(&|t| t.nodes[at].parent ^= 64), TreeFault::Parent { .. }));
        assert!(matches!(fault_of(&|t| t.nodes[at].left = t.nodes[at].right), TreeFault::TwoParents { .. }));
        assert!(matches!(fault_of(&|t| t.nodes[at].right = LEAF_BIT | 100), TreeFault::NoSuchChild { .. }));
        assert!(matches!(fault_of(&|t| t.leaves[at].index = 100), TreeFault::Leaf { .. }));
        assert!(matches!(fault_of(&|t| t.leaves[at] = t.leaves[at + 1]), TreeFault::Leaf { .. }));
    }
    assert!(matches!(fault_of(&|t| t.nodes.truncate(98)), TreeFault::NodeCount { .. }));
}

/// Counts the words in which two buffers differ, on the GPU: a download of a large tree takes longer than a hundred builds.
static DIFFER: Pass = Pass {
    name: "differ",
    module: "passes/differ",
    entry: "differ",
    features: &[],
    bindings: &[
        Binding::read("found", "array<u32>"),
        Binding::read("expected", "array<u32>"),
        Binding::write("differences", "array<atomic<u32>>"),
        Binding::params("BuildParams"),
    ],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

const DIFFER_WGSL: &str = "
import package::gen::BuildParams;

@group(0) @binding(0) var<storage, read> found: array<u32>;
@group(0) @binding(1) var<storage, read> expected: array<u32>;
@group(0) @binding(2) var<storage, read_write> differences: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read> params: BuildParams;

@compute @workgroup_size(256)
fn differ(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let word = (workgroup.x + workgroup.y * workgroups.x) * 256u + lane;
    if (word < params.count && found[word] != expected[word]) {
        atomicAdd(&differences[0], 1u);
    }
}
";

/// Words in which `nodes` and `leaves` differ from `expected_nodes` and `expected_leaves` after a new build.
fn differences_of_a_build(rig: &mut Runtime, n: u32, core: f32) -> u32 {
    let mut recording = Recording::default();
    spoil(&mut recording, n);
    lbvh::record(&mut recording, n, core);
    lucerna::passes::clear(&mut recording, "differences", 0, 1);
    let buffers = [
        ("nodes", "expected_nodes", node_count(n) * size_of::<Node>() as u32 / 4),
        ("leaves", "expected_leaves", n * size_of::<Triangle>() as u32 / 4),
    ];
    for (found, expected, count) in buffers {
        let call = recording.run(&DIFFER, Size::Items(u64::from(count))).params(&BuildParams { count, core: 0.0 });
        call.bind("found", found).bind("expected", expected);
    }
    rig.play(&recording).unwrap();
    rig.read_some::<u32>("differences", 1).unwrap()[0]
}

/// The first build is judged in full; the others must equal it in every word.
fn build_again_and_again(what: &str, triangles: &[Triangle], builds: u32) {
    let (n, core) = (triangles.len() as u32, morton::core_of(triangles));
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("passes/differ", DIFFER_WGSL));
    for (name, bytes) in lbvh::buffers(n) {
        rig.reserve(name, bytes).unwrap();
    }
    rig.reserve("differences", 4).unwrap();
    let found = check(&mut rig, what, triangles);
    let tree = download(&rig, n).unwrap();
    rig.upload("expected_nodes", &tree.nodes).unwrap();
    rig.upload("expected_leaves", &tree.leaves).unwrap();
    for round in 0..builds {
        let differences = differences_of_a_build(&mut rig, n, core);
        assert_eq!(differences, 0, "words that differ in build {round} of {n} triangles, {what}");
    }
    eprintln!("{builds} builds of {n} triangles, {what}: depth {}, cost {:.3}", found.depth, found.sah);

    // The comparison itself sees a change of one word.
    let mut spoilt = tree.leaves[n as usize / 2];
    spoilt.material ^= 1;
    rig.write("expected_leaves", u64::from(n / 2), &[spoilt]).unwrap();
    assert_eq!(differences_of_a_build(&mut rig, n, core), 1);
}

#[test]
fn every_build_gives_the_same_tree() {
    build_again_and_again("random", &cloud(20_000, 0.01, |_, random| point(random)), 20);
    build_again_and_again("clustered", &clustered(20_000), 20);
}

#[test]
fn every_build_of_a_large_tree_gives_the_same() {
    if !support::stress() {
        return;
    }
    for n in [1 << 20, 1 << 23] {
        build_again_and_again("random", &cloud(n, 0.001, |_, random| point(random)), 100);
        build_again_and_again("clustered", &clustered(n), 100);
        build_again_and_again("all equal", &cloud(n, 0.0, |_, _| Vec3::ONE), 100);
    }
}

#[test]
fn the_plan_is_of_one_tree() {
    let triangles = support::trees::records(&support::trees::sphere(2));
    let count = triangles.len() as u32;
    let mut buffers = std::collections::BTreeMap::new();
    (PLAN.twin)(&triangles, &mut |name, bytes| {
        buffers.insert(name, bytes.to_vec());
    });
    assert_eq!(buffers.keys().copied().collect::<Vec<_>>(), ["leaves", "nodes"]);
    for (name, bytes) in &buffers {
        assert_eq!(bytes.len() as u64, PLAN.bytes(name, count), "{name}");
    }
    let (leaves, mut nodes) = (&buffers["leaves"], buffers["nodes"].clone());
    let tree = tree::build(&triangles);
    assert_eq!((PLAN.cost)(leaves, &nodes).unwrap().sah, measure(&tree.leaves, &tree.nodes).unwrap().sah);
    let mut rig = Runtime::new(support::gpu(), Library::shipped());
    for (name, bytes) in (PLAN.buffers)(count) {
        rig.reserve(name, bytes).unwrap();
    }
    rig.upload("triangles", &triangles).unwrap();
    let mut recording = Recording::default();
    (PLAN.record)(&mut recording, &triangles);
    rig.play(&recording).unwrap();
    for (name, bytes) in &buffers {
        assert!(rig.read_some::<u8>(name, bytes.len()).unwrap() == *bytes, "{name}");
    }
    nodes[48] ^= 1;
    assert!((PLAN.cost)(leaves, &nodes).is_err());
}
