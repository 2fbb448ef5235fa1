//! The window: its mathematics by themselves, and all of it on a display of its own.

mod beside;
#[cfg(target_os = "linux")]
mod display;
mod dock;
#[cfg(target_os = "linux")]
mod edits;
mod family;
mod files;
#[cfg(target_os = "linux")]
mod fine;
mod flight;
mod inspect;
mod keys;
mod legend;
#[cfg(target_os = "linux")]
mod lens;
mod live;
mod magnifier;
mod maps;
mod navigate;
#[cfg(target_os = "linux")]
mod own;
mod pace;
mod panel;
mod parameters;
#[cfg(target_os = "linux")]
mod person;
#[cfg(target_os = "linux")]
mod room;
#[cfg(target_os = "linux")]
mod save;
mod selection;
mod session;
#[cfg(target_os = "linux")]
mod states;
mod steady;
#[cfg(target_os = "linux")]
mod xvfb;
