//! The window: its mathematics by themselves, and all of it on a display of its own.

mod alike;
mod beside;
#[cfg(target_os = "linux")]
mod display;
mod dock;
#[cfg(target_os = "linux")]
mod edits;
mod errors;
mod family;
mod files;
#[cfg(target_os = "linux")]
mod fine;
mod flight;
mod inspect;
#[cfg(target_os = "linux")]
mod judged;
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
mod paths;
#[cfg(target_os = "linux")]
mod person;
mod probes;
mod record;
#[cfg(target_os = "linux")]
mod room;
mod rows;
#[cfg(target_os = "linux")]
mod save;
mod selection;
mod session;
#[cfg(target_os = "linux")]
mod states;
mod steady;
#[cfg(target_os = "linux")]
mod xvfb;
