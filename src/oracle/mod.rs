//! A path tracer in f64 on a scene's components: the judge of every estimator of the GPU.
//!
//! It shares nothing with what it judges: its own rays, random numbers, BSDFs and lights, each as plain as can be. So it
//! knows `components` alone, neither the structs shared with WGSL nor their twins. Tangents alone come from the same crate.

pub mod bsdf;
mod choice;
mod coat;
mod daylight;
mod facing;
mod light;
mod lobes;
mod pane;
mod path;
mod points;
mod random;
mod scene;
mod sky;
mod substance;
mod tangents;
pub mod texture;
mod tree;
mod vertex;

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2};

pub use random::Random;
pub use scene::OracleError;
pub use vertex::Vertex;

use light::Lights;
use points::PointLights;
use scene::Scene;

/// A scene, ready to be rendered.
pub struct Oracle {
    scene: Scene,
    lights: Lights,
    points: PointLights,
    /// Path segments: 1 sees emitters only. That of the scene's settings at first.
    pub max_depth: u32,
    /// Whether every surface asks a light directly too; if not, light is found by hitting it, and points alone are asked. The mean is the same.
    pub ask_lights: bool,
}

/// Linear Rec.709 radiance of the rendered window, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels of the window.
    pub size: UVec2,
    /// Of a pixel's samples.
    pub mean: Vec<DVec3>,
    /// Standard error of the mean; 0 for a single sample.
    pub error: Vec<DVec3>,
}

impl Oracle {
    /// Reads the world as the engine does: the active camera, everything else by the order of names.
    pub fn new(world: &mut World) -> Result<Self, OracleError> {
        let scene = Scene::read(world)?;
        let (lights, points) = (Lights::new(&scene), PointLights::read(world));
        Ok(Self { max_depth: scene.max_depth, ask_lights: true, scene, lights, points })
    }

    /// The samples of a range for every pixel of the window: equal ranges and seeds give equal pictures on any number of
    /// threads (0 counts as 1), and disjoint ranges give independent ones. `progress` hears of rows finished and rows in all.
    pub fn render(
        &self,
        samples: Range<u32>,
        seed: u64,
        threads: usize,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Picture {
        let window = self.scene.film.window();
        let size = window.size();
        let height = size.y as usize;
        let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = || {
            let mut rows = Vec::new();
            loop {
                let row = next.fetch_add(1, Ordering::Relaxed);
                if row >= height {
                    return rows;
                }
                let at = |x| self.pixel(UVec2::new(x, window.min.y + row as u32), samples.clone(), seed);
                rows.push((row, (window.min.x..window.max.x).map(at).collect::<Vec<_>>()));
                progress(done.fetch_add(1, Ordering::Relaxed) + 1, height);
            }
        };
        let mut rows: Vec<_> = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads.clamp(1, height.max(1))).map(|_| scope.spawn(work)).collect();
            let join = |worker: std::thread::ScopedJoinHandle<'_, _>| {
                worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            };
            workers.into_iter().flat_map(join).collect()
        });
        rows.sort_by_key(|(row, _)| *row);
        let (mean, error) = rows.into_iter().flat_map(|(_, pixels)| pixels).unzip();
        Picture { size, mean, error }
    }

    /// Mean and standard error of a pixel's samples, by Welford's recurrence (1962).
    fn pixel(&self, pixel: UVec2, samples: Range<u32>, seed: u64) -> (DVec3, DVec3) {
        let index = u64::from(pixel.y) * u64::from(self.scene.film.size.x) + u64::from(pixel.x);
        let (mut mean, mut squares, mut count) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for sample in samples {
            let radiance = self.trace(pixel, &mut Random::new([seed, index, u64::from(sample)]));
            count += 1.0;
            let off = radiance - mean;
            mean += off / count;
            squares += off * (radiance - mean);
        }
        let error = if count > 1.0 { (squares / (count * (count - 1.0))).map(f64::sqrt) } else { DVec3::ZERO };
        (mean, error)
    }
}
