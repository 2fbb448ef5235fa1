//! The film by itself: samples in, sums out.

use crate::gpu::{GpuError, Runtime};
use crate::layout::film::{FilmCounters, FilmPixel};
use crate::layout::trace::{RadianceSample, TraceParams};
use crate::passes::{Recording, film};

fn pixels(params: &TraceParams) -> u32 {
    params.window_width * params.window_height
}

/// An empty film for the window.
pub fn reset(rig: &mut Runtime, params: &TraceParams) -> Result<(), GpuError> {
    for (name, bytes) in film::buffers(u64::from(pixels(params))) {
        rig.reserve(name, bytes)?;
    }
    let mut recording = Recording::default();
    film::record_reset(&mut recording, pixels(params));
    rig.play(&recording)
}

/// Adds samples, as many layers as there are.
pub fn add(
    rig: &mut Runtime,
    params: &TraceParams,
    first_sample: u32,
    samples: &[RadianceSample],
    exponent: i32,
) -> Result<(), GpuError> {
    rig.upload("radiance", samples)?;
    let params = TraceParams { first_sample, layers: samples.len() as u32 / pixels(params), ..*params };
    let mut recording = Recording::default();
    film::record_accumulate(&mut recording, &film::accumulate_params(&params, exponent, &params));
    rig.play(&recording)
}

pub fn read(rig: &Runtime, params: &TraceParams) -> Result<(Vec<FilmPixel>, FilmCounters), GpuError> {
    Ok((rig.read_some("film", pixels(params) as usize)?, rig.read_some("counters", 1)?[0]))
}
