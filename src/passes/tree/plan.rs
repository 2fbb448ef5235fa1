//! What everything outside this folder knows of a builder of trees.

use crate::cpu::tree_check::{TreeFault, TreeMeasure};
use crate::layout::tree::Triangle;
use crate::passes::Recording;

/// Receives the contents of a buffer, by its name.
pub type PutBuffer<'a> = dyn FnMut(&'static str, &[u8]) + 'a;

/// A builder of trees: from `triangles`, in scene order, to `leaves` and `nodes`.
#[derive(Debug)]
pub struct Plan {
    /// Triangles that it can build over, at most.
    pub most_triangles: u32,
    /// The buffers that building over so many triangles needs beside `triangles` itself, with their bytes. `leaves` and `nodes` are
    /// among them, and hold no more than the tree.
    pub buffers: fn(count: u32) -> Vec<(&'static str, u64)>,
    /// Records the whole way over these triangles, at most `most_triangles`.
    pub record: fn(&mut Recording, &[Triangle]),
    /// The word that names the root of a tree over so many triangles, as traversal expects it.
    pub root: fn(count: u32) -> u32,
    /// The same tree, built on the CPU: hands over the contents of each buffer that traversal reads.
    pub twin: fn(&[Triangle], &mut PutBuffer<'_>),
    /// Checks the contents of `leaves` and `nodes`, and measures what traversing them costs.
    pub cost: fn(leaves: &[u8], nodes: &[u8]) -> Result<TreeMeasure, TreeFault>,
}

impl Plan {
    /// Bytes of one of the plan's buffers; 0 of one that it does not need.
    pub fn bytes(&self, buffer: &str, count: u32) -> u64 {
        (self.buffers)(count).into_iter().find(|(name, _)| *name == buffer).map_or(0, |(_, bytes)| bytes)
    }
}
