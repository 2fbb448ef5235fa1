//! A window with an engine behind it: one frame after the other.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::UVec2;
use winit::event::WindowEvent;
use winit::window::Window;

use super::cameras;
use super::controls::Controls;
use super::flight::Flight;
use super::navigate;
use super::overlay::Overlay;
use super::pace::{self, Pace};
use super::screen::{Screen, physical_size};
use crate::app::Failure;
use crate::app::failure::rendered;
use crate::components::{Camera, Film};
use crate::gpu::{Drawn, Fit, Gpu, GpuError};
use crate::layout::film::FilmPixel;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;
use crate::systems::state::{PackedScene, Spent};
use crate::systems::{Engine, EngineError, Progress};

/// A film that is moved on before each of its pixels has a sample gets so much time for it.
const FIRST_SAMPLE: Duration = Duration::from_millis(100);

/// Sizes of the scene a second, at full speed.
const FLIGHT_SPEED: f64 = 0.3;

/// A frame that takes longer does not make a flight longer.
const LONGEST_FRAME: Duration = Duration::from_millis(100);

/// Time between two changes of the title.
const TITLE: Duration = Duration::from_millis(500);

/// What a session starts from.
pub struct Opening {
    pub description: SceneDescription,
    /// The cameras as the scene's file has them.
    homes: BTreeMap<String, Camera>,
}

impl Opening {
    /// A scene as it was read.
    pub fn of(description: SceneDescription) -> Self {
        Self { homes: description.cameras.clone(), description }
    }
}

/// All that lives as long as a device does.
pub struct Session {
    pub(super) window: Arc<Window>,
    screen: Screen,
    pub(super) engine: Engine,
    pub(super) gpu: Arc<Gpu>,
    /// The scene's name.
    pub(super) name: String,
    pub(super) homes: BTreeMap<String, Camera>,
    pub(super) controls: Controls,
    pub(super) pace: Pace,
    pub(super) overlay: Overlay,
    flight: Flight,
    /// Where the person is; the engine's camera follows.
    pub(super) view: Camera,
    /// The engine's camera does not follow yet.
    pub(super) view_moved: bool,
    /// A frame was drawn already.
    started: bool,
    /// The engine has something to do.
    working: bool,
    /// There is something to draw.
    redraw: bool,
    hidden: bool,
    quit: bool,
    progress: Option<Progress>,
    /// Why the last step failed.
    failure: Option<String>,
    notice_ends: Option<Instant>,
    ui_again: Option<Instant>,
    last_frame: Instant,
    /// When the film was last made to start anew.
    film_began: Instant,
    /// What drawing a frame takes.
    drawing: Duration,
    titled: Option<Instant>,
}

impl Session {
    /// Opens a device for the window, and the scene on it.
    pub fn open(window: Arc<Window>, opening: Opening) -> Result<Session, EngineError> {
        let library = Library::shipped();
        let (gpu, screen) = Screen::open(&window, &library)?;
        let Opening { description, homes } = opening;
        let mut engine = Engine::open(gpu.clone(), library, &description)?;
        engine.set_live(true);
        let (_, view) = engine.edit(cameras::view).ok_or(EngineError::NoCamera)?;
        let most_pixels = gpu.limits.max_storage_buffer_binding_size / size_of::<FilmPixel>() as u64;
        let now = Instant::now();
        Ok(Session {
            window,
            screen,
            engine,
            gpu,
            name: description.name,
            homes,
            controls: Controls::default(),
            pace: Pace::new(most_pixels),
            overlay: Overlay::default(),
            flight: Flight::default(),
            view,
            view_moved: false,
            started: false,
            working: true,
            redraw: true,
            hidden: false,
            quit: false,
            progress: None,
            failure: None,
            notice_ends: None,
            ui_again: None,
            last_frame: now,
            film_began: now,
            drawing: Duration::ZERO,
            titled: None,
        })
    }

    /// Gives up the device. What stays is the window, and the scene with all edits and the view.
    pub fn dismantle(mut self) -> (Arc<Window>, Opening) {
        let view = self.view;
        self.engine.edit(|world| cameras::set_view(world, view));
        let description = self.engine.edit(|world| scene::describe(world, &self.name));
        (self.window, Opening { description, homes: self.homes })
    }

