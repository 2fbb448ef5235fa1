//! Members against the reference.

use std::path::Path;

use glam::UVec2;

use super::answers::numbers::short;
use super::record::{Against, Record, State};
use super::shelf;
use super::survey::{Found, Subject};
use crate::image::srgb::srgb_byte;
use crate::stats::metrics::Difference;

/// A reference's error is to be at most this part of that of the best member: what is left once it is subtracted is noise otherwise.
const FAR_BELOW: f64 = 0.25;

/// What members are compared with.
struct Reference {
    size: UVec2,
    rgb: Vec<[f32; 3]>,
    /// Of its own: it is subtracted, since that of a member by it is the sum of both. 0 where it is a member's picture, whose noise is
    /// that of the members too.
    relmse: f64,
    exposure: f32,
}

/// Compares every member that is done. `name` is the reference's member, and `own` what is known of its own film, if it is to have one.
/// Nothing is compared with a reference that is not done, or of other inputs. Returns what is to be known of it.
pub fn compare(
    folder: &Path,
    found: &[Found],
    records: &mut [Record],
    name: &str,
    own: Option<&Record>,
) -> Option<String> {
    let not_done = || Some(format!("Nothing is compared: the reference `{name}` is not done."));
    let has_own = found.iter().flatten().any(|subject| subject.is_reference);
    let is_it = |subject: &&Subject| subject.member.name == name && subject.is_reference == has_own;
    let Some(subject) = found.iter().flatten().find(is_it) else { return not_done() };
    let record = if has_own { own } else { records.iter().find(|record| record.name == name) };
    let Some(record) = record.filter(|record| record.state == State::Done) else { return not_done() };
    let Some((size, rgb)) = shelf::radiance(folder, subject) else { return not_done() };
    let relmse = record.snapshots.last().filter(|_| has_own).map_or(0.0, |snapshot| snapshot.relmse);
    let reference = Reference { size, rgb, relmse, exposure: subject.description.film.exposure };
    for (record, subject) in records.iter_mut().zip(found) {
        record.against = match (subject, &record.state) {
            (Ok(subject), State::Done | State::Lost { .. }) => against(folder, subject, &reference),
            _ => None,
        };
    }
    let errors = records.iter().filter(|record| record.against.is_some()).flat_map(|record| record.snapshots.last());
    let least = errors.map(|snapshot| snapshot.relmse).fold(f64::INFINITY, f64::min);
    (relmse > FAR_BELOW * least).then(|| {
        format!(
            "The reference's own error, a relMSE of {}, is not far below those of members: give it more samples (`reference: (member: .., spp: ..)`).",
            short(relmse)
        )
    })
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
