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
//! | `opening`, `session` | what a session starts from; what it keeps: a window with an engine |
//! | `events`, `frame`, `draw` | an event of the window, and when the next frame is due; one frame; what it draws |
//! | `viewpoint`, `tracing`, `activity`, `judgement`, `failures` | what a session keeps, by what it is about |
//! | `intents` | what each key and gesture does |
//! | `snapshot`, `repeat` | saving what is seen; the command that gives it again |
//! | `controls`, `keys` | events to intents; the table of keys |
//! | `navigate`, `flight`, `pace` | pure: moving a camera, flying smoothly, how large a film and how many frames |
//! | `dock` | pure: what the window gives to the picture, and what to the panel |
//! | `placement` | where the picture lies, the size of its film, the pixel under the pointer |
//! | `selection`, `mark`, `outline` | the mesh that was clicked; its mark over the picture; pure: the edges of its box as the camera sees them |
//! | `path_tracing`, `paths`, `brightest` | the brightest paths of a pixel: asked for and taken away; over the picture; pure: which they are, and their lines |
//! | `legend` | what the colours of a view mean; drawn in the panel, and over the picture where that is closed |
//! | `magnifier` | pure: the picture's pixels as large squares |
//! | `screen`, `overlay` | drawing: surface and user interface; help, notice, problems |
//! | `beside` | drawing: two pictures with a divider between them |
//! | `errors`, `surveying` | where the film's error comes from, in the panel and over the picture; finding it out, frame by frame |
//! | `family`, `members`, `pair` | a variant file: its members, stepping through them, the last two side by side |
//! | `save_edits`, `scene_file` | what was changed goes into the scene's file |
//! | `saves`, `edits` | what was saved meanwhile; the record of it, kept and judged by itself |
//! | `judge`, `judging` | whether an edit made the estimator better, worse or wrong |
//! | `alike` | pure: when what was found of one scene holds for another |
//! | `panel` | numbers, curves, sliders |

pub mod activity;
pub mod alike;
mod application;
mod arguments;
pub mod beside;
pub mod brightest;
mod cameras;
mod controls;
mod display;
pub mod dock;
mod draw;
pub mod edits;
mod errors;
mod events;
mod failures;
pub mod family;
pub mod flight;
mod frame;
mod intents;
mod judge;
mod judgement;
mod judging;
pub mod keys;
pub mod legend;
pub mod magnifier;
mod mark;
mod members;
pub mod navigate;
mod opening;
pub mod outline;
mod overlay;
pub mod pace;
pub mod pair;
pub mod panel;
mod path_tracing;
mod paths;
mod placement;
mod reason;
mod repeat;
mod save_edits;
mod saves;
pub mod scene_file;
mod screen;
mod selection;
mod session;
mod snapshot;
mod surveying;
pub mod thumbs;
pub mod tracing;
pub mod viewpoint;
#[cfg(all(unix, not(target_os = "macos")))]
mod wayland;

use std::path::PathBuf;

use super::variants::find::find as find_variants;
use super::{Exit, Failure};
use crate::scene::variants::is_family;
use crate::scene::{self, Assets};

use application::Application;
pub use arguments::ViewArguments;
pub use display::has_display;
use family::Family;
use opening::Opening;

/// The loop of events ended by itself.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("the window's events ended: {0}")]
struct Ended(winit::error::EventLoopError);

/// Opens a window on a scene, and returns once it is closed.
pub fn run(arguments: &ViewArguments) -> Result<Exit, Failure> {
    let events = display::open()?;
    let (wake, flags) = (events.create_proxy(), arguments.flags.clone());
    let mut opening = match variant_file(&arguments.scene) {
        Some(path) => {
            let (family, opened, library) = Family::open(&path, &flags)?;
            Opening::new(opened, library, flags, wake).of_family(family)
        }
        None => {
            let opened = flags.open(&arguments.scene, false)?;
            let library = flags.library(&opened)?;
            Opening::new(opened, library, flags, wake).called(&arguments.scene)
        }
    };
    opening.panel = !arguments.no_panel;
    let mut application = Application::new(opening.judging(!arguments.no_judge));
    events.run_app(&mut application).map_err(|error| Failure::of(Ended(error)))?;
    application.outcome()
}

/// The variant file that a path or a name means; none where it means a scene, or nothing.
fn variant_file(name: &str) -> Option<PathBuf> {
    let path = scene::find(name).or_else(|_| find_variants(name)).ok()?;
    is_family(&path, &Assets::new()).then_some(path)
}
