//! The environment of a scene file.

use glam::{DMat3, Vec3};

use super::diagnostic::Diagnostic;
use super::ron::{Fields, Kind, Node, Reader};
use super::turn::read_turn;
use crate::components::Daylight;

/// Light from beyond the scene; its picture is not read yet.
#[derive(Debug)]
pub enum EnvironmentEntry {
    Constant(Vec3),
    Daylight(Daylight),
    Map {
        /// As written: relative to the folder of the file that has it.
        path: String,
        strength: f32,
        tint: Vec3,
        /// A rotation: from directions of the picture to those of the scene.
        turn: DMat3,
        /// An error about this entry, without its message.
        place: Box<Diagnostic>,
    },
}

/// `Constant((r, g, b))`, with or without the inner parentheses, or `Constant(grey)`; or `Map(path: "sky.exr", ..)`,
/// or `Sky(sun: (45, 0), ..)`.
pub fn read_environment(reader: &Reader, node: &Node) -> Option<EnvironmentEntry> {
    let constant = match &node.kind {
        Kind::Variant("Constant", Some(content)) => content.inner().colour(1e6).map(EnvironmentEntry::Constant),
        Kind::Variant("Map", Some(content)) => return read_map(reader, content),
        Kind::Variant("Sky", Some(content)) => return read_daylight(reader, content),
        _ => {
            let found = node.describe();
            Err(format!("expected Constant((r, g, b)), Map(path: \"sky.exr\") or Sky(sun: (45, 0)), found {found}"))
        }
    };
    constant.map_err(|message| reader.error(node, "environment", message)).ok()
}

/// `(path: "sky.exr", strength: 1, tint: (1, 1, 1), rotate_x: 0, rotate_y: 0, rotate_z: 0)`
fn read_map(reader: &Reader, node: &Node) -> Option<EnvironmentEntry> {
    let fields = Fields::open(reader, node, "environment")?;
    let named = fields.get("path").unwrap_or(node);
    let place = Box::new(named.text.error(named.source, ""));
    let path = fields.require("path", Node::string);
    let strength = fields.read("strength", |node| node.number(0.0, 1e6)).unwrap_or(1.0) as f32;
    let tint = fields.read("tint", |node| node.colour(1e3)).unwrap_or(Vec3::ONE);
    let turn = read_turn(&fields).unwrap_or(DMat3::IDENTITY);
    let sound = fields.finish();
    let entry = EnvironmentEntry::Map { path: path?, strength, tint, turn, place };
    sound.then_some(entry)
}

/// `(sun: (elevation, azimuth), turbidity: 3, ground: (0.3, 0.3, 0.3), strength: 1, sun_size: 0.533)`
fn read_daylight(reader: &Reader, node: &Node) -> Option<EnvironmentEntry> {
    let fields = Fields::open(reader, node, "environment")?;
    let sun = fields.require("sun", |node| {
        let [elevation, azimuth] = node.numbers(-1e6, 1e6)?;
        if (0.0..=90.0).contains(&elevation) {
            return Ok([elevation, azimuth]);
        }
        Err(format!(
            "expected an elevation from 0 (at the horizon) to 90 degrees (overhead), found {elevation}: there is no sky of night"
        ))
    });
    let turbidity = fields.read("turbidity", |node| node.number(1.0, 10.0)).unwrap_or(3.0) as f32;
    let ground = fields.read("ground", |node| node.colour(1.0)).unwrap_or(Vec3::splat(0.3));
    let strength = fields.read("strength", |node| node.number(0.0, 1e3)).unwrap_or(1.0) as f32;
    let sun_size = fields.read("sun_size", |node| node.number(0.05, 30.0)).unwrap_or(Daylight::SUN_SIZE);
    let sound = fields.finish();
    let [elevation, azimuth] = sun?;
    let day = Daylight { elevation, azimuth, turbidity, ground, strength, sun_size };
    sound.then_some(EnvironmentEntry::Daylight(day))
}
