//! The window: its mathematics by themselves, and all of it on a display of its own.

mod flight;
mod inspect;
mod keys;
mod live;
mod navigate;
mod pace;
#[cfg(target_os = "linux")]
mod person;
#[cfg(target_os = "linux")]
mod xvfb;
