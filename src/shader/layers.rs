//! Shaders as they lie on the disk: a folder, and another that is laid over it.

use std::path::{Path, PathBuf};

use super::{Library, ShaderError};

/// Where a library is read from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layers {
    /// A whole folder of shaders; the built-in ones without one.
    pub base: Option<PathBuf>,
    /// A folder that holds what it has otherwise.
    pub over: Option<PathBuf>,
}

impl Layers {
    /// One folder, as it is.
    pub fn folder(folder: impl Into<PathBuf>) -> Self {
        Self { base: Some(folder.into()), ..Self::default() }
    }

    /// The folders, that above first.
    pub fn folders(&self) -> impl Iterator<Item = &Path> {
        self.over.iter().chain(&self.base).map(PathBuf::as_path)
    }

    /// Reads them as they are now.
    pub fn read(&self) -> Result<Library, ShaderError> {
        let base = self.base.as_deref().map_or_else(|| Ok(Library::embedded()), Library::open)?;
        Ok(match &self.over {
            Some(over) => Library::open(over)?.laid_over(&base),
            None => base,
        })
    }

    /// The file of a module: that of the folder above, if it has one.
    pub fn file(&self, module: &str) -> PathBuf {
        let name = format!("{module}.wgsl");
        let own = self.over.iter().map(|over| over.join(&name)).find(|file| file.exists());
        let below = || self.base.as_deref().unwrap_or(Path::new("shaders")).join(&name);
        own.unwrap_or_else(below)
    }
}
