//! Where the film's error comes from: some samples more of every pixel, traced window by window with what each of their rays brings.
//!
//! Plain functions, no system: they ask the device, and change nothing in the world. What the kernels leave in buffers of samples is read by
//! nobody else: a batch writes before it reads.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::Engine;
use super::film::{progress, read_radiance};
use crate::components::{Crop, Name};
use crate::cpu::sources::{Batch, Class, Emitters, Light, Means, PixelShare, Share, Tally, Way, shares};
use crate::gpu::GpuTable;
use crate::layout::light::LightRecord;
use crate::layout::sources::{Contribution, MOST_BROUGHT};
use crate::layout::trace::{RadianceSample, TILE_BLOCK, TraceParams};
use crate::passes::{Recording, sources, trace};
use crate::systems::resources::{
    CompileListener, Device, MaterialSlot, MeshSlot, SceneGeometry, Shot, Tree, point_names,
};
use crate::systems::{EngineError, Entered};

/// Samples a pixel, at most, for each of the two means that are compared.
const MOST_SAMPLES: u32 = 16;

/// Samples of all pixels together, as far as each has two: the processor takes a microsecond for one.
const MOST_TRACED: u64 = 1 << 24;

/// Bytes of what the paths of a window bring, at most.
const MOST_BYTES: u64 = 32 << 20;

/// The largest side of such a window, pixels; a power of two, and at least that of a block.
const LARGEST_SIDE: u32 = 128;

/// A look at where the film's error comes from, as far as it has come.
pub struct Survey {
    /// What the film is of.
    shot: Shot,
    /// How often a film had begun.
    began: u64,
    /// Samples of each of the two means.
    samples: u32,
    /// Film sample that comes first.
    first_sample: u32,
    /// The film's mean radiance, window by window row.
    means: Vec<[f32; 3]>,
    emitters: Emitters,
    /// Windows in the whole film, the next one last.
    left: Vec<Crop>,
    windows: usize,
    tally: Tally,
    map: Vec<PixelShare>,
}

/// How a survey goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surveyed {
    /// There are pixels left.
    More,
    Done,
    /// The film is another one by now.
    Stale,
}

/// What has how much of the film's error.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSources {
    /// Samples a pixel that this is from.
    pub samples: u32,
    /// Pixels that had samples in both means.
    pub pixels: u64,
    /// relMSE of a film of so many samples, by the film's own radiance.
    pub relmse: f64,
    /// Contributions that there was no room to keep: those of very long paths.
    pub dropped: u64,
    /// What of it has most, whatever its bounces and the surface; none where there is no error.
    pub most: Option<(Most, Share)>,
    /// The ways that light comes, the one with the greatest part first.
    pub ways: Vec<(Source, Share)>,
    /// Parts by bounce alone, and so on.
    pub by_bounce: Vec<(u32, Share)>,
    /// With the material of mirror or glass that light was found through.
    pub by_way: Vec<((Way, Option<String>), Share)>,
    pub by_surface: Vec<(Option<String>, Share)>,
    pub by_light: Vec<(String, Share)>,
}

/// Ways that differ by bounce and surface alone, by names.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Most {
    pub light: String,
    pub way: Way,
    pub through: Option<String>,
    /// That of their bounces which has most.
    pub bounce: u32,
}

/// A way that light comes, by names.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    /// As in [`Class`].
    pub bounce: u32,
    pub way: Way,
    /// Name of the material where the last direction was chosen; none where that was the camera.
    pub surface: Option<String>,
    /// Name of the material of mirror or glass behind that.
    pub through: Option<String>,
    /// Name of mesh or point light, `sun`, `sky`, or `many lights`.
    pub light: String,
}

/// Each pixel's own part, row by row from the top of the film's window.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceMap {
    pub size: UVec2,
    pub pixels: Vec<PixelShare>,
}

impl Engine {
    /// Begins to find out where the error of the film comes from, by windows of at most so many paths; none before every pixel has a sample. The
    /// film stays as it is.
    pub fn begin_survey(&self, most_paths: u64) -> Result<Option<Survey>, EngineError> {
        Survey::begin(&self.world, most_paths)
    }

    /// Traces the next window.
    pub fn survey(&mut self, survey: &mut Survey) -> Result<Surveyed, EngineError> {
        survey.advance(&mut self.world)
    }

    /// What is known so far, by names.
    pub fn sources(&self, survey: &Survey) -> ErrorSources {
        survey.named(&self.world)
    }
}