    pub fn window(&self) -> &Window {
        &self.window
    }

    pub fn has_quit(&self) -> bool {
        self.quit
    }

    pub(super) fn quit(&mut self) {
        self.quit = true;
    }

    /// The next step may find something to do.
    pub fn look_again(&mut self) {
        self.working = true;
    }

    /// Something is to be drawn anew.
    pub(super) fn draw_again(&mut self) {
        self.redraw = true;
    }

    /// Says something at the bottom of the window, for a while.
    pub(super) fn notify(&mut self, text: String) {
        self.overlay.notice = Some(text);
        self.notice_ends = Some(Instant::now() + Duration::from_secs(4));
        self.redraw = true;
    }

    /// The scene's cameras are other ones: the view is that of the rendered one.
    pub(super) fn take_view(&mut self, now: Instant) {
        if let Some((_, view)) = self.engine.edit(cameras::view) {
            self.view = view;
            self.view_moved = false;
            self.flight = Flight::default();
            self.film_began = now;
            self.working = true;
        }
    }

    /// The largest extent of the scene; 1 for one without meshes.
    pub(super) fn scene_size(&mut self) -> f64 {
        let size = self.engine.edit(|world| {
            let scene = world.resource::<PackedScene>();
            (scene.high - scene.low).length()
        });
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }

    /// Takes an event of the window: first the user interface, then the controls.
    pub fn event(&mut self, event: &WindowEvent) -> Result<(), EngineError> {
        match event {
            WindowEvent::Resized(_) => {
                self.screen.resize()?;
                let now = Instant::now();
                self.pace.moved(now);
                self.view_moved = true;
                self.redraw = true;
            }
            WindowEvent::Occluded(hidden) => {
                self.hidden = *hidden;
                self.redraw = true;
            }
            _ => {}
        }
        let response = self.screen.event(event);
        let visible = self.shows_ui();
        if visible {
            self.redraw |= response.repaint;
        } else {
            self.screen.forget_events();
        }
        if response.consumed && visible {
            self.controls.let_go(event);
        } else if let Some(intent) = self.controls.event(event, f64::from(physical_size(&self.window).y)) {
            self.act(intent)?;
        }
        Ok(())
    }

    fn shows_ui(&self) -> bool {
        !self.overlay.is_empty()
    }

    /// When the next frame is due; none while nothing changes.
    pub fn next_frame(&mut self, now: Instant) -> Option<Instant> {
        if self.notice_ends.is_some_and(|at| at <= now) {
            (self.notice_ends, self.overlay.notice) = (None, None);
            self.redraw = true;
        }
        if self.ui_again.is_some_and(|at| at <= now) {
            self.ui_again = None;
            self.redraw = true;
        }
        if self.hidden || physical_size(&self.window).min_element() == 0 {
            return None;
        }
        let flies = self.flight.is_under_way() || self.controls.flight() != glam::DVec3::ZERO;
        if self.working || self.redraw || self.view_moved || flies {
            return Some(self.last_frame + pace::FRAME);
        }
        [self.pace.settles_at(), self.notice_ends, self.ui_again].into_iter().flatten().min()
    }

    /// One frame: takes up what changed, traces for a while, draws.
    pub fn frame(&mut self) -> Result<(), EngineError> {
        let now = Instant::now();
        if physical_size(&self.window).min_element() == 0 {
            return Ok(());
        }
        let elapsed = now.duration_since(self.last_frame).min(LONGEST_FRAME);
        self.last_frame = now;
        if !self.started {
            // The first step compiles for a while: a window that says so comes before it.
            self.started = true;
            self.overlay.notice = Some("compiling shaders".to_owned());
            self.draw()?;
            self.overlay.notice = None;
            return Ok(());
        }
        self.fly(elapsed, now);
        self.follow_view(now);
        self.follow_window(now);
        if self.working {
            self.step()?;
        }
        self.draw()
    }

