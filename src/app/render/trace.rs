//! Traces a film band by band, and hands each on once it is finished.

use std::time::{Duration, Instant};

use super::bands::Bands;
use super::rendered::{FilmSummary, Rendered};
use super::until::{Ended, Next, Until};
use crate::app::Failure;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::progress::Meter;
use crate::app::shared::textures::TextureNotices;
use crate::components::{Crop, Film, Render};
use crate::engine::{Engine, EngineError, FilmError, FilmPart, Progress, Report};
use crate::gpu::GpuError;

/// Tracing between two polls of the clock and of signals.
const STEP: Duration = Duration::from_millis(100);

/// What tracing needs.
pub struct Tracing<'r> {
    pub engine: &'r mut Engine,
    pub meter: Meter,
    pub until: Until,
    pub interrupt: &'r Interrupt,
    /// No warnings.
    pub quiet: bool,
    /// When the band that is traced is to end.
    end: Option<Duration>,
    /// Spent on reading the film's error.
    looking: Duration,
    /// Spent on reading finished bands back.
    reading: Duration,
}

/// Takes a band that is one of several; false where nothing can be done with any more.
pub type Take<'t> = dyn FnMut(FilmPart) -> bool + 't;

impl<'r> Tracing<'r> {
    /// Nothing is traced yet.
    pub fn new(engine: &'r mut Engine, meter: Meter, (until, quiet): (Until, bool), interrupt: &'r Interrupt) -> Self {
        let (looking, reading) = Default::default();
        Self { engine, meter, until, interrupt, quiet, end: None, looking, reading }
    }

    /// Traces all of a film's window, in as many bands as it takes; where those are several, each is taken by `take`.
    pub fn trace(mut self, film: &Film, mut bands: Bands, take: &mut Take) -> Result<Rendered, Failure> {
        let window = film.window();
        let mut rendered = Rendered {
            film: FilmSummary::new(film.size, window),
            whole: None,
            report: None,
            looking: Duration::ZERO,
            reading: Duration::ZERO,
        };
        while let Some(band) = bands.band(rendered.film.end()) {
            let (ended, report, part) = match self.trace_and_read(window, band) {
                // Of a lower band, all arrays that grow with pixels are smaller.
                Err(EngineError::Gpu(GpuError::OutOfMemory { .. })) if bands.halve() => continue,
                traced => traced.map_err(Failure::engine)?,
            };
            rendered.report = Some(match rendered.report.take() {
                Some(earlier) => report.after(earlier),
                None => report,
            });
            // Without a sample, it was interrupted.
            let Some(part) = part else { break };
            rendered.film.add(&part, ended);
            if band == window {
                rendered.whole = Some(part);
            } else if !take(part) {
                break;
            }
            if ended == Ended::Interrupted {
                break;
            }
        }
        self.meter.finish();
        (rendered.looking, rendered.reading) = (self.looking, self.reading);
        Ok(rendered)
    }

    /// Traces a band of the window to its end; also what was done, and its pixels, if it has any samples.
    fn trace_and_read(&mut self, window: Crop, band: Crop) -> Result<(Ended, Report, Option<FilmPart>), EngineError> {
        let ended = self.trace_band(window, band)?;
        let begin = Instant::now();
        let report = self.engine.report()?;
        let part = if report.samples > 0 { Some(self.engine.film_part()?) } else { None };
        self.reading += begin.elapsed();
        Ok((ended, report, part))
    }

    /// Traces a band of the window, from its first sample to its end.
    fn trace_band(&mut self, window: Crop, band: Crop) -> Result<Ended, EngineError> {
        if band != window {
            self.begin_band(window, band);
        }
        loop {
            let (step, over) = self.step()?;
            if !std::mem::replace(&mut self.quiet, true) {
                let warnings = TextureNotices::default().fresh(self.engine.textures(), self.engine.halved_sky());
                warnings.iter().for_each(|warning| output::note(&format!("warning: {warning}")));
            }
            if let Some(ended) = self.ended(step, over)? {
                return Ok(ended);
            }
            if self.meter.wants_error() {
                self.look()?;
            }
        }
    }

    /// Has the engine render a band, of which nothing is traced yet. Of the time that is left, it has the share of its rows.
    fn begin_band(&mut self, window: Crop, band: Crop) {
        let first = self.until.first();
        self.engine.edit(|world| {
            for (mut film, mut render) in world.query::<(&mut Film, &mut Render)>().iter_mut(world) {
                film.crop = Some(band);
                render.spp = first;
            }
        });
        let rows = |from: u32, to: u32| f64::from(to - from);
        let share = rows(band.min.y, band.max.y) / rows(band.min.y, window.max.y);
        let left = self.meter.seconds_left();
        self.end = left.map(|left| self.meter.elapsed() + Duration::from_secs_f64(left * share));
        let height = rows(window.min.y, window.max.y);
        let before = rows(window.min.y, band.min.y) / height;
        let name = format!("rows {}-{}", band.min.y, band.max.y);
        self.meter.begin_part(&name, before, rows(band.min.y, band.max.y) / height);
    }

    /// Traces for a moment. Also says whether the time is up.
    fn step(&mut self) -> Result<(Progress, bool), EngineError> {
        let of_band = self.end.map(|end| end.saturating_sub(self.meter.elapsed()));
        let of_all = self.meter.seconds_left().map(Duration::from_secs_f64);
        let left = of_band.or(of_all).unwrap_or(STEP);
        let step = self.engine.step(STEP.min(left))?;
        self.meter.advance(step.samples, step.spp);
        if step.samples > 0 {
            self.interrupt.hold();
        }
        Ok((step, left.is_zero()))
    }

    /// Whether what is traced is finished, and why. A film that is to have more samples first is given them.
    fn ended(&mut self, step: Progress, over: bool) -> Result<Option<Ended>, EngineError> {
        if step.finished {
            let until = self.until;
            match until.next(step.spp, || self.look())? {
                Next::End(ended) => return Ok(Some(ended)),
                Next::Samples(spp) => self.engine.edit(|world| {
                    for mut render in world.query::<&mut Render>().iter_mut(world) {
                        render.spp = spp;
                    }
                }),
            }
        }
        Ok(match (self.interrupt.requested(), over) {
            (true, _) => Some(Ended::Interrupted),
            // Short of time, every pixel still gets one sample.
            (false, true) if step.spp >= 1 => Some(Ended::Time),
            (false, _) => None,
        })
    }

    /// Reads the film's error, and shows it.
    fn look(&mut self) -> Result<FilmError, EngineError> {
        let begin = Instant::now();
        let error = self.engine.film_error()?;
        self.looking += begin.elapsed();
        self.meter.set_error(error, begin.elapsed());
        Ok(error)
    }
}
