//! The folder of a family: members that are done are kept there, and found again.
//!
//! A record is written last, and has the digests of its pictures: what a killed process leaves is whole, or is made again.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::record::{Record, State};
use super::survey::Subject;
use crate::engine::FilmImage;
use crate::files::Digest;
use crate::image::{Output, Picture, PictureFile, SaveError, file};

/// A folder that can't be used.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ShelfError {
    #[error("{}: another process renders into this folder", .0.display())]
    #[diagnostic(help("wait for it, or choose another folder with --out"))]
    Busy(PathBuf),
    #[error("{}: can't be used: {source}", folder.display())]
    #[diagnostic(help("choose another folder with --out"))]
    Folder { folder: PathBuf, source: io::Error },
}

/// What is kept of a film.
#[derive(Serialize, Deserialize)]
struct Kept {
    record: Record,
    /// Length and hash of the files.
    png: (u64, u64),
    exr: (u64, u64),
}

/// The folder, which no other process uses meanwhile.
pub struct Shelf {
    pub folder: PathBuf,
    /// Locked as long as the process lives, however it ends.
    _lock: File,
}

impl Shelf {
    /// Opens a folder, which is made where there is none, and sweeps out what a killed process has left.
    pub fn open(folder: &Path) -> Result<Self, ShelfError> {
        let failed = |source| ShelfError::Folder { folder: folder.to_path_buf(), source };
        std::fs::create_dir_all(folder.join("members")).map_err(failed)?;
        let lock = File::options().create(true).append(true).open(folder.join(".lock")).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(ShelfError::Busy(folder.to_path_buf())),
            // A file system without locks: as if there were no other.
            Err(TryLockError::Error(_)) => {}
        }
        for swept in [folder.to_path_buf(), folder.join("members")] {
            for entry in std::fs::read_dir(swept).map_err(failed)?.flatten() {
                let name = entry.file_name();
                let name = name.to_string_lossy();
                if name.starts_with(".lucerna-") && name.ends_with(".part") {
                    let _ = std::fs::remove_file(entry.path());
                }
            }
        }
        Ok(Self { folder: folder.to_path_buf(), _lock: lock })
    }

    /// The record of a film that was made of the same inputs, with its pictures as they were written.
    pub fn find(&self, subject: &Subject) -> Option<Record> {
        find(&self.folder, subject)
    }

    /// Writes pictures, and then the record.
    pub fn keep(
        &self,
        subject: &Subject,
        record: &Record,
        film: &FilmImage,
        metadata: &[(&'static str, String)],
    ) -> Result<(), SaveError> {
        let picture = Picture {
            size: film.size,
            window: film.window,
            linear: &film.rgb,
            display: &film.picture,
            metadata,
            report: &serde_json::Value::Null,
        };
        let path = |extension: &str| path(&self.folder, subject, extension);
        let write = |extension: &str| {
            let output = Output::new(path(extension))?;
            output.write(&picture)?;
            digest(&output.path).map_err(|source| SaveError::Write { path: output.path, source })
        };
        let kept = Kept { record: record.clone(), png: write("png")?, exr: write("exr")? };
        let json = path("json");
        let text = serde_json::to_string_pretty(&kept)
            .map_err(|error| SaveError::Write { path: json.clone(), source: error.into() })?;
        file::write_text(&json, &(text + "\n"))
    }
}

/// The same of a folder that another process may use.
pub fn find(folder: &Path, subject: &Subject) -> Option<Record> {
    let path = |extension: &str| path(folder, subject, extension);
    let text = std::fs::read_to_string(path("json")).ok()?;
    let Kept { record, png, exr } = serde_json::from_str(&text).ok()?;
    let whole = |extension: &str, kept: (u64, u64)| digest(&path(extension)).is_ok_and(|now| now == kept);
    let holds = record.key == subject.key && record.state == State::Done && whole("png", png) && whole("exr", exr);
    holds.then_some(record)
}

/// Linear Rec.709 radiance of a film that is kept, with its size.
pub fn radiance(folder: &Path, subject: &Subject) -> Option<(glam::UVec2, Vec<[f32; 3]>)> {
    let picture = PictureFile::open(&path(folder, subject, "exr")).ok()?;
    Some((picture.size, picture.read_all().ok()?))
}

/// A file of a film: in `members`, but for the reference's own.
pub fn path(folder: &Path, subject: &Subject, extension: &str) -> PathBuf {
    match subject.is_reference {
        true => folder.join(format!("reference.{extension}")),
        false => folder.join("members").join(format!("{}.{extension}", subject.member.name)),
    }
}

fn digest(path: &Path) -> io::Result<(u64, u64)> {
    let Digest { length, hash } = Digest::of(path)?;
    Ok((length, hash))
}
