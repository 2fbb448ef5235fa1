//! `lucerna view`: a window that traces progressively, and lets a user move.
//!
//! The same schedule as headless: each frame takes up what changed, runs one step of the engine for a few milliseconds, and
//! draws the picture there is. A finished film of an unchanged scene does nothing at all: no step, no frame.
//!
//! | file | what it holds |
//! |---|---|
//! | `display`, `wayland` | which display it opens on |
//! | `reason` | why the window library failed, in words for a user |
//! | `application` | the window library's events, and when to wake |
//! | `session`, `frame` | a window with an engine: what it keeps; one frame |
//! | `viewpoint`, `tracing`, `activity`, `judgement`, `failures` | what a session keeps, by what it is about |
//! | `intents` | what each key and gesture does |
//! | `controls`, `keys` | events to intents; the table of keys |
//! | `navigate`, `flight`, `pace` | pure: moving a camera, flying smoothly, how large a film and how many frames |
//! | `screen`, `overlay` | drawing: surface and user interface; help, notice, problems |
//! | `saves`, `judge`, `judging` | what was saved meanwhile; whether it made the estimator better, worse or wrong |
//! | `panel` | numbers, curves, sliders |

pub mod activity;
mod application;
mod arguments;
mod cameras;
mod controls;
mod display;
mod failures;
pub mod flight;
mod frame;
mod intents;
mod judge;
mod judgement;
mod judging;
pub mod keys;
pub mod navigate;
mod overlay;
pub mod pace;
pub mod panel;
mod reason;
mod saves;
mod screen;
mod session;
mod snapshot;
pub mod tracing;
pub mod viewpoint;
#[cfg(all(unix, not(target_os = "macos")))]
mod wayland;

use super::{Exit, Failure};

use application::Application;
pub use arguments::ViewArguments;
pub use display::has_display;
use session::Opening;

/// The loop of events ended by itself.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("the window's events ended: {0}")]
struct Ended(winit::error::EventLoopError);

/// Opens a window on a scene, and returns once it is closed.
pub fn run(arguments: &ViewArguments) -> Result<Exit, Failure> {
    let events = display::open()?;
    let opened = arguments.flags.open(&arguments.scene, false)?;
    let wake = events.create_proxy();
    let mut application = Application::new(Opening::new(opened, arguments.flags.clone(), wake));
    events.run_app(&mut application).map_err(|error| Failure::of(Ended(error)))?;
    application.outcome()
}
