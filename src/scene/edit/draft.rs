//! The text of a scene file on its way from one state of the scene to another: one change after the other, each at its place.

use std::collections::BTreeMap;
use std::path::Path;

use super::change::Change;
use super::edited::Edited;
use super::material::{self, MaterialChange};
use super::path::Step;
use super::place::{Places, Sibling, bare};
use super::value::Value;
use super::write::{Written, follow, write};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::file::scene_fields;
use crate::scene::mtl::MtlMaterial;
use crate::scene::read::merged;
use crate::scene::ron::parse;
use crate::scene::source::SceneText;
use crate::scene::text::Text;

/// A text on its way, and what was done to it.
pub struct Draft {
    text: SceneText,
    edited: Edited,
}

impl Draft {
    /// Nothing is done yet. `own` is the text of the file itself.
    pub fn new(text: &SceneText, own: &Text) -> Self {
        Self { text: text.clone(), edited: Edited::of(own.text.clone()) }
    }

    /// As it is by now.
    pub fn text(&self) -> &SceneText {
        &self.text
    }

    pub fn finish(self) -> Edited {
        self.edited
    }

    /// Writes a value; what it is a part of, as a whole, where no file has that yet.
    pub fn add(&mut self, change: Change) -> Result<(), Diagnostic> {
        let Change { path, value, entry } = change;
        if entry.is_none() && value != Value::word("None") {
            return self.write(&path, &value);
        }
        let Some(root) = merged(&self.text)? else { return Ok(()) };
        let whole = entry.filter(|_| follow(&root, &path[..path.len() - 1]).is_none());
        let is_gone = value == Value::word("None") && follow(&root, &path).is_none_or(|node| node.is_none());
        drop(root);
        match whole {
            // Nothing is there that would have to be taken away.
            _ if is_gone => Ok(()),
            Some(entry) => self.write(&entry.path, &entry.value),
            None => self.write(&path, &value),
        }
    }

    /// Writes a number or map of a material where it counts. `materials` are all, as they are to be; `models` the names of the file's.
    pub fn add_material(
        &mut self,
        change: MaterialChange,
        materials: &BTreeMap<String, MtlMaterial>,
        folder: &Path,
        models: &[Option<String>],
    ) -> Result<(), Diagnostic> {
        let MaterialChange { name, key, part, value } = change;
        let (Some(own), Some(merged)) = (self.text.own(), merged(&self.text)?) else { return Ok(()) };
        let others = materials.iter().filter(|(other, _)| bare(other) == bare(&name) && **other != name);
        let wanted = material::of_key(&materials[&name], key, folder);
        let siblings: Vec<Sibling> = others
            .map(|(other, material)| Sibling { name: other, agrees: material::of_key(material, key, folder) == wanted })
            .collect();
        let own = if self.text.extends() { scene_fields(parse(own)?) } else { merged.clone() };
        let places = Places { own, merged, models };
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
