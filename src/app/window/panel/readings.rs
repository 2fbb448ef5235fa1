//! What the panel shows of the engine, read now and then: reading back stops the device for a moment.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::{UVec2, Vec4};

use super::probes::BINS;
use crate::cpu::probe::Histogram;
use crate::engine::{DebugRange, Engine, EngineError, Inspected, Report};
use crate::gpu::PassTiming;
use crate::passes::debug::DEBUG;
use crate::passes::probe::PROBE_COLOURS;
use crate::process;

/// Time between two readings of the film, at least.
const FILM: Duration = Duration::from_secs(1);

/// Reading the film takes at most this part of the time.
const SHARE: u32 = 10;

/// Time between two readings of a pixel.
const PIXEL: Duration = Duration::from_millis(300);

/// Points of the curve; beyond that, every second one is dropped.
const MOST_POINTS: usize = 512;

/// What state a film was read in: when it had begun, and the samples the engine had traced.
type Stamp = (Instant, u64);

/// The last readings of the engine.
pub struct Readings {
    /// All features that shaders know.
    pub features: Vec<String>,
    /// Those that the scene needs.
    pub needed: Vec<String>,
    pub spp: u32,
    /// None where the film goes on for as long as it is let.
    pub target: Option<u32>,
    /// Of all pixels; 0 before the second reading.
    pub samples_per_second: f64,
    pub rays_per_second: f64,
    pub report: Option<Report>,
    /// Bytes of memory that the process took at most; none where the system does not tell.
    pub process_peak: Option<u64>,
    /// Estimated relMSE; none before the second sample.
    pub error: Option<f64>,
    /// log10 of the seconds since the film began, and of its estimated relMSE.
    pub curve: Vec<[f64; 2]>,
    /// Time by pass between the last two readings that found any.
    pub passes: Vec<PassTiming>,
    /// Dispatches by pass between the last two readings that found any.
    pub dispatched: BTreeMap<&'static str, u64>,
    pub pixel: Option<Inspected>,
    /// Of view "debug", if that is shown.
    pub debug: Option<DebugRange>,
    /// How often that view had been drawn when it was read.
    debug_read: u64,
    /// Of view "probe", if that is shown.
    pub histogram: Option<Histogram>,
    /// How often that view had been coloured when it was read.
    probe_read: u64,
    /// What the chosen name shows at the pixel, by bounce; none where no name is chosen.
    pub probed: Option<Probed>,
    film_read: Option<(Instant, Stamp)>,
    film_cost: Duration,
    pixel_read: Option<(Instant, Looked, Stamp)>,
}

/// The pixel that was looked at, and the name that was chosen.
type Looked = (Option<UVec2>, Option<String>);

/// What a name shows of a pixel.
pub struct Probed {
    pub name: String,
    /// By bounce, as the engine has them; none where there is nothing to read.
    pub values: Option<Vec<Vec4>>,
}

impl Readings {
    /// Nothing was read yet.
    pub fn new(features: Vec<String>) -> Self {
        Self {
            features,
            needed: Vec::new(),
            spp: 0,
            target: None,
            samples_per_second: 0.0,
            rays_per_second: 0.0,
            report: None,
            process_peak: process::peak(),
            error: None,
            curve: Vec::new(),
            passes: Vec::new(),
            dispatched: BTreeMap::new(),
            pixel: None,
            debug: None,
            debug_read: 0,
            histogram: None,
            probe_read: 0,
            probed: None,
            film_read: None,
            film_cost: Duration::ZERO,
            pixel_read: None,
        }
    }

    /// Reads all of it anew, as soon as may be.
    pub fn forget(&mut self) {
        *self = Self::new(std::mem::take(&mut self.features));
    }

    /// When the film is to be read, if it is another than the last time.
    fn film_due(&self, stamp: Stamp, now: Instant) -> Option<Instant> {
        match self.film_read {
            None => Some(now),
            Some((_, last)) if last == stamp => None,
            Some((at, _)) => Some(at + FILM.max(self.film_cost * SHARE)),
        }
    }

    /// The same of the pixel.
    fn pixel_due(&self, looked: &Looked, stamp: Stamp, now: Instant) -> Option<Instant> {
        match &self.pixel_read {
            None => Some(now),
            Some((_, last_looked, last)) if (last_looked, *last) == (looked, stamp) => None,
            Some((at, ..)) => Some(*at + PIXEL),
        }
    }

    /// When the next reading is due; none if nothing changed since the last.
    pub fn next(&self, engine: &mut Engine, pixel: Option<UVec2>, began: Instant) -> Option<Instant> {
        let (stamp, now) = (stamp(engine, began), Instant::now());
        if self.debug_due(engine).is_some() || self.probe_due(engine).is_some() {
            return Some(now);
        }
        let looked = looked(engine, pixel);
        [self.film_due(stamp, now), self.pixel_due(&looked, stamp, now)].into_iter().flatten().min()
    }

