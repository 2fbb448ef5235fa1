//! Reads asset files for their messages alone.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::assets::Assets;
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::file::ShaderPlace;
use super::kind::Kind;
use super::lights;
use super::load::{Loaded, attempt_in, bare};
use super::mtl::{Appearance, read_mtl};
use super::text::cannot_read;
use super::textures::Loading;
use super::unseen::unseen_by;
use super::variants::{Family, Member, frames, is_family, load, plan};
use crate::components::ShaderValues;
use crate::files;

/// What a check has read and found.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// The assets that were checked, sorted.
    pub files: Vec<PathBuf>,
    pub diagnostics: Diagnostics,
    /// The materials and lights of each file that no other one of them reads.
    pub tables: Vec<Table>,
    /// What scenes and members of families ask of shaders, where they ask anything.
    pub asked: Vec<Asked>,
}

/// What a scene, a member of a family or a frame asks of shaders.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// A folder of its own.
    pub shaders: Option<PathBuf>,
    /// Where that is written: an error without its message.
    pub place: Diagnostic,
    pub values: ShaderValues,
    /// Where values are set, by their names.
    pub places: BTreeMap<String, ShaderPlace>,
}

/// The materials of a scene, model or library, and the lights of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    pub file: PathBuf,
    /// In the order of their names.
    pub rows: Vec<Row>,
}

/// What a material or a light is taken as, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Of a scene's material, `model:material`.
    pub name: String,
    pub look: Appearance,
}

/// Checks an asset file (OBJ, MTL, RON), or every one in a folder and the folders below it.
///
/// A message that several files lead to (a scene and the model it names) is kept once.
pub fn check(path: &Path) -> Checked {
    let mut checked = Checked::default();
    if path.is_dir() && Kind::by_ending(path).is_none() {
        collect(path, &mut checked);
        if checked.files.is_empty() && !checked.diagnostics.has_errors() {
            let warning = Diagnostic::file(Severity::Warning, path, "there is no asset in this folder");
            checked.diagnostics.push(warning.help(KINDS));
        }
    } else {
        checked.files.push(path.to_path_buf());
    }
    let mut seen = BTreeSet::new();
    let mut read = BTreeSet::new();
    for file in &checked.files {
        let mut found = check_file(file);
        for diagnostic in found.diagnostics {
            if seen.insert((diagnostic.file.clone(), diagnostic.line, diagnostic.column, diagnostic.message.clone())) {
                checked.diagnostics.push(diagnostic);
            }
        }
        if !found.rows.is_empty() {
            found.rows.sort_by(|a, b| a.name.cmp(&b.name));
            checked.tables.push(Table { file: file.clone(), rows: found.rows });
        }
        checked.asked.extend(found.asked);
        read.extend(found.reads.into_iter().filter(|other| other != file).map(identity));
    }
    checked.tables.retain(|table| !read.contains(&identity(table.file.clone())));
    checked
}

/// One path for each file, whatever it was reached by.
fn identity(path: PathBuf) -> PathBuf {
    path.canonicalize().unwrap_or(path)
}

/// What can be checked.
const KINDS: &str = "assets are .ron (scenes and variant files), .obj (models) and .mtl (materials)";

/// Adds the asset files of a folder and those below it.
fn collect(folder: &Path, checked: &mut Checked) {
    match files::walk(folder, files::DEEPEST, |path| Kind::by_ending(path).is_some()) {
        Ok(found) => {
            checked.files = found.files;
            checked.diagnostics.list.extend(found.unread.iter().map(|(path, error)| cannot_read(path, error)));
        }
        Err(error) => checked.diagnostics.push(cannot_read(folder, &files::explained(folder, error))),
    }
}

/// What there is to say of one file.
#[derive(Default)]
struct Found {
    diagnostics: Diagnostics,
    rows: Vec<Row>,
    /// The files it was read from.
    reads: Vec<PathBuf>,
    asked: Vec<Asked>,
}

