//! Sums of what paths find in blocks of pixels, by the kernels and by their twins, and whether two estimators agree.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec3, UVec2};

use super::batch::{trace_batch, trace_reused_batch};
use crate::cpu::path::Traced;
use crate::gpu::{Gpu, Runtime};
use crate::layout::trace::{RadianceSample, SAMPLE_BAD, TILE_BLOCK, TraceParams};
use crate::shader::Library;
use crate::stats::agreement::{Agreement, BATCHES, MOST_NOISE, Pairs};
use crate::stress::measured::{Measured, StressError};
use crate::stress::scenes::room::Room;

/// Pixels of a side of a block whose mean is compared.
const BLOCK: u32 = 8;

/// Radiance and rays, block by block.
pub type Sums = Vec<(DVec3, u64)>;

/// What gives the sums of batch `i`.
pub trait Estimator: FnMut(usize) -> Result<Sums, StressError> {}
impl<F: FnMut(usize) -> Result<Sums, StressError>> Estimator for F {}

/// The samples of a batch: layer by layer, pixel by pixel.
pub fn samples(rig: &mut Runtime, params: &TraceParams) -> Result<Vec<RadianceSample>, StressError> {
    trace_batch(rig, params)?;
    read(rig, params)
}

/// The same of a batch of whole blocks, whose paths are reused.
pub fn reused_samples(rig: &mut Runtime, params: &TraceParams) -> Result<Vec<RadianceSample>, StressError> {
    trace_reused_batch(rig, params, false)?;
    read(rig, params)
}

fn read(rig: &Runtime, params: &TraceParams) -> Result<Vec<RadianceSample>, StressError> {
    let count = params.window_width * params.window_height * params.layers;
    Ok(rig.read_some("radiance", count as usize)?)
}

/// Sums over the blocks of a batch.
pub fn block_sums(params: &TraceParams, of: impl Fn(u32, UVec2) -> (DVec3, u32)) -> Sums {
    let columns = params.window_width.div_ceil(BLOCK);
    let mut sums = vec![(DVec3::ZERO, 0); (columns * params.window_height.div_ceil(BLOCK)) as usize];
    for layer in 0..params.layers {
        for y in 0..params.window_height {
            for x in 0..params.window_width {
                let (radiance, rays) = of(layer, UVec2::new(x, y));
                let sum = &mut sums[(y / BLOCK * columns + x / BLOCK) as usize];
                *sum = (sum.0 + radiance, sum.1 + u64::from(rays));
            }
        }
    }
    sums
}

/// Of samples, none of which may be bad.
fn sums_of(params: &TraceParams, got: &[RadianceSample]) -> Result<Sums, StressError> {
    if let Some(at) = got.iter().position(|sample| sample.info & SAMPLE_BAD != 0) {
        return Err(StressError::Broken(format!("a bad sample, number {at}: {:?}", got[at])));
    }
    Ok(block_sums(params, |layer, p| {
        let sample = got[((layer * params.window_height + p.y) * params.window_width + p.x) as usize];
        (sample.rgb.as_dvec3(), sample.info)
    }))
}

/// The kernel's sums of a batch.
pub fn gpu_sums(rig: &mut Runtime, params: &TraceParams) -> Result<Sums, StressError> {
    let got = samples(rig, params)?;
    sums_of(params, &got)
}

/// Batch `i` of equally large ones.
pub fn batch(params: &TraceParams, i: usize) -> TraceParams {
    TraceParams { first_sample: i as u32 * params.layers, ..*params }
}

/// The kernel's estimates in a room.
pub fn kernel(
    gpu: &Arc<Gpu>,
    library: Library,
    room: &Room,
    params: &TraceParams,
) -> Result<impl Estimator + use<>, StressError> {
    let (mut rig, params) = (Runtime::new(gpu.clone(), library), *params);
    room.load(&mut rig)?;
    Ok(move |i| gpu_sums(&mut rig, &batch(&params, i)))
}

