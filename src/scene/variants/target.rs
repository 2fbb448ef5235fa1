//! What a path of a variant file is about: the scene, or its folder of shaders.

use std::path::{Path, PathBuf};

use super::family::Member;
use crate::scene::define::{Define, Written};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::locate::{as_written, folder_of, near_names};
use crate::scene::ron::parse;
use crate::scene::text::{Text, missing};

/// The path of the scene itself.
const SCENE: &str = "scene";

/// The path of the folder of shaders.
const SHADERS: &str = "shaders";

/// Has a member changed by one define.
pub fn change(member: &mut Member, define: &Define) {
    if define.path == SCENE {
        found(named(define, SCENE, "file", Path::is_file), member, |member, file| member.scene = Some(file));
    } else if define.path == SHADERS {
        found(folder(define), member, |member, folder| member.shaders = folder);
    } else {
        member.defines.push(define.clone());
    }
}

/// Has what was found, or is wrong.
fn found<T>(found: Result<T, Diagnostic>, member: &mut Member, take: impl FnOnce(&mut Member, T)) {
    match found {
        Ok(found) => take(member, found),
        Err(wrong) => member.wrong = Some(wrong),
    }
}

/// The folder of shaders that a value names; none for `None`.
fn folder(define: &Define) -> Result<Option<PathBuf>, Diagnostic> {
    let text = Text::new(Path::new("-D"), define.value.clone());
    match parse(&text) {
        Ok(node) if node.is_none() => Ok(None),
        _ => named(define, SHADERS, "folder", Path::is_dir).map(Some),
    }
}

/// What a value names, from the folder of the file that it is written in.
fn named(define: &Define, about: &str, kind: &str, is: fn(&Path) -> bool) -> Result<PathBuf, Diagnostic> {
    let text = Text::new(Path::new("-D"), define.value.clone());
    let Ok(Ok(name)) = parse(&text).map(|node| node.string()) else {
        return Err(wrong(define, format!("{about}: expected a {kind}, found `{}`", define.value)));
    };
    let here = Path::new("");
    let (of, from) = match &define.written {
        Written::CommandLine => (here, "here"),
        Written::File { value, .. } => (folder_of(value, here), "the folder of this file"),
    };
    let path = as_written(of, &name);
    if is(&path) {
        return Ok(path);
    }
    let help = near_names(of, &name).unwrap_or_else(|| format!("the path is relative to {from}"));
    Err(wrong(define, format!("{about}: {}", missing(kind, &path))).help(help))
}

/// An error about a define's value.
fn wrong(define: &Define, message: String) -> Diagnostic {
    match &define.written {
        Written::CommandLine => Diagnostic::file(Severity::Error, Path::new("-D"), message),
        Written::File { value, .. } => Diagnostic { severity: Severity::Error, message, ..(**value).clone() },
    }
}
