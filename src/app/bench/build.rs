//! `bench build`: many small spheres, from triangles in scene order to the tree that is traversed, which is then judged.

use std::sync::Arc;

use super::{BenchError, BenchReport, Case, measure, measure_unstamped, spheres};
use crate::cpu::morton;
use crate::cpu::tree::{self, Tree};
use crate::cpu::tree_check::{self, TreeMeasure};
use crate::gpu::{Gpu, Runtime};
use crate::layout::tree::node_count;
use crate::passes::{Recording, build};
use crate::shader::Library;

/// Builds in one submission where timestamps are left out, so that the cost of submitting is small beside them.
const REPEATS: u32 = 8;

/// Which spheres: any number will do.
const SEED: u64 = 1;

/// Builds over each number of triangles `runs` times, and prints what that took.
pub fn run(gpu: Arc<Gpu>, triangles: &[u32], runs: u32, json: bool) -> Result<(), BenchError> {
    let mut cases = Vec::new();
    for &count in triangles {
        cases.push(case(&gpu, count, runs)?);
    }
    BenchReport { bench: "build", adapter: gpu.name(), runs, cases }.print(json)
}

fn case(gpu: &Arc<Gpu>, count: u32, runs: u32) -> Result<Case, BenchError> {
    let triangles = spheres(count, SEED);
    let count = triangles.len() as u32;
    let mut rig = Runtime::new(gpu.clone(), Library::shipped());
    for (name, bytes) in build::buffers(count) {
        rig.reserve(name, bytes)?;
    }
    rig.upload("triangles", &triangles)?;
    let mut whole = Recording::default();
    build::record(&mut whole, count, morton::core_of(&triangles));

    let nothing = Recording::default();
    let mut rows = measure(&mut rig, &nothing, &whole, runs)?;
    rows.push(measure_unstamped(&mut rig, &nothing, &whole, runs, REPEATS)?);
    let found = Tree {
        leaves: rig.read_some("leaves", count as usize)?,
        nodes: rig.read_some("nodes", node_count(count) as usize)?,
    };
    let (found, twin) = (judge(&found)?, judge(&tree::build(&triangles))?);
    Ok(Case::new(format!("{count} triangles"), u64::from(count), "triangles/s", rows)
        .note("depth", f64::from(found.depth))
        .note("SAH cost", found.sah)
        .note("SAH cost of the CPU twin", twin.sah))
}

fn judge(tree: &Tree) -> Result<TreeMeasure, BenchError> {
    tree_check::measure(&tree.leaves, &tree.nodes).map_err(|fault| BenchError::Wrong(fault.to_string()))
}
