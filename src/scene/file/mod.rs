//! Scene files: what each field means, its range and its default.

mod animate;
mod camera;
mod entries;
mod extend;
mod light;
mod map;
mod material;
mod model;
mod shader;

use std::collections::{BTreeMap, BTreeSet};

use glam::UVec2;

use super::animate::Animation;
use super::environment::{EnvironmentEntry, read_environment};
use super::ron::{Fields, Kind, Node, Reader};
use super::settings::{Group, SETTINGS, Settings, Value};
use super::source::SceneText;
use super::suggest::known_names;
use crate::components::{Camera, Crop, Film, PointLight, ShaderValue};
use animate::read_animation;
use camera::read_camera;
use entries::{read_entries, read_list};
use light::read_light;
use material::read_materials;
use model::read_model;
use shader::read_values;

pub use extend::{Chain, is_of_family, merge, no_scene, take_extends};
pub use material::{MaterialEntry, plain_field};
pub use model::{ModelEntry, Parent};
pub use shader::ShaderPlace;

/// The camera of scenes that have none.
pub const DEFAULT_CAMERA: &str = "default";

/// A scene file, typed; models are not read yet.
#[derive(Debug, Default)]
pub struct SceneFile {
    pub models: Vec<ModelEntry>,
    pub cameras: BTreeMap<String, Camera>,
    /// The chosen camera, one of `cameras`.
    pub active: Option<String>,
    pub lights: BTreeMap<String, PointLight>,
    pub settings: Settings,
    /// The fields of settings that are written.
    pub given: BTreeSet<&'static str>,
    pub environment: Option<EnvironmentEntry>,
    /// Without that, where something of the scene sends out light.
    pub dark_if_lit: bool,
    /// Sorted by name; full keys (`model:material`) after bare names, so that they win.
    pub materials: Vec<MaterialEntry>,
    /// By the names of parameters.
    pub shader: BTreeMap<String, (ShaderValue, ShaderPlace)>,
    pub animation: Option<Animation>,
    /// What it was read from.
    pub text: SceneText,
}

/// The fields of a whole file, which may be named: `Scene(..)`.
pub fn scene_fields(root: Node) -> Node {
    match root.kind {
        Kind::Variant("Scene", Some(inner)) => *inner,
        _ => root,
    }
}

/// Types a tree; what is wrong goes to the reader, and the rest has its defaults.
pub fn read_scene(reader: &Reader, root: &Node, animated: bool) -> SceneFile {
    let mut file = SceneFile::default();
    let Some(fields) = Fields::open(reader, root, "") else { return file };
    if let Some(node) = fields.get("extends") {
        reader.error(node, "extends", "which file is extended can't be changed: extend another one in a scene file");
    }
    if let Some(node) = fields.get("models") {
        file.models = read_list(reader, node, "models", read_model);
    }
    if let Some(node) = fields.get("cameras") {
        file.cameras = read_entries(reader, node, "cameras", read_camera).into_iter().collect();
    }
    file.active = fields.read("camera", |node| choose_camera(reader, node, &file.cameras));
    if let Some(node) = fields.get("lights") {
        file.lights = read_entries(reader, node, "lights", read_light).into_iter().collect();
    }
    if let Some(node) = fields.get("film") {
        read_settings(reader, node, "film", Group::Film, &mut file);
    }
    if let Some(node) = fields.get("render") {
        read_settings(reader, node, "render", Group::Render, &mut file);
    }
    file.environment = fields.get("environment").and_then(|node| read_environment(reader, node));
    if let Some(node) = fields.get("materials") {
        file.materials = read_materials(reader, node, "materials");
        file.materials.sort_by_key(|entry| (entry.name.contains(':'), entry.name.clone()));
    }
    if let Some(node) = fields.get("shader") {
        file.shader = read_values(reader, node, "shader");
    }
    let animate = fields.get("animate").filter(|_| animated);
    file.animation = animate.and_then(|node| read_animation(reader, node, "animate"));
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

/// `(size: (512, 512), crop: (x0, x1, y0, y1), exposure: 0)`, or `(integrator: Path, sampler: Sobol, ..)`: all optional.
fn read_settings(reader: &Reader, node: &Node, path: &str, group: Group, file: &mut SceneFile) {
    let Some(fields) = Fields::open(reader, node, path) else { return };
    let settings = &mut file.settings;
    for setting in SETTINGS.iter().filter(|setting| setting.group == group) {
        let size = settings.film.size;
        let read = fields.read(setting.field, |node| {
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
        file.given.extend(read.map(|()| setting.field));
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
