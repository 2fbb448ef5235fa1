//! What an engine has to show: the film, and an account of the work.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::EngineError;
use super::state::{Device, FilmProgress, PackedScene, Spent, Viewed};
use crate::components::Crop;
use crate::cpu::film::{film_mean, half_mean, pixel_mean, relative_error};
use crate::gpu::PassTiming;
use crate::layout::film::{BAD_LOG, BadSample, FilmCounters, FilmPixel};
use crate::layout::tree::node_count;
use crate::layout::view::ViewMode;
use crate::passes::{Recording, film};

/// The film, read back. Pixels go row by row from the top of the window.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmImage {
    /// The whole film, pixels.
    pub size: UVec2,
    /// The rendered part of it.
    pub window: Crop,
    /// Mean radiance, linear Rec.709.
    pub rgb: Vec<[f32; 3]>,
    /// The same from the even and from the odd samples alone: independent of each other.
    pub halves: [Vec<[f32; 3]>; 2],
    /// The sums themselves: two films are equal if these are.
    pub pixels: Vec<FilmPixel>,
    /// As shown: exposed, sRGB, opaque.
    pub picture: Vec<[u8; 4]>,
    /// Samples that every pixel has.
    pub spp: u32,
    /// Mean over all pixels.
    pub mean: [f64; 3],
    /// Estimated relMSE of `rgb`; 0 where no pixel has two samples.
    pub relative_error: f64,
}

/// What the engine did since it opened.
#[derive(Clone, Debug)]
pub struct Report {
    /// Adapter and driver.
    pub adapter: String,
    pub triangles: u32,
    pub nodes: u32,
    /// Samples of the film, over all pixels.
    pub samples: u64,
    /// Rays of those samples, counted on the GPU.
    pub rays: u64,
    /// Seconds from the first submission of a tree to its end.
    pub seconds_build: f64,
    /// Seconds of all batches of samples, from submission to end.
    pub seconds_trace: f64,
    /// Samples of the film that were not added.
    pub bad_samples: u64,
    /// The first of them.
    pub bad_log: Vec<BadSample>,
    /// GPU time by pass since the last report, if timing is on.
    pub passes: Vec<PassTiming>,
    /// Dispatches by pass.
    pub dispatches: BTreeMap<&'static str, u64>,
}

/// Reads the film back; shows it first, if its picture is an older one or not what is viewed.
pub(super) fn read_film(world: &mut World) -> Result<FilmImage, EngineError> {
    let progress = *world.resource::<FilmProgress>();
    let scene = world.resource::<PackedScene>();
    let (shot, exponent, exposure) = (scene.shot, scene.exponent, scene.exposure);
    let size = UVec2::new(shot.film_width, shot.film_height);
    let min = UVec2::new(shot.window_x, shot.window_y);
    let window = Crop { min, max: min + UVec2::new(shot.window_width, shot.window_height) };
    let count = shot.window_width * shot.window_height;
    if count == 0 {
        return Err(EngineError::EmptyFilm);
    }
    // A view that is on the screen stays there.
    let is_viewed = world.resource::<Viewed>().0 != ViewMode::Beauty;
    let held = if is_viewed { "film_picture" } else { "picture" };
    let device = &mut world.resource_mut::<Device>().0;
    device.reserve(held, u64::from(count) * 4)?;
    let mut recording = Recording::default();
    if !progress.cleared {
        film::record_reset(&mut recording, count);
    }
    if is_viewed || progress.shown != Some(ViewMode::Beauty) || !progress.cleared {
        film::record_display(&mut recording, count, exponent, exposure).bind("picture", held);
    }
    device.play(&recording)?;
    let pixels: Vec<FilmPixel> = device.read_some("film", count as usize)?;
    let picture: Vec<[u8; 4]> = device.read_some(held, count as usize)?;
    let mut progress = world.resource_mut::<FilmProgress>();
    progress.cleared = true;
    if !is_viewed {
        progress.shown = Some(ViewMode::Beauty);
    }
    let as_f32 = |mean: [f64; 3]| mean.map(|channel| channel as f32);
    let half = |h: usize| pixels.iter().map(|p| as_f32(half_mean(&p.halves[h], exponent).0)).collect();
    Ok(FilmImage {
        size,
        window,
        rgb: pixels.iter().map(|p| as_f32(pixel_mean(p, exponent).0)).collect(),
        halves: [half(0), half(1)],
        spp: progress.samples,
        mean: film_mean(&pixels, exponent),
        relative_error: relative_error(&pixels, shot.window_width as usize, exponent),
        picture,
        pixels,
    })
}

/// Reads the film's mean radiance alone; black where nothing was traced.
pub(super) fn read_radiance(world: &mut World) -> Result<Vec<[f32; 3]>, EngineError> {
    let cleared = world.resource::<FilmProgress>().cleared;
    let scene = world.resource::<PackedScene>();
    let (count, exponent) = ((scene.shot.window_width * scene.shot.window_height) as usize, scene.exponent);
    match (count, cleared) {
        (0, _) => Err(EngineError::EmptyFilm),
        (_, false) => Ok(vec![[0.0; 3]; count]),
        (_, true) => {
            let pixels: Vec<FilmPixel> = world.resource::<Device>().0.read_some("film", count)?;
            Ok(pixels.iter().map(|pixel| pixel_mean(pixel, exponent).0.map(|channel| channel as f32)).collect())
        }
    }
}

/// Adds up what was done.
pub(super) fn read_report(world: &mut World) -> Result<Report, EngineError> {
    let progress = *world.resource::<FilmProgress>();
    let spent = *world.resource::<Spent>();
    let scene = world.resource::<PackedScene>();
    let (triangles, width, height) = (scene.triangles, scene.shot.window_width, scene.shot.window_height);
    let device = &mut world.resource_mut::<Device>().0;
    let counters = match progress.cleared {
        true => device.read_some::<FilmCounters>("counters", 1)?[0],
        false => FilmCounters::default(),
    };
    let bad = counters.bad.0;
    Ok(Report {
        adapter: device.gpu().name(),
        triangles,
        nodes: node_count(triangles),
        samples: u64::from(width) * (u64::from(progress.samples) * u64::from(height) + u64::from(progress.rows)),
        rays: u64::from(counters.rays_hi.0) << 32 | u64::from(counters.rays_lo.0),
        seconds_build: spent.build,
        seconds_trace: spent.trace,
        bad_samples: u64::from(bad),
        bad_log: counters.log[..bad.min(BAD_LOG) as usize].to_vec(),
        passes: device.timings()?,
        dispatches: device.dispatches().clone(),
    })
}
