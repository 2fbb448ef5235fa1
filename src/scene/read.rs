//! A scene file, and those that it extends, read and typed.

use std::path::{Path, PathBuf};

use super::assets::Assets;
use super::define::Define;
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::file::{
    Chain, ModelEntry, SceneFile, is_of_family, merge, no_scene, plain_field, read_scene, scene_fields, take_extends,
};
use super::kind::Kind;
use super::ron::{Node, Reader, apply_defines, define_texts, parse};
use super::source::SceneText;
use super::text::Text;

/// Bytes that a scene file may have.
pub const SCENE_LIMIT: u64 = 4 << 20;

/// What a model by itself is a scene of: the sun stands to the right of the camera that sees all of it, a little before the model.
const ALONE: &str = "(environment: Sky(sun: (45, 120)))";

/// Where files are read, and what comes of it beside the scene.
pub struct Reading<'r> {
    pub assets: &'r Assets,
    /// Gets every file that is read or looked for.
    pub files: &'r mut Vec<PathBuf>,
    pub diagnostics: &'r mut Diagnostics,
    /// Whether what changes with time is read too.
    pub animated: bool,
}

impl Reading<'_> {
    /// Reads and types a scene file; for an OBJ file, the scene that holds it alone.
    pub fn scene(&mut self, scene: &Path, defines: &[Define]) -> Option<SceneFile> {
        let file = self.try_scene(scene, defines);
        file.map_err(|error| self.diagnostics.push(error)).ok()
    }

    fn try_scene(&mut self, scene: &Path, defines: &[Define]) -> Result<SceneFile, Diagnostic> {
        let kind = Kind::of(scene).inspect_err(|_| self.files.push(scene.to_path_buf()))?;
        match kind {
            Some(Kind::Model) => {
                let text = Text::new(scene, ALONE.to_owned());
                let mut file = self.typed(parse(&text)?, defines)?;
                file.dark_if_lit = !defines.iter().any(|define| define.path.split('.').next() == Some("environment"));
                let path = scene.file_name().unwrap_or_default().to_string_lossy().into_owned();
                let place = Diagnostic::file(Severity::Error, scene, "");
                file.models.insert(0, ModelEntry::alone(path, place));
                Ok(file)
            }
            Some(Kind::Library) => {
                self.files.push(scene.to_path_buf());
                let error = Diagnostic::file(Severity::Error, scene, "this is a library of materials, not a scene");
                Err(error.help("name the model (.obj) that uses it, or `lucerna check` it"))
            }
            Some(Kind::Scene) | None => self.chain(scene, Vec::new(), Chain::new(scene), defines),
        }
    }

    /// Reads a file and those that it extends. `over` are the trees that extend it, the nearest last.
    fn chain(
        &mut self,
        file: &Path,
        over: Vec<Node>,
        mut chain: Chain,
        defines: &[Define],
    ) -> Result<SceneFile, Diagnostic> {
        self.files.push(file.to_path_buf());
        let text = self.assets.text(file, SCENE_LIMIT);
        let text = text.as_ref().as_ref().map_err(Diagnostic::clone)?;
        let mut root = scene_fields(parse(text)?);
        // Of this text's lifetime from here on, as is the tree that is added.
        let mut over: Vec<Node> = over;
        if is_of_family(&root) {
            return Err(no_scene(file));
        }
        let extends = take_extends(&mut root)?;
        let Some(extends) = extends else {
            let root = over.into_iter().rev().fold(root, |base, over| merge(base, over, plain_field));
            let mut file = self.typed(root, defines)?;
            file.text.put_before(text);
            return Ok(file);
        };
        over.push(root);
        let next = chain.add(&extends)?;
        if let Some(what) = no_scene_file(&next) {
            let message = format!("`{}` is {what}: a scene extends scenes only", extends.name);
            return Err(Diagnostic { message, ..extends.place }.help("name a scene file (.ron)"));
        }
        let mut file = self.chain(&next, over, chain, defines)?;
        file.text.put_before(text);
        Ok(file)
    }

    /// Types a tree that was changed by defines.
    fn typed(&mut self, root: Node, defines: &[Define]) -> Result<SceneFile, Diagnostic> {
        let texts = define_texts(defines);
        let mut root: Node = root;
        apply_defines(&mut root, defines, &texts, plain_field)?;
        let reader = Reader::default();
        let file = read_scene(&reader, &root, self.animated);
        self.diagnostics.list.extend(reader.into_diagnostics());
        Ok(file)
    }
}

/// The tree that a scene's texts come to, each written over those that it extends; none without a text.
pub fn merged(text: &SceneText) -> Result<Option<Node<'_>>, Diagnostic> {
    let mut base: Option<Node> = None;
    for text in text.all().rev() {
        let mut root = scene_fields(parse(text)?);
        take_extends(&mut root)?;
        base = Some(match base {
            Some(base) => merge(base, root, plain_field),
            None => root,
        });
    }
    Ok(base)
}

/// The same, typed; and what is wrong with it.
pub fn retyped(text: &SceneText) -> Result<(SceneFile, Diagnostics), Diagnostic> {
    let reader = Reader::default();
    let file = merged(text)?.map(|root| read_scene(&reader, &root, true)).unwrap_or_default();
    Ok((file, reader.into_diagnostics()))
}

/// What a file is by its ending, where that is no scene.
fn no_scene_file(path: &Path) -> Option<&'static str> {
    match Kind::by_ending(path) {
        Some(Kind::Model) => Some("a model"),
        Some(Kind::Library) => Some("a library of materials"),
        Some(Kind::Scene) | None => None,
    }
}
