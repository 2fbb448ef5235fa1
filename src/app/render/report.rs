//! What a render says about itself: metadata in its files, the report as JSON, and a few lines for users.

use std::path::Path;

use glam::UVec2;
use serde_json::{Value, json};

use super::arguments::RenderArguments;
use super::rendered::FilmSummary;
use super::until::{Ended, Until};
use crate::app::shared::describe::Described;
use crate::app::shared::memory;
use crate::app::shared::quality::Quality;
use crate::app::shared::sources;
use crate::engine::{ErrorSources, FilmError, Report, RobustFilm, TileCounts};
use crate::image::Outputs;
use crate::layout::film::BadSample;
use crate::scene::SceneDescription;
use crate::scene::settings::Named;

/// Bad samples whose command lines are shown.
const TOLD: usize = 4;

/// Buffers whose bytes are shown.
const LARGEST: usize = 5;

/// Wall-clock seconds of the phases.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seconds {
    /// Opening the device, while files are read.
    pub start: f64,
    /// Reading the scene's files and making entities of them.
    pub load: f64,
    /// Reading the film's error, to see whether it is good enough, and to show it.
    pub estimate: f64,
    /// Reading the finished film back, with all that is said of it.
    pub read: f64,
    /// Finding out where its error comes from.
    pub sources: f64,
    /// From the start of the process to the film's return.
    pub total: f64,
}

/// All there is to say about a finished render.
#[derive(Debug)]
pub struct RenderSummary<'a> {
    pub arguments: &'a RenderArguments,
    /// The scene file.
    pub path: &'a Path,
    /// As it was rendered.
    pub description: &'a SceneDescription,
    pub film: &'a FilmSummary,
    pub report: &'a Report,
    /// Where its error comes from, where that was asked.
    pub sources: Option<&'a ErrorSources>,
    /// Its robust means, where those were asked.
    pub robust: Option<&'a RobustFilm>,
    pub seconds: Seconds,
    pub until: Until,
    /// Bytes of memory that the process took at most; none where the system does not tell.
    pub process_peak: Option<u64>,
}

