//! Scene files: what each field means, its range and its default.

mod camera;
mod extend;
mod map;
mod material;

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DVec3, UVec2};

use super::diagnostic::Diagnostic;
use super::environment::{EnvironmentEntry, read_environment};
use super::ron::{Fields, Kind, Node, Reader};
use super::settings::{Group, SETTINGS, Settings, Value};
use super::suggest::known_names;
use super::turn::read_turn;
use crate::components::{Camera, Crop, Film};
use camera::read_camera;
use material::read_material;

pub use extend::{Chain, is_of_family, merge, no_scene, take_extends};
pub use material::{MaterialEntry, plain_field};

/// The camera of scenes that have none.
pub const DEFAULT_CAMERA: &str = "default";

/// A scene file, typed; models are not read yet.
#[derive(Debug, Default)]
pub struct SceneFile {
    pub models: Vec<ModelEntry>,
    pub cameras: BTreeMap<String, Camera>,
    /// The chosen camera, one of `cameras`.
    pub active: Option<String>,
    pub settings: Settings,
    pub environment: Option<EnvironmentEntry>,
    /// Sorted by name; full keys (`model:material`) after bare names, so that they win.
    pub materials: Vec<MaterialEntry>,
}

/// One model of a scene.
#[derive(Debug)]
pub struct ModelEntry {
    /// As written: relative to the folder of the file that has it.
    pub path: String,
    /// First part of its meshes' names; the file's stem where it isn't given.
    pub name: Option<String>,
    pub transform: DAffine3,
    /// An error about this entry, without its message.
    pub place: Diagnostic,
}

/// The fields of a whole file, which may be named: `Scene(..)`.
pub fn scene_fields(root: Node) -> Node {
    match root.kind {
        Kind::Variant("Scene", Some(inner)) => *inner,
        _ => root,
    }
}

/// Types a tree; what is wrong goes to the reader, and the rest has its defaults.
pub fn read_scene(reader: &Reader, root: &Node) -> SceneFile {
    let mut file = SceneFile::default();
    let Some(fields) = Fields::open(reader, root, "") else { return file };
    if let Some(node) = fields.get("extends") {
        reader.error(node, "extends", "which file is extended can't be changed: extend another one in a scene file");
    }
    if let Some(node) = fields.get("models") {
        file.models = read_list(reader, node, "models", read_model);
    }
    if let Some(node) = fields.get("cameras") {
        file.cameras = read_map(reader, node, "cameras", read_camera).into_iter().collect();
    }
    file.active = fields.read("camera", |node| choose_camera(reader, node, &file.cameras));
    if let Some(node) = fields.get("film") {
        read_settings(reader, node, "film", Group::Film, &mut file.settings);
    }
    if let Some(node) = fields.get("render") {
        read_settings(reader, node, "render", Group::Render, &mut file.settings);
    }
    file.environment = fields.get("environment").and_then(|node| read_environment(reader, node));
    if let Some(node) = fields.get("materials") {
        file.materials = read_map(reader, node, "materials", |reader, node, path| {
            Some((read_material(reader, node, path)?, node.text.error(node.source, "")))
        })
        .into_iter()
        .map(|(name, (edit, place))| MaterialEntry { name, edit, place })
        .collect();
        file.materials.sort_by_key(|entry| (entry.name.contains(':'), entry.name.clone()));
    }
    fields.finish();
    file
}

/// The name of one of the cameras, or of the one that a scene without cameras gets.
fn choose_camera(reader: &Reader, node: &Node, cameras: &BTreeMap<String, Camera>) -> Result<String, String> {
    let name = node.string()?;
    let known = || cameras.keys().map(String::as_str).chain(cameras.is_empty().then_some(DEFAULT_CAMERA));
    // A camera that is missing for its own errors was reported already.
    if known().any(|camera| camera == name) || reader.has_errors() {
        return Ok(name);
    }
    let help = known_names(&name, known().collect::<Vec<_>>());
    Err(format!("there is no camera `{name}`; {help}"))
}

/// The entries of a list, those that are right.
fn read_list<T>(reader: &Reader, node: &Node, path: &str, read: impl Fn(&Reader, &Node, &str) -> Option<T>) -> Vec<T> {
    match node.items() {
        Ok(items) => {
            items.iter().enumerate().filter_map(|(i, item)| read(reader, item, &format!("{path}.{i}"))).collect()
        }
        Err(message) => {
            reader.error(node, path, message);
            Vec::new()
        }
    }
}

/// The entries of a map, those that are right. `None` takes away what the file that is extended has.
fn read_map<T>(
    reader: &Reader,
    node: &Node,
    path: &str,
    read: impl Fn(&Reader, &Node, &str) -> Option<T>,
) -> Vec<(String, T)> {
    match node.fields() {
        Ok(fields) => fields
            .iter()
            .filter(|(.., node)| !matches!(node.kind, Kind::Variant("None", None)))
            .filter_map(|(name, _, node)| Some((name.clone(), read(reader, node, &format!("{path}.{name}"))?)))
            .collect(),
        Err(message) => {
            reader.error(node, path, message);
            Vec::new()
        }
    }
}

