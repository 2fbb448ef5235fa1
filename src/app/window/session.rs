//! A window with an engine behind it: what it keeps, its events, and when the next frame is due.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event::WindowEvent;
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::cameras;
use super::controls::Controls;
use super::flight::Flight;
use super::judging::{Ending, Judging};
use super::overlay::Overlay;
use super::pace::{self, Pace};
use super::panel::Panel;
use super::screen::{Screen, physical_size};
use crate::app::failure::show;
use crate::app::scene::{Opened, SceneFlags};
use crate::components::Camera;
use crate::engine::{Engine, EngineError, Progress};
use crate::gpu::{Gpu, GpuError};
use crate::layout::film::FilmPixel;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// What a session starts from.
pub struct Opening {
    pub description: SceneDescription,
    /// The scene as it was read, to be watched.
    opened: Opened,
    flags: SceneFlags,
    /// The shaders to go on with, where a device was lost; else they are read.
    shaders: Option<Library>,
    /// Has the window look when something was saved.
    wake: EventLoopProxy<()>,
}

impl Opening {
    /// A scene as it was read.
    pub fn new(opened: Opened, flags: SceneFlags, wake: EventLoopProxy<()>) -> Self {
        Self { description: opened.description.clone(), opened, flags, shaders: None, wake }
    }

    /// Watches the scene's files and the shaders. The window does without if that can't be done.
    fn watch(&self, engine: &mut Engine, library: Library) {
        let wake = self.wake.clone();
        let sources = self.flags.sources(self.opened.clone(), library);
        let woken = move || {
            // A window that has gone has nothing to look at.
            let _ = wake.send_event(());
        };
        if let Err(error) = engine.watch(sources, woken) {
            show(&error);
        }
    }
}

/// All that lives as long as a device does.
pub struct Session {
    pub(super) window: Arc<Window>,
    pub(super) screen: Screen,
    pub(super) engine: Engine,
    pub(super) gpu: Arc<Gpu>,
    /// What to open again on another device.
    opening: Opening,
    /// The cameras as the scene's file has them.
    pub(super) homes: BTreeMap<String, Camera>,
    /// The shaders that are run, and those from before the last edit that changed what is traced.
    pub(super) shaders: Library,
    pub(super) old_shaders: Option<Library>,
    pub(super) judging: Option<Judging>,
    pub(super) ending: Ending,
    /// Before and after are shown side by side, where they were judged.
    pub(super) split: bool,
    pub(super) controls: Controls,
    pub(super) pace: Pace,
    pub(super) overlay: Overlay,
    pub(super) panel: Panel,
    pub(super) flight: Flight,
    /// Where the user is; the engine's camera follows.
    pub(super) view: Camera,
    /// The engine's camera does not follow yet.
    pub(super) view_moved: bool,
    /// A frame was drawn already.
    pub(super) started: bool,
    /// The engine has something to do.
    pub(super) working: bool,
    /// There is something to draw.
    pub(super) redraw: bool,
    pub(super) hidden: bool,
    pub(super) quit: bool,
    pub(super) progress: Option<Progress>,
    /// What failed when it was last tried, and why.
    pub(super) failures: BTreeMap<&'static str, String>,
    /// The film is to be saved once each pixel has a sample.
    pub(super) saving: bool,
    pub(super) notice_ends: Option<Instant>,
    pub(super) ui_again: Option<Instant>,
    pub(super) last_frame: Instant,
    /// When the film was last made to start anew.
    pub(super) film_began: Instant,
    /// What a frame takes besides tracing.
    pub(super) drawing: Duration,
    pub(super) titled: Option<Instant>,
}

impl Session {
    /// Opens a device for the window, and the scene on it.
    pub fn open(window: Arc<Window>, opening: Opening) -> Result<Session, EngineError> {
        let again = opening.shaders.is_some();
        let library = match &opening.shaders {
            Some(library) => library.clone(),
            None => opening.flags.library().map_err(GpuError::from)?,
        };
        let features = library.features().map_err(GpuError::from)?.into_iter().collect();
        let (gpu, screen) = Screen::open(&window, &library)?;
        let mut engine = Engine::open(gpu.clone(), library.clone(), &opening.description)?;
        engine.set_live(true);
        opening.watch(&mut engine, library.clone());
        if again {
            // Files may have come to be named since the scene was first read.
            engine.reload();
        }
        let (_, view) = engine.camera().ok_or(EngineError::NoCamera)?;
        let most_pixels = gpu.limits.max_storage_buffer_binding_size / size_of::<FilmPixel>() as u64;
        let panel = Panel::new(features, gpu.is_software());
        let now = Instant::now();
        Ok(Session {
            window,
            screen,
            engine,
            gpu,
            homes: opening.opened.description.cameras.clone(),
            opening,
            shaders: library,
            old_shaders: None,
            judging: None,
            ending: Ending::default(),
            split: false,
            controls: Controls::default(),
            pace: Pace::new(most_pixels),
            overlay: Overlay::default(),
            panel,
            flight: Flight::default(),
            view,
            view_moved: false,
            started: false,
            working: true,
            redraw: true,
            hidden: false,
            quit: false,
            progress: None,
            failures: BTreeMap::new(),
            saving: false,
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
        let name = self.name().to_owned();
        let description = self.engine.describe(&name);
        let mut opened = self.opening.opened.clone();
        if let Some(saved) = self.engine.saved_scene() {
            opened.description = saved.clone();
        }
        let shaders = Some(self.engine.library());
        self.end_judging();
        (self.window, Opening { description, opened, shaders, ..self.opening })
    }

    pub fn window(&self) -> &Window {
        &self.window
    }

    /// The scene's name.
    pub(super) fn name(&self) -> &str {
        &self.opening.description.name
    }

    pub(super) fn wake(&self) -> EventLoopProxy<()> {
        self.opening.wake.clone()
    }

    pub fn has_quit(&self) -> bool {
        self.quit
    }

    pub(super) fn quit(&mut self) {
        self.end_judging();
        self.quit = true;
    }

    /// The next step may find something to do.
    pub fn look_again(&mut self) {
        self.working = true;
        self.redraw |= self.judging.is_some();
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
        if let Some((_, view)) = self.engine.camera() {
            self.view = view;
            self.view_moved = false;
            self.flight = Flight::default();
            self.film_began = now;
            self.working = true;
        }
    }

    /// The largest extent of the scene; 1 for one without meshes.
    pub(super) fn scene_size(&mut self) -> f64 {
        let (low, high) = self.engine.bounds();
        let size = (high - low).length();
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
            self.act(intent);
        }
        Ok(())
    }

    fn shows_ui(&self) -> bool {
        self.panel.open || !self.overlay.is_empty() || self.judging.is_some()
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
        // Judging has the device to itself, and wakes the window when it has found something.
        let working = self.working && !self.judging.as_ref().is_some_and(Judging::is_under_way);
        if working || self.redraw || self.view_moved || flies {
            return Some(self.last_frame + pace::FRAME);
        }
        let pixel = self.pixel_under_pointer();
        let reading = self.panel.next_reading(&mut self.engine, pixel, self.film_began);
        [self.pace.settles_at(), self.notice_ends, self.ui_again, reading].into_iter().flatten().min()
    }
}
