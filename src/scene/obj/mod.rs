//! Models of OBJ files.
//!
//! A [`scanner::Scanner`] reads the file as a stream, checks each statement, reports what is wrong at its line and column, and
//! passes on only what is right, in a plain form, to tobj, which builds the meshes: tobj itself knows no line numbers, loses
//! the first line after a byte order mark and takes NaN for a number. What it is never shown it can't stumble over.

mod faces;
mod libraries;
mod parts;
mod scanner;
mod statements;

use std::collections::{BTreeMap, BTreeSet};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::Assets;
use super::bounds::Bounds;
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::model::{DEFAULT_MATERIAL, Imported, Model, ModelMesh};
use super::suggest::known_names;
use super::text;
use crate::components::MeshData;
use faces::Group;
use libraries::Libraries;
use scanner::{Scanned, Scanner};

pub use statements::is_statement;

/// Bytes that an OBJ file may have.
const LIMIT: u64 = 4 << 30;

/// Reads an OBJ file and the MTL files it names: a mesh for each object and material.
pub fn read_obj(file: &Path, assets: &Assets) -> Imported {
    let mut imported = Imported::default();
    imported.model = read(file, assets, &mut imported.messages, &mut imported.files);
    imported
}

fn read(file: &Path, assets: &Assets, diagnostics: &mut Diagnostics, files: &mut Vec<PathBuf>) -> Option<Model> {
    files.push(file.to_path_buf());
    let handle = text::open(file, LIMIT).map_err(|error| diagnostics.push(error)).ok()?;
    let mut scanner = Scanner::new(BufReader::with_capacity(1 << 18, handle), file);
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, triangulate: false, single_index: false };
    // tobj is shown no libraries.
    let models = tobj::load_obj_buf(&mut scanner, &options, |_| Ok(Default::default()));
    let Scanned { messages, groups, libraries } = scanner.finish();
    let libraries = Libraries::read(file, &libraries, &groups, assets, diagnostics, files);
    let broken = messages.has_errors();
    diagnostics.list.extend(messages);
    match models {
        Ok((models, _)) if !broken => {
            let (parts, bounds) = parts::collect(models, &groups);
            let model = assemble(&libraries, parts, bounds, &groups, diagnostics);
            Some(Model { map_places: libraries.map_places, sources: libraries.sources, ..model })
        }
        Ok(_) => None,
        Err(error) => {
            if !broken {
                diagnostics.push(Diagnostic::file(
                    Severity::Error,
                    file,
                    format!("tobj can't read this file: {error}"),
                ));
            }
            None
        }
    }
}

/// Gives each part its material and its name.
fn assemble(
    libraries: &Libraries,
    parts: Vec<(usize, MeshData)>,
    bounds: Bounds,
    groups: &[Group],
    diagnostics: &mut Diagnostics,
) -> Model {
    let mut model = Model { meshes: Vec::with_capacity(parts.len()), bounds, ..Model::default() };
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    let mut unknown = BTreeSet::new();
    let mut unplaced = BTreeSet::new();
    for (number, geometry) in parts {
        let group = &groups[number];
        let name = group.material.as_ref().map(|(name, _)| name.as_str());
        let found = name.and_then(|name| libraries.materials.get(name));
        if let (Some((name, place)), None) = (&group.material, found)
            // Where a library is missing, that was said already.
            && libraries.are_known()
            && unknown.insert(name)
        {
            let help = known_names(name, libraries.materials.keys().map(String::as_str));
            let message = format!("no library has a material `{name}`: it is rendered grey");
            diagnostics.push(Diagnostic { message, ..place.clone() }.help(help));
        }
        if let (Some((name, place)), Some(material)) = (&group.material, found)
            && !group.uvs
            && material.maps.uses().next().is_some()
            && unplaced.insert(name)
        {
            let message = format!(
                "material `{name}` has maps, but faces here have no texture coordinates (`vt`): its pictures show one texel there, the lower left"
            );
            diagnostics.push(Diagnostic { message, ..place.clone() }.help("export the model with texture coordinates"));
        }
        let key = name.unwrap_or(DEFAULT_MATERIAL);
        model.materials.entry(key.to_owned()).or_insert_with(|| found.cloned().unwrap_or_default());
        let count = counts.entry(&group.object).or_insert(0);
        let name = format!("{}/{count}", group.object);
        *count += 1;
        model.meshes.push(ModelMesh { name, material: key.to_owned(), geometry: Arc::new(geometry) });
    }
    model
}
