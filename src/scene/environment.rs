//! The environment of a scene file.

use glam::{DMat3, Vec3};

use super::diagnostic::Diagnostic;
use super::ron::{Fields, Kind, Node, Reader};
use super::turn::read_turn;

/// Light from beyond the scene; its picture is not read yet.
#[derive(Debug)]
pub enum EnvironmentEntry {
    Constant(Vec3),
    Map {
        /// As written: relative to the scene file's folder.
        path: String,
        strength: f32,
        tint: Vec3,
        /// A rotation: from directions of the picture to those of the scene.
        turn: DMat3,
        /// An error about this entry, without its message.
        place: Box<Diagnostic>,
    },
}

/// `Constant((r, g, b))`, with or without the inner parentheses, or `Constant(grey)`; or `Map(path: "sky.exr", ..)`.
pub fn read_environment(reader: &Reader, node: &Node) -> Option<EnvironmentEntry> {
    let constant = match &node.kind {
        Kind::Variant("Constant", Some(content)) => {
            let inner = match &content.kind {
                Kind::Items(items) if items.len() == 1 => &items[0],
                _ => content,
            };
            inner.colour(1e6).map(EnvironmentEntry::Constant)
        }
        Kind::Variant("Map", Some(content)) => return read_map(reader, content),
        _ => {
            let found = node.describe();
            Err(format!("expected Constant((r, g, b)) or Map(path: \"sky.exr\"), found {found}"))
        }
    };
    constant.map_err(|message| reader.error(node, "environment", message)).ok()
}

/// `(path: "sky.exr", strength: 1, tint: (1, 1, 1), rotate_x: 0, rotate_y: 0, rotate_z: 0)`
fn read_map(reader: &Reader, node: &Node) -> Option<EnvironmentEntry> {
    let fields = Fields::open(reader, node, "environment")?;
    let place = Box::new(node.text.error(fields.get("path").map_or(node.source, |path| path.source), ""));
    let path = fields.require("path", Node::string);
    let strength = fields.read("strength", |node| node.number(0.0, 1e6)).unwrap_or(1.0) as f32;
    let tint = fields.read("tint", |node| node.colour(1e3)).unwrap_or(Vec3::ONE);
    let turn = read_turn(&fields).unwrap_or(DMat3::IDENTITY);
    let sound = fields.finish();
    let entry = EnvironmentEntry::Map { path: path?, strength, tint, turn, place };
    sound.then_some(entry)
}
