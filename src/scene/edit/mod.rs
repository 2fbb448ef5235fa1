//! Edits of a scene file's text: what differs between two states of the scene is written where it belongs, and the rest stays to the byte.
//!
//! Knows texts and descriptions, and no file: who saves writes it. What is written is exchanged in place, as little of it as can be; what is
//! not written yet goes behind the last entry of its block. Of a file that extends others, only its own text changes.
//!
//! | file | what it does |
//! |---|---|
//! | `camera`, `light`, `environment`, `setting`, `material`, `map` | what differs, as values for the file |
//! | `draft` | the text on its way: one change after the other |
//! | `place` | where a material's value counts: by its name, by its model, or both |
//! | `write`, `append` | one value into the text; a new entry behind others |
//! | `value`, `number`, `trivia`, `path`, `change` | what these are made of |

mod append;
mod camera;
mod change;
mod draft;
mod edited;
mod environment;
mod light;
mod map;
mod material;
mod number;
mod path;
mod place;
mod setting;
mod trivia;
mod value;
mod write;

use std::path::Path;

use super::description::SceneDescription;
use super::diagnostic::{Diagnostic, Severity};
use super::mtl::MtlMaterial;
use super::place::names;
use super::read::retyped;
use super::source::SceneText;
use crate::components::Camera;
use change::Changes;
use draft::Draft;

pub use edited::Edited;

/// A camera as an entry of a scene file's `cameras` has it, in brackets and one line, exact.
pub fn camera(camera: &Camera) -> String {
    camera::whole(camera).text()
}

/// The same with its name, as a line of `cameras`.
pub fn camera_line(name: &str, camera: &Camera) -> String {
    line(name, &self::camera(camera))
}

/// A material as an entry of a scene file's `materials`, in brackets and one line, exact. Its pictures are named from a folder; without one, left out.
pub fn material(material: &MtlMaterial, folder: Option<&Path>) -> String {
    material::whole(material, folder).text()
}

/// The same with its name, as a line of `materials`.
pub fn material_line(name: &str, material: &MtlMaterial, folder: Option<&Path>) -> String {
    line(name, &self::material(material, folder))
}

fn line(name: &str, entry: &str) -> String {
    format!("{name:?}: {entry},")
}

/// Writes into a scene file's text what differs between the scene as the file was read, `before`, and as it is now, `after`. Meshes are
/// the models' matter. What can't be said is left out and told; a text that would not be read is refused.
pub fn edit(text: &SceneText, before: &SceneDescription, after: &SceneDescription) -> Result<Edited, Diagnostic> {
    let Some(own) = text.own() else {
        return Err(Diagnostic::file(Severity::Error, Path::new("-"), "there is no scene file to be edited"));
    };
    let (file, found) = retyped(text)?;
    let mut draft = Draft::new(text, own);
    let mut changes = Changes::default();
    camera::differences(before, after, &mut changes);
    light::differences(before, after, &mut changes);
    setting::differences(before, after, &mut changes);
    environment::differences(before, after, &mut changes);
    let unsaid = changes.unsaid.into_iter().map(|(what, help)| {
        Diagnostic::file(Severity::Warning, &own.file, format!("{what} can't be saved")).help(help)
    });
    let unsaid: Vec<Diagnostic> = unsaid.collect();
    for change in changes.list {
        draft.add(change)?;
    }
    let folder = own.file.parent().unwrap_or(Path::new(""));
    let models = names(&file.models, &mut Default::default());
    for change in material::differences(before, after, folder) {
        draft.add_material(change, &after.materials, folder, &models)?;
    }
    let mut values = Changes::default();
    setting::parameters(before, after, &mut values);
    for change in values.list {
        draft.add(change)?;
    }
    let (_, wrong) = retyped(draft.text())?;
    if let Some(error) = wrong.list.into_iter().find(|found| found.severity == Severity::Error)
        && !found.has_errors()
    {
        return Err(Diagnostic { message: format!("{}: nothing was saved", error.message), ..error });
    }
    let mut edited = draft.finish();
    edited.left_out.splice(0..0, unsaid);
    let tracks = file.animation.iter().flat_map(|animation| &animation.tracks);
    edited.tell_animated(tracks.map(|track| (track.path.as_str(), &track.place)));
    Ok(edited)
}