/// `(path: "..", name: "..", transform: (..))`
fn read_model(reader: &Reader, node: &Node, path: &str) -> Option<ModelEntry> {
    let fields = Fields::open(reader, node, path)?;
    let named = fields.get("path").unwrap_or(node);
    let place = named.text.error(named.source, "");
    let file = fields.require("path", |node| match node.string()? {
        path if path.is_empty() => Err("expected the path of an .obj file, found an empty string".into()),
        path => Ok(path),
    });
    let name = fields.read("name", |node| match node.string()? {
        name if name.is_empty() || name.contains([':', '/']) => {
            Err("a model's name is not empty and has no `:` or `/`".into())
        }
        name => Ok(name),
    });
    let transform = match fields.get("transform") {
        Some(node) => read_transform(reader, node, &fields.path_of("transform")),
        None => Some(DAffine3::IDENTITY),
    };
    let sound = fields.finish();
    let entry = ModelEntry { path: file?, name, transform: transform?, place };
    sound.then_some(entry)
}

/// Scale, then turns about x, y and z in this order, then translation; or a matrix of three rows of four.
fn read_transform(reader: &Reader, node: &Node, path: &str) -> Option<DAffine3> {
    let fields = Fields::open(reader, node, path)?;
    let matrix = fields.read("matrix", |node| {
        let rows: Vec<[f64; 4]> = node.items()?.iter().map(|row| row.numbers(-1e12, 1e12)).collect::<Result<_, _>>()?;
        let rows: [[f64; 4]; 3] = rows.try_into().map_err(|_| "expected three rows of four numbers".to_owned())?;
        let linear = DMat3::from_cols_array_2d(&[0, 1, 2].map(|row| [rows[row][0], rows[row][1], rows[row][2]]));
        Ok(DAffine3::from_mat3_translation(linear.transpose(), DVec3::from_array(rows.map(|row| row[3]))))
    });
    let scale = fields.read("scale", |node| match &node.kind {
        Kind::Items(_) => node.vector(),
        _ => node.number(-1e12, 1e12).map(DVec3::splat),
    });
    let turn = read_turn(&fields);
    let translate = fields.read("translate", Node::vector);
    if matrix.is_some() && (scale.is_some() || turn.is_some() || translate.is_some()) {
        fields.fail("`matrix` stands alone: leave out scale, rotate and translate");
    }
    let linear = turn.unwrap_or(DMat3::IDENTITY) * DMat3::from_diagonal(scale.unwrap_or(DVec3::ONE));
    let transform = matrix.unwrap_or_else(|| DAffine3::from_mat3_translation(linear, translate.unwrap_or(DVec3::ZERO)));
    let determinant = transform.matrix3.determinant();
    if !(determinant.is_finite() && determinant.abs() > 1e-100) {
        fields.fail("this transform flattens the model (its determinant is 0)");
    }
    fields.finish().then_some(transform)
}

/// `(size: (512, 512), crop: (x0, x1, y0, y1), exposure: 0)`, or `(integrator: Path, sampler: Sobol, ..)`: all optional.
fn read_settings(reader: &Reader, node: &Node, path: &str, group: Group, settings: &mut Settings) {
    let Some(fields) = Fields::open(reader, node, path) else { return };
    for setting in SETTINGS.iter().filter(|setting| setting.group == group) {
        let size = settings.film.size;
        fields.read(setting.field, |node| {
            match setting.value {
                Value::Whole { least, most, at } => *at(settings) = node.integer(least, most)?,
                Value::Stops { most, at, .. } => *at(settings) = node.number((-most).into(), most.into())? as f32,
                Value::Switch(at) => *at(settings) = node.boolean()?,
                Value::Choice(at) => {
                    let choice = at(settings);
                    let words: Vec<_> = choice.words().iter().map(|word| (word.variant, word.value)).collect();
                    choice.choose(node.one_of(&words)?);
                }
                Value::Size(at) => *at(settings) = UVec2::from_array(node.integers(1, Film::MAX_SIDE)?),
                Value::Crop(at) => *at(settings) = Some(read_crop(node, size)?),
            }
            Ok(())
        });
    }
    fields.finish();
}

/// `(x0, x1, y0, y1)` within a picture.
fn read_crop(node: &Node, size: UVec2) -> Result<Crop, String> {
    let [x0, x1, y0, y1] = node.integers(0, Film::MAX_SIDE)?;
    let crop = Crop { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) };
    if crop.min.cmplt(crop.max).all() && crop.max.cmple(size).all() {
        return Ok(crop);
    }
    Err(format!("expected x0, x1, y0, y1 with x0 < x1 <= {} and y0 < y1 <= {}", size.x, size.y))
}
