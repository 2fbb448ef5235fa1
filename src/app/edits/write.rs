//! The shaders of an edit, as files of a folder.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::folder::{EditsFolder, Kept};
use crate::app::Failure;
use crate::image::file;
use crate::shader::{Library, module_name};

/// Texts that are gone, or are no longer what was written.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("edit {number}: its shaders can't be read: {source}")]
#[diagnostic(help("texts are beside the record, in the folder `texts`; choose another edit if they are gone"))]
struct Lost {
    number: u32,
    source: std::io::Error,
}

/// Writes all shaders of an edit to a folder, which is to be a new one or empty unless `force`. Says which other shaders are there.
pub fn write(folder: &EditsFolder, kept: &Kept, to: &Path, force: bool) -> Result<Vec<String>, Failure> {
    let number = kept.number;
    let Some(shaders) = &kept.shaders else {
        let help = "edits of shaders that ran can be written: `lucerna edits` lists them";
        return Err(Failure::usage(
            format!("edit {number} has no shaders of its own: {}", kept.edit.verdict.short),
            help,
        ));
    };
    let is_used = to.is_file() || std::fs::read_dir(to).is_ok_and(|mut entries| entries.next().is_some());
    if is_used && !force {
        let message = format!("{}: is there already", to.display());
        return Err(Failure::usage(message, "choose another folder, or write over it with --force"));
    }
    // All is read before anything is written.
    let lost = |source| Failure::of(Lost { number, source });
    let texts: BTreeMap<&String, String> = shaders
        .iter()
        .map(|(module, name)| {
            // A record may come from anywhere: what it names stays within the folder.
            let below = module.split('/').collect::<PathBuf>();
            match module_name(&below.with_extension("wgsl")).as_ref() == Some(module) {
                true => Ok((module, folder.text(name)?)),
                false => Err(io::Error::other(format!("`{module}` is no name of a shader"))),
            }
        })
        .collect::<Result<_, _>>()
        .map_err(lost)?;
    for (module, text) in texts {
        let parts = module.split('/').fold(to.to_path_buf(), |path, part| path.join(part));
        file::write_text(&parts.with_extension("wgsl"), &text)?;
    }
    let there = Library::open(to)?;
    Ok(there.modules().filter(|module| !shaders.contains_key(*module)).map(str::to_owned).collect())
}
