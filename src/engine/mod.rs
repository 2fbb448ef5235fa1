//! The engine: the only door for command line and tests. A scene is opened, edited, read, stepped and shown.

mod debug;
mod film;
mod inspect;
mod mesh;
mod paths;
mod probe;
mod read;
mod replay;
mod report;
mod sources;
mod spared;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2, Vec4};

pub use crate::cpu::film::FilmSum;
pub use crate::cpu::film_error::{ErrorSums, FilmError};
pub use crate::cpu::robust::{RobustFilm, Worst};
pub use crate::gpu::{DeviceMemory, Held};
pub use crate::systems::EngineError;
pub use crate::systems::resources::{Probing, Spared, Spent, TextureUse, TileCounts, TreeBuilder};
pub use debug::DebugRange;
pub use film::{FilmImage, FilmPart};
pub use inspect::{Inspected, LookedUp, Seen};
pub use mesh::MeshExtent;
pub use paths::TracedPath;
pub use replay::{ProbedNumber, ProbedValue, Replay, TrianglePlace};
pub use report::Report;
pub use sources::{ErrorSources, Most, Source, SourceMap, Survey, Surveyed};

use crate::components::{self, Camera, Film, Render};
use crate::gpu::{Code, Drawn, Gpu, GpuError, Paint, Placement, Runtime, Surface};
use crate::layout::view::ViewMode;
use crate::scene::{self, SceneDescription, SceneText};
use crate::shader::{Library, Parameter, Probe};
use crate::systems::resources::{
    Budget, CompileListener, Device, Endless, FilmProgress, Frame, General, Live, MaterialSlot, ProbeChosen, Robust,
    SceneGeometry, Shot, Sky, SkySource, Target, Textures, Viewed,
};
use crate::systems::{self, Fault, Reload};
use crate::watch::{Problem, ReloadEvent, Sources, WatchError};

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
    /// Every pixel has all its samples, or is to get no more.
    pub finished: bool,
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
        systems::insert_resources(&mut world);
        world.insert_resource(TreeBuilder::of(&gpu));
        world.insert_resource(Device(Runtime::new(gpu, library)));
        world.insert_resource(Budget(Duration::from_millis(100)));
        scene::apply(&mut world, description);
        Ok(Engine { world, schedule: systems::schedule() })
    }

    /// Makes the scene another one, touching only what differs; the next step finds out what that changed.
    pub fn apply(&mut self, description: &SceneDescription) {
        self.edit(|world| scene::apply(world, description));
    }

    /// The passes in use as another library has them, to be [`run`](Self::run). Compiles what is other code, and disturbs nothing.
    pub fn remake(&self, library: Library) -> Result<Code, EngineError> {
        Ok(self.world.resource::<Device>().0.compiler().remake(library, &BTreeSet::new(), &|_| {})?)
    }

    /// Runs other code from now on; what runs the same code keeps tree and film. Returns the code that was run until now, with all
    /// that was compiled of it, so that nothing is compiled again where it is run once more.
    pub fn run(&mut self, code: Code) -> Code {
        systems::run_code(&mut self.world, code)
    }

    /// How many pipelines of each pass were compiled since the engine opened.
    pub fn compiled(&self) -> BTreeMap<&'static str, u64> {
        self.world.resource::<Device>().0.compiler().compiled()
    }

    /// Seconds that were spent on tracing the film that there is.
    pub fn film_seconds(&self) -> f64 {
        self.spent().film
    }

    /// Changes the scene; the next step finds out what that changed.
    pub fn edit<R>(&mut self, change: impl FnOnce(&mut World) -> R) -> R {
        change(&mut self.world)
    }

    /// Reads the scene.
    pub fn read<R>(&self, read: impl FnOnce(&World) -> R) -> R {
        read(&self.world)
    }

    /// The scene as it is now, edits included.
    pub fn describe(&self, name: &str) -> SceneDescription {
        scene::describe(&self.world, name)
    }

    /// Name and view of the camera that is rendered.
    pub fn camera(&self) -> Option<(String, Camera)> {
        let mut cameras = self.world.try_query::<components::CameraItem>()?;
        let (_, name, camera) = components::rendered_camera(cameras.iter(&self.world))?;
        Some((name.as_str().to_owned(), *camera))
    }

    /// The film and its settings.
    pub fn settings(&self) -> Option<(Film, Render)> {
        let mut films = self.world.try_query::<(&Film, &Render)>()?;
        films.iter(&self.world).next().map(|(film, render)| (*film, *render))
    }

    /// World space box of all meshes as they were last extracted, scene units; low above high without any.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let geometry = self.world.resource::<SceneGeometry>();
        (geometry.low, geometry.high)
    }

    /// Pixels of the rendered window, as it was last extracted.
    pub fn window_size(&self) -> UVec2 {
        self.world.resource::<Shot>().size()
    }

    /// All parameters that shaders declare, by name.
    pub fn parameters(&self) -> Arc<[Parameter]> {
        self.world.resource::<Device>().0.parameters().clone()
    }

    /// Whether a pass that runs for this scene reads a parameter: known once a step has compiled them.
    pub fn reads(&self, parameter: &str) -> bool {
        self.world.resource::<Device>().0.is_read(parameter)
    }

    /// Shader features that the scene needs, as it was last extracted.
    pub fn features(&self) -> &BTreeSet<String> {
        &self.world.resource::<Shot>().features
    }

    /// Has the trace kernels of later steps compiled with all that can be compiled in where a scene has no use for it; the film starts anew where
    /// that is a change. What that costs is what a scene without it saves.
    pub fn set_general(&mut self, on: bool) {
        self.world.resource_mut::<General>().set_if_neq(General(on));
    }

    /// Has samples summed in blocks too, beside the film, so that a robust mean can be told; or no longer. Where that begins the film starts anew,
    /// and is the same film.
    pub fn set_robust(&mut self, on: bool) {
        if self.world.resource_mut::<Robust>().set_if_neq(Robust(on)) && on {
            self.restart_film();
        }
    }

    /// Whether samples are summed in blocks too.
    pub fn is_robust(&self) -> bool {
        self.world.resource::<Robust>().0
    }

    /// Seconds and samples since the engine opened.
    pub fn spent(&self) -> Spent {
        *self.world.resource::<Spent>()
    }

    /// Samples that every pixel has, and how many it is to have.
    pub fn samples(&self) -> (u32, u32) {
        (film::progress(&self.world).samples, self.world.resource::<Target>().0)
    }

    /// What the textures take on the device, as they were last extracted, by name.
    pub fn textures(&self) -> &[TextureUse] {
        &self.world.resource::<Textures>().uses
    }

    /// The size of the environment's picture, and how often its sides were halved for want of room on the device, where they were.
    pub fn halved_sky(&self) -> Option<(UVec2, u32)> {
        let sky = self.world.resource::<Sky>();
        match &sky.source {
            Some(SkySource::Map(image, _)) if sky.halvings > 0 => Some((image.size, sky.halvings)),
            _ => None,
        }
    }

    /// Has the film start anew in the next step.
    pub fn restart_film(&mut self) {
        systems::restart_film(&mut self.world);
    }

    /// Has films go on from the next step on for as long as they are let, or only to the samples that their settings say.
    pub fn set_endless(&mut self, on: bool) {
        self.world.resource_mut::<Endless>().set_if_neq(Endless(on));
    }

    /// Whether films go on for as long as they are let.
    pub fn is_endless(&self) -> bool {
        self.world.resource::<Endless>().0
    }

    /// Leaves the film at the samples it has, until it starts anew; or lets it go on.
    pub fn rest(&mut self, on: bool) {
        self.edit(|world| world.query::<&mut FilmProgress>().iter_mut(world).for_each(|mut film| film.rests = on));
    }

    /// The error that the picture of the film is estimated to have, root mean square, in codes of 8 bits.
    pub fn picture_error(&self) -> Result<f64, EngineError> {
        film::picture_error(&self.world)
    }

    /// What one pixel of the picture holds and sees; none if there is no such pixel, or nothing was traced yet.
    pub fn inspect(&mut self, pixel: UVec2) -> Result<Option<Inspected>, EngineError> {
        inspect::inspect(&mut self.world, pixel)
    }

    /// A film sample of a pixel of the whole film, traced again, with all that happens on its way; none if there is no such pixel, or no step
    /// has built the tree yet. The film stays as it is.
    pub fn replay(&mut self, pixel: UVec2, sample: u32) -> Result<Option<Replay>, EngineError> {
        Ok(self.replay_all(&[(pixel, sample)])?.pop())
    }

    /// The same of several, sooner than one by one: those that there are.
    pub fn replay_all(&mut self, samples: &[(UVec2, u32)]) -> Result<Vec<Replay>, EngineError> {
        replay::replay_samples(&mut self.world, samples)
    }

    /// Film samples of a pixel of the whole film, traced again by the kernel alone: sooner than [`replay_all`](Self::replay_all), which also asks the twin.
    /// Nothing if there is no such pixel, or no step has built the tree yet.
    pub fn trace_paths(&mut self, pixel: UVec2, samples: Range<u32>) -> Result<Vec<TracedPath>, EngineError> {
        paths::trace_paths(&mut self.world, pixel, samples)
    }

    /// Of each point, world space, whether something hides it from the camera.
    pub fn hidden(&mut self, points: &[DVec3]) -> Result<Vec<bool>, EngineError> {
        paths::hidden(&mut self.world, points)
    }

    /// What is known of the mesh of a name, as it was last extracted; none if there is no such mesh.
    pub fn mesh(&self, name: &str) -> Option<MeshExtent> {
        mesh::extent(&self.world, name)
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

    /// The distance from the camera that view "depth" shows as half, scene units, as the scene was last extracted.
    pub fn view_reach(&self) -> f32 {
        systems::present::reach(self.world.resource::<SceneGeometry>())
    }

    /// The materials' names, in the order of the numbers that view "material ids" shows.
    pub fn material_names(&self) -> Vec<String> {
        let Some(mut materials) = self.world.try_query::<(&components::Name, &MaterialSlot)>() else {
            return Vec::new();
        };
        let mut named: Vec<_> = materials.iter(&self.world).map(|(name, slot)| (slot.0, name.to_string())).collect();
        named.sort();
        named.into_iter().map(|(_, name)| name).collect()
    }

    /// What shaders showed of themselves, row by row from the top, linear, with 1 behind each colour and all 0 where there is none; none
    /// unless that is what the picture shows.
    pub fn debug_colours(&self) -> Result<Option<Vec<Vec4>>, EngineError> {
        debug::read_debug(&self.world)
    }

    /// All names that shaders show numbers by (`probe("name", value)`), in order.
    pub fn probes(&self) -> Arc<[Probe]> {
        self.world.resource::<Device>().0.probes().clone()
    }

    /// Chooses the name that view "probe" shows, and how it is looked at, from the next step on; or none. Another one compiles nothing.
    pub fn set_probe(&mut self, probing: Option<Probing>) {
        probe::choose(&mut self.world, probing);
    }

    /// The name that is chosen.
    pub fn probing(&self) -> Option<&Probing> {
        self.world.resource::<ProbeChosen>().0.as_ref()
    }

    /// The numbers of the chosen name, row by row from the top, with 1 + its type behind each, and all 0 where there is none; none unless that is what
    /// the picture shows.
    pub fn probe_values(&self) -> Result<Option<Vec<Vec4>>, EngineError> {
        probe::read_values(&self.world)
    }

    /// The same of the first sample of one pixel of the picture, by bounce; none where no name is chosen that code has, or there is no such pixel,
    /// or no step has built the tree yet.
    pub fn probe_pixel(&mut self, pixel: UVec2) -> Result<Option<Vec<Vec4>>, EngineError> {
        probe::of_pixel(&mut self.world, pixel)
    }

    /// Draws the picture as it was last presented to a window of the engine's own device, and `paint` over it.
    pub fn draw(&self, surface: &mut Surface, placement: Placement, paint: Paint) -> Result<Drawn, EngineError> {
        // Of a film that starts anew there is nothing yet, or what a step left that failed.
        let size = film::progress(&self.world).shown.map(|_| self.window_size());
        Ok(surface.draw(&self.world.resource::<Device>().0, size, placement, paint)?)
    }

    /// Runs the schedule once: takes up changes, and adds samples for about `budget`.
    pub fn step(&mut self, budget: Duration) -> Result<Progress, EngineError> {
        let start = Instant::now();
        let before: u64 = self.dispatches().values().sum();
        let samples = self.world.resource::<Spent>().samples;
        self.world.resource_mut::<Budget>().0 = budget;
        *self.world.resource_mut::<Frame>() = Frame::default();
        self.schedule.run(&mut self.world);
        self.world.clear_trackers();
        self.world.resource_mut::<Spent>().steps += start.elapsed().as_secs_f64();
        if let Some(error) = self.world.resource_mut::<Fault>().0.take() {
            systems::go_back(&mut self.world, error).inspect_err(|error| {
                if matches!(error, EngineError::Gpu(GpuError::OutOfMemory { .. })) {
                    systems::release_film(&mut self.world);
                }
                systems::start_again(&mut self.world);
            })?;
        }
        let (spp, target) = self.samples();
        Ok(Progress {
            spp,
            target,
            samples: self.world.resource::<Spent>().samples - samples,
            dispatches: self.dispatches().values().sum::<u64>() - before,
            finished: spp >= target || film::progress(&self.world).rests,
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

    /// Whether steps from now on leave what was saved where it is: for who has to look at what is there before it goes.
    pub fn hold_saves(&mut self, held: bool) {
        if let Some(mut reload) = self.world.get_resource_mut::<Reload>() {
            reload.held = held;
        }
    }

    /// The scene as its files were last taken up.
    pub fn saved_scene(&self) -> Option<&SceneDescription> {
        self.world.get_resource::<Reload>()?.description.as_ref()
    }

    /// The text of the scene's own file, as it was when that was last taken up.
    pub fn saved_text(&self) -> Option<&SceneText> {
        Some(&self.world.get_resource::<Reload>()?.text)
    }

    /// The shaders that are run.
    pub fn library(&self) -> Library {
        self.world.resource::<Device>().0.library().clone()
    }

    /// Whether something that was saved is being compiled.
    pub fn is_compiling_saves(&self) -> bool {
        self.world.get_resource::<Reload>().is_some_and(Reload::compiles)
    }

    /// Has shaders that ran before compiled and run again, as if they were saved, while the files stay as they are: the next save goes on from
    /// those. Nothing without a watch.
    pub fn run_again(&self, library: Library) {
        if let Some(reload) = self.world.get_resource::<Reload>() {
            reload.run_again(library, &self.library());
        }
    }

    /// Has everything that is watched read again, changed or not.
    pub fn reload(&self) {
        if let Some(reload) = self.world.get_resource::<Reload>() {
            reload.force();
        }
    }

    /// Has the scene read again, at once: another one is wanted of what reads it.
    pub fn choose_scene(&self) {
        if let Some(reload) = self.world.get_resource::<Reload>() {
            reload.choose();
        }
    }
}
