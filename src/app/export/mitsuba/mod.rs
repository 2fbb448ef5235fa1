//! A scene as Mitsuba 3 reads it: one XML file, its meshes and its pictures beside it.
//!
//! What a plugin of Mitsuba's says exactly is written so. What none does is written by the nearest, and told: a picture
//! that is not the same is never passed off as the same.

mod camera;
mod light;
mod mesh;
mod note;
mod picture;
mod surface;
mod xml;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::components::{Passage, TextureFilter};
use crate::image::{SaveError, file};
use crate::scene::{Audit, MtlMaterial, SceneDescription};
use mesh::Mesh;
use note::Notes;
pub use note::{Note, Weight};
use picture::Pictures;
use surface::Surfaces;
use xml::Element;

/// The scene's file.
const FILE: &str = "scene.xml";

/// The folder of meshes, within the scene's.
const MESHES: &str = "meshes";

/// How far the two sides of a lamp that shines both ways are apart, by the greatest coordinate of it.
const APART: f64 = 3e-5;

/// What was written.
#[derive(Clone, Debug)]
pub struct Exported {
    pub scene: PathBuf,
    pub meshes: usize,
    pub lights: usize,
    /// What is otherwise than in Lucerna, the gravest first.
    pub notes: Vec<Note>,
}

impl Exported {
    /// Whether nothing differs that could be seen.
    pub fn is_the_same(&self) -> bool {
        self.notes.iter().all(|note| note.weight == Weight::Slight)
    }
}

/// Tries whether a folder can be written to.
pub fn prepare(folder: &Path) -> Result<(), SaveError> {
    file::prepare(&folder.join(FILE)).map(drop)
}

/// Refuses a folder where files that the scene was read from have names that are written, or are what links of such names lead to.
pub fn spare(folder: &Path, read: &[PathBuf]) -> Result<(), SaveError> {
    let numbered = |name: &Path| {
        let first = name.file_stem().and_then(|stem| stem.as_encoded_bytes().first());
        first.is_some_and(u8::is_ascii_digit)
    };
    let ours = |path: &Path, within: &str, ending: &str| match within {
        "" => path.ends_with(FILE),
        _ => numbered(path) && path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending)),
    };
    for (within, ending) in [("", "xml"), (MESHES, "ply"), (picture::FOLDER, "exr")] {
        let entries = std::fs::read_dir(folder.join(within)).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|path| ours(path, within, ending)) {
            if std::fs::canonicalize(&path).is_ok_and(|place| file::is_among(&place, read)) {
                return Err(SaveError::Input(path));
            }
        }
    }
    Ok(())
}

/// Writes a scene into a folder. `audit` says where its materials are written.
pub fn export(scene: &SceneDescription, audit: Audit, folder: &Path) -> Result<Exported, SaveError> {
    let mut notes = Notes::new(audit);
    let mut pictures = Pictures::new(folder.to_path_buf());
    let meshes = placed_meshes(scene);
    let (centre, radius) = around(scene, &meshes);
    let mut root = Element::new("scene").attribute("version", "3.0.0");
    root = root.with(camera::integrator(scene.render.max_depth));
    root = root.with(camera::sensor(scene, radius, &mut notes));
    let mut surfaces = Surfaces { scene, pictures: &mut pictures, notes: &mut notes };
    let ids: BTreeMap<&str, String> =
        scene.materials.keys().enumerate().map(|(i, name)| (name.as_str(), format!("material-{i}"))).collect();
    let used = |name: &String| meshes.iter().any(|placed| placed.material == name);
    for (name, material) in scene.materials.iter().filter(|(name, _)| used(name)) {
        root = root.with(surfaces.bsdf(&ids[name.as_str()], name, material)?);
    }
    let mut lights = 0;
    for (index, placed) in meshes.iter().enumerate() {
        let stem = format!("{MESHES}/{index}");
        let emitter = surfaces.radiance(placed.numbers)?;
        lights += usize::from(emitter.is_some());
        for (mesh, side) in sides(placed, emitter.is_some()) {
            let name = format!("{stem}{side}.ply");
            file::write(&folder.join(&name), |out| mesh.write(out))?;
            let shape = Element::plugin("shape", "ply").attribute("id", format!("mesh-{index}{side}"));
            let shape = shape.string("filename", &name).boolean("face_normals", !mesh.has_normals);
            let material = Element::new("ref").attribute("id", ids[placed.material.as_str()].clone());
            let shape = shape.with(material);
            root = root.with(emitter.iter().fold(shape, |shape, emitter| shape.with(emitter.clone())));
        }
    }
    for (name, light) in &scene.lights {
        root = root.with(light::point(name, light, &mut notes));
        lights += 1;
    }
    if let Some(environment) = &scene.environment {
        let all = light::environment(environment, (centre, radius), &mut pictures, &mut notes)?;
        lights += 1;
        root = all.into_iter().fold(root, Element::with);
    }
    say_of_all(scene, &meshes, &mut notes);
    let path = folder.join(FILE);
    file::write_text(&path, &root.document())?;
    let mut list = notes.list;
    list.sort_by_key(|note| std::cmp::Reverse(note.weight));
    Ok(Exported { scene: path, meshes: meshes.len(), lights, notes: list })
}

