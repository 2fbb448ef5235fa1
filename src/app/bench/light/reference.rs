//! The picture that errors are taken against: made once, and kept.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use bevy_ecs::prelude::World;

use super::configuration::Configuration;
use super::read::read_json;
use super::record::ReferenceRecord;
use crate::app::bench::BenchError;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::components::{Adaptive, Film, Integrator, Render, Reuse, Sampler, TextureFilter};
use crate::image::{Output, Picture, PictureFile, file};
use crate::oracle::{self, Oracle};
use crate::scene::{self, SceneDescription};
use crate::stats::metrics::DARK;

/// The estimator that is trusted most: independent samples, no path ended early, textures looked up at points.
pub const TRUSTED: Configuration = Configuration {
    integrator: Integrator::Path,
    sampler: Sampler::Pcg,
    roulette: false,
    reuse: Reuse::Off,
    adaptive: Adaptive::Off,
    texture_filter: Some(TextureFilter::Exact),
};

/// Of no film that is measured: those have small seeds.
const SEED: u32 = 0x9e37_79b9;

/// A reference.
pub struct Reference {
    /// Linear Rec.709 radiance of the film's window, row by row from the top.
    pub rgb: Vec<[f32; 3]>,
    pub record: ReferenceRecord,
}

/// Where a reference of some key is kept.
#[derive(Clone, Debug)]
pub struct Shelf {
    picture: PathBuf,
    record: PathBuf,
    /// Of the scene, and of the shaders.
    key: String,
}

impl Shelf {
    pub fn new(folder: &Path, scene: &str, key: String) -> Self {
        let file = |extension: &str| folder.join("reference").join(format!("{scene}-{key}.{extension}"));
        Self { picture: file("exr"), record: file("json"), key }
    }

    /// The reference, if it is there, whole, of the scene's size, and of enough samples.
    pub fn find(&self, film: &Film, spp: u32) -> Option<Reference> {
        let record: ReferenceRecord = read_json(&self.record).ok()?;
        let size = film.window().size();
        let picture = PictureFile::open(&self.picture).ok()?;
        let fits = picture.size == size && record.key == self.key && record.spp >= spp;
        Some(Reference { rgb: picture.read_all().ok().filter(|_| fits)?, record })
    }

    /// Traces the reference, and keeps it. None if a signal came before it was done.
    pub fn make(
        &self,
        tracer: &mut Tracer,
        film: &Film,
        spp: u32,
        monitor: &mut Monitor,
    ) -> Result<Option<Reference>, BenchError> {
        let seconds = tracer.report()?.seconds_trace;
        tracer.set(Render { seed: SEED, spp, ..TRUSTED.of(&tracer.render) });
        if !tracer.finish(monitor)? {
            return Ok(None);
        }
        let (image, report) = (tracer.film()?, tracer.report()?);
        let record = ReferenceRecord {
            key: self.key.clone(),
            by: TRUSTED.to_string(),
            seed: SEED,
            spp,
            relmse: image.error.relmse,
            adapter: report.adapter,
            seconds: report.seconds_trace - seconds,
        };
        let reference = Reference { rgb: image.rgb, record };
        self.keep(&reference, film)?;
        Ok(Some(reference))
    }

    /// Traces the reference in f64 on the processor, and keeps it.
    pub fn make_on_processor(
        &self,
        description: &SceneDescription,
        spp: u32,
        quiet: bool,
    ) -> Result<Reference, BenchError> {
        let mut world = World::new();
        scene::apply(&mut world, description);
        let oracle = Oracle::new(&mut world)?;
        let size = description.film.window().size();
        let row = u64::from(size.x) * u64::from(spp);
        let goal = Goal { samples: Some(row * u64::from(size.y)), seconds: None, error: None };
        let meter = Mutex::new(Meter::new(&format!("{}, reference", description.name), goal, quiet));
        let advance = |_, _| {
            if let Ok(mut meter) = meter.lock() {
                meter.advance(row, 0);
            }
        };
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let begin = Instant::now();
        let picture = oracle.render(0..spp, u64::from(SEED), threads, &advance);
        let seconds = begin.elapsed().as_secs_f64();
        if let Ok(meter) = meter.into_inner() {
            meter.finish();
        }
        let record = ReferenceRecord {
            key: self.key.clone(),
            by: "cpu".to_owned(),
            seed: SEED,
            spp,
            relmse: stated_error(&picture),
            adapter: format!("{threads} threads"),
            seconds,
        };
        let rgb = picture.mean.iter().map(|mean| mean.as_vec3().to_array()).collect();
        let reference = Reference { rgb, record };
        self.keep(&reference, &description.film)?;
        Ok(reference)
    }

    /// The record is written last: a picture without one is not found.
    fn keep(&self, reference: &Reference, film: &Film) -> Result<(), BenchError> {
        let record = serde_json::to_string_pretty(&reference.record)? + "\n";
        let metadata = [("reference", record.clone())];
        let picture = Picture {
            size: film.size,
            window: film.window(),
            linear: &reference.rgb,
            display: &[],
            metadata: &metadata,
            report: &serde_json::Value::Null,
        };
        Output::new(&self.picture)?.write(&picture)?;
        Ok(file::write_text(&self.record, &record)?)
    }
}

/// The relMSE that a picture has by its standard errors.
fn stated_error(picture: &oracle::Picture) -> f64 {
    let terms = picture
        .mean
        .iter()
        .zip(&picture.error)
        .map(|(mean, error)| (error * error / (mean * mean + DARK)).element_sum());
    terms.sum::<f64>() / (3 * picture.mean.len().max(1)) as f64
}
