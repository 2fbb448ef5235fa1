//! A scene file and all it names, read into one description.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::Assets;
use super::dark::{dark, is_lit};
use super::define::Define;
use super::description::{MeshEntry, SceneDescription};
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::environment::EnvironmentEntry;
use super::file::{DEFAULT_CAMERA, MaterialEntry, ModelEntry, SceneFile, ShaderPlace};
use super::framing::framing;
use super::kind::Kind;
use super::locate::{as_written, file_names, folder_of, relative_to, stem};
use super::model::FARTHEST;
use super::mtl::{Edited, MtlMaterial};
use super::obj::read_obj;
use super::place::{Placed, place};
use super::read::Reading;
use super::sky::read_sky;
use super::source::SceneText;
use super::suggest::{did_you_mean, known_names};
use super::text::missing;
use super::textures::{self, Loading};
use super::unseen::{Beyond, beyond, unseen_by, unseen_model};
use crate::components::{Environment, ShaderValues, Texture, Transform};

/// What loading gives.
#[derive(Clone, Debug)]
pub struct Loaded {
    pub description: SceneDescription,
    /// What was not taken as written, in the order it was met.
    pub warnings: Vec<Diagnostic>,
    /// Every file that was read, or that was looked for and is missing.
    pub files: Vec<PathBuf>,
    /// Pictures that are empty or cut short: if one was saved just now, its rest may follow.
    pub unfinished: Vec<PathBuf>,
    /// The fields of settings that the scene or a define gives.
    pub given: BTreeSet<&'static str>,
    /// Of each material of the description, where it comes from.
    pub origins: BTreeMap<String, Origin>,
    /// Where shaders' parameters are set, by their names.
    pub shader_places: BTreeMap<String, ShaderPlace>,
    /// The scene file as it was read.
    pub text: SceneText,
}

/// Where a material comes from.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The library that has it; none where none has.
    pub library: Option<Arc<Path>>,
    /// What the scene file changed.
    pub edited: Edited,
}

/// Reads a scene file; or an OBJ file, with a camera that sees all of it, and by day where nothing of it sends out light.
///
/// `defines` change values of the scene file by field path before it is typed: `materials.teapot.ns` to `64`.
pub fn load(scene: &Path, defines: &[Define]) -> Result<Loaded, Diagnostics> {
    attempt(scene, defines).0
}

/// The same, with other bounds for pictures, and somebody who is told how far they are.
pub fn load_with(scene: &Path, defines: &[Define], loading: &Loading) -> Result<Loaded, Diagnostics> {
    attempt_in(scene, defines, true, loading, &Assets::new()).0
}

/// The same as [`load`], and every file that was read or looked for, whatever came of it.
pub fn attempt(scene: &Path, defines: &[Define]) -> (Result<Loaded, Diagnostics>, Vec<PathBuf>) {
    attempt_in(scene, defines, true, &Loading::default(), &Assets::new())
}

/// The same, of files as they are held: what another scene has read is not read again. `animated`: what the scene says of values that change
/// with time is held to its rules; of a member of a family, nobody asks.
pub fn attempt_in(
    scene: &Path,
    defines: &[Define],
    animated: bool,
    loading: &Loading,
    assets: &Assets,
) -> (Result<Loaded, Diagnostics>, Vec<PathBuf>) {
    let mut loader = Loader {
        assets,
        files: Vec::new(),
        diagnostics: Diagnostics::default(),
        models: BTreeSet::new(),
        map_places: BTreeMap::new(),
        unfinished: Vec::new(),
        origins: BTreeMap::new(),
        shader_places: BTreeMap::new(),
        given: BTreeSet::new(),
        text: SceneText::default(),
    };
    let description = loader.load(scene, defines, animated, loading);
    let files = loader.files.clone();
    let loaded = match description {
        Some(description) if !loader.diagnostics.has_errors() => {
            let Loader { diagnostics, files, unfinished, given, origins, shader_places, text, .. } = loader;
            let warnings = diagnostics.list;
            Ok(Loaded { description, warnings, files, unfinished, given, origins, shader_places, text })
        }
        _ => Err(loader.diagnostics),
    };
    (loaded, files)
}

