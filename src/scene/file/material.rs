//! What a scene file says of materials.

use std::path::Path;

use super::entries::read_entries;
use super::map::{FoundMap, MapEdit, read_map};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::keys::{KEYS, Key, Range, Value};
use crate::scene::mtl::MtlMaterial;
use crate::scene::ron::{Fields, Node, Reader};

/// Changes to the materials of one name.
#[derive(Debug)]
pub struct MaterialEntry {
    pub name: String,
    pub edit: MaterialEdit,
    /// An error about this entry, without its message.
    pub place: Diagnostic,
}

/// The numbers and maps of a material that a scene file changes.
#[derive(Clone, Debug, Default)]
pub struct MaterialEdit {
    /// The numbers that are given, and no other of `numbers`.
    given: Vec<&'static Key>,
    numbers: MtlMaterial,
    /// Those that are given, and their keys.
    maps: Vec<(&'static Key, MapEdit)>,
}

impl MaterialEdit {
    /// Whether it gives an `illum` of glass.
    pub fn asks_for_glass(&self) -> bool {
        self.gives("illum") && self.numbers.asks_for_glass()
    }

    /// Whether it says that glass is thin.
    pub fn asks_for_pane(&self) -> bool {
        self.gives("thin") && self.numbers.thin
    }

    /// Finds the files of its maps, which are relative to the file that names them.
    pub fn find_maps(&mut self, scene: &Path) -> Vec<FoundMap> {
        self.maps.iter_mut().filter_map(|(_, edit)| edit.find(scene)).collect()
    }

    /// Writes the given numbers and maps over a material's. What can't be is told.
    pub fn apply(&self, material: &mut MtlMaterial) -> Vec<Diagnostic> {
        let before = material.clone();
        self.given.iter().for_each(|key| key.copy(&self.numbers, material));
        let mut errors = Vec::new();
        for (key, edit) in &self.maps {
            if let Value::Map(_, at) = key.value {
                errors.extend(edit.apply(at(material), key.scene).err());
            }
        }
        material.edited(&before, |field| self.gives_anew(field));
        errors
    }

    /// The fields that it gives.
    pub fn fields(&self) -> impl Iterator<Item = &'static str> {
        self.given.iter().chain(self.maps.iter().map(|(key, _)| key)).map(|key| key.scene)
    }

    fn gives(&self, field: &str) -> bool {
        self.fields().any(|given| given == field)
    }

    /// Whether a number or map is given that is not just a change of the map that is there.
    fn gives_anew(&self, field: &str) -> bool {
        let changes = |(key, edit): &(&Key, MapEdit)| key.scene == field && edit.is_change();
        self.gives(field) && !self.maps.iter().any(changes)
    }

    /// Reads the field of a key, where it is there and right.
    fn read(&mut self, key: &'static Key, fields: &Fields) {
        let numbers = &mut self.numbers;
        let between =
            |node: &Node, range: Range| node.number(range.least.into(), range.most.into()).map(|value| value as f32);
        let found = match key.value {
            Value::Colour(colour, at) => fields
                .read(key.scene, |node| node.colour(colour.most_in_scene().into()))
                .map(|value| *at(numbers) = value),
            Value::Number(range, at) => {
                fields.read(key.scene, |node| between(node, range)).map(|value| *at(numbers) = value)
            }
            Value::Optional(range, at) => {
                let read = |reader: &Reader, node: &Node, path: &str| match node.is_none() {
                    true => Some(None),
                    false => between(node, range).map_err(|message| reader.error(node, path, message)).ok().map(Some),
                };
                fields.part(key.scene, read).map(|value| *at(numbers) = value)
            }
            Value::Switch(at) => fields.read(key.scene, Node::boolean).map(|value| *at(numbers) = value),
            Value::Whole(most, at) => {
                fields.read(key.scene, |node| node.integer(0, most)).map(|value| *at(numbers) = value)
            }
            Value::Map(used, _) => {
                let edit = fields.part(key.scene, |reader, node, path| read_map(reader, node, path, used));
                self.maps.extend(edit.map(|edit| (key, edit)));
                return;
            }
        };
        self.given.extend(found.map(|()| key));
    }
}

/// `{ "name": (kd: (..), ..), .. }`
pub fn read_materials(reader: &Reader, node: &Node, path: &str) -> Vec<MaterialEntry> {
    let read = |reader: &Reader, node: &Node, path: &str| {
        Some((read_material(reader, node, path)?, node.text.error(node.source, "")))
    };
    let entries = read_entries(reader, node, path, read).into_iter();
    entries.map(|(name, (edit, place))| MaterialEntry { name, edit, place }).collect()
}

/// `(kd: (..), ks: (..), ns: 64, ke: (..), ..)`, all optional.
fn read_material(reader: &Reader, node: &Node, path: &str) -> Option<MaterialEdit> {
    let fields = Fields::open(reader, node, path)?;
    let mut edit = MaterialEdit::default();
    KEYS.iter().for_each(|key| edit.read(key, &fields));
    if let Some(node) = fields.get("illum").filter(|_| edit.gives("illum") && edit.numbers.illum == 10) {
        let message = format!("{}: a shadow catcher is rendered as a surface for now", fields.path_of("illum"));
        reader.push(node.text.at(Severity::Warning, node.source, message));
    }
    fields.finish().then_some(edit)
}

/// The field that a plain value at a path stands for: `materials.x.map_kd`, written as a file, is its `file`; also of a model's own.
pub fn plain_field(path: &[&str]) -> Option<&'static str> {
    let (["materials", _, field] | ["models", _, "materials", _, field]) = path else { return None };
    KEYS.iter().any(|key| key.scene == *field && matches!(key.value, Value::Map(..))).then_some("file")
}
