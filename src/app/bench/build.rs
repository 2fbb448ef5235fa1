//! `bench build`: many small spheres, from triangles in scene order to the tree that is traversed, which is then judged.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{BenchError, BenchReport, Case, measure, measure_unstamped, spheres};
use crate::cpu::tree_check::TreeMeasure;
use crate::gpu::{Gpu, Runtime};
use crate::layout::tree::Triangle;
use crate::passes::Recording;
use crate::passes::tree::PLAN;
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
    rig.set_features(gpu.shader_features());
    for (name, bytes) in (PLAN.buffers)(count) {
        rig.reserve(name, bytes)?;
    }
    rig.upload("triangles", &triangles)?;
    let mut whole = Recording::default();
    (PLAN.record)(&mut whole, &triangles);

    let nothing = Recording::default();
    let mut rows = measure(&mut rig, &nothing, &whole, runs)?;
    rows.push(measure_unstamped(&mut rig, &nothing, &whole, runs, REPEATS)?);
    let bytes = |buffer| PLAN.bytes(buffer, count) as usize;
    let found = judge(&rig.read_some("leaves", bytes("leaves"))?, &rig.read_some("nodes", bytes("nodes"))?)?;
    let twin = judge_twin(&rig, &triangles)?;
    Ok(Case::new(format!("{count} triangles"), u64::from(count), "triangles/s", rows)
        .note("depth", f64::from(found.depth))
        .note("SAH cost", found.sah)
        .note("SAH cost of the CPU twin", twin.sah))
}

/// Judges the tree that the CPU builds, and compares it with what is in the buffers.
fn judge_twin(rig: &Runtime, triangles: &[Triangle]) -> Result<TreeMeasure, BenchError> {
    let mut twin = BTreeMap::new();
    (PLAN.twin)(triangles, &mut |buffer, bytes| {
        twin.insert(buffer, bytes.to_vec());
    });
    for (buffer, bytes) in &twin {
        if rig.read_some::<u8>(buffer, bytes.len())? != *bytes {
            return Err(BenchError::Wrong(format!("`{buffer}` is not what the CPU makes")));
        }
    }
    judge(&twin["leaves"], &twin["nodes"])
}

/// Judges a tree by the contents of its buffers.
fn judge(leaves: &[u8], nodes: &[u8]) -> Result<TreeMeasure, BenchError> {
    (PLAN.cost)(leaves, nodes).map_err(|fault| BenchError::Wrong(fault.to_string()))
}