impl RenderSummary<'_> {
    /// What is needed to repeat the render, for the files' metadata.
    pub fn metadata(&self) -> Vec<(&'static str, String)> {
        self.described().metadata_with(self.repeat())
    }

    /// A command line that gives the same film again. Bands of unlike samples are traced anew for as long as they were to be.
    fn repeat(&self) -> String {
        let [least, most] = self.film.samples();
        match least == most {
            true => self.described().repeat(),
            false => self.described().rendered(self.until.flags()),
        }
    }

    pub fn described(&self) -> Described<'_> {
        Described {
            path: self.path,
            description: self.description,
            defines: &self.arguments.flags.define,
            shaders: self.arguments.flags.shaders.as_deref(),
            window: self.film.window,
            spp: self.film.spp(),
            adapter: &self.report.adapter,
        }
    }

    /// The report as one JSON object.
    pub fn json(&self, outputs: &Outputs) -> Value {
        let (scene, film, report) = (self.description, self.film, self.report);
        let (window, ended) = (film.window, film.ended());
        let passes: Vec<Value> = report
            .passes
            .iter()
            .map(|pass| json!({ "name": pass.name, "count": pass.count, "milliseconds": pass.milliseconds }))
            .collect();
        let compiled: Vec<Value> = report
            .compiles
            .iter()
            .map(|pass| {
                json!({
                    "name": pass.name,
                    "count": pass.count,
                    "kept": pass.kept,
                    "link_milliseconds": pass.link_milliseconds,
                    "driver_milliseconds": pass.driver_milliseconds,
                })
            })
            .collect();
        let writes: serde_json::Map<String, Value> =
            outputs.seconds().iter().map(|(name, seconds)| (name.clone(), (*seconds).into())).collect();
        let mut whole = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "scene": scene.name,
            "scene_file": self.path.display().to_string(),
            "adapter": report.adapter,
            "size": [film.size.x, film.size.y],
            "crop": [window.min.x, window.max.x, window.min.y, window.max.y],
            "spp": film.spp(),
            "triangles": report.triangles,
            "nodes": report.nodes,
            "textures": report.textures,
            "texture_bytes": report.texture_bytes,
            "camera": scene.active,
            "seed": scene.render.seed,
            "integrator": scene.render.integrator.name(),
            "sampler": scene.render.sampler.name(),
            "max_depth": scene.render.max_depth,
            "roulette": scene.render.roulette,
            "reuse": scene.render.reuse.name(),
            "adaptive": scene.render.adaptive.name(),
            "energy": scene.render.energy.variant(),
            "exposure": scene.film.exposure,
            "tone": scene.film.tone.name(),
            "repeat": self.repeat(),
            "interrupted": ended == Ended::Interrupted,
            "ended_by": ended.word(),
            "quality": self.until.quality.map(Quality::name),
            "error_wanted": self.until.error,
            "seconds": {
                "start": self.seconds.start,
                "load": self.seconds.load,
                "extract": report.seconds_extract,
                "compile": report.seconds_compile,
                "build": report.seconds_build,
                "trace": report.seconds_trace,
                "estimate": self.seconds.estimate,
                "read": self.seconds.read,
                "sources": self.seconds.sources,
                "total": self.seconds.total,
                "write": writes,
            },
            "samples": report.samples,
            "rays": report.rays,
            "rays_per_second": self.rays_per_second(),
            "mean": film.mean(),
            // Null with one sample a pixel: that gives no error.
            "relative_error": film.error().map(|error| error.relmse),
            // It is at most this, with 95 % confidence.
            "relative_error_bound": film.error().map(|error| error.bound),
            "bad_samples": report.bad_samples,
            "bad_log": report.bad_log.iter().map(|bad| self.bad_sample(bad)).collect::<Vec<_>>(),
            "full_halves": report.full_halves,
            "passes": passes,
            "compiled": compiled,
            "skipped": self.skipped(),
            "outputs": outputs.names(),
        });
        // Null where all pixels have the same number.
        let tiles = |tiles: TileCounts| json!({ "tiles": tiles.tiles, "least": tiles.least, "median": tiles.median, "most": tiles.most });
        whole["tile_samples"] = report.tiles.map(tiles).into();
        // Null without --sources.
        whole["sources"] = self.sources.map(|found| sources::report(found, &scene.render)).into();
        // Null without --robust.
        whole["robust"] = self.robust.map(|robust| self.robust_report(robust)).into();
        whole["memory"] = self.memory();
        // Null where the film was traced at once.
        whole["bands"] = self.bands().into();
        // Null but where rows were left.
        whole["rest"] = self.rest(outputs).into();
        whole
    }

    /// Bytes of memory. Null where the system does not tell.
    fn memory(&self) -> Value {
        let device = &self.report.memory;
        let buffers: serde_json::Map<String, Value> =
            device.buffers.iter().map(|(name, bytes)| ((*name).to_owned(), (*bytes).into())).collect();
        json!({
            "device_peak": device.held.most,
            "device_buffers": buffers,
            "process_peak": self.process_peak,
        })
    }

    fn bad_sample(&self, bad: &BadSample) -> Value {
        let pixel = self.pixel(bad);
        json!({
            "pixel": [pixel.x, pixel.y],
            "sample": bad.sample,
            "bounce": bad.bounce,
            "material": bad.material,
            "kind": bad.kind,
            "replay": self.described().replay(pixel, bad.sample),
        })
    }

    fn pixel(&self, bad: &BadSample) -> UVec2 {
        let width = self.film.size.x.max(1);
        UVec2::new(bad.pixel % width, bad.pixel / width)
    }

    /// What is said of bad samples: how many there are, and how the first of them are replayed. Nothing without any.
    pub fn bad_lines(&self) -> Vec<String> {
        let (report, shown) = (self.report, self.report.bad_log.iter().take(TOLD));
        if report.bad_samples == 0 {
            return Vec::new();
        }
        let count = report.bad_samples;
        let kept = report.bad_log.len();
        let head = format!(
            "warning: {count} samples were no numbers, or too large, and were left out; --json lists {kept} of them, these show the first:"
        );
        let line = |bad: &BadSample| format!("  {}", self.described().replay(self.pixel(bad), bad.sample));
        std::iter::once(head).chain(shown.map(line)).collect()
    }

    /// What is said where pixels are full; nothing otherwise.
    pub fn full_line(&self) -> Option<String> {
        let full = self.report.full_halves;
        let line = format!(
            "warning: {full} halves of pixels are full: they hold no more samples than they have, however many --spp asks for; their means are of those"
        );
        (full > 0).then_some(line)
    }

    fn rays_per_second(&self) -> f64 {
        match self.report.seconds_trace {
            seconds if seconds > 0.0 => self.report.rays as f64 / seconds,
            _ => 0.0,
        }
    }

    /// A few lines for users.
    pub fn text(&self, outputs: &Outputs, stats: bool) -> String {
        let (film, report) = (self.film, self.report);
        let size = film.window.size();
        let samples = match film.samples() {
            [least, most] if least == most => least.to_string(),
            [least, most] => format!("{least} to {most}"),
        };
        let mut text = format!(
            "{}: {}x{}, {} spp, {} triangles, {:.2} s ({:.2} Mrays/s), {}\n",
            self.description.name,
            size.x,
            size.y,
            samples,
            report.triangles,
            self.seconds.total,
            self.rays_per_second() * 1e-6,
            match film.error() {
                None => "too few samples to tell the error".to_owned(),
                Some(FilmError { relmse, bound }) => format!("relMSE {relmse:.1e} (95 %: below {bound:.1e})"),
            },
        );
        if let Some(line) = self.until.line(film.ended(), film.error()) {
            text += &format!("  {line}\n");
        }
        text += &self.source_lines();
        text += &self.robust_lines();
        if stats {
            text += &self.stats(outputs);
        }
        for output in outputs.names() {
            text += &format!("  {output}\n");
        }
        text
    }

    fn stats(&self, outputs: &Outputs) -> String {
        let (report, seconds) = (self.report, self.seconds);
        let mut text = format!(
            "  {}\n  start {:.3} s, and load {:.3} s beside it; extract {:.3} s, compile {:.3} s, build {:.3} s, trace {:.3} s, \
             estimate {:.3} s, read {:.3} s, sources {:.3} s; total {:.3} s\n  {} rays, {} samples, {} bad\n",
            report.adapter,
            seconds.start,
            seconds.load,
            report.seconds_extract,
            report.seconds_compile,
            report.seconds_build,
            report.seconds_trace,
            seconds.estimate,
            seconds.read,
            seconds.sources,
            seconds.total,
            report.rays,
            report.samples,
            report.bad_samples,
        );
        for (name, seconds) in outputs.seconds() {
            text += &format!("  written in {seconds:.3} s: {name}\n");
        }
        text += &self.memory_lines();
        text += &self.skipped_lines();
        for pass in &report.compiles {
            let (link, driver) = (pass.link_milliseconds, pass.driver_milliseconds);
            let how = if pass.kept == pass.count { "made with the file of an earlier start" } else { "compiled" };
            text += &format!("  {:<16} linked in {link:.1} ms, {how} in {driver:.1} ms\n", pass.name);
        }
        if report.textures > 0 {
            let megabytes = report.texture_bytes as f64 / f64::from(1 << 20);
            text += &format!("  {} textures, {megabytes:.1} MiB on the device\n", report.textures);
        }
        if report.passes.is_empty() {
            text += "  this adapter can't time passes\n";
        }
        for pass in &report.passes {
            text += &format!("  {:<16} {:>8} x {:>12.3} ms\n", pass.name, pass.count, pass.milliseconds);
        }
        text
    }

    /// What was held at most, and the largest buffers.
    fn memory_lines(&self) -> String {
        let device = &self.report.memory;
        let largest: Vec<String> = device
            .buffers
            .iter()
            .take(LARGEST)
            .map(|(name, bytes)| format!("{name} {}", memory::shown(*bytes)))
            .collect();
        let process =
            self.process_peak.map_or(String::new(), |bytes| format!("; process {} at most", memory::shown(bytes)));
        let (most, largest) = (memory::shown(device.held.most), largest.join(", "));
        let mut text = format!("  memory: buffers on the device {most} at most ({largest}){process}\n");
        if self.film.is_in_bands() {
            text +=
                &format!("  traced in {} bands of rows, for the film is larger than a buffer\n", self.film.bands.len());
        }
        text
    }
}
