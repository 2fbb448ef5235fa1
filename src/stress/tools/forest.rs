//! Trees that the passes build on the device, judged.

use crate::cpu::morton;
use crate::cpu::tree::{self, Tree};
use crate::cpu::tree_check::{TreeMeasure, measure};
use crate::cpu::treelets::treelets;
use crate::gpu::{GpuError, Runtime};
use crate::layout::tree::{Node, Triangle, node_count};
use crate::passes::tree::lbvh;
use crate::passes::{Recording, clear};
use crate::stress::lab::Lab;
use crate::stress::measured::StressError;

/// A device with buffers for so many triangles.
pub fn rig_for(lab: &Lab, n: u32) -> Result<Runtime, GpuError> {
    let mut rig = lab.rig();
    for (name, bytes) in lbvh::buffers(n) {
        rig.reserve(name, bytes)?;
    }
    Ok(rig)
}

/// Junk before a build: what no pass writes is seen.
pub fn spoil(recording: &mut Recording, n: u32) {
    let words = |size: usize| n * size as u32 / 4;
    clear(recording, "nodes", 0x7fff_fffe, words(size_of::<Node>()));
    clear(recording, "leaves", 0x7fff_fffe, words(size_of::<Triangle>()));
}

pub fn download(rig: &Runtime, n: u32) -> Result<Tree, GpuError> {
    Ok(Tree { leaves: rig.read_some("leaves", n as usize)?, nodes: rig.read_some("nodes", node_count(n) as usize)? })
}

/// The tree that the passes build over triangles.
pub fn built(rig: &mut Runtime, triangles: &[Triangle]) -> Result<Tree, GpuError> {
    let n = triangles.len() as u32;
    rig.upload("triangles", triangles)?;
    let mut recording = Recording::default();
    spoil(&mut recording, n);
    lbvh::record(&mut recording, n, morton::core_of(triangles));
    rig.play(&recording)?;
    download(rig, n)
}

/// The tree over codes that are given, whatever the triangles; and what the twin makes of them.
pub fn built_by_codes(rig: &mut Runtime, triangles: &[Triangle], codes: &[u64]) -> Result<[Tree; 2], GpuError> {
    let n = codes.len() as u32;
    let mut order: Vec<u32> = (0..n).collect();
    rig.upload("triangles", triangles)?;
    rig.upload("keys", codes)?;
    rig.upload("payload", &order)?;
    let mut recording = Recording::default();
    spoil(&mut recording, n);
    lbvh::record_tree(&mut recording, n);
    rig.play(&recording)?;
    order.sort_by_key(|&i| codes[i as usize]);
    let sorted: Vec<u64> = order.iter().map(|&i| codes[i as usize]).collect();
    let leaves = tree::leaves(triangles, &order);
    let mut twin = Tree { nodes: tree::nodes(&sorted, &leaves), leaves };
    treelets(&mut twin.nodes);
    Ok([download(rig, n)?, twin])
}

/// Leaves and nodes that are others.
pub fn others(found: &Tree, right: &Tree) -> u64 {
    let leaves = found.leaves.iter().zip(&right.leaves).filter(|(a, b)| a != b).count();
    let nodes = found.nodes.iter().zip(&right.nodes).filter(|(a, b)| a != b).count();
    (leaves + nodes + found.leaves.len().abs_diff(right.leaves.len())) as u64
}

/// What a tree is like: every leaf once, every parent around its children.
pub fn judged(tree: &Tree, what: &str) -> Result<TreeMeasure, StressError> {
    measure(&tree.leaves, &tree.nodes).map_err(|fault| StressError::Broken(format!("{what}: {fault}")))
}
