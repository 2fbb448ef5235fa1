//! `bench skip`: what scenes save because what they do not need is not compiled.
//!
//! One engine a scene makes films of equal seeds by turns, with the kernels that the scene needs, and with all compiled in that can be idle
//! there (`passes/features.rs`). Both films have to be the same but for rounding.

use clap::Args;
use glam::UVec2;

use super::{BenchError, BenchReport, Case, Row, light};
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::progress::{Goal, Meter};
use crate::app::shared::tracer::{Monitor, Tracer};
use crate::app::shared::values::{MORE, size};
use crate::app::{Exit, Failure};
use crate::components::Render;
use crate::engine::FilmImage;
use crate::gpu::Gpu;
use crate::passes::features::FEATURES;
use crate::shader::Library;
use crate::stats::metrics::relative_mse;

/// Other code rounds otherwise, and a path in some thousands then goes another way. Above this it is more than rounding.
const LARGEST_DIFFERENCE: f64 = 1e-6;

/// Films of each kind, the first of which only compiles.
const RUNS: u32 = 7;

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct SkipArguments {
    /// Scene files (.ron), models (.obj), or names of files in assets/scenes
    #[arg(value_name = "SCENE", default_values = ["cornell-box-original", "teapot"])]
    pub scenes: Vec<String>,
    /// Samples a pixel of each film
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(2..=1 << 24))]
    pub spp: u32,
    /// Size of the picture in pixels, each side 1 to 16384 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Print one JSON object instead of a table
    #[arg(long)]
    pub json: bool,
    /// No progress, and no warnings
    #[arg(long, short)]
    pub quiet: bool,
}

/// Measures all scenes, and prints a table; after a signal, of those that were finished before it.
pub fn run(arguments: &SkipArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let library = Library::shipped();
    let mut scenes = Vec::new();
    for name in &arguments.scenes {
        let path = crate::scene::find(name)?;
        let mut scene = light::scene::read(&path, (arguments.size, None), &library, arguments.quiet)?;
        scene.render.spp = arguments.spp;
        scenes.push(scene);
    }
    let gpu = Gpu::open()?;
    let pixels = |scene: &crate::scene::SceneDescription| u64::from(scene.film.window().size().element_product());
    let samples = scenes.iter().map(pixels).sum::<u64>() * u64::from(2 * RUNS) * u64::from(arguments.spp);
    let goal = Goal { samples: Some(samples), seconds: None, error: None };
    let mut monitor = Monitor { meter: Meter::new("bench skip", goal, arguments.quiet), interrupt };
    let mut cases = Vec::new();
    for scene in &scenes {
        let mut tracer = Tracer::open(&gpu, &library, scene).map_err(BenchError::from)?;
        tracer.show_compiling(&monitor.meter);
        match measure(&mut tracer, &scene.name, pixels(scene), &mut monitor)? {
            Some(case) => cases.push(case),
            None => break,
        }
    }
    monitor.meter.finish();
    monitor.interrupt.hold();
    BenchReport { bench: "skip", adapter: gpu.name(), runs: RUNS - 1, cases }.print(arguments.json)?;
    Ok(if monitor.interrupt.requested() { Exit::Interrupted } else { Exit::Done })
}

/// Films of both kinds by turns; none after a signal.
fn measure(tracer: &mut Tracer, name: &str, pixels: u64, monitor: &mut Monitor) -> Result<Option<Case>, BenchError> {
    let (mut times, mut difference) = ([Vec::new(), Vec::new()], 0.0f64);
    let mut needed = 0;
    for seed in 0..RUNS {
        let mut films = Vec::new();
        for (general, times) in [true, false].into_iter().zip(&mut times) {
            let Some((film, milliseconds)) = film(tracer, seed, general, monitor)? else { return Ok(None) };
            films.push(film);
            if seed > 0 {
                times.push(milliseconds);
            }
            needed = tracer.features().len();
        }
        difference = difference.max(relative_mse(&films[0].rgb, &films[1].rgb));
    }
    if difference.is_nan() || difference > LARGEST_DIFFERENCE {
        let what = format!(
            "{name}: films with and without what the scene does not need differ by a relMSE of {difference:.1e}"
        );
        return Err(BenchError::Wrong(what));
    }
    let rows =
        [("all compiled in", &times[0]), ("what is needed", &times[1])].map(|(name, times)| Row::of(name, times));
    let quotient = rows[0].median / rows[1].median;
    let samples = pixels * u64::from(tracer.render.spp);
    let case = Case::new(format!("{name}, {} spp", tracer.render.spp), samples, "samples/s", rows.into())
        .note("times as fast", quotient)
        .note("relMSE between both films, at most", difference)
        .note("features needed", needed as f64)
        .note("features in all", FEATURES.len() as f64);
    Ok(Some(case))
}

/// A film and the milliseconds that tracing it took; none if a signal came before its end.
fn film(
    tracer: &mut Tracer,
    seed: u32,
    general: bool,
    monitor: &mut Monitor,
) -> Result<Option<(FilmImage, f64)>, BenchError> {
    tracer.set_general(general);
    tracer.set(Render { seed, ..tracer.render });
    let before = tracer.report()?.seconds_trace;
    if !tracer.finish(monitor)? {
        return Ok(None);
    }
    let seconds = tracer.report()?.seconds_trace - before;
    Ok(Some((tracer.film()?, 1e3 * seconds)))
}
