//! The engine: the only door for command line and tests.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;

use super::compiling::CompileListener;
use super::governor::Governor;
use super::present;
use super::reload::{self, Problem, Reload, ReloadEvent, Sources, WatchError};
use super::report::{self, FilmImage, Report};
use super::schedule;
use super::state::{
    Batch, Budget, Device, Dirty, Fault, FilmProgress, Frame, Live, PackedScene, Pending, Spent, TreeBuilder, Viewed,
};
use crate::gpu::{Drawn, Fit, Gpu, GpuError, Paint, Runtime, Surface};
use crate::layout::view::ViewMode;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;

/// Why the engine cannot go on. It keeps the film it has; the next `step` tries again.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum EngineError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Gpu(#[from] GpuError),

    #[error("the scene has no camera")]
    #[diagnostic(help("add one under `cameras` in the scene file"))]
    NoCamera,

    #[error("the scene has no film")]
    NoFilm,

    #[error("the film's window is empty, or outside the film")]
    #[diagnostic(help("a crop is X0,X1,Y0,Y1 in pixels, with X0 < X1 and Y0 < Y1 within the size"))]
    EmptyFilm,

    #[error("the scene has {count} triangles; {most} are the most")]
    #[diagnostic(help("use a coarser model"))]
    TooManyTriangles { count: u64, most: u32 },
}

/// How far the film is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Samples that every pixel has.
    pub spp: u32,
    /// Samples every pixel is to have.
    pub target: u32,
    /// Samples of all pixels in this step.
    pub samples: u64,
    /// Dispatches of this step.
    pub dispatches: u64,
    /// Every pixel has all its samples.
    pub finished: bool,
}

/// Has everything sent and traced anew: what was packed may not have been sent, nor what was recorded have run.
pub(super) fn start_again(world: &mut World) {
    *world.resource_mut::<Pending>() = Pending::default();
    world.resource_mut::<PackedScene>().send_again();
    world.resource_mut::<Dirty>().film = true;
}

/// A world of entities, the schedule that runs on it, and the device it runs on.
pub struct Engine {
    world: World,
    schedule: Schedule,
}

impl Engine {
    /// Opens a scene. Nothing is traced yet.
    pub fn open(gpu: Arc<Gpu>, library: Library, description: &SceneDescription) -> Result<Engine, EngineError> {
        let mut world = World::new();
        world.insert_resource(TreeBuilder::of(&gpu));
        world.insert_resource(Device(Runtime::new(gpu, library)));
        world.init_resource::<CompileListener>();
        world.insert_resource(Budget(Duration::from_millis(100)));
        world.init_resource::<Fault>();
        world.init_resource::<PackedScene>();
        world.init_resource::<Pending>();
        world.init_resource::<Dirty>();
        world.init_resource::<FilmProgress>();
        world.init_resource::<Batch>();
        world.init_resource::<Frame>();
        world.init_resource::<Spent>();
        world.init_resource::<Live>();
        world.init_resource::<Viewed>();
        world.init_resource::<Governor>();
        // A film that was never reset is of size zero.
        world.resource_mut::<Dirty>().film = true;
        scene::apply(&mut world, description);
        Ok(Engine { world, schedule: schedule() })
    }

    /// Changes the world; the next step finds out what that changed.
    pub fn edit<R>(&mut self, change: impl FnOnce(&mut World) -> R) -> R {
        change(&mut self.world)
    }

    /// Times every pass from now on, where the device can.
    pub fn set_timing(&mut self, on: bool) {
        self.world.resource_mut::<Device>().0.set_timing(on);
    }

    /// Has the tree built by passes or twin from the next build on, whatever suits the device.
    pub fn set_tree_builder(&mut self, builder: TreeBuilder) {
        self.world.insert_resource(builder);
    }

    /// Has `told` called with true whenever a step begins to compile, and with false when that is over.
    pub fn on_compiling(&mut self, told: impl Fn(bool) + Send + Sync + 'static) {
        self.world.insert_resource(CompileListener::new(told));
    }

    /// Has the picture follow the film batch by batch from now on, or only once it is finished.
    pub fn set_live(&mut self, on: bool) {
        self.world.resource_mut::<Live>().0 = on;
    }

