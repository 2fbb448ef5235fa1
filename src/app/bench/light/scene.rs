//! A scene that is to be measured.

use std::path::Path;

use glam::UVec2;

use crate::app::Failure;
use crate::app::shared::failure::show;
use crate::app::shared::parameters;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;

/// Reads a scene's file. `size` and `max_depth` are in place of the scene's own, where they are given.
pub fn read(
    path: &Path,
    (size, max_depth): (Option<UVec2>, Option<u32>),
    library: &Library,
    quiet: bool,
) -> Result<SceneDescription, Failure> {
    let loaded = scene::load(path, &[])?;
    if !quiet {
        loaded.warnings.iter().for_each(|warning| show(warning));
    }
    let mut description = loaded.description;
    parameters::check(&description.shader, &loaded.shader_places, library)?;
    if let Some(size) = size {
        description.film.size = size;
        // A crop in pixels is one of the scene's own size.
        description.film.crop = None;
    }
    description.render.max_depth = max_depth.unwrap_or(description.render.max_depth);
    Ok(description)
}
