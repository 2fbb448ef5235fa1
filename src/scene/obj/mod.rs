//! Models of OBJ files.
//!
//! Threads read pieces of a file ([`plain`]), each of them the lines of which nothing is to be told; a [`scanner::Scanner`] takes the pieces in
//! their order, checks what depends on what came before, and all other lines one by one. Where something is wrong, it reads the whole file
//! line by line, and reports each fault at its line and column. What there is, and what is told, is the same either way. The crate `tobj`, which
//! knows no line numbers, reads on one thread, loses the first line after a byte order mark and takes NaN for a number, is what tests
//! compare the meshes with.

mod decimal;
mod faces;
mod geometry;
mod libraries;
mod parts;
mod pieces;
mod plain;
mod scanner;
mod statements;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufReader, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::Assets;
use super::bounds::Bounds;
use super::diagnostic::{Diagnostic, Diagnostics};
use super::model::{DEFAULT_MATERIAL, Imported, Model, ModelMesh};
use super::suggest::known_names;
use super::text;
use crate::components::MeshData;
use faces::Group;
use libraries::Libraries;
use pieces::PIECE;
use scanner::{Scanned, Scanner};

pub use statements::is_statement;

/// Bytes that an OBJ file may have.
const LIMIT: u64 = 4 << 30;

/// Reads an OBJ file and the MTL files it names: a mesh for each object and material.
pub fn read_obj(file: &Path, assets: &Assets) -> Imported {
    let mut imported = Imported::default();
    imported.model = read(file, assets, Some(PIECE), &mut imported.messages, &mut imported.files);
    imported
}

/// Meshes and their names.
pub type NamedMeshes = Vec<(String, Arc<MeshData>)>;

/// The meshes of an OBJ file by their names, and all that is told of it, read by pieces of about some bytes; without, line by line. Both
/// come to the same.
pub fn read_obj_by(file: &Path, piece: Option<usize>) -> (Option<NamedMeshes>, Diagnostics) {
    let mut messages = Diagnostics::default();
    let model = read(file, &Assets::new(), piece, &mut messages, &mut Vec::new());
    (model.map(|model| model.meshes.into_iter().map(|mesh| (mesh.name, mesh.geometry)).collect()), messages)
}

fn read(
    file: &Path,
    assets: &Assets,
    piece: Option<usize>,
    diagnostics: &mut Diagnostics,
    files: &mut Vec<PathBuf>,
) -> Option<Model> {
    files.push(file.to_path_buf());
    let mut handle = text::open(file, LIMIT).map_err(|error| diagnostics.push(error)).ok()?;
    let in_pieces = piece.and_then(|piece| pieces::read(file, &handle, piece).ok());
    let scanned = match in_pieces {
        Some(scanned) => scanned,
        None => {
            let rewound = handle.rewind();
            rewound.map_err(|error| diagnostics.push(text::cannot_read(file, &error))).ok()?;
            Scanner::new(file).read(BufReader::with_capacity(1 << 18, handle))
        }
    };
    let Scanned { messages, groups, libraries, values, corners } = scanned;
    let libraries = Libraries::read(file, &libraries, &groups, assets, diagnostics, files);
    let broken = messages.has_errors();
    diagnostics.list.extend(messages);
    if broken {
        return None;
    }
    let (parts, bounds) = parts::collect(&groups, &values, &corners);
    let model = assemble(&libraries, parts, bounds, &groups, diagnostics);
    Some(Model { map_places: libraries.map_places, sources: libraries.sources, ..model })
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