    /// Has the picture show something else from the next step on. The film goes on as it was.
    pub fn set_view(&mut self, mode: ViewMode) {
        self.world.resource_mut::<Viewed>().0 = mode;
    }

    /// What the picture is to show.
    pub fn view(&self) -> ViewMode {
        self.world.resource::<Viewed>().0
    }

    /// Draws the picture as it was last presented to a window of the engine's own device, and `paint` over it.
    pub fn draw(&self, surface: &mut Surface, fit: Fit, paint: Paint) -> Result<Drawn, EngineError> {
        let shown = present::shown(self.world.resource(), self.world.resource());
        Ok(surface.draw(&self.world.resource::<Device>().0, shown, fit, paint)?)
    }

    /// Runs the schedule once: takes up changes, and adds samples for about `budget`.
    pub fn step(&mut self, budget: Duration) -> Result<Progress, EngineError> {
        let before: u64 = self.dispatches().values().sum();
        let samples = self.world.resource::<Spent>().samples;
        self.world.resource_mut::<Budget>().0 = budget;
        *self.world.resource_mut::<Frame>() = Frame::default();
        self.schedule.run(&mut self.world);
        self.world.clear_trackers();
        if let Some(error) = self.world.resource_mut::<Fault>().0.take() {
            reload::go_back(&mut self.world, error).inspect_err(|_| start_again(&mut self.world))?;
        }
        let progress = *self.world.resource::<FilmProgress>();
        let target = self.world.resource::<PackedScene>().target;
        Ok(Progress {
            spp: progress.samples,
            target,
            samples: self.world.resource::<Spent>().samples - samples,
            dispatches: self.dispatches().values().sum::<u64>() - before,
            finished: progress.samples >= target,
        })
    }

    /// Takes up what is saved from now on, in every step. `wake` is called, from another thread, when the next step has
    /// something to take up.
    pub fn watch(&mut self, sources: Sources, wake: impl Fn() + Send + Sync + 'static) -> Result<(), WatchError> {
        let compiler = self.world.resource::<Device>().0.compiler();
        self.world.insert_resource(Reload::start(sources, compiler, Arc::new(wake))?);
        Ok(())
    }

    /// What happened to what was saved, since the last call; nothing without a watch.
    pub fn events(&mut self) -> Vec<ReloadEvent> {
        self.world.get_resource_mut::<Reload>().map(|mut reload| std::mem::take(&mut reload.events)).unwrap_or_default()
    }

    /// What is wrong with the saved files: the engine runs the last that were right.
    pub fn problems(&self) -> Vec<Problem> {
        let standing = self.world.get_resource::<Reload>().map(|reload| &reload.problems);
        standing.into_iter().flat_map(|all| all.code.iter().chain(&all.scene)).cloned().collect()
    }

    /// Whether the next step has something to take up.
    pub fn has_saves(&self) -> bool {
        self.world.get_resource::<Reload>().is_some_and(Reload::waits)
    }

    /// The scene as its files were last taken up.
    pub fn saved_scene(&self) -> Option<&SceneDescription> {
        self.world.get_resource::<Reload>()?.description.as_ref()
    }

    /// The shaders that are run.
    pub fn library(&self) -> Library {
        self.world.resource::<Device>().0.library().clone()
    }

    /// Has everything that is watched read again, changed or not.
    pub fn reload(&self) {
        if let Some(reload) = self.world.get_resource::<Reload>() {
            reload.force();
        }
    }

    /// How often each pass was dispatched since the engine opened.
    pub fn dispatches(&self) -> &BTreeMap<&'static str, u64> {
        self.world.resource::<Device>().0.dispatches()
    }

    /// Reads the film back, with its picture.
    pub fn film(&mut self) -> Result<FilmImage, EngineError> {
        report::read_film(&mut self.world)
    }

    /// Reads the mean radiance of the film's window back, row by row from the top: sooner done than the whole film.
    pub fn radiance(&mut self) -> Result<Vec<[f32; 3]>, EngineError> {
        report::read_radiance(&mut self.world)
    }

    /// What was done so far, and what it took.
    pub fn report(&mut self) -> Result<Report, EngineError> {
        report::read_report(&mut self.world)
    }
}
