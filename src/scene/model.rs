//! What every importer of models yields, whatever format it reads.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::bounds::Bounds;
use super::diagnostic::{Diagnostic, Diagnostics};
use super::mtl::MtlMaterial;
use crate::components::MeshData;

/// The greatest coordinate of a model, and in world space: its cube, which a determinant needs, is within f32.
pub const FARTHEST: f64 = 1e12;

/// The name of the material of meshes without one.
pub const DEFAULT_MATERIAL: &str = "default";

/// What came of reading a model's file.
#[derive(Clone, Debug, Default)]
pub struct Imported {
    /// None where it can't be used; a message says why.
    pub model: Option<Model>,
    pub messages: Diagnostics,
    /// Every file that was read or looked for.
    pub files: Vec<PathBuf>,
}

/// A model: its meshes, and the materials that they use.
#[derive(Clone, Debug, Default)]
pub struct Model {
    pub meshes: Vec<ModelMesh>,
    /// By the names that the meshes have.
    pub materials: BTreeMap<String, MtlMaterial>,
    /// The library that each material is of, where one has it.
    pub sources: BTreeMap<String, Arc<Path>>,
    /// By the files that maps name: the first statement that does, as a warning without its message.
    pub map_places: BTreeMap<PathBuf, Diagnostic>,
    /// Model space.
    pub bounds: Bounds,
}

/// One mesh of a model, of one material.
#[derive(Clone, Debug)]
pub struct ModelMesh {
    /// `object/3`: the object's name, and the number of this mesh within it. Unique within the model.
    pub name: String,
    /// A key of the model's materials.
    pub material: String,
    /// Model space.
    pub geometry: Arc<MeshData>,
}
