//! The one reader of pictures: files of every kind that programs write, by their values; and what is told of those that can't be read.

mod cut;
mod exr;
mod exr_layers;
mod hdr;
mod png;

use std::path::Path;

use glam::UVec2;
use lucerna::image::{Fault, PictureFile, Shown};
use miette::Diagnostic;

/// A file that is read whole.
fn shown(path: &Path) -> Shown {
    Shown::read(path).unwrap_or_else(|error| panic!("{error}"))
}

/// What is said of a file that can't be read, whichever way it is.
fn refused(path: &Path) -> String {
    let error = Shown::read(path).expect_err("the file can't be read");
    let by_parts = PictureFile::open(path).and_then(|source| source.read_all()).expect_err("the file can't be read");
    if !matches!(error.fault, Fault::TooLarge { .. }) {
        assert_eq!(error.to_string(), by_parts.to_string());
    }
    assert!(error.help().is_some(), "{error}: no help");
    assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
    error.to_string()
}

/// A value of its own for every pixel and channel, exact in 16 bits.
fn value(x: i64, y: i64, channel: usize) -> f32 {
    (x + 16 * y) as f32 + 0.25 * channel as f32
}

/// A picture of these values.
fn picture(size: UVec2) -> Vec<[f32; 3]> {
    let pixel = |at: u32| [0, 1, 2].map(|channel| value((at % size.x).into(), (at / size.x).into(), channel));
    (0..size.x * size.y).map(pixel).collect()
}
