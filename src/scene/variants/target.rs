//! What a path of a variant file is about: the scene, or shaders.

use std::path::PathBuf;

use super::family::Member;
use crate::scene::define::{Define, Written};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::locate::{as_written, folder_of, near_names};
use crate::scene::ron::parse;
use crate::scene::text::{Text, missing};

/// The path of the folder of shaders.
const SHADERS: &str = "shaders";

/// Before the names of values of shaders.
const SHADER_VALUE: &str = "shader.";

/// Has a member changed by one define.
pub fn change(member: &mut Member, define: &Define) -> Result<(), Diagnostic> {
    if define.path == SHADERS {
        member.shaders = folder(define)?;
    } else if let Some(name) = define.path.strip_prefix(SHADER_VALUE) {
        if name.is_empty() || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
            let message = format!("`{}` names no value of a shader", define.path);
            return Err(wrong(define, message).help("write shader.NAME, where a module has `override NAME`"));
        }
        member.values.insert(name.to_owned(), define.value.clone());
    } else {
        member.defines.push(define.clone());
    }
    Ok(())
}

/// The folder of shaders that a value names; none for `None`.
fn folder(define: &Define) -> Result<Option<PathBuf>, Diagnostic> {
    let text = Text::new(std::path::Path::new("-D"), define.value.clone());
    let name = match parse(&text).map(|node| node.string()) {
        Ok(Ok(name)) => name,
        _ => return Err(wrong(define, format!("shaders: expected a folder, found `{}`", define.value))),
    };
    if name == "None" {
        return Ok(None);
    }
    let here = std::path::Path::new("");
    let of = match &define.written {
        Written::CommandLine => here,
        Written::File { value, .. } => folder_of(value, here),
    };
    let path = as_written(of, &name);
    if path.is_dir() {
        return Ok(Some(path));
    }
    let help = near_names(of, &name).unwrap_or_else(|| "the path is relative to the folder of this file".to_owned());
    Err(wrong(define, format!("shaders: {}", missing("folder", &path))).help(help))
}

/// An error about a define's value.
fn wrong(define: &Define, message: String) -> Diagnostic {
    match &define.written {
        Written::CommandLine => Diagnostic::file(Severity::Error, std::path::Path::new("-D"), message),
        Written::File { value, .. } => Diagnostic { severity: Severity::Error, message, ..(**value).clone() },
    }
}