    /// Reads what is due. Says whether anything was.
    pub fn read(
        &mut self,
        engine: &mut Engine,
        pixel: Option<UVec2>,
        began: Instant,
        now: Instant,
    ) -> Result<bool, EngineError> {
        let stamp = stamp(engine, began);
        let film = self.film_due(stamp, now).is_some_and(|at| at <= now);
        if film {
            self.read_film(engine, stamp, now)?;
        }
        let looked = looked(engine, pixel);
        let one = self.pixel_due(&looked, stamp, now).is_some_and(|at| at <= now);
        if one {
            self.pixel_read = Some((now, looked.clone(), stamp));
            self.pixel = match pixel {
                Some(pixel) => engine.inspect(pixel)?,
                None => None,
            };
            self.probed = None;
            if let (pixel, Some(name)) = looked {
                let values = pixel.map(|pixel| engine.probe_pixel(pixel)).transpose()?.flatten();
                self.probed = Some(Probed { name, values });
            }
        }
        let debug = self.debug_due(engine);
        if let Some(drawn) = debug {
            self.debug_read = drawn;
            self.debug = engine.debug_colours()?.map(|colours| DebugRange::of(&colours));
        }
        let probed = self.probe_due(engine);
        if let Some(drawn) = probed {
            self.probe_read = drawn;
            let (values, shown) = (engine.probe_values()?, engine.probing());
            let known = values.zip(shown).map(|(values, shown)| {
                let params = shown.look.colours(values.len() as u32);
                Histogram::of(&values, &params, BINS)
            });
            self.histogram = known;
        }
        Ok(film || one || debug.is_some() || probed.is_some())
    }

    /// How often view "probe" was coloured, if it is to be read: it is once for each film and way to look at it.
    fn probe_due(&self, engine: &Engine) -> Option<u64> {
        let drawn = engine.dispatches().get(PROBE_COLOURS.name).copied().unwrap_or(0);
        (drawn != self.probe_read).then_some(drawn)
    }

    /// How often view "debug" was drawn, if it is to be read: it is drawn once for each film.
    fn debug_due(&self, engine: &Engine) -> Option<u64> {
        let drawn = engine.dispatches().get(DEBUG.name).copied().unwrap_or(0);
        (drawn != self.debug_read).then_some(drawn)
    }

    fn read_film(&mut self, engine: &mut Engine, stamp: Stamp, now: Instant) -> Result<(), EngineError> {
        let begin = Instant::now();
        let (began, traced) = stamp;
        // Noted first: what fails is not tried again at once.
        let last = self.film_read.replace((now, stamp));
        let report = engine.report()?;
        let (spp, target) = engine.samples();
        (self.spp, self.target) = (spp, (!engine.is_endless()).then_some(target));
        self.needed = engine.features().iter().cloned().collect();
        if last.is_none_or(|(_, (last, _))| last != began) {
            self.curve.clear();
        }
        self.error = None;
        if self.spp > 1 {
            let error = engine.film_error()?.relmse;
            self.error = Some(error);
            self.add_point(now.duration_since(began).as_secs_f64(), error);
        }
        if let Some((at, (_, before))) = last {
            let seconds = now.duration_since(at).as_secs_f64().max(1e-3);
            self.samples_per_second = traced.saturating_sub(before) as f64 / seconds;
            let rays_per_sample = report.rays as f64 / report.samples.max(1) as f64;
            self.rays_per_second = self.samples_per_second * rays_per_sample;
        }
        self.count_passes(&report);
        self.process_peak = process::peak();
        self.report = Some(report);
        self.film_cost = begin.elapsed();
        Ok(())
    }

    fn add_point(&mut self, seconds: f64, error: f64) {
        if seconds > 0.0 && error > 0.0 {
            self.curve.push([seconds.log10(), error.log10()]);
        }
        if self.curve.len() > MOST_POINTS {
            let mut place = 0;
            self.curve.retain(|_| {
                place += 1;
                place % 2 == 1
            });
        }
    }

    fn count_passes(&mut self, report: &Report) {
        let before = |name: &str| {
            let last = self.report.as_ref();
            last.and_then(|last| last.dispatches.get(name)).copied().unwrap_or(0)
        };
        let since: BTreeMap<&'static str, u64> = report
            .dispatches
            .iter()
            .map(|(name, count)| (*name, count - before(name)))
            .filter(|(_, count)| *count > 0)
            .collect();
        if !since.is_empty() {
            self.dispatched = since;
        }
        if !report.passes.is_empty() {
            self.passes.clone_from(&report.passes);
        }
    }
}

fn looked(engine: &Engine, pixel: Option<UVec2>) -> Looked {
    (pixel, engine.probing().map(|probing| probing.name.clone()))
}

fn stamp(engine: &mut Engine, began: Instant) -> Stamp {
    (began, engine.spent().samples)
}
