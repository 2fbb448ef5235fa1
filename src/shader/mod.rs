//! Linker, source map, validation and reflection of WGSL. Does not know wgpu.
//!
//! A module is a file below shaders/: `shaders/lib/rng.wgsl` is `lib/rng`, and says what it takes from others in WESL's
//! syntax, `import package::lib::rng::{next_2d};`. All names share one flat namespace: a module is included whole, once,
//! behind what it imports, and nothing in it moves, so that an error of naga has its place in the original file.
//! `package::gen` holds the structs and constants of [`crate::layout`]. `@if(feature)`, `@elif` and `@else` stand before
//! declarations, statements, struct members and parameters of functions. `override`, with or without our `@range`, declares what
//! is set while it runs ([`Parameter`]); `probe("name", value);` shows a number where somebody listens ([`Probe`]).

mod budget;
mod check;
mod conditional;
mod depth;
mod error;
mod feature_sets;
mod generated;
mod layers;
mod library;
mod link;
mod message;
mod module;
mod names;
mod parameter;
mod probe;
mod reflect;
mod seek;
mod site;
mod source_map;
mod stack;
mod token;
mod types;
mod values;

use std::collections::BTreeSet;

pub use budget::LOOP_FAULTS;
pub use check::BALLOTS;
pub use error::{ErrorKind, Place, ShaderError, Source};
pub use layers::Layers;
pub use library::Library;
pub use link::Linked;
pub use names::module_name;
pub use parameter::{Parameter, ParameterKind};
pub use probe::Probe;
pub use reflect::{BoundResource, EntryPoint, ResourceKind};
pub use stack::on_large_stack;
pub use values::{LinkedParameter, SHADER_VALUES};

/// Names of scene features, as `@if` knows them.
pub type Features = BTreeSet<String>;
