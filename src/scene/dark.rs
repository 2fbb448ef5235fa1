//! Scenes whose picture will be black, since nothing in them sends out light: said where it is certain.

use std::collections::BTreeMap;
use std::path::Path;

use super::description::{MeshEntry, SceneDescription};
use super::diagnostic::{Diagnostic, Severity};
use super::mtl::MtlMaterial;
use crate::components::{Environment, PointLight};

/// Whether a surface or a light without extent sends out light.
pub fn is_lit(
    meshes: &BTreeMap<String, MeshEntry>,
    materials: &BTreeMap<String, MtlMaterial>,
    lights: &BTreeMap<String, PointLight>,
) -> bool {
    let mut used = meshes.values().filter_map(|mesh| materials.get(&mesh.material));
    used.any(|material| material.ke.max_element() > 0.0)
        || lights.values().any(|light| light.intensity.max_element() > 0.0)
}

/// A warning that nothing emits light, if so; `scene` is the file.
pub fn dark(description: &SceneDescription, scene: &Path) -> Option<Diagnostic> {
    let SceneDescription { meshes, materials, lights, environment, .. } = description;
    if is_lit(meshes, materials, lights) || environment.as_ref().is_some_and(sends_light) {
        return None;
    }
    let message = "nothing emits light: the picture will be black";
    let help = "add an `environment: Sky(sun: (45, 120))`, a light under `lights`, or a material with `ke`; \
                or see it by day with -D 'environment=Sky(sun: (45, 120))'";
    Some(Diagnostic::file(Severity::Warning, scene, message).help(help))
}

/// Whether any radiance comes from beyond the scene.
fn sends_light(environment: &Environment) -> bool {
    match environment {
        Environment::Constant(radiance) => radiance.max_element() > 0.0,
        Environment::Daylight(day) => day.strength > 0.0,
        Environment::Map { image, strength, tint, .. } => {
            let tint = *tint * *strength;
            image.pixels.iter().any(|radiance| (*radiance * tint).max_element() > 0.0)
        }
    }
}