impl Survey {
    fn begin(world: &World, most_paths: u64) -> Result<Option<Self>, EngineError> {
        let (progress, shot) = (progress(world), world.resource::<Shot>().clone());
        if progress.samples == 0 || !world.resource::<Tree>().built || shot.size().min_element() == 0 {
            return Ok(None);
        }
        let samples = samples_of_each(progress.samples, shot.size());
        let slots = slots(&shot.params);
        let side = side(2 * samples, slots, most_paths);
        let min = UVec2::new(shot.params.window_x, shot.params.window_y);
        let mut left = windows(Crop { min, max: min + shot.size() }, side);
        left.reverse();
        let means = read_radiance(world)?;
        Ok(Some(Self {
            began: films_begun(world),
            samples,
            first_sample: progress.samples.next_multiple_of(2 * samples),
            map: vec![PixelShare::default(); means.len()],
            means,
            emitters: emitters(world),
            windows: left.len(),
            left,
            tally: Tally::default(),
            shot,
        }))
    }

    /// How much of it is done, of 1.
    pub fn done(&self) -> f64 {
        1.0 - self.left.len() as f64 / self.windows.max(1) as f64
    }

    /// Each pixel's own part; of pixels that are left, none.
    pub fn map(&self) -> SourceMap {
        SourceMap { size: self.shot.size(), pixels: self.map.clone() }
    }

    /// What has been summed up so far.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    fn advance(&mut self, world: &mut World) -> Result<Surveyed, EngineError> {
        if films_begun(world) != self.began || !world.resource::<Shot>().same(&self.shot) {
            return Ok(Surveyed::Stale);
        }
        if let Some(window) = self.left.pop() {
            self.trace(world, window)?;
        }
        Ok(if self.left.is_empty() { Surveyed::Done } else { Surveyed::More })
    }

    /// Traces the samples of a window, and sums up what they brought.
    fn trace(&mut self, world: &mut World, window: Crop) -> Result<(), EngineError> {
        let size = window.size();
        let own = TraceParams {
            window_x: window.min.x,
            window_y: window.min.y,
            window_width: size.x,
            window_height: size.y,
            first_sample: self.first_sample,
            layers: 2 * self.samples,
            first_layer: 0,
            column_shift: 0,
            row_shift: 0,
            keeps: 0,
            ..self.shot.params
        };
        let reuse = self.shot.reuses().then_some(self.shot.is_textured());
        let params = if reuse.is_some() { trace::whole_blocks(&own) } else { own };
        let listener = world.resource::<CompileListener>().clone();
        let device = &mut world.resource_mut::<Device>().0;
        for (name, bytes) in sources::buffers(&params, slots(&params), reuse) {
            device.reserve(name, bytes)?;
        }
        let mut recording = Recording::default();
        sources::record(&mut recording, &params, reuse);
        let telling = device.lacks(&[&recording]).then(|| listener.tell());
        device.prepare(&[&recording])?;
        device.play(&recording)?;
        let paths = (params.window_width * params.window_height * params.layers) as usize;
        let counts: Vec<u32> = device.read_some("brought_counts", paths)?;
        drop(telling);
        device.check_loops()?;
        let samples: Vec<RadianceSample> = device.read_some("radiance", paths)?;
        let longest = counts.iter().copied().max().unwrap_or(0).min(slots(&params)) as usize;
        let min = UVec2::new(self.shot.params.window_x, self.shot.params.window_y);
        let film = Means { min, size: self.shot.size(), means: &self.means };
        let (tally, emitters) = (&mut self.tally, &self.emitters);
        let shares = device.look_at("brought", longest * paths, |brought: &[Contribution]| {
            let batch = Batch { params: &params, samples: &samples, counts: &counts, brought, reuses: reuse.is_some() };
            tally.add(&batch, film, emitters)
        })?;
        for (place, share) in shares {
            self.map[(place.y * film.size.x + place.x) as usize] = share;
        }
        Ok(())
    }

    fn named(&self, world: &World) -> ErrorSources {
        let names = Names::of(world);
        let tally = &self.tally;
        ErrorSources {
            samples: 2 * self.samples,
            pixels: tally.pixels,
            relmse: tally.relmse(),
            dropped: tally.dropped,
            most: most(tally, &names),
            ways: shares(tally, |class| names.source(class)),
            by_bounce: shares(tally, |class| class.bounce),
            by_way: shares(tally, |class| (class.way, class.through.map(|index| names.material(index)))),
            by_surface: shares(tally, |class| class.surface.map(|index| names.material(index))),
            by_light: shares(tally, |class| names.light(class.light)),
        }
    }
}

