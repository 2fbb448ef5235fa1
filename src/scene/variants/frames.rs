//! Members of an animation: a frame each, with the values of all keys at that time.

use std::path::Path;

use super::family::{Axis, Family, MOST_MEMBERS, Member};
use super::member::{hidden, plain, refuse_overlaps};
use super::target::change;
use crate::scene::animate::{Animation, MOST_FRAMES, Track};
use crate::scene::assets::Assets;
use crate::scene::define::Define;
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::scene::read::Reading;

const _: () = assert!(MOST_FRAMES as usize <= MOST_MEMBERS);

/// The frames of a scene file; none where nothing of it is animated. `defines` change the scene before keys do.
pub fn frames(scene: &Path, defines: &[Define], assets: &Assets) -> Result<Option<Family>, Diagnostics> {
    let mut still = plain(&Diagnostic::file(Severity::Error, scene, ""), defines.iter());
    let (mut files, mut diagnostics) = (Vec::new(), Diagnostics::default());
    let mut reading = Reading { assets, files: &mut files, diagnostics: &mut diagnostics, animated: true };
    let file = reading.scene(scene, &still.defines);
    if diagnostics.has_errors() {
        return Err(diagnostics);
    }
    let Some(Animation { frames, fps, tracks }) = file.and_then(|file| file.animation) else { return Ok(None) };
    // Of what is said about time, no picture follows.
    still.defines.retain(|define| define.path.split('.').next() != Some("animate"));
    let columns: Vec<(&str, &Diagnostic)> = tracks.iter().map(|track| (track.path.as_str(), &track.place)).collect();
    refuse_overlaps(&columns, "one would write over the other: give keys to one of them")?;
    let digits = (frames - 1).to_string().len().max(4);
    let frame = |frame: u32| {
        let name = format!("{frame:0digits$}");
        at(&tracks, frame, Member { name, at: vec![frame as usize], ..still.clone() })
    };
    let members = (0..frames).map(frame).collect::<Vec<Member>>();
    let axis = Axis {
        name: "frame".to_owned(),
        paths: tracks.iter().map(|track| track.path.clone()).collect(),
        labels: members.iter().map(|member| member.name.clone()).collect(),
    };
    Ok(Some(Family {
        name: scene.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        path: scene.to_path_buf(),
        scene: scene.to_path_buf(),
        axes: vec![axis],
        members,
        reference: None,
        goal: None,
        fps: Some(fps),
        keyed: tracks.iter().flat_map(|track| &track.keys).map(|key| key.at as usize).collect(),
        warnings: hidden(&columns, defines),
        files,
    }))
}

/// A scene as it is at a frame.
fn at(tracks: &[Track], frame: u32, still: Member) -> Member {
    let mut member = still;
    for track in tracks {
        change(&mut member, &track.at(f64::from(frame)));
        member.place = track.place.clone();
    }
    member
}