    /// Flies on, or comes to rest.
    fn fly(&mut self, elapsed: Duration, now: Instant) {
        let wanted = self.controls.flight();
        if wanted == glam::DVec3::ZERO && !self.flight.is_under_way() {
            return;
        }
        let speed = FLIGHT_SPEED * self.scene_size();
        let way = self.flight.advance(wanted, elapsed);
        self.view = navigate::fly(self.view, way * speed);
        self.view_moved = true;
        self.pace.moved(now);
    }

    /// Moves the engine's camera after the view, once there is a picture of where it was: a film that starts anew before
    /// it has any shows nothing.
    fn follow_view(&mut self, now: Instant) {
        let whole = self.progress.is_none_or(|progress| progress.spp >= 1);
        if !self.view_moved || !(whole || now.duration_since(self.film_began) > FIRST_SAMPLE) {
            return;
        }
        let view = self.view;
        self.engine.edit(|world| cameras::set_view(world, view));
        self.view_moved = false;
        self.set_film_size(self.pace.film_size(physical_size(&self.window)));
        self.film_began = now;
        self.working = true;
    }

    /// Gives the film the window's whole size, once nothing moves.
    fn follow_window(&mut self, now: Instant) {
        if self.pace.settle(now) || self.progress.is_none() {
            self.set_film_size(self.pace.film_size(physical_size(&self.window)));
        }
    }

    /// A film without a crop is as large as the window wants it; a crop is a part of a film of one size.
    fn set_film_size(&mut self, size: UVec2) {
        let changed = self.engine.edit(|world| {
            let mut films = world.query::<&mut Film>();
            let film = films.iter_mut(world).next().filter(|film| film.crop.is_none() && film.size != size);
            film.map(|mut film| film.size = size).is_some()
        });
        if changed {
            self.film_began = Instant::now();
            self.working = true;
        }
    }

    /// Runs the schedule once. What goes wrong is said once, and stays over the picture until a step succeeds.
    fn step(&mut self) -> Result<(), EngineError> {
        // Without the time of compiling, which is not that of samples.
        let traced = |engine: &mut Engine| engine.edit(|world| world.resource::<Spent>().trace);
        let before = traced(&mut self.engine);
        let budget = match self.pace.settles_at() {
            Some(_) => pace::MOVING_SAMPLE,
            None => pace::still_step(self.drawing),
        };
        match self.engine.step(budget) {
            Ok(progress) => {
                self.pace.learn(progress.samples, traced(&mut self.engine) - before);
                self.working = !progress.finished;
                self.progress = Some(progress);
                self.failure = None;
            }
            Err(EngineError::Gpu(error @ GpuError::Lost { .. })) => return Err(error.into()),
            Err(error) => {
                let failure = Failure::engine(error);
                let text = rendered(&*failure.report, false);
                if self.failure.as_ref() != Some(&text) {
                    failure.show();
                }
                self.failure = Some(text);
                // Until something changes, it would fail again.
                self.working = false;
            }
        }
        self.overlay.problems = self.failure.iter().cloned().collect();
        Ok(())
    }

    /// Draws the picture there is, and what lies over it.
    fn draw(&mut self) -> Result<(), EngineError> {
        let begin = Instant::now();
        let Session { screen, engine, overlay, .. } = self;
        let (paint, again) = screen.run_ui(|ui| overlay.show(ui.ctx()));
        let crop = engine.edit(|world| world.query::<&Film>().iter(world).any(|film| film.crop.is_some()));
        let fit = if crop { Fit::Letterbox } else { Fit::Fill };
        self.redraw = screen.draw(engine, fit, paint)? == Drawn::Later;
        // egui asks for nothing by the longest of times.
        self.ui_again = begin.checked_add(again).filter(|_| again < Duration::from_secs(3600));
        self.drawing = (self.drawing * 3 + begin.elapsed()) / 4;
        self.set_title();
        Ok(())
    }

    /// Says in the title how far the film is, twice a second and when it is finished.
    fn set_title(&mut self) {
        let Some(progress) = self.progress else { return };
        if !progress.finished && self.titled.is_some_and(|at| at.elapsed() < TITLE) {
            return;
        }
        self.titled = Some(Instant::now());
        let Progress { spp, target, .. } = progress;
        self.window.set_title(&format!("{}: {spp} of {target} spp (F1 for keys) - Lucerna", self.name));
    }
}
