//! Edits of a scene file's text: what differs between two states of the scene is written where it belongs, and the rest stays to the byte.
//!
//! Knows texts and descriptions, and no file: who saves writes it. What is written is exchanged in place, as little of it as can be; what is
//! not written yet goes behind the last entry of its block. Of a file that extends others, only its own text changes.
//!
//! | file | what it does |
//! |---|---|
//! | `camera`, `light`, `environment`, `setting`, `material`, `map` | what differs, as values for the file |
//! | `place` | where a material's value counts: by its name, by its model, or both |
//! | `write`, `append` | one value into the text; a new entry behind others |
//! | `value`, `number`, `trivia`, `path`, `change` | the stones of these |

mod append;
mod camera;
mod change;
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
use super::file::scene_fields;
use super::mtl::MtlMaterial;
use super::place::names;
use super::read::{merged, retyped};
use super::ron::parse;
use super::source::SceneText;
use crate::components::Camera;
use change::{Change, Changes};
use material::MaterialChange;
use path::Step;
use place::{Places, Sibling, bare};
use value::Value;
use write::{Written, follow, write};

pub use edited::Edited;

/// A camera as an entry of a scene file's `cameras` has it, in brackets and one line, exact.
pub fn camera(camera: &Camera) -> String {
    camera::whole(camera).text()
}

/// A material as an entry of a scene file's `materials`, in brackets and one line, exact. Its pictures are named from a folder; without one, left out.
pub fn material(material: &MtlMaterial, folder: Option<&Path>) -> String {
    material::whole(material, folder).text()
}

/// Writes into a scene file's text what differs between the scene as the file was read, `before`, and as it is now, `after`. Meshes are
/// the models' matter. What can't be said is left out and told; a text that would not be read is refused.
pub fn edit(text: &SceneText, before: &SceneDescription, after: &SceneDescription) -> Result<Edited, Diagnostic> {
    let Some(own) = text.own() else {
        return Err(Diagnostic::file(Severity::Error, Path::new("-"), "there is no scene file to be edited"));
    };
    let (file, found) = retyped(text)?;
    let mut draft = Draft { text: text.clone(), edited: Edited::of(own.text.clone()) };
    let mut changes = Changes::default();
    camera::differences(before, after, &mut changes);
    light::differences(before, after, &mut changes);
    setting::differences(before, after, &mut changes);
    environment::differences(before, after, &mut changes);
    for (what, help) in changes.unsaid {
        let error = Diagnostic::file(Severity::Warning, &own.file, format!("{what} can't be saved"));
        draft.edited.left_out.push(error.help(help));
    }
    for change in changes.list {
        draft.add(change)?;
    }
    let folder = own.file.parent().unwrap_or(Path::new(""));
    let models = names(&file.models, &mut Default::default());
    for change in material::differences(before, after, folder) {
        draft.add_material(change, after, folder, &models)?;
    }
    let mut values = Changes::default();
    setting::parameters(before, after, &mut values);
    for change in values.list {
        draft.add(change)?;
    }
    let (_, wrong) = retyped(&draft.text)?;
    if let Some(error) = wrong.list.into_iter().find(|found| found.severity == Severity::Error)
        && !found.has_errors()
    {
        return Err(Diagnostic { message: format!("{}: nothing was saved", error.message), ..error });
    }
    let tracks = file.animation.iter().flat_map(|animation| &animation.tracks);
    draft.edited.tell_animated(tracks.map(|track| (track.path.as_str(), &track.place)));
    Ok(draft.edited)
}

/// A text on its way, and what was done to it.
struct Draft {
    text: SceneText,
    edited: Edited,
}

impl Draft {
    /// Writes a value; what it is a part of, as a whole, where no file has that yet.
    fn add(&mut self, change: Change) -> Result<(), Diagnostic> {
        let Change { path, value, entry } = change;
        let Some(root) = merged(&self.text)? else { return Ok(()) };
        let whole = entry.filter(|entry| follow(&root, &path[..path.len() - 1]).is_none() && !entry.path.is_empty());
        let is_gone = value == Value::word("None") && follow(&root, &path).is_none_or(|node| node.is_none());
        drop(root);
        match whole {
            // Nothing is there that would have to be taken away.
            _ if is_gone => Ok(()),
            Some(entry) => self.write(&entry.path, &entry.value),
            None => self.write(&path, &value),
        }
    }

    /// Writes a number or map of a material where it counts.
    fn add_material(
        &mut self,
        change: MaterialChange,
        after: &SceneDescription,
        folder: &Path,
        models: &[Option<String>],
    ) -> Result<(), Diagnostic> {
        let MaterialChange { name, key, part, value } = change;
        let (Some(own), Some(merged)) = (self.text.own(), merged(&self.text)?) else { return Ok(()) };
        let others = after.materials.iter().filter(|(other, _)| bare(other) == bare(&name) && **other != name);
        let wanted = material::of_key(&after.materials[&name], key, folder);
        let siblings: Vec<Sibling> = others
            .map(|(other, material)| Sibling { name: other, agrees: material::of_key(material, key, folder) == wanted })
            .collect();
        let places = Places { own: scene_fields(parse(own)?), merged, models };
        let mut path = places.of(&name, key, &siblings);
        path.extend(part.map(Step::Field));
        drop(places);
        self.write(&path, &value)
    }

    fn write(&mut self, path: &[Step], value: &Value) -> Result<(), Diagnostic> {
        let Some(own) = self.text.own() else { return Ok(()) };
        match write(own, path, value) {
            Ok(Written::Same) => {}
            Ok(Written::Changed(text)) => {
                self.edited.changed += 1;
                self.took(path, text);
            }
            Ok(Written::Added(text)) => {
                self.edited.added += 1;
                self.took(path, text);
            }
            Err(error) => self.edited.left_out.push(Diagnostic { severity: Severity::Warning, ..error }),
        }
        Ok(())
    }

    fn took(&mut self, path: &[Step], text: String) {
        self.edited.paths.push(Step::names(path));
        self.edited.text.clone_from(&text);
        self.text = self.text.with_text(text);
    }
}
