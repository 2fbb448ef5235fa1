//! One scene in both: their references first, and where those agree, the race.

use std::sync::Arc;

use super::arguments::PeersArguments;
use super::peer::Peer;
use super::python::Python;
use super::race::Race;
use super::references::{self, Halves};
use super::verdict::{self, Verdict};
use crate::app::Failure;
use crate::app::bench::BenchError;
use crate::app::bench::light::key;
use crate::app::bench::light::record::{Bench, ConfigurationRecord, ReferenceRecord, SceneRecord};
use crate::app::bench::light::reference::Reference;
use crate::app::export::mitsuba::{self, Exported};
use crate::app::shared::key::scene_key;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::components::Render;
use crate::gpu::Gpu;
use crate::scene::{Audit, SceneDescription};
use crate::shader::Library;

/// Samples a pixel of the film that says how many a reference needs.
const PILOT: u32 = 16;

/// By how much a reference's error is to be below the least that is measured.
const QUIETER: f64 = 16.0;

/// A scene, and where its materials are written.
pub struct Subject {
    pub description: SceneDescription,
    pub audit: Audit,
}

/// What all scenes have in common.
pub struct Rig<'a> {
    pub arguments: &'a PeersArguments,
    pub gpu: Arc<Gpu>,
    pub library: Library,
    pub python: Python,
    /// As Mitsuba calls it.
    pub variant: &'static str,
    /// Of what Mitsuba writes.
    pub folder: tempfile::TempDir,
}

/// Both programs, with one scene open in each.
struct Contest<'a> {
    rig: &'a Rig<'a>,
    description: &'a SceneDescription,
    tracer: Tracer,
    peer: Peer,
    peer_name: String,
    /// Pixels of a picture.
    pixels: u64,
}

/// A meter for so many samples, if they are known.
pub fn meter(name: &str, samples: Option<u64>, quiet: bool) -> Meter {
    Meter::new(name, Goal { samples, seconds: None, error: None }, quiet)
}

impl Rig<'_> {
    /// Measures a scene. None if a signal came before there was anything to say.
    pub fn measure(
        &self,
        subject: &Subject,
        monitor: &mut Monitor,
        bench: &mut Bench,
    ) -> Result<Option<Verdict>, Failure> {
        let description = &subject.description;
        let folder = self.arguments.out.join("scenes").join(&description.name);
        let exported = mitsuba::export(description, subject.audit.clone(), &folder).map_err(BenchError::from)?;
        let Some(mut contest) = self.open(description, &exported, monitor)? else { return Ok(None) };
        let Some((spp, ours, theirs)) = contest.references(monitor)? else { return Ok(None) };
        let mut verdict = Verdict {
            scene: description.name.clone(),
            peer: contest.peer_name.clone(),
            agreement: references::agreement(&ours, &theirs, self.arguments.to),
            notes: exported.notes.iter().map(ToString::to_string).collect(),
            beside: Vec::new(),
        };
        if !verdict.agreement.agree {
            return Ok(Some(verdict));
        }
        let reference = references::together(&ours, &theirs, &verdict.agreement, contest.record(spp)?);
        let Some((spp, measured)) = contest.race(&reference, monitor)? else { return Ok(None) };
        let Some((theirs, ours)) = measured.split_last() else { return Ok(None) };
        verdict.beside = ours.iter().map(|ours| verdict::beside(ours, theirs, self.arguments.to)).collect();
        bench.spp = bench.spp.max(spp);
        bench.scenes.push(SceneRecord {
            scene: description.name.clone(),
            size: description.film.window().size().to_array(),
            max_depth: description.render.max_depth,
            triangles: contest.tracer.report().map_err(Failure::engine)?.triangles,
            key: scene_key(description),
            reference: reference.record,
            configurations: measured,
        });
        Ok(Some(verdict))
    }

    /// Opens a scene in both. None if a signal came.
    fn open<'a>(
        &'a self,
        description: &'a SceneDescription,
        exported: &Exported,
        monitor: &Monitor,
    ) -> Result<Option<Contest<'a>>, Failure> {
        let size = description.film.window().size();
        let scene = std::path::absolute(&exported.scene).map_err(|e| BenchError::file(&exported.scene, e))?;
        let listening = (&monitor.interrupt, self.arguments.quiet);
        let peer = Peer::start(&self.python, self.variant, (&scene, size), self.folder.path(), listening)?;
        let Some(peer) = peer else { return Ok(None) };
        let mut tracer = Tracer::open(&self.gpu, &self.library, description).map_err(Failure::engine)?;
        tracer.show_compiling(&monitor.meter);
        let peer_name = format!("mitsuba {}, {}", self.python.version, self.variant);
        let pixels = u64::from(size.x) * u64::from(size.y);
        Ok(Some(Contest { rig: self, description, tracer, peer, peer_name, pixels }))
    }
}

