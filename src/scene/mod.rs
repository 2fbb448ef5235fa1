//! Asset files to entities, with located diagnostics. Does not know the GPU.
//!
//! [`load`] reads a scene file (RON) or a bare OBJ file with all it names into a [`SceneDescription`]; [`apply`] makes a
//! world hold it, touching only what differs; [`describe`] is the way back; [`check`] reads any asset and keeps only the messages.
//!
//! Whatever a file can't be taken at its word for is an error or a warning at its line and column, never a silent default.

mod animate;
mod apply;
mod assets;
mod audit;
mod bounds;
mod check;
mod dark;
mod define;
mod describe;
mod description;
mod diagnostic;
pub mod edit;
mod environment;
mod file;
mod find;
mod framing;
pub mod generate;
mod keys;
mod kind;
mod lights;
mod lines;
mod load;
mod locate;
mod mapped;
mod model;
mod mtl;
mod obj;
mod place;
mod printable;
mod read;
mod ron;
pub mod schema;
pub mod settings;
mod sky;
mod source;
mod suggest;
mod text;
mod textures;
mod triangulate;
mod turn;
mod unseen;
pub mod variants;

pub use apply::{apply, apply_changes};
pub use assets::Assets;
pub use audit::{Audit, Audited, audit, audits};
pub use check::{Asked, Checked, Row, Table, check};
pub use define::{Define, Written};
pub use describe::describe;
pub use description::{MeshEntry, SceneDescription};
pub use diagnostic::{Diagnostic, Diagnostics, Severity};
pub use file::ShaderPlace;
pub use find::{find, names};
pub use framing::reframe;
pub use keys::{Colour, KEYS, Key, Range, Value};
pub use load::{Loaded, Origin, attempt, attempt_in, load, load_with};
pub use mtl::{Appearance, Fate, MtlMaterial, TextureMap, TextureMaps, Verdict};
pub use obj::{NamedMeshes, read_obj_by};
pub use printable::{printable, printable_name};
pub use source::SceneText;
pub use suggest::did_you_mean;
pub use textures::{Loading, MapUse, name as texture_name};
pub use triangulate::triangulate;
pub use unseen::unseen_by;
