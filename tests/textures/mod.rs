//! Textures: pictures of every kind that models name, by their texels; how scenes come to them; and what is made of them.

mod alpha;
mod board;
mod fuzz;
pub mod garden;
mod horizon;
mod kinds;
mod leaves;
mod limits;
mod load;
mod lookups;
mod moved;
mod oracle;
mod refusals;
pub mod room;
mod seen;
mod twin;

use std::path::{Path, PathBuf};

use image::{ExtendedColorType, ImageFormat};
use lucerna::image::{ReadTexture, TextureFile};
use miette::Diagnostic;
use tempfile::TempDir;

/// The texels of a file that can be read.
fn read(path: &Path) -> ReadTexture {
    TextureFile::open(path).and_then(TextureFile::read).unwrap_or_else(|error| panic!("{error}"))
}

/// What is said of a file that can't be read.
fn refused(path: &Path) -> String {
    let error = TextureFile::open(path).and_then(TextureFile::read).expect_err("the file can't be read");
    let help = error.help().unwrap_or_else(|| panic!("{error}: no help")).to_string();
    assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
    format!("{}; {help}", error.fault)
}

/// A folder with a file of these bytes.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// A picture as a file of a format.
fn encoded(format: ImageFormat, size: [u32; 2], colour: ExtendedColorType, bytes: &[u8]) -> Vec<u8> {
    let mut file = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut file, bytes, size[0], size[1], colour, format).unwrap();
    file.into_inner()
}
