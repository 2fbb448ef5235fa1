//! Pictures that some scene of this process still has: a scene that is read again decodes only what changed.
//!
//! The memory goes when the last scene goes, for the cache holds none of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, Weak};

use super::picture::{Facts, Header, Picture, Reduction};
use crate::components::TextureImage;
use crate::files::Stamp;

/// Pictures by the real paths of their files.
static PICTURES: Mutex<BTreeMap<PathBuf, Kept>> = Mutex::new(BTreeMap::new());

struct Kept {
    stamp: Stamp,
    image: Weak<TextureImage>,
    facts: Facts,
}

/// What the header of a file says, if it is as it was.
pub fn header(file: &Path, stamp: &Stamp) -> Option<Header> {
    let pictures = PICTURES.lock().unwrap_or_else(PoisonError::into_inner);
    let kept = pictures.get(file).filter(|kept| kept.stamp == *stamp && kept.image.strong_count() > 0)?;
    Some(kept.facts.header)
}

/// The picture of a file, if the file is as it was, and the picture is still in memory.
pub fn find(file: &Path, stamp: &Stamp, reduction: Reduction) -> Option<Picture> {
    let pictures = PICTURES.lock().unwrap_or_else(PoisonError::into_inner);
    let kept = pictures.get(file)?;
    let same = kept.stamp == *stamp && kept.facts.reduction.is_like(reduction);
    let image = kept.image.upgrade().filter(|_| same)?;
    Some(Picture { image, facts: kept.facts.clone() })
}

/// Remembers a picture whose file had this stamp before it was read, and was not young.
pub fn keep(file: &Path, stamp: &Stamp, picture: &Picture) {
    let mut pictures = PICTURES.lock().unwrap_or_else(PoisonError::into_inner);
    pictures.retain(|_, kept| kept.image.strong_count() > 0);
    let image = Arc::downgrade(&picture.image);
    pictures.insert(file.to_path_buf(), Kept { stamp: stamp.clone(), image, facts: picture.facts.clone() });
}
