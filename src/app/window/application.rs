//! The window library's events: to the session, and when to wake next.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

use super::dock;
use super::opening::Opening;
use super::reason::reason;
use super::session::Session;
use crate::app::shared::interrupt::end;
use crate::app::shared::output;
use crate::app::{Exit, Failure};
use crate::engine::EngineError;
use crate::gpu::GpuError;

/// A device that is lost twice within this is not opened a third time.
const PATIENCE: Duration = Duration::from_secs(10);

/// No window can be made.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("no window could be opened: {0}")]
#[diagnostic(help("use `lucerna render`, which needs none"))]
struct NoWindow(String);

/// The one window, from its opening to its end.
pub struct Application {
    /// What to open, until it is.
    opening: Option<Opening>,
    session: Option<Session>,
    lost: Option<Instant>,
    failure: Option<Failure>,
}

impl Application {
    /// Nothing is opened yet.
    pub fn new(opening: Opening) -> Self {
        Self { opening: Some(opening), session: None, lost: None, failure: None }
    }

    /// How it ended.
    pub fn outcome(self) -> Result<Exit, Failure> {
        self.failure.map_or(Ok(Exit::Done), Err)
    }

    fn fail(&mut self, events: &ActiveEventLoop, failure: Failure) {
        self.session = None;
        self.failure.get_or_insert(failure);
        events.exit();
    }

    /// Runs something of the session. A lost device is opened again, once.
    fn with_session(&mut self, events: &ActiveEventLoop, act: impl FnOnce(&mut Session) -> Result<(), EngineError>) {
        let Some(session) = &mut self.session else { return };
        match act(session) {
            Ok(()) => {}
            Err(EngineError::Gpu(GpuError::Lost { reason })) if self.lost.is_none_or(|at| at.elapsed() > PATIENCE) => {
                output::note(&format!("the device was lost: {reason}; opening it again"));
                self.lost = Some(Instant::now());
                self.reopen(events);
            }
            Err(error) => self.fail(events, Failure::engine(error)),
        }
    }

    /// A new device and a new engine in the same window. The scene is kept as it was edited; samples are not.
    fn reopen(&mut self, events: &ActiveEventLoop) {
        let Some((window, opening)) = self.session.take().map(Session::dismantle) else { return };
        match Session::open(window, opening) {
            Ok(session) => self.session = Some(session),
            Err(error) => self.fail(events, Failure::engine(error)),
        }
    }
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(mut opening) = self.opening.take() else { return };
        let window = match events.create_window(attributes(events, &mut opening)) {
            Ok(window) => Arc::new(window),
            Err(error) => return self.fail(events, Failure::of(NoWindow(reason(&error)))),
        };
        match Session::open(window, opening) {
            Ok(session) => self.session = Some(session),
            Err(error) => self.fail(events, Failure::engine(error)),
        }
    }

    /// A wake-up from elsewhere: something outside may have changed, and a step of the engine finds out.
    fn user_event(&mut self, _: &ActiveEventLoop, (): ()) {
        if let Some(session) = &mut self.session {
            session.resume();
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::RedrawRequested => self.with_session(events, Session::frame),
            event => self.with_session(events, |session| session.event(&event)),
        }
        if self.session.as_ref().is_some_and(Session::has_quit) {
            events.exit();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let Some(session) = &mut self.session else { return };
        let now = Instant::now();
        events.set_control_flow(match session.next_frame(now) {
            Some(at) if at > now => ControlFlow::WaitUntil(at),
            Some(_) => {
                session.window().request_redraw();
                ControlFlow::Wait
            }
            None => ControlFlow::Wait,
        });
    }

    /// Nothing is left to be saved but the last edit: compilers, judges and drivers, which may take seconds to come to an end, are not waited for.
    fn exiting(&mut self, _: &ActiveEventLoop) {
        if let Some(session) = &self.session {
            session.finish();
        }
        if self.failure.is_none() {
            end(Exit::Done);
        }
        // The surface goes before the window library's connection does.
        self.session = None;
    }
}

/// A window for the film, and the panel beside it where the screen has room for both.
fn attributes(events: &ActiveEventLoop, opening: &mut Opening) -> winit::window::WindowAttributes {
    let monitor = events.primary_monitor().or_else(|| events.available_monitors().next());
    let screen = monitor.filter(|monitor| monitor.size() != PhysicalSize::default()).map(|monitor| {
        let room: LogicalSize<f64> = monitor.size().to_logical(monitor.scale_factor());
        [room.width, room.height]
    });
    let film = opening.description.film.window().size();
    let dock::Opened { size: [width, height], panel } = dock::opened(film, screen, opening.panel);
    opening.panel = panel;
    Window::default_attributes().with_title("Lucerna").with_inner_size(LogicalSize::new(width, height))
}
