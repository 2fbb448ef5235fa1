//! Numbers that stand for all that a picture depends on.

use crate::app::shared::key::{hash, scene_key};
use crate::passes::trace::PATH;
use crate::scene::SceneDescription;
use crate::shader::{Library, ShaderError};

/// Of the scene, and of the shaders that trace it.
pub fn reference_key(description: &SceneDescription, library: &Library) -> Result<String, ShaderError> {
    let kernel = library.link(PATH.module, &library.features()?)?;
    // The text has no values of parameters.
    let declared: Vec<String> = kernel.parameters.iter().map(|own| own.parameter.to_string()).collect();
    Ok(format!("{:016x}", hash((scene_key(description), kernel.text, declared))))
}