/// What has most of the error, whatever its bounces and the surface.
fn most(tally: &Tally, names: &Names) -> Option<(Most, Share)> {
    let key = |class: &Class| (class.light, class.way, class.through);
    let (first, share) = shares(tally, key).into_iter().next()?;
    let bounces = shares(tally, |class| (key(class) == first, class.bounce));
    let bounce = bounces.into_iter().find(|((is_first, _), _)| *is_first).map_or(0, |((_, bounce), _)| bounce);
    let (light, way, through) = first;
    let through = through.map(|index| names.material(index));
    Some((Most { light: names.light(light), way, through, bounce }, share))
}

/// Samples a pixel of each of the two means: as many as the film has, so that tracing takes no longer, and that they even out as they do there. A
/// large film needs fewer to tell as much.
fn samples_of_each(spp: u32, size: UVec2) -> u32 {
    let pixels = (u64::from(size.x) * u64::from(size.y)).max(1);
    let most = (MOST_TRACED / 2 / pixels).min(MOST_SAMPLES.into()) as u32;
    1 << (spp / 2).min(most).max(1).ilog2()
}

/// Contributions of a path that are kept: a segment finds light at its end, and its surface samples one.
fn slots(params: &TraceParams) -> u32 {
    params.max_depth.saturating_mul(2).clamp(1, MOST_BROUGHT)
}

/// The side of windows of so many samples a pixel: as large as is allowed.
fn side(layers: u32, slots: u32, most_paths: u64) -> u32 {
    let fits = |side: &u32| {
        let paths = u64::from(side * side) * u64::from(layers);
        paths * u64::from(slots) * size_of::<Contribution>() as u64 <= MOST_BYTES && paths <= most_paths
    };
    let sides = std::iter::successors(Some(LARGEST_SIDE), |side| Some(side / 2));
    sides.take_while(|side| *side > TILE_BLOCK).find(fits).unwrap_or(TILE_BLOCK)
}

/// The cells of a grid over the whole film that a window has part of, as far as it has.
fn windows(film: Crop, side: u32) -> Vec<Crop> {
    let first = film.min / side;
    let end = film.max.map(|end| end.div_ceil(side));
    let rows = (first.y..end.y).flat_map(|y| (first.x..end.x).map(move |x| UVec2::new(x, y)));
    rows.map(|cell| Crop { min: (cell * side).max(film.min), max: ((cell + 1) * side).min(film.max) }).collect()
}

/// How often a film began.
fn films_begun(world: &World) -> u64 {
    world.resource::<Entered>().0.get("begin_film").copied().unwrap_or_default()
}

/// Where the triangles of meshes begin.
fn emitters(world: &World) -> Emitters {
    let meshes = &world.resource::<SceneGeometry>().meshes;
    Emitters::new(meshes.iter().filter_map(|mesh| Some(world.get::<MeshSlot>(*mesh)?.first)).collect())
}

/// What indices stand for.
struct Names {
    materials: Vec<String>,
    meshes: Vec<String>,
    /// The row of the first point light, and all of them in order.
    points: (u32, Vec<String>),
}

impl Names {
    fn of(world: &World) -> Self {
        let name = |entity: &Entity| world.get::<Name>(*entity).map_or(String::new(), |name| name.to_string());
        let geometry = world.resource::<SceneGeometry>();
        let mut materials: Vec<(u32, String)> = Vec::new();
        if let Some(mut found) = world.try_query::<(&Name, &MaterialSlot)>() {
            materials.extend(found.iter(world).map(|(name, slot)| (slot.0, name.to_string())));
        }
        materials.sort();
        let rows = world.resource::<GpuTable<LightRecord>>().rows();
        let first = rows.iter().position(|row| row.point().is_some()).unwrap_or(rows.len()) as u32;
        Self {
            materials: materials.into_iter().map(|(_, name)| name).collect(),
            meshes: geometry.meshes.iter().filter(|mesh| world.get::<MeshSlot>(**mesh).is_some()).map(name).collect(),
            points: (first, point_names(world)),
        }
    }

    fn material(&self, index: u32) -> String {
        self.materials.get(index as usize).map_or("the default material".to_owned(), Clone::clone)
    }

    fn light(&self, light: Light) -> String {
        let named = |names: &[String], index: u32| names.get(index as usize).cloned().unwrap_or_default();
        match light {
            Light::Mesh(index) => named(&self.meshes, index),
            Light::Point(row) => named(&self.points.1, row.saturating_sub(self.points.0)),
            Light::Sun => "sun".to_owned(),
            Light::Sky => "sky".to_owned(),
            Light::Many => "many lights".to_owned(),
        }
    }

    fn source(&self, class: &Class) -> Source {
        let material = |index: Option<u32>| index.map(|index| self.material(index));
        Source {
            bounce: class.bounce,
            way: class.way,
            surface: material(class.surface),
            through: material(class.through),
            light: self.light(class.light),
        }
    }
}
