//! `bench sort`: random 63-bit keys, no digit skipped, the result checked.

use std::sync::Arc;

use super::{BenchError, BenchReport, Case, measure, measure_unstamped};
use crate::cpu::sort::random_key;
use crate::gpu::{Gpu, Runtime};
use crate::layout::sort::{SORT_DIGITS, SORT_IN_FRONT, SortPlan};
use crate::passes::{Recording, sort};
use crate::shader::Library;

/// Sorts in one submission where timestamps are left out, so that the cost of submitting is small beside them.
const REPEATS: u32 = 8;

/// Sorts each number of pairs `runs` times, and prints what that took.
pub fn run(gpu: Arc<Gpu>, n: &[u32], runs: u32, json: bool) -> Result<(), BenchError> {
    let mut cases = Vec::new();
    for &count in n {
        cases.push(case(&gpu, count, runs)?);
    }
    BenchReport { bench: "sort", adapter: gpu.name(), runs, cases }.print(json)
}

fn case(gpu: &Arc<Gpu>, count: u32, runs: u32) -> Result<Case, BenchError> {
    let mut rig = Runtime::new(gpu.clone(), Library::shipped());
    rig.set_features(gpu.shader_features());
    for (name, bytes) in sort::buffers(count) {
        rig.reserve(name, bytes)?;
    }
    let (mut fill, mut whole) = (Recording::default(), Recording::default());
    sort::record_fill(&mut fill, count);
    sort::record(&mut whole, count);

    rig.play(&fill)?;
    rig.play(&whole)?;
    let digits_run = check(&rig, count)?;
    let mut rows = measure(&mut rig, &fill, &whole, runs)?;
    check(&rig, count)?;
    rows.push(measure_unstamped(&mut rig, &fill, &whole, runs, REPEATS)?);
    check(&rig, count)?;
    let name = format!("{count} pairs");
    Ok(Case::new(name, u64::from(count), "pairs/s", rows).note("digits sorted", f64::from(digits_run)))
}

/// Checks that the result is the sorted input, and stable. Returns how many digits were not skipped.
fn check(rig: &Runtime, count: u32) -> Result<u32, BenchError> {
    let wrong = |what: String| Err(BenchError::Wrong(what));
    let plan: SortPlan = rig.read_some("sort_plan", 1)?[0];
    // With this many random keys, some differ in every digit.
    if count >= 1 << 16 && plan.digits_run != SORT_DIGITS {
        return wrong(format!("only {} digits were sorted", plan.digits_run));
    }
    let front = plan.result == SORT_IN_FRONT;
    let (keys, payload) = if front { ("keys", "payload") } else { ("keys_back", "payload_back") };
    let keys: Vec<u64> = rig.read_some(keys, count as usize)?;
    let payload: Vec<u32> = rig.read_some(payload, count as usize)?;
    // Each key belongs to its payload and the pairs strictly ascend, so they are distinct: a permutation of the input.
    for (i, (key, index)) in keys.iter().zip(&payload).enumerate() {
        if *index >= count || *key != random_key(*index) {
            return wrong(format!("pair {i} of {count} is ({key:#x}, {index}), which was not in the input"));
        }
        if i > 0 && (keys[i - 1], payload[i - 1]) >= (*key, *index) {
            return wrong(format!("pairs {} and {i} of {count} are out of order", i - 1));
        }
    }
    Ok(plan.digits_run)
}
