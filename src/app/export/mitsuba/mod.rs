//! A scene as Mitsuba 3 reads it: one XML file, its meshes and its pictures beside it.
//!
//! What a plugin of Mitsuba's says exactly is written so. What none does is written by the nearest, and told: a picture
//! that is not the same is never passed off as the same.

mod camera;
mod light;
mod mesh;
mod note;
mod picture;
mod placed;
mod surface;
mod whole;
mod xml;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::image::{SaveError, file};
use crate::scene::{Audit, SceneDescription};
use note::Notes;
pub use note::{Note, Weight};
use picture::Pictures;
use placed::{PlacedMesh, around, placed_meshes};
use surface::Surfaces;
use whole::say_of_whole;
use xml::Element;

/// The scene's file.
const FILE: &str = "scene.xml";

/// The folder of meshes, within the scene's.
const MESHES: &str = "meshes";

/// What was written.
#[derive(Clone, Debug)]
pub struct Exported {
    pub scene: PathBuf,
    pub meshes: usize,
    pub lights: usize,
    /// What is otherwise than in Lucerna, the gravest first.
    pub notes: Vec<Note>,
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
    root = with_meshes(root, &meshes, &mut surfaces, folder)?;
    for (name, light) in &scene.lights {
        root = root.with(light::point(name, light, &mut notes));
    }
    if let Some(environment) = &scene.environment {
        let all = light::environment(environment, (centre, radius), &mut pictures, &mut notes)?;
        root = all.into_iter().fold(root, Element::with);
    }
    say_of_whole(scene, &meshes, &mut notes);
    let path = folder.join(FILE);
    file::write_text(&path, &root.document())?;
    let lamps = meshes.iter().filter(|placed| placed.shines()).count();
    let lights = lamps + scene.lights.len() + usize::from(scene.environment.is_some());
    let mut list = notes.list;
    list.sort_by_key(|note| std::cmp::Reverse(note.weight));
    Ok(Exported { scene: path, meshes: meshes.len(), lights, notes: list })
}

/// Adds the materials that are used, and the meshes, whose files are written into the scene's folder.
fn with_meshes(
    mut root: Element,
    meshes: &[PlacedMesh],
    surfaces: &mut Surfaces,
    folder: &Path,
) -> Result<Element, SaveError> {
    let materials = &surfaces.scene.materials;
    let ids: BTreeMap<&str, String> =
        materials.keys().enumerate().map(|(i, name)| (name.as_str(), format!("material-{i}"))).collect();
    let used = |name: &String| meshes.iter().any(|placed| placed.material == name);
    for (name, material) in materials.iter().filter(|(name, _)| used(name)) {
        root = root.with(surfaces.bsdf(&ids[name.as_str()], name, material)?);
    }
    for (index, placed) in meshes.iter().enumerate() {
        let emitter = surfaces.radiance(placed.numbers)?;
        for (mesh, side) in placed.sides() {
            let name = format!("{MESHES}/{index}{side}.ply");
            file::write(&folder.join(&name), |out| mesh.write(out))?;
            let shape = Element::plugin("shape", "ply").attribute("id", format!("mesh-{index}{side}"));
            let shape = shape.string("filename", &name).boolean("face_normals", !mesh.has_normals);
            let material = Element::new("ref").attribute("id", ids[placed.material.as_str()].clone());
            let shape = shape.with(material);
            root = root.with(emitter.iter().fold(shape, |shape, emitter| shape.with(emitter.clone())));
        }
    }
    Ok(root)
}
