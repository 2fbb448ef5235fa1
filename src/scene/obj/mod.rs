//! Models of OBJ files.
//!
//! A [`scanner::Scanner`] reads the file as a stream, checks each statement, reports what is wrong at its line and column, and
//! passes on only what is right, in a plain form, to tobj, which builds the meshes: tobj itself knows no line numbers, loses
//! the first line after a byte order mark and takes NaN for a number. What it is never shown it can't stumble over.

mod faces;
mod parts;
mod scanner;
mod statements;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::mtl::read_mtl;
use super::suggest::known_names;
use super::text;
use crate::components::{Material, MeshData};
use faces::Group;
use scanner::{Library, Scanner};

/// Bytes that an OBJ file may have.
const LIMIT: u64 = 4 << 30;

/// The name of the material of meshes without one.
const DEFAULT_MATERIAL: &str = "default";

/// A model: its parts, one for each object and material, and the materials of its libraries that they use.
#[derive(Clone, Debug)]
pub struct Model {
    pub parts: Vec<Part>,
    pub materials: BTreeMap<String, Material>,
    /// Least and greatest coordinates, model space.
    pub bounds: (DVec3, DVec3),
}

/// One mesh of a model.
#[derive(Clone, Debug)]
pub struct Part {
    /// `object/3`: the object's name, and the number of this part within it.
    pub name: String,
    /// A key of the model's materials.
    pub material: String,
    pub geometry: Arc<MeshData>,
}

/// Reads an OBJ file and the MTL files it names. `None` where it can't be used; its messages say why.
///
/// `files` gets every file that was read or looked for.
pub fn read_obj(file: &Path, diagnostics: &mut Diagnostics, files: &mut Vec<PathBuf>) -> Option<Model> {
    files.push(file.to_path_buf());
    let handle = text::open(file, LIMIT).map_err(|error| diagnostics.push(error)).ok()?;
    let libraries = RefCell::new(Vec::new());
    let mut scanner = Scanner::new(BufReader::with_capacity(1 << 18, handle), file, &libraries);
    let mut loaded = Libraries::default();
    let shared = RefCell::new((&mut loaded, &mut *diagnostics, &mut *files));
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, triangulate: false, single_index: false };
    let models = tobj::load_obj_buf(&mut scanner, &options, |name| {
        let (loaded, diagnostics, files) = &mut *shared.borrow_mut();
        Ok(loaded.load(name, file, &libraries.borrow(), diagnostics, files))
    });
    let (found, groups) = scanner.finish();
    let broken = found.has_errors();
    diagnostics.list.extend(found);
    match models {
        Ok((models, _)) if !broken => {
            let (parts, bounds) = parts::collect(models, &groups);
            Some(loaded.into_model(parts, bounds, &groups, diagnostics))
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

/// The materials of a model's MTL files.
#[derive(Default)]
struct Libraries {
    materials: BTreeMap<String, Material>,
    read: BTreeSet<PathBuf>,
}

impl Libraries {
    /// Reads one library for tobj, which gets the names alone: `name` is the library's number in the scanner's list.
    fn load(
        &mut self,
        name: &Path,
        obj: &Path,
        list: &[Library],
        diagnostics: &mut Diagnostics,
        files: &mut Vec<PathBuf>,
    ) -> (Vec<tobj::Material>, std::collections::HashMap<String, usize>) {
        let number: usize = name.to_str().and_then(|name| name.parse().ok()).unwrap_or(usize::MAX);
        let Some(library) = list.get(number) else { return Default::default() };
        let path = obj.parent().unwrap_or(Path::new("")).join(library.name.replace('\\', "/"));
        if !self.read.insert(path.clone()) {
            return Default::default();
        }
        files.push(path.clone());
        if !path.is_file() {
            let message = text::missing("material library", &path);
            let help = "its materials are rendered grey; the path is relative to the folder of the OBJ file";
            diagnostics.push(Diagnostic { message, ..library.place.clone() }.help(help));
            return Default::default();
        }
        let materials = read_mtl(&path, diagnostics).unwrap_or_default();
        let named = |name: &String| tobj::Material { name: name.clone(), ..Default::default() };
        let list = materials.iter().map(|(name, _)| named(name)).collect();
        let numbers = materials.iter().enumerate().map(|(i, (name, _))| (name.clone(), i)).collect();
        for (name, material) in materials {
            self.materials.entry(name).or_insert(material);
        }
        (list, numbers)
    }

    /// Gives each part its material and its name.
    fn into_model(
        self,
        parts: Vec<(usize, MeshData)>,
        bounds: (DVec3, DVec3),
        groups: &[Group],
        diagnostics: &mut Diagnostics,
    ) -> Model {
        let mut model = Model { parts: Vec::with_capacity(parts.len()), materials: BTreeMap::new(), bounds };
        let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
        let mut unknown = BTreeSet::new();
        for (number, geometry) in parts {
            let group = &groups[number];
            let name = group.material.as_ref().map(|(name, _)| name.as_str());
            let found = name.and_then(|name| self.materials.get_key_value(name));
            if let (Some((name, place)), None) = (&group.material, found)
                // Where a library is missing, that was said already.
                && (!self.materials.is_empty() || self.read.is_empty())
                && unknown.insert(name)
            {
                let help = known_names(name, self.materials.keys().map(String::as_str));
                let message = format!("no library has a material `{name}`: it is rendered grey");
                diagnostics.push(Diagnostic { message, ..place.clone() }.help(help));
            }
            let key = name.unwrap_or(DEFAULT_MATERIAL);
            model
                .materials
                .entry(key.to_owned())
                .or_insert_with(|| found.map_or_else(Material::default, |(_, m)| m.clone()));
            let count = counts.entry(&group.object).or_insert(0);
            let name = format!("{}/{count}", group.object);
            *count += 1;
            model.parts.push(Part { name, material: key.to_owned(), geometry: Arc::new(geometry) });
        }
        model
    }
}
