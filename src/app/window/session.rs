//! A window with an engine behind it: what it keeps, from the opening of a device to its end.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use glam::UVec2;
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::activity::Activity;
use super::cameras;
use super::controls::Controls;
use super::edits::Edits;
use super::errors::Errors;
use super::failures::Failures;
use super::family::{Family, Listing};
use super::judgement::Judgement;
use super::magnifier::Magnifier;
use super::opening::Opening;
use super::overlay::Overlay;
use super::pair::Pair;
use super::panel::Panel;
use super::paths::Paths;
use super::repeat::Shown;
use super::scene_file::Kept;
use super::screen::Screen;
use super::thumbs::Thumbs;
use super::tracing::Tracing;
use super::viewpoint::Viewpoint;
use crate::app::edits::PLACE;
use crate::app::shared::scene::Opened;
use crate::app::shared::textures::TextureNotices;
use crate::engine::{Engine, EngineError, FilmImage};
use crate::gpu::{Gpu, GpuError};
use crate::layout::film::FilmPixel;
use crate::scene::SceneDescription;

/// All that lives as long as a device does.
pub struct Session {
    pub(super) window: Arc<Window>,
    pub(super) screen: Screen,
    pub(super) engine: Engine,
    pub(super) gpu: Arc<Gpu>,
    /// What to open again on another device.
    opening: Opening,
    pub(super) judgement: Judgement,
    /// What was saved since the window opened.
    pub(super) edits: Edits,
    pub(super) controls: Controls,
    pub(super) overlay: Overlay,
    pub(super) panel: Panel,
    pub(super) viewpoint: Viewpoint,
    pub(super) magnifier: Magnifier,
    /// The name of the mesh that was clicked.
    pub(super) selected: Option<String>,
    /// The brightest paths of a pixel, over the picture.
    pub(super) paths: Paths,
    /// The pixel of the picture that is looked at.
    pub(super) pixel: Option<UVec2>,
    pub(super) tracing: Tracing,
    pub(super) activity: Activity,
    pub(super) failures: Failures,
    /// Where the film's error comes from, where that was asked.
    pub(super) errors: Errors,
    pub(super) textures: TextureNotices,
    /// The film is to be saved once each pixel has a sample.
    pub(super) saving: bool,
    /// The members of the family, where the scene is one of them.
    pub(super) members: Option<Listing>,
    pub(super) pair: Pair,
    pub(super) thumbs: Thumbs,
    /// The scene as it was last saved from here.
    pub(super) kept: Option<Kept>,
    /// A file that was saved from here, and is not taken up yet.
    pub(super) saved_here: Option<PathBuf>,
    /// When the title was last set.
    pub(super) titled: Option<Instant>,
}

impl Session {
    /// Opens a device for the window, and the scene on it.
    pub fn open(window: Arc<Window>, mut opening: Opening) -> Result<Session, EngineError> {
        let library = opening.shaders.clone();
        let features = library.features().map_err(GpuError::from)?.into_iter().collect();
        let (gpu, screen) = Screen::open(&window, &library)?;
        let mut engine = Engine::open(gpu.clone(), library.clone(), &opening.description)?;
        engine.set_live(true);
        engine.set_endless(!opening.flags.gives_samples());
        opening.watch(&mut engine, library.clone());
        if opening.again {
            // Files may have come to be named since the scene was first read.
            engine.reload();
        }
        let (_, view) = engine.camera().ok_or(EngineError::NoCamera)?;
        let most_pixels = gpu.limits.max_storage_buffer_binding_size / size_of::<FilmPixel>() as u64;
        let folder = opening.opened.path.parent().map(Path::to_path_buf).unwrap_or_default();
        let panel = Panel::new(opening.panel, features, gpu.is_software(), folder);
        let now = Instant::now();
        let edits = opening.edits.take().unwrap_or_else(|| {
            let wake = opening.wake.clone();
            let woken = move || {
                let _ = wake.send_event(());
            };
            Edits::new(&opening.description.name, library, PLACE.into(), opening.judges, woken)
        });
        Ok(Session {
            window,
            screen,
            engine,
            gpu,
            judgement: Judgement::default(),
            edits,
            controls: Controls::default(),
            overlay: Overlay::default(),
            panel,
            viewpoint: Viewpoint::new(view, opening.opened.description.cameras.clone()),
            magnifier: Magnifier::default(),
            selected: None,
            paths: Paths::default(),
            pixel: None,
            tracing: Tracing::new(most_pixels, now),
            activity: Activity::new(now),
            failures: Failures::default(),
            errors: Errors::default(),
            textures: TextureNotices::default(),
            saving: false,
            members: opening.family.as_ref().map(Family::listing),
            pair: Pair::default(),
            thumbs: Thumbs::default(),
            opening,
            kept: None,
            saved_here: None,
            titled: None,
        })
    }

