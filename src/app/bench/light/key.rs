//! Numbers that stand for all that a picture depends on.

use crate::app::shared::key::hash;
use crate::components::{Integrator, Render, Sampler};
use crate::passes::trace::PATH;
use crate::scene::SceneDescription;
use crate::shader::{Library, ShaderError};

/// Of the picture that every unbiased estimate of a scene tends to: all of the description but its name, the exposure,
/// and how light is estimated.
pub fn scene_key(description: &SceneDescription) -> String {
    let mut plain = description.clone();
    plain.name.clear();
    plain.film.exposure = 0.0;
    let (integrator, sampler) = (Integrator::Path, Sampler::Pcg);
    plain.render = Render { integrator, sampler, roulette: false, seed: 0, spp: 1, ..plain.render };
    // Numbers are written so that they read back to the same bits.
    format!("{:016x}", hash(plain))
}

/// Of the scene, and of the shaders that trace it.
pub fn reference_key(description: &SceneDescription, library: &Library) -> Result<String, ShaderError> {
    let kernel = library.link(PATH.module, &library.features()?)?.text;
    Ok(format!("{:016x}", hash((scene_key(description), kernel))))
}