impl Contest<'_> {
    /// The reference of each, and their samples a pixel. None if a signal came.
    fn references(&mut self, monitor: &mut Monitor) -> Result<Option<(u32, Halves, Halves)>, Failure> {
        let Some(spp) = self.reference_spp(monitor)? else { return Ok(None) };
        let name = format!("{}, references", self.description.name);
        monitor.meter = meter(&name, Some(2 * self.pixels * u64::from(spp)), self.rig.arguments.quiet);
        let Some(ours) = references::of_lucerna(&mut self.tracer, spp, monitor)? else { return Ok(None) };
        let theirs = references::of_peer(&mut self.peer, spp, (monitor, self.pixels))?;
        Ok(theirs.map(|theirs| (spp, ours, theirs)))
    }

    /// Samples a pixel that a reference needs, by what a small film says of its own error. None if a signal came.
    fn reference_spp(&mut self, monitor: &mut Monitor) -> Result<Option<u32>, Failure> {
        let arguments = self.rig.arguments;
        if let Some(spp) = arguments.reference_spp {
            return Ok(Some(spp));
        }
        self.tracer.set(Render { spp: PILOT, ..references::BY.of(&self.tracer.render) });
        if !self.tracer.finish(monitor).map_err(Failure::engine)? {
            return Ok(None);
        }
        let error = self.tracer.film().map_err(Failure::engine)?.error.relmse;
        let needed = f64::from(PILOT) * error / arguments.to * QUIETER;
        Ok(Some((needed.clamp(256.0, f64::from(1u32 << 20)) as u32).next_power_of_two()))
    }

    /// What is known of the reference before there are pictures.
    fn record(&self, spp: u32) -> Result<ReferenceRecord, Failure> {
        Ok(ReferenceRecord {
            key: key::reference_key(self.description, &self.rig.library)?,
            by: format!("{} and {}", references::BY, self.peer_name),
            seed: 0,
            spp,
            relmse: 0.0,
            adapter: self.rig.gpu.name(),
            seconds: 0.0,
        })
    }

    /// What was measured of each configuration and, last, of the peer, of whose pictures the largest has so many samples a pixel. None if a
    /// signal came before there was a whole run.
    fn race(
        &mut self,
        reference: &Reference,
        monitor: &mut Monitor,
    ) -> Result<Option<(u32, Vec<ConfigurationRecord>)>, Failure> {
        let (arguments, name) = (self.rig.arguments, &self.description.name);
        monitor.meter = meter(&format!("{name}, first pictures"), None, arguments.quiet);
        let (tracer, peer, pixels) = (&mut self.tracer, &mut self.peer, self.pixels);
        let mut race = Race { tracer, peer, reference, monitor, pixels };
        let mut ours = Vec::new();
        for configuration in &arguments.configs {
            let Some(numbers) = race.try_out(*configuration, arguments.to)? else { return Ok(None) };
            ours.push((*configuration, numbers));
        }
        let Some(theirs) = race.try_out_peer(arguments.to)? else { return Ok(None) };
        let films: u64 = ours.iter().map(|(_, numbers)| u64::from(numbers[numbers.len() - 1])).sum();
        let pictures: u64 = theirs.iter().map(|spp| u64::from(*spp)).sum();
        let samples = pixels * u64::from(arguments.runs) * (films + pictures);
        race.monitor.meter = meter(name, Some(samples), arguments.quiet);
        let measured = race.run(&ours, (&self.peer_name, &theirs), arguments.runs)?;
        Ok((!measured.is_empty()).then(|| (theirs[theirs.len() - 1], measured)))
    }
}
