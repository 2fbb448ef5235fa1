//! What was changed in the window, saved into the scene's file; of a model by itself, into a new one beside it. Knows files, and no window.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::app::new::template;
use crate::files;
use crate::image::{SaveError, file};
use crate::scene::edit::{Edited, edit};
use crate::scene::{Diagnostic, SceneDescription, SceneText};

/// What some editors write before UTF-8.
const MARK: &str = "\u{feff}";

/// Bytes that are read of a file: more than a scene file may have.
const LIMIT: u64 = 64 << 20;

/// A scene as a file has it.
#[derive(Clone, Debug)]
pub struct Kept {
    pub text: SceneText,
    pub description: SceneDescription,
}

/// A save that was done.
#[derive(Debug)]
pub struct Saved {
    pub path: PathBuf,
    pub edited: Edited,
    /// The file was not there before.
    pub is_new: bool,
    pub kept: Kept,
}

/// Why nothing was saved. Each says what to do.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum Unsaved {
    #[error("{}: was changed since it was read, and is not written over", .0.display())]
    #[diagnostic(help("it is taken up as soon as nothing is wrong with it, or by F5: save again after that"))]
    Changed(PathBuf),
    #[error("{}: may not be written", .0.display())]
    #[diagnostic(help("copy it and open the copy, or change its permissions"))]
    ReadOnly(PathBuf),
    #[error("{}: is there already, and is not written over", .0.display())]
    #[diagnostic(help("open it in place of the model, or give it another name"))]
    IsThere(PathBuf),
    #[error("{}: can't be read: {source}", path.display())]
    #[diagnostic(help("what was read of it may be saved once it is there again"))]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{}: can't be written: {source}", path.display())]
    #[diagnostic(help("copy the scene to a folder that you may write to, and open the copy"))]
    Write { path: PathBuf, source: std::io::Error },
    #[error("the scene was read from no file")]
    #[diagnostic(help("`lucerna new NAME` writes one"))]
    NoFile,
    #[error("{name} was opened by its name, and {} is not written over", path.display())]
    #[diagnostic(help("copy it and open the copy; or open it by its path, to save into it"))]
    Found { name: String, path: PathBuf },
    #[error("{0}")]
    Place(SaveError),
    #[error("{member}: is a member of {}, and what is changed in the window is not saved into that", family.display())]
    #[diagnostic(help("open {} by itself, or write it into the variant file by hand (the buttons `copy as RON` give lines)", scene.display()))]
    Member { member: String, family: PathBuf, scene: PathBuf },
    #[error("{0}")]
    Text(Box<Diagnostic>),
}

/// Saves what differs between the scene as it is `now` and as it was taken up, or as it was saved `last`, into the file that it was read from:
/// only if that still has the text of the one or the other.
pub fn save(taken: &Kept, last: Option<&Kept>, now: &SceneDescription) -> Result<Saved, Unsaved> {
    let path = taken.text.file().map(Path::to_path_buf).ok_or(Unsaved::NoFile)?;
    let held = read(&path)?;
    let text = held.strip_prefix(MARK).unwrap_or(&held);
    let is_held = |kept: &&Kept| kept.text.file() == Some(&path) && kept.text.text() == Some(text);
    let from = [Some(taken), last].into_iter().flatten().find(is_held);
    let from = from.ok_or_else(|| Unsaved::Changed(path.clone()))?;
    write_edits(from, &path, held.len() > text.len(), now)
}

/// Saves a model that was opened by itself, as it is `now`, into a scene file beside it; or, once that was done, what differs from `last`.
/// `taken` is the model as it was read.
pub fn save_model(
    model: &Path,
    taken: &SceneDescription,
    last: Option<&Kept>,
    now: &SceneDescription,
) -> Result<Saved, Unsaved> {
    let path = model.with_extension("ron");
    if let Some(last) = last.filter(|last| last.text.file() == Some(&path)) {
        return save(last, None, now);
    }
    if path.exists() {
        return Err(Unsaved::IsThere(path));
    }
    let alone = SceneDescription { materials: taken.materials.clone(), ..now.clone() };
    let name = model.file_name().unwrap_or_default().to_string_lossy();
    let camera = now.cameras.get(&now.active).copied().unwrap_or_default();
    let text = template::scene(&name, (&now.active, &camera), &alone);
    let from = Kept { text: SceneText::new(&path, text), description: template::said(&alone) };
    write_edits(&from, &path, false, now).map(|saved| Saved { is_new: true, ..saved })
}

/// Writes the text of a file with what differs from it. Nothing is written where nothing does, unless there is no file yet.
fn write_edits(from: &Kept, path: &Path, marked: bool, now: &SceneDescription) -> Result<Saved, Unsaved> {
    let edited = edit(&from.text, &from.description, now).map_err(|error| Unsaved::Text(Box::new(error)))?;
    if !edited.is_unchanged() || !path.exists() {
        if std::fs::metadata(path).is_ok_and(|metadata| metadata.permissions().readonly()) {
            return Err(Unsaved::ReadOnly(path.to_path_buf()));
        }
        let mark = if marked { MARK } else { "" };
        file::write(path, |out| out.write_all(mark.as_bytes()).and_then(|()| out.write_all(edited.text.as_bytes())))
            .map_err(|error| match error {
                SaveError::Write { path, source } => Unsaved::Write { path, source },
                other => Unsaved::Place(other),
            })?;
    }
    let kept = Kept { text: from.text.with_text(edited.text.clone()), description: now.clone() };
    Ok(Saved { path: path.to_path_buf(), edited, is_new: false, kept })
}

fn read(path: &Path) -> Result<String, Unsaved> {
    let bytes = files::read(path, LIMIT).map_err(|source| Unsaved::Read { path: path.to_path_buf(), source })?;
    // What is no UTF-8 any more is another text.
    String::from_utf8(bytes).map_err(|_| Unsaved::Changed(path.to_path_buf()))
}
