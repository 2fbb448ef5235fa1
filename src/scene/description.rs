//! A whole scene as plain data: what files come to, and what a world is made to hold.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::mtl::MtlMaterial;
use crate::components::{Camera, Environment, Film, MeshData, PointLight, Render, ShaderValues, Texture, Transform};

/// A whole scene as plain data, every name a stable key: equal files give equal descriptions.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDescription {
    /// The scene file's stem.
    pub name: String,
    /// By `model/object/part`.
    pub meshes: BTreeMap<String, MeshEntry>,
    /// By `model:material`.
    pub materials: BTreeMap<String, MtlMaterial>,
    /// By the names that the materials' maps come to ([`textures::name`](super::textures::name)): those that could be read.
    pub textures: BTreeMap<String, Texture>,
    /// By the name in the scene file; never empty.
    pub cameras: BTreeMap<String, Camera>,
    /// The camera that is rendered, a key of `cameras`.
    pub active: String,
    /// By the name in the scene file.
    pub lights: BTreeMap<String, PointLight>,
    pub film: Film,
    pub render: Render,
    /// Of the shaders' parameters, as far as the scene sets them.
    pub shader: ShaderValues,
    /// `None` is black.
    pub environment: Option<Environment>,
}

/// One mesh: its geometry may be shared with others.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshEntry {
    pub geometry: Arc<MeshData>,
    pub transform: Transform,
    /// A key of the description's materials.
    pub material: String,
}
