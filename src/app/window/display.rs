//! Which display a window opens on. What the environment names may be a display that is long gone.

use winit::event_loop::EventLoop;

use super::reason::reason;
use crate::app::Failure;

/// There is nothing to open a window on.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("no display to open a window on: {0}")]
#[diagnostic(help("use `lucerna render`, which needs none"))]
struct NoDisplay(String);

/// Whether the environment names anything that a window could open on.
pub fn has_display() -> bool {
    cfg!(not(all(unix, not(target_os = "macos"))))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].iter().any(|name| is_set(name))
}

/// The window library's loop of events, on X where no Wayland compositor answers.
pub fn open() -> Result<EventLoop<()>, Failure> {
    let mut builder = EventLoop::builder();
    #[cfg(all(unix, not(target_os = "macos")))]
    if let Some(why) = super::wayland::silence() {
        use winit::platform::x11::EventLoopBuilderExtX11;
        if !is_set("DISPLAY") {
            return Err(Failure::of(NoDisplay(why)));
        }
        let opened = builder.with_x11().build();
        if opened.is_ok() {
            crate::app::shared::output::note(&format!("{why}; the window opens on X instead"));
        }
        return opened.map_err(|error| Failure::of(NoDisplay(format!("{why}; {}", reason(&error)))));
    }
    builder.build().map_err(|error| Failure::of(NoDisplay(reason(&error))))
}

fn is_set(name: &str) -> bool {
    std::env::var_os(name).is_some_and(|value| !value.is_empty())
}
