//! Films of independent seeds, each looked at as it grows.

use super::configuration::Configuration;
use super::record::{ConfigurationRecord, Run, Snapshot};
use super::reference::Reference;
use crate::app::bench::BenchError;
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::components::Render;
use crate::stats::metrics::relative_mse;

/// Samples a pixel, at most, of the film before the first that counts: compiles, and lets the clocks rise.
const WARM_UP_SPP: u32 = 16;

/// Seed of the film that does not count: of no other film.
const WARM_UP_SEED: u32 = u32::MAX;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Films of each configuration, of the seeds 0, 1, 2, ..
    pub seeds: u32,
    /// Samples a pixel of each film, at least 2.
    pub spp: u32,
}

impl Extent {
    /// Numbers of samples at which films are looked at: 1, 4, 16, .. and the last.
    pub fn snapshots(&self) -> Vec<u32> {
        let powers = (0..16).map(|power| 1 << (2 * power)).filter(|spp| *spp < self.spp);
        powers.chain([self.spp]).collect()
    }

    /// Samples a pixel of all films of a configuration.
    pub fn samples(&self) -> u64 {
        u64::from(self.seeds) * u64::from(self.spp) + u64::from(self.warm_up())
    }

    fn warm_up(&self) -> u32 {
        self.spp.min(WARM_UP_SPP)
    }
}

/// Measures one configuration. After a signal, the films that were finished before it; none if there is none.
///
/// Time is that of the engine's batches alone: not that of compiling, of reading films back, of comparing them.
pub fn measure(
    tracer: &mut Tracer,
    configuration: Configuration,
    extent: Extent,
    reference: &Reference,
    monitor: &mut Monitor,
) -> Result<Option<ConfigurationRecord>, BenchError> {
    let render = configuration.of(&tracer.render);
    tracer.set(Render { seed: WARM_UP_SEED, spp: extent.warm_up(), ..render });
    let mut whole = tracer.finish(monitor)?;
    let (mut runs, mut bad_samples) = (Vec::new(), 0);
    let snapshots = extent.snapshots();
    for seed in 0..extent.seeds {
        let run = if whole { film(tracer, Render { seed, ..render }, &snapshots, reference, monitor)? } else { None };
        match run {
            Some((run, bad)) => {
                runs.push(run);
                bad_samples += bad;
            }
            None => whole = false,
        }
    }
    Ok((!runs.is_empty()).then(|| ConfigurationRecord::of(configuration.to_string(), bad_samples, runs)))
}

/// One film, looked at after so many samples a pixel, and its bad samples; none if a signal came before its end.
pub fn film(
    tracer: &mut Tracer,
    render: Render,
    numbers: &[u32],
    reference: &Reference,
    monitor: &mut Monitor,
) -> Result<Option<(Run, u64)>, BenchError> {
    let before = tracer.report()?.seconds_trace;
    let mut snapshots = Vec::new();
    let mut bad_samples = 0;
    for &spp in numbers {
        tracer.set(Render { spp, ..render });
        if !tracer.finish(monitor)? {
            return Ok(None);
        }
        let report = tracer.report()?;
        let film = tracer.film()?;
        bad_samples = report.bad_samples;
        snapshots.push(Snapshot {
            spp,
            seconds: report.seconds_trace - before,
            rays: report.rays,
            relmse: relative_mse(&film.rgb, &reference.rgb) - reference.record.relmse,
            claimed: (spp > 1).then_some(film.error.relmse),
        });
    }
    Ok(Some((Run { seed: render.seed, snapshots }, bad_samples)))
}
