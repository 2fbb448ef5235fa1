//! Records of members of which nothing was traced.

use std::path::Path;

use super::record::{Record, State, Work};
use super::survey::Subject;
use crate::scene::variants::Member;

/// Of a member that could be rendered.
pub fn blank(subject: &Subject) -> Record {
    Record { key: subject.key.clone(), ..missing(&subject.member) }
}

/// Of a member without a key.
pub fn missing(member: &Member) -> Record {
    let mut settings: Vec<(String, String)> =
        member.defines.iter().map(|define| (define.path.clone(), define.value.clone())).collect();
    settings.extend(member.scene.iter().map(|scene| ("scene".to_owned(), name_of(scene))));
    settings.extend(member.shaders.iter().map(|folder| ("shaders".to_owned(), folder.display().to_string())));
    Record {
        name: member.name.clone(),
        key: String::new(),
        at: member.at.clone(),
        settings,
        state: State::Missing,
        snapshots: Vec::new(),
        mean: [0.0; 3],
        bad_samples: 0,
        adapter: String::new(),
        film_of: None,
        against: None,
        work: Work::default(),
        repeat: String::new(),
    }
}

/// A file by its name alone.
fn name_of(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