/// The same of both kernels, where paths are reused.
pub fn reusing(
    gpu: &Arc<Gpu>,
    library: Library,
    room: &Room,
    params: &TraceParams,
) -> Result<impl Estimator + use<>, StressError> {
    let (mut rig, params) = (Runtime::new(gpu.clone(), library), *params);
    Room { reuse: true, ..room.clone() }.load(&mut rig)?;
    Ok(move |i| {
        let params = batch(&params, i);
        let got = reused_samples(&mut rig, &params)?;
        sums_of(&params, &got)
    })
}

/// The f64 twin's sums of batch `i`.
pub fn twin_sums<'a>(room: &'a Room, params: &TraceParams) -> impl Fn(usize) -> Sums + use<'a> {
    let (twin, params) = (room.twin(), *params);
    move |i| {
        let params = batch(&params, i);
        block_sums(&params, |layer, p| {
            let traced = twin.sample(&params, p, params.first_sample + layer);
            (traced.radiance, traced.rays)
        })
    }
}

/// The same where paths are reused, tile by tile.
pub fn twin_reusing<'a>(room: &'a Room, params: &TraceParams) -> impl Fn(usize) -> Sums + use<'a> {
    let (twin, params) = (room.twin(), *params);
    move |i| {
        let params = batch(&params, i);
        let mut traced: HashMap<(u32, UVec2), Traced> = HashMap::new();
        for layer in 0..params.layers {
            for first in first_pixels(&params) {
                let block = twin.sample_block(&params, first, params.first_sample + layer);
                traced.extend(block.into_iter().map(|(pixel, sample)| ((layer, pixel), sample)));
            }
        }
        block_sums(&params, |layer, pixel| (traced[&(layer, pixel)].radiance, traced[&(layer, pixel)].rays))
    }
}

/// The first pixel of every block of a film.
fn first_pixels(params: &TraceParams) -> Vec<UVec2> {
    let of = |length: u32| (0..length).step_by(TILE_BLOCK as usize);
    of(params.film_height).flat_map(|y| of(params.film_width).map(move |x| UVec2::new(x, y))).collect()
}

/// How far two estimators agree, in the block and channel where they do least; the second is right.
pub fn compare(mut ours: impl Estimator, mut right: impl Estimator) -> Result<Agreement, StressError> {
    let mut batches = Vec::with_capacity(BATCHES);
    for i in 0..BATCHES {
        batches.push((ours(i)?, right(i)?));
    }
    let mut worst = Agreement::PERFECT;
    for block in 0..batches[0].0.len() {
        for c in 0..3 {
            let pairs = Pairs {
                differences: std::array::from_fn(|i| batches[i].0[block].0[c] - batches[i].1[block].0[c]),
                mean: batches.iter().map(|(_, right)| right[block].0[c]).sum::<f64>() / BATCHES as f64,
            };
            worst = worst.worst(pairs.agreement());
        }
    }
    Ok(worst)
}

/// How far the kernel agrees with its f64 twin, path by path.
pub fn against_twin(
    gpu: &Arc<Gpu>,
    library: Library,
    room: &Room,
    params: &TraceParams,
) -> Result<Agreement, StressError> {
    let twin = twin_sums(room, params);
    compare(kernel(gpu, library, room, params)?, |i| Ok(twin(i)))
}

/// Paths of a comparison by such parameters.
pub fn paths_of(params: &TraceParams) -> u64 {
    u64::from(params.window_width * params.window_height * params.layers) * BATCHES as u64
}

/// An agreement as what a row measures, in standard errors: too much noise proves nothing.
pub fn as_measured(agreement: Agreement, samples: u64, case: &str) -> Measured {
    let Agreement { errors, noise, .. } = agreement;
    let doubt = (noise > MOST_NOISE)
        .then(|| format!("{case}: a standard error of {:.2} % of the mean proves nothing", 100.0 * noise));
    let note = format!("{case}: standard error {:.3} %", 100.0 * noise);
    Measured { value: errors, samples, note, doubt }
}