/// A mesh in world space, and what it is of.
struct PlacedMesh<'a> {
    name: &'a String,
    material: &'a String,
    numbers: &'a MtlMaterial,
    mesh: Mesh,
}

/// All meshes that are seen. Those that emit light are flat: Mitsuba would have them shine by their normals.
fn placed_meshes(scene: &SceneDescription) -> Vec<PlacedMesh<'_>> {
    let seen = scene.meshes.iter().filter_map(|(name, entry)| {
        let numbers = scene.materials.get(&entry.material)?;
        let material = numbers.material();
        if material.is_invisible() || entry.geometry.triangles.is_empty() {
            return None;
        }
        let mesh = Mesh::new(&entry.geometry, &entry.transform.0, material.emission == glam::Vec3::ZERO);
        Some(PlacedMesh { name, material: &entry.material, numbers, mesh })
    });
    seen.collect()
}

/// A mesh, and where it shines to both sides another one for its back: an emitter of Mitsuba's shines to the front alone.
fn sides<'a>(placed: &'a PlacedMesh, emits: bool) -> Vec<(std::borrow::Cow<'a, Mesh>, &'static str)> {
    use std::borrow::Cow;
    let front = (Cow::Borrowed(&placed.mesh), "");
    if !emits || placed.numbers.one_sided {
        return vec![front];
    }
    let far = placed.mesh.positions().fold(0.0f64, |far, p| far.max(p.abs().max_element()));
    vec![front, (Cow::Owned(placed.mesh.back(APART * far)), "-back")]
}

/// A point and a radius around it that has all meshes, point lights and the camera.
fn around(scene: &SceneDescription, meshes: &[PlacedMesh]) -> (DVec3, f64) {
    let camera = scene.cameras.get(&scene.active).map(|camera| camera.position);
    let points = || {
        let corners = meshes.iter().flat_map(|placed| placed.mesh.positions());
        corners.chain(scene.lights.values().map(|light| light.position)).chain(camera)
    };
    let low = points().fold(DVec3::INFINITY, DVec3::min);
    let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
    if low.is_finite() { (0.5 * (low + high), 0.5 * (high - low).length()) } else { (DVec3::ZERO, 1.0) }
}

/// What differs of no material alone.
fn say_of_all(scene: &SceneDescription, meshes: &[PlacedMesh], notes: &mut Notes) {
    let is_passed = |numbers: &MtlMaterial| {
        let map = numbers.maps.d.as_ref().is_some_and(|map| !map.off);
        map || matches!(numbers.passage(), Passage::Pane(_) | Passage::SeeThrough(_))
    };
    let mut lamps = meshes.iter().filter(|placed| placed.numbers.ke != glam::Vec3::ZERO);
    if let Some(lamp) = lamps.find(|lamp| !lamp.numbers.one_sided) {
        let text = format!(
            "lamps that shine to both sides, such as {}, are two sheets back to back: half of what Mitsuba draws of them is of the side that is not seen, which costs it efficiency; `one_sided: true` spares that",
            lamp.name
        );
        notes.say(Weight::Slight, &text);
    }
    let masked = meshes.iter().find(|placed| {
        placed.numbers.ke != glam::Vec3::ZERO && placed.numbers.maps.d.as_ref().is_some_and(|map| !map.off)
    });
    if let Some(placed) = masked {
        notes.say_of(placed.material, "map_d", "what shines is not cut out by its map of opacity".to_owned());
    }
    if !scene.lights.is_empty() && meshes.iter().any(|placed| is_passed(placed.numbers)) {
        notes.say(
            Weight::Another,
            "light of points goes through no pane and no see-through surface: Mitsuba's `path` finds none of it there",
        );
    }
    if meshes.iter().any(|placed| placed.mesh.has_normals) {
        notes.say(
            Weight::Slight,
            "where a normal leans off its triangle, Lucerna's triangles mirror what would run into them, and Mitsuba's lose it",
        );
    }
    if !scene.textures.is_empty() && scene.render.texture_filter == TextureFilter::Footprint {
        notes.say(
            Weight::Slight,
            "Mitsuba looks textures up at points: compare with pictures of `--texture-filter exact`",
        );
    }
    let clamped = |wrap: [crate::components::Wrap; 2]| wrap[0] != wrap[1];
    if scene.textures.values().any(|texture| clamped(texture.wrap)) {
        notes.say(Weight::Another, "a texture that is clamped along one axis alone is repeated along both");
    }
}
