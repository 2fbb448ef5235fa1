//! Members against the reference.

use std::path::Path;

use glam::UVec2;

use super::record::{Against, Record, State};
use super::shelf;
use super::survey::{Found, Subject};
use crate::image::srgb::srgb_byte;
use crate::stats::metrics::Difference;

/// What members are compared with.
struct Reference {
    size: UVec2,
    rgb: Vec<[f32; 3]>,
    /// Of its own: it is subtracted, since that of a member by it is the sum of both. 0 where it is a member's picture, whose noise is
    /// that of the members too.
    relmse: f64,
    exposure: f32,
}

/// Compares every member that is done. `name` is the reference's member, and `own` the record of its own film.
pub fn compare(folder: &Path, found: &[Found], records: &mut [Record], name: &str, own: Option<&Record>) {
    let is_it = |subject: &&Subject| subject.member.name == name && subject.is_reference == own.is_some();
    let Some(subject) = found.iter().flatten().find(is_it) else { return };
    let Some((size, rgb)) = shelf::radiance(folder, subject) else { return };
    let relmse = own.and_then(|record| record.snapshots.last()).map_or(0.0, |snapshot| snapshot.relmse);
    let reference = Reference { size, rgb, relmse, exposure: subject.description.film.exposure };
    for (record, subject) in records.iter_mut().zip(found) {
        record.against = match (subject, &record.state) {
            (Ok(subject), State::Done | State::Lost { .. }) => against(folder, subject, &reference),
            _ => None,
        };
    }
}

/// None for a picture of another size.
fn against(folder: &Path, subject: &Subject, reference: &Reference) -> Option<Against> {
    let (size, rgb) = shelf::radiance(folder, subject).filter(|(size, _)| *size == reference.size)?;
    let difference = Difference::of(&rgb, &reference.rgb)?;
    let shown = [shown(&rgb, subject.description.film.exposure), shown(&reference.rgb, reference.exposure)];
    Some(Against {
        relmse: (difference.relative_mse - reference.relmse).max(0.0),
        flip: flip(&shown, size),
        mean: std::array::from_fn(|c| difference.mean_a[c] / difference.mean_b[c].max(f64::MIN_POSITIVE)),
    })
}

/// As it is displayed.
fn shown(rgb: &[[f32; 3]], exposure: f32) -> Vec<[u8; 3]> {
    let scale = f64::from(exposure).exp2();
    rgb.iter().map(|pixel| pixel.map(|channel| srgb_byte(f64::from(channel) * scale))).collect()
}

#[cfg(feature = "flip")]
fn flip([test, reference]: &[Vec<[u8; 3]>; 2], size: UVec2) -> Option<f64> {
    let map = crate::app::shared::flip::flip(test, reference, size);
    Some(map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len().max(1) as f64)
}

#[cfg(not(feature = "flip"))]
fn flip(_: &[Vec<[u8; 3]>; 2], _: UVec2) -> Option<f64> {
    None
}