struct Loader<'s> {
    assets: &'s Assets,
    files: Vec<PathBuf>,
    diagnostics: Diagnostics,
    /// OBJ files of which all was told.
    models: BTreeSet<PathBuf>,
    /// By the files that maps name: the first place that does, as a warning without its message.
    map_places: BTreeMap<PathBuf, Diagnostic>,
    /// Pictures that are empty or cut short.
    unfinished: Vec<PathBuf>,
    origins: BTreeMap<String, Origin>,
    shader_places: BTreeMap<String, ShaderPlace>,
    given: BTreeSet<&'static str>,
    text: SceneText,
}

impl Loader<'_> {
    fn load(
        &mut self,
        scene: &Path,
        defines: &[Define],
        animated: bool,
        loading: &Loading,
    ) -> Option<SceneDescription> {
        let Self { assets, files, diagnostics, .. } = self;
        let mut file = Reading { assets, files, diagnostics, animated }.scene(scene, defines)?;
        self.given = std::mem::take(&mut file.given);
        self.text = std::mem::take(&mut file.text);
        let mut meshes = BTreeMap::new();
        let mut materials = BTreeMap::new();
        let placed = place(&file.models, &mut self.diagnostics);
        let mut models = Vec::new();
        for (entry, placed) in file.models.iter().zip(placed) {
            let placed = placed.filter(|placed| self.add_model(scene, entry, placed, &mut meshes, &mut materials));
            models.push(placed.map(|placed| placed.name));
        }
        for mut entry in edits(&mut file, &models) {
            self.find_maps(scene, &mut entry);
            self.edit_materials(&entry, &mut materials);
        }
        let cameras = match file.cameras {
            none if none.is_empty() => {
                BTreeMap::from([(DEFAULT_CAMERA.to_owned(), framing(&meshes, file.settings.film.size))])
            }
            cameras => cameras,
        };
        let environment = file.environment.and_then(|entry| self.read_environment(scene, entry));
        let active = file.active.or_else(|| cameras.keys().next().cloned())?;
        let textures = self.load_textures(&meshes, &materials, loading);
        for material in materials.values_mut() {
            material.settle(|map, used| textures.contains_key(&textures::name(map, used)));
        }
        let lit = file.dark_if_lit && is_lit(&meshes, &materials, &file.lights);
        let environment = environment.filter(|_| !lit);
        let values = file.shader.iter().map(|(name, entry)| (name.clone(), entry.0)).collect();
        self.shader_places.extend(file.shader.into_iter().map(|(name, entry)| (name, entry.1)));
        let description = SceneDescription {
            name: stem(scene),
            meshes,
            materials,
            textures,
            cameras,
            active,
            lights: file.lights,
            film: file.settings.film,
            render: file.settings.render,
            shader: ShaderValues(values),
            environment,
        };
        self.warn_of_unseen(&description, models.iter().zip(&file.models), scene);
        let sound = !self.diagnostics.has_errors();
        self.diagnostics.list.extend(dark(&description, scene).filter(|_| sound));
        Some(description)
    }

    /// Says which models can't be seen at all.
    fn warn_of_unseen<'m>(
        &mut self,
        description: &SceneDescription,
        models: impl Iterator<Item = (&'m Option<String>, &'m ModelEntry)>,
        scene: &Path,
    ) {
        for (name, entry) in models {
            if let Some(message) = name.as_ref().and_then(|name| unseen_model(description, name)) {
                self.diagnostics.push(Diagnostic { message, severity: Severity::Warning, ..entry.place.clone() });
            }
        }
        let camera = description.cameras.get(&description.active);
        if camera.and_then(|camera| beyond(description, camera)) == Some(Beyond::Behind) {
            self.diagnostics.list.extend(unseen_by(description, &description.active, scene));
        }
    }

    /// The environment, with its picture.
    fn read_environment(&mut self, scene: &Path, entry: EnvironmentEntry) -> Option<Environment> {
        match entry {
            EnvironmentEntry::Constant(radiance) => Some(Environment::Constant(radiance)),
            EnvironmentEntry::Daylight(day) => Some(Environment::Daylight(day)),
            EnvironmentEntry::Map { path, strength, tint, turn, place } => {
                let path = folder_of(&place, scene).join(path.replace('\\', "/"));
                self.files.push(path.clone());
                let sky = self.assets.sky(&path, || read_sky(&path));
                self.diagnostics.list.extend(sky.messages(&place));
                let image = sky.image.clone()?;
                Some(Environment::Map { image, strength, tint, turn })
            }
        }
    }

    /// The textures of the materials that meshes have.
    fn load_textures(
        &mut self,
        meshes: &BTreeMap<String, MeshEntry>,
        materials: &BTreeMap<String, MtlMaterial>,
        loading: &Loading,
    ) -> BTreeMap<String, Texture> {
        let used: BTreeSet<&String> = meshes.values().map(|mesh| &mesh.material).collect();
        let maps = used.into_iter().filter_map(|name| materials.get(name)).flat_map(MtlMaterial::seen_maps);
        if self.diagnostics.has_errors() {
            // A scene that can't be used waits for its files all the same.
            self.files.extend(maps.map(|(map, _)| map.file.clone()));
            return BTreeMap::new();
        }
        let found = textures::load(maps, &|file| self.place_of_map(file), loading, self.assets);
        self.diagnostics.list.extend(found.messages);
        self.files.extend(found.files);
        self.unfinished = found.unfinished;
        found.textures
    }

    /// Where a picture is named first: a warning without its message.
    fn place_of_map(&self, file: &Path) -> Diagnostic {
        self.map_places.get(file).cloned().unwrap_or_else(|| Diagnostic::file(Severity::Warning, file, ""))
    }

    /// Adds the meshes and materials of one model where it is placed. Whether there is one.
    fn add_model(
        &mut self,
        scene: &Path,
        entry: &ModelEntry,
        Placed { name, transform }: &Placed,
        meshes: &mut BTreeMap<String, MeshEntry>,
        materials: &mut BTreeMap<String, MtlMaterial>,
    ) -> bool {
        let Some(path) = self.find_model(scene, entry) else { return false };
        let imported = self.assets.model(&path, || read_obj(&path, self.assets));
        if self.models.insert(path.clone()) {
            self.diagnostics.list.extend(imported.messages.list.iter().cloned());
            self.files.extend(imported.files.iter().cloned());
        }
        let Some(model) = imported.model.as_ref() else { return false };
        for (file, place) in &model.map_places {
            self.map_places.entry(file.clone()).or_insert_with(|| place.clone());
        }
        for part in &model.meshes {
            let material = format!("{name}:{}", part.material);
            let mesh = MeshEntry { geometry: part.geometry.clone(), transform: Transform(*transform), material };
            meshes.insert(format!("{name}/{}", part.name), mesh);
        }
        for (material, value) in &model.materials {
            let origin = Origin { library: model.sources.get(material).cloned(), ..Origin::default() };
            self.origins.insert(format!("{name}:{material}"), origin);
            materials.insert(format!("{name}:{material}"), value.clone());
        }
        let corners = model.bounds.corners().map(|corner| transform.transform_point3(corner));
        if !corners.iter().all(|corner| corner.abs().max_element() <= FARTHEST) {
            let message = format!("this model reaches beyond {FARTHEST:e} units in world space");
            let help = "scale it down: single precision can't hold such distances";
            self.diagnostics.push(Diagnostic { message, ..entry.place.clone() }.help(help));
        }
        true
    }

    /// The file of a model, if it is one.
    fn find_model(&mut self, scene: &Path, entry: &ModelEntry) -> Option<PathBuf> {
        let folder = folder_of(&entry.place, scene);
        // A model that is opened by itself may have any name.
        let path = if entry.place.line > 0 { as_written(folder, &entry.path) } else { entry.place.file.clone() };
        let error = if !path.is_file()
            && entry.place.line > 0
            && !matches!(Kind::by_ending(&path), Some(Kind::Scene | Kind::Library))
        {
            let names = file_names(path.parent().unwrap_or(folder));
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let near = did_you_mean(&name, names.iter().map(String::as_str));
            let help = near.unwrap_or_else(|| relative_to(&entry.place, scene));
            Diagnostic { message: missing("file", &path), ..entry.place.clone() }.help(help)
        } else {
            match Kind::of(&path) {
                Ok(Some(Kind::Model)) => return Some(path),
                Ok(_) => {
                    let message = format!("`{}` is no .obj file: models are read from OBJ files only", entry.path);
                    Diagnostic { message, ..entry.place.clone() }
                }
                Err(error) => {
                    let message = format!("can't use `{}` as a model: {}", entry.path, error.message);
                    Diagnostic { message, help: error.help, ..entry.place.clone() }
                }
            }
        };
        self.files.push(path);
        self.diagnostics.push(error);
        None
    }

    /// Finds the pictures that an entry of the scene file's `materials` names.
    fn find_maps(&mut self, scene: &Path, entry: &mut MaterialEntry) {
        for found in entry.edit.find_maps(scene) {
            if let Some(message) = found.message {
                self.files.push(found.path.clone());
                self.diagnostics.push(message);
            }
            self.map_places.entry(found.path).or_insert(found.place);
        }
    }

    /// Applies one entry of the scene file's `materials`: to a full key, or to every model's material of that name.
    fn edit_materials(&mut self, entry: &MaterialEntry, materials: &mut BTreeMap<String, MtlMaterial>) {
        let mut found = false;
        for (key, material) in materials.iter_mut() {
            if *key == entry.name || bare(key) == entry.name {
                let glass = entry.edit.asks_for_glass();
                for error in entry.edit.apply(material) {
                    let told = self.diagnostics.list.contains(&error);
                    self.diagnostics.list.extend((!told).then_some(error));
                }
                let origin = self.origins.entry(key.clone()).or_default();
                origin.edited.extend(entry.edit.fields().map(|field| (field, entry.place.clone())));
                found = true;
                if glass && !material.is_glass() {
                    let (illum, look) = (material.illum, material.appearance().kind);
                    let message = format!("`illum {illum}` alone makes no glass of `{key}`, which is {look}");
                    let warning = Diagnostic { message, severity: Severity::Warning, ..entry.place.clone() };
                    self.diagnostics.push(warning.help("for glass, give it `ni` or `tf` too"));
                } else if entry.edit.asks_for_pane() && !material.is_glass() {
                    let message = format!("`thin` makes no pane of `{key}`, which is {}", material.appearance().kind);
                    let warning = Diagnostic { message, severity: Severity::Warning, ..entry.place.clone() };
                    self.diagnostics.push(warning.help("for glass, give it `illum: 4`, and `ni` or `tf`"));
                }
            }
        }
        if !found && !self.diagnostics.has_errors() {
            let known: Vec<&str> = if entry.name.contains(':') {
                materials.keys().map(String::as_str).collect()
            } else {
                materials.keys().map(|key| bare(key)).collect()
            };
            let message = format!("no model has a material `{}`", entry.name);
            let help = known_names(&entry.name, known);
            self.diagnostics.push(Diagnostic { message, ..entry.place.clone() }.help(help));
        }
    }
}

/// The material's own name within a key `model:material`.
pub fn bare(key: &str) -> &str {
    key.split_once(':').map_or(key, |(_, name)| name)
}

/// All changes of materials, those that count over others behind them: what the scene says of a name, what a model says of its own, and
/// what the scene says of one model's. `models` are the names of those that there are.
fn edits(file: &mut SceneFile, models: &[Option<String>]) -> Vec<MaterialEntry> {
    let full = file.materials.iter().position(|entry| entry.name.contains(':')).unwrap_or(file.materials.len());
    let full = file.materials.split_off(full);
    let mut edits = std::mem::take(&mut file.materials);
    for (model, entry) in models.iter().zip(&mut file.models) {
        let own = std::mem::take(&mut entry.materials).into_iter();
        let named = |name: &String, own: MaterialEntry| MaterialEntry { name: format!("{name}:{}", own.name), ..own };
        edits.extend(own.filter_map(|own| Some(named(model.as_ref()?, own))));
    }
    edits.extend(full);
    edits
}
