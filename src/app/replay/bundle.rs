//! A folder in which `lucerna replay` gives the same path: the scene's files, where they are to each other, the shaders, and the command.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use glam::UVec2;

use crate::app::Failure;
use crate::app::shared::describe::Described;
use crate::app::shared::output::Unplaced;
use crate::app::shared::scene::Opened;
use crate::files;
use crate::image::{SaveError, file};
use crate::shader::Library;

/// Bytes that a file of a scene may have.
const LARGEST: u64 = 16 << 30;

/// A file of the scene that can't be copied.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{}: can't be read: {source}", file.display())]
#[diagnostic(help("the scene needs it: leave --bundle out, or make it readable"))]
struct Unread {
    file: PathBuf,
    source: io::Error,
}

/// Refuses a folder in which there is something.
pub fn refuse_used(folder: &Path) -> Result<(), Failure> {
    let is_used = folder.is_file() || std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    if is_used {
        let message = format!("{}: is there already", folder.display());
        return Err(Failure::usage(message, "choose another folder with --bundle DIR"));
    }
    Ok(())
}

/// Writes the folder, and returns it.
pub fn write(
    folder: &Path,
    opened: &Opened,
    library: &Library,
    (described, pixel, sample): (&Described, UVec2, u32),
) -> Result<PathBuf, Failure> {
    let placed = |error: SaveError| Failure::of(Unplaced::by("--bundle DIR")(error));
    let mut sources: Vec<PathBuf> = opened.files.clone();
    sources.push(opened.path.clone());
    let absolute: Vec<PathBuf> = sources.iter().map(|path| plain(path)).collect();
    let common = common_folder(&absolute);
    let within = |path: &Path| Path::new("scene").join(path.strip_prefix(&common).unwrap_or(path));
    for (source, path) in sources.iter().zip(&absolute) {
        let unread = |error| Failure::of(Unread { file: source.clone(), source: error });
        let bytes = files::read(source, LARGEST).map_err(unread)?;
        file::write(&folder.join(within(path)), |out| out.write_all(&bytes)).map_err(placed)?;
    }
    for module in library.modules() {
        let Some(text) = library.text(module) else { continue };
        let path = module.split('/').fold(folder.join("shaders"), |path, part| path.join(part));
        file::write_text(&path.with_extension("wgsl"), text).map_err(placed)?;
    }
    let scene = within(&plain(&opened.path));
    let shaders = PathBuf::from("shaders");
    let there = Described { path: &scene, shaders: Some(&shaders), ..*described };
    file::write_text(&folder.join("README.md"), &readme(&there, pixel, sample)).map_err(placed)?;
    Ok(folder.to_path_buf())
}

fn readme(described: &Described, pixel: UVec2, sample: u32) -> String {
    format!(
        "# A path of {}\n\nPixel {},{}, sample {sample}. In this folder, with Lucerna {}:\n\n```sh\n{}\n```\n\n\
         It was replayed on {}; another device rounds otherwise.\n\n`scene/` has the files that the scene reads, and `shaders/` the \
         shaders that traced it.\n",
        described.description.name,
        pixel.x,
        pixel.y,
        env!("CARGO_PKG_VERSION"),
        described.replay(pixel, sample),
        described.adapter,
    )
}

/// A path from the root, without `.` and `..`: links stay what they are called.
fn plain(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let mut plain = PathBuf::new();
    for part in whole.components() {
        match part {
            std::path::Component::CurDir => {}
            std::path::Component::ParentDir => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// The folder that all files are below.
fn common_folder(files: &[PathBuf]) -> PathBuf {
    let mut common = files.first().and_then(|file| file.parent()).map(Path::to_path_buf).unwrap_or_default();
    for file in files {
        while !file.starts_with(&common) && common.pop() {}
    }
    common
}
