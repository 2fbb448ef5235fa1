//! What was not done for a film, in words.

use super::memory::shown;
use crate::engine::Spared;

/// Rows that are always there: what was not done, and how much; none where it all was.
pub fn rows(spared: &Spared) -> [(&'static str, Option<String>); 5] {
    let bytes = |bytes: u64| (bytes > 0).then(|| shown(bytes));
    let unused = bytes(spared.unused_texture_bytes).map(|bytes| format!("{}, {bytes}", spared.unused_textures));
    let timed = spared.pass_milliseconds();
    let milliseconds = if timed > 0.0 { format!(", {timed:.3} ms") } else { String::new() };
    let passes = (!spared.passes.is_empty()).then(|| format!("{}{milliseconds}", spared.passes.len()));
    [
        ("textures unused", unused),
        ("textures halved by", bytes(spared.halved_texture_bytes)),
        ("not sent again", bytes(spared.upload_bytes())),
        ("passes not run again", passes),
        ("tree kept", spared.build_milliseconds.map(|milliseconds| format!("{milliseconds:.3} ms"))),
    ]
}
