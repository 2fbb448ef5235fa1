//! The window: its mathematics by themselves, and all of it on a display of its own.

#[cfg(target_os = "linux")]
mod display;
#[cfg(target_os = "linux")]
mod edits;
mod family;
mod flight;
mod inspect;
#[cfg(target_os = "linux")]
mod judged;
mod keys;
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
mod record;
#[cfg(target_os = "linux")]
mod room;
mod rows;
mod session;
#[cfg(target_os = "linux")]
mod states;
#[cfg(target_os = "linux")]
mod xvfb;
