//! Surface materials, by the names of the MTL format.

use std::path::PathBuf;

use bevy_ecs::prelude::*;
use glam::Vec3;

/// What a surface does with light. Linear Rec.709; every number finite.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Material {
    /// Diffuse reflectance, each channel at least 0.
    pub kd: Vec3,
    /// Reflectance of the specular lobe, each channel at least 0.
    pub ks: Vec3,
    /// Exponent of the Phong lobe, 0 to 1e5.
    pub ns: f32,
    /// `Pr`, 0 to 1: the specular lobe is GGX of alpha = roughness^2. Without it, it is the Phong lobe of `ns`,
    /// or what `illum` says.
    pub roughness: Option<f32>,
    /// `Pm`, 0 to 1: this part of `kd` is reflected by the specular lobe instead of diffusely.
    pub metallic: f32,
    /// Emitted radiance, each channel at least 0 (`Ke`, or `Le` in the Cornell box family of files).
    pub emission: Vec3,
    /// Light leaves the front side only (counter-clockwise winding seen from there). Off by default: winding in OBJ files
    /// is unreliable.
    pub one_sided: bool,
    /// Index of refraction, at least 1.
    pub ni: f32,
    /// Opacity, 0 to 1 (`d`, or 1 - `Tr`).
    pub dissolve: f32,
    /// Transmission filter, each channel 0 to 1.
    pub tf: Vec3,
    /// The file's illumination model, 0 to 10. What it means, [`Material::passage`] and [`Material::specular`] say.
    pub illum: u32,
    /// Image files of `map_*` statements.
    pub maps: TextureMaps,
}

impl Default for Material {
    /// A grey Lambert surface: what meshes get that name no material, or one that no library has.
    fn default() -> Self {
        Self {
            kd: Vec3::splat(0.6),
            ks: Vec3::ZERO,
            ns: 1.0,
            roughness: None,
            metallic: 0.0,
            emission: Vec3::ZERO,
            one_sided: false,
            ni: 1.0,
            dissolve: 1.0,
            tf: Vec3::ONE,
            illum: 1,
            maps: TextureMaps::default(),
        }
    }
}

/// Image files a material names, resolved against the folder of its MTL file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextureMaps {
    pub kd: Option<PathBuf>,
    pub ks: Option<PathBuf>,
    pub ns: Option<PathBuf>,
    pub ke: Option<PathBuf>,
    pub dissolve: Option<PathBuf>,
    pub bump: Option<PathBuf>,
}