    /// Gives up the device. What stays is the window, and the scene with all edits and the view.
    pub fn dismantle(mut self) -> (Arc<Window>, Opening) {
        let view = self.viewpoint.camera;
        self.engine.edit(|world| cameras::set_view(world, view));
        let name = self.name().to_owned();
        let description = self.engine.describe(&name);
        let mut opened = self.opening.opened.clone();
        if let Some(saved) = self.engine.saved_scene() {
            opened.description = saved.clone();
        }
        if let Some(text) = self.engine.saved_text() {
            opened.text = text.clone();
        }
        let shaders = self.engine.library();
        self.end_judging();
        let (panel, edits) = (self.panel.open, Some(self.edits));
        (self.window, Opening { description, opened, shaders, panel, again: true, edits, ..self.opening })
    }

    pub fn window(&self) -> &Window {
        &self.window
    }

    /// The scene's name; that of the member that is shown.
    pub(super) fn name(&self) -> &str {
        self.engine.saved_scene().map_or(&self.opening.description.name, |scene| &scene.name)
    }

    /// The scene as it was read first.
    pub(super) fn opened(&self) -> &Opened {
        &self.opening.opened
    }

    /// Whether the scene was found by its name.
    pub(super) fn is_found(&self) -> bool {
        self.opening.is_found
    }

    pub(super) fn family(&self) -> Option<&Family> {
        self.opening.family.as_ref()
    }

    /// What the window shows, as a film of it was read back.
    pub(super) fn shown<'a>(&'a self, scene: &'a SceneDescription, film: &'a FilmImage) -> Shown<'a> {
        let Opening { opened, flags, family, .. } = &self.opening;
        let saved = self.engine.saved_scene().unwrap_or(&opened.description);
        let (path, is_member) = (&*opened.path, family.is_some());
        Shown { path, is_member, saved, scene, flags, film, adapter: self.gpu.name() }
    }

    pub(super) fn wake(&self) -> EventLoopProxy<()> {
        self.opening.wake.clone()
    }

    pub fn has_quit(&self) -> bool {
        self.activity.quit
    }

    /// Has on the disk what is to outlive the window.
    pub fn finish(&self) {
        self.edits.flush();
    }

    pub(super) fn quit(&mut self) {
        self.end_judging();
        self.activity.quit = true;
    }

    /// The next step may find something to do.
    pub fn resume(&mut self) {
        if self.engine.has_saves() || self.engine.is_compiling_saves() {
            self.touch(Instant::now());
        }
        self.hear_keeper();
        self.show_judgement();
        self.activity.working = true;
    }

    /// Something is to be drawn anew.
    pub(super) fn draw_again(&mut self) {
        self.activity.redraw = true;
    }

    /// Says something at the bottom of the window, for a while.
    pub(super) fn notify(&mut self, text: String) {
        self.overlay.notify(text, Instant::now());
        self.draw_again();
    }

    /// The scene's cameras are other ones: the view is that of the rendered one.
    pub(super) fn follow_camera(&mut self, now: Instant) {
        if let Some((_, view)) = self.engine.camera() {
            self.viewpoint.rest_at(view);
            self.film_restarts(now);
        }
    }

    /// The film starts anew: there is something to trace.
    pub(super) fn film_restarts(&mut self, now: Instant) {
        self.tracing.began = now;
        self.tracing.pace.moved(now);
        self.activity.working = true;
    }

    /// The largest extent of the scene; 1 for one without meshes.
    pub(super) fn scene_size(&mut self) -> f64 {
        let (low, high) = self.engine.bounds();
        let size = (high - low).length();
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }
}