/// Reads a variant file, and all members as they would be loaded.
fn check_family(path: &Path, assets: &Assets) -> Found {
    let family = match plan(path, &[], assets) {
        Ok(family) => family,
        Err(errors) => return Found { diagnostics: errors, ..Found::default() },
    };
    let mut found = Found { reads: family.files.clone(), ..Found::default() };
    found.diagnostics.list.clone_from(&family.warnings);
    for member in &family.members {
        found.check_member(&family, member, assets);
    }
    found
}

/// Reads one file.
fn check_file(path: &Path) -> Found {
    let mut found = Found::default();
    let assets = Assets::new();
    if is_family(path, &assets) {
        return check_family(path, &assets);
    }
    match Kind::of(path) {
        Ok(Some(kind @ (Kind::Scene | Kind::Model))) => {
            let (loaded, reads) = attempt_in(path, &[], true, &Loading::default(), &assets);
            found.reads = reads;
            match loaded {
                Ok(loaded) => {
                    found.take(path, kind, loaded);
                    found.check_frames(path, &assets);
                }
                Err(errors) => found.diagnostics = errors,
            }
        }
        Ok(Some(Kind::Library)) => {
            let materials = read_mtl(path, &mut found.diagnostics).unwrap_or_default().materials;
            found.rows.extend(materials.into_iter().map(|(name, material)| Row { name, look: material.appearance() }));
        }
        Ok(None) => {
            let message = "can't check this kind of file";
            found.diagnostics.push(Diagnostic::file(Severity::Error, path, message).help(KINDS));
        }
        Err(error) => found.diagnostics.push(error),
    }
    found
}

impl Found {
    /// Reads a member as it would be loaded. Whether nothing is wrong with it.
    fn check_member(&mut self, family: &Family, member: &Member, assets: &Assets) -> bool {
        let (loaded, reads) = load(family, member, &Loading::default(), assets);
        self.reads.extend(reads);
        let sound = loaded.is_ok();
        let given = (member.shaders.clone(), member.place.clone());
        let told = match loaded {
            Ok(loaded) => {
                self.ask(given, loaded.description.shader, loaded.shader_places);
                loaded.warnings
            }
            Err(errors) => {
                self.ask(given, ShaderValues::default(), BTreeMap::new());
                errors.list
            }
        };
        self.diagnostics.list.extend(told);
        sound
    }

    /// Keeps what is asked of shaders, if anything is.
    fn ask(
        &mut self,
        (shaders, place): (Option<PathBuf>, Diagnostic),
        values: ShaderValues,
        places: BTreeMap<String, ShaderPlace>,
    ) {
        if shaders.is_some() || !values.0.is_empty() {
            self.asked.push(Asked { shaders, place, values, places });
        }
    }

    /// Reads the frames of a scene, where it has some, up to the first that is wrong: others are so by the same keys. Those of keys come
    /// first: what is wrong with one is told as it is written.
    fn check_frames(&mut self, scene: &Path, assets: &Assets) {
        match frames(scene, &[], assets) {
            Ok(None) => {}
            Ok(Some(family)) => {
                let mut order: Vec<usize> = (0..family.members.len()).collect();
                order.sort_by_key(|frame| !family.keyed.contains(frame));
                // All of them as long as there is nothing wrong.
                let _ = order.into_iter().all(|frame| self.check_member(&family, &family.members[frame], assets));
            }
            Err(errors) => self.diagnostics.list.extend(errors.list),
        }
    }

    /// Takes the messages, materials and lights of a scene, and what its cameras miss.
    fn take(&mut self, path: &Path, kind: Kind, loaded: Loaded) {
        self.diagnostics.list = loaded.warnings;
        let description = &loaded.description;
        for camera in description.cameras.keys() {
            let unseen = unseen_by(description, camera, path);
            self.diagnostics.list.extend(unseen);
        }
        for (key, material) in &description.materials {
            // A model by itself is named by its file.
            let name = if kind == Kind::Model { bare(key) } else { key };
            self.rows.push(Row { name: name.to_owned(), look: material.appearance() });
        }
        let listed = |(name, light): (&String, _)| Row { name: name.clone(), look: lights::appearance(light) };
        self.rows.extend(description.lights.iter().map(listed));
        let place = Diagnostic::file(Severity::Error, path, "");
        self.ask((None, place), loaded.description.shader, loaded.shader_places);
    }
}
