//! Trees that no pass has built.

use glam::Vec4;

use crate::cpu::bounds::Bounds;
use crate::cpu::tree::Tree;
use crate::layout::tree::{LEAF_BIT, NO_ROOT, Node, Triangle};
use crate::scene::generate::{Corners, SplitMix};

/// How a run of leaves is cut in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// At the median of the centroids along the widest axis.
    Median,
    /// Leaves shuffled, and cut anywhere: boxes overlap, and the order of leaves means nothing.
    Random(u64),
    /// After the first two leaves: half as deep as there are leaves.
    Chain,
}

/// Corners as records, indexed as listed.
pub fn records(triangles: &[Corners]) -> Vec<Triangle> {
    let record =
        |(i, [a, b, c]): (usize, &Corners)| Triangle { a: *a, b: *b, c: *c, index: i as u32, ..Triangle::default() };
    triangles.iter().enumerate().map(record).collect()
}

/// A range of leaves that waits for its place in the tree: its parent, and whether it is the left child.
struct Waiting {
    first: usize,
    last: usize,
    parent: u32,
    is_left: bool,
}

/// A valid tree over all triangles.
pub fn build(triangles: &[Corners], cut: Cut) -> Tree {
    let mut leaves = records(triangles);
    let mut random = SplitMix(if let Cut::Random(seed) = cut { seed } else { 0 });
    if let Cut::Random(_) = cut {
        for i in (1..leaves.len()).rev() {
            leaves.swap(i, (random.next_u64() % (i as u64 + 1)) as usize);
        }
    }
    let mut nodes: Vec<Node> = Vec::new();
    let mut waiting = vec![Waiting { first: 0, last: leaves.len(), parent: NO_ROOT, is_left: false }];
    while let Some(Waiting { first, last, parent, is_left }) = waiting.pop() {
        let word = if last - first < 2 { LEAF_BIT | first as u32 } else { nodes.len() as u32 };
        if parent != NO_ROOT {
            let node = &mut nodes[parent as usize];
            *(if is_left { &mut node.left } else { &mut node.right }) = word;
        }
        if last - first < 2 {
            continue;
        }
        let split = first + choose(&mut leaves[first..last], cut, &mut random);
        nodes.push(Node { leaves: (last - first) as u32, parent, ..Node::default() });
        waiting.push(Waiting { first: split, last, parent: word, is_left: false });
        waiting.push(Waiting { first, last: split, parent: word, is_left: true });
    }
    let mut tree = Tree { leaves, nodes };
    fill_boxes(&mut tree);
    tree
}

/// How many leaves go left, at least one and not all.
fn choose(leaves: &mut [Triangle], cut: Cut, random: &mut SplitMix) -> usize {
    match cut {
        Cut::Chain => 2.min(leaves.len() - 1),
        Cut::Random(_) => 1 + (random.next_u64() % (leaves.len() as u64 - 1)) as usize,
        Cut::Median => {
            let centre = |t: &Triangle| t.a + t.b + t.c;
            let boxes = leaves.iter().map(|t| Bounds { low: centre(t), high: centre(t) });
            let all = boxes.fold(Bounds::EMPTY, Bounds::joined);
            let axis = (all.high - all.low).max_position();
            leaves.sort_by(|p, q| centre(p)[axis].total_cmp(&centre(q)[axis]).then(p.index.cmp(&q.index)));
            leaves.len() / 2
        }
    }
}

/// Children come after their parents, so that the last node is done first.
fn fill_boxes(tree: &mut Tree) {
    let mut boxes = vec![Bounds::EMPTY; tree.nodes.len()];
    for i in (0..tree.nodes.len()).rev() {
        let of = |child: u32| match child & LEAF_BIT {
            0 => boxes[child as usize],
            _ => Bounds::padded(&tree.leaves[(child & !LEAF_BIT) as usize]),
        };
        let (left, right) = (of(tree.nodes[i].left), of(tree.nodes[i].right));
        let along = |axis: usize| Vec4::new(left.low[axis], left.high[axis], right.low[axis], right.high[axis]);
        (tree.nodes[i].x, tree.nodes[i].y, tree.nodes[i].z) = (along(0), along(1), along(2));
        boxes[i] = left.joined(right);
    }
}
