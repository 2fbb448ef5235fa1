//! Sets words of a buffer to one value, within the order of the dispatches around it.

use super::{Binding, Makes, Pass, Recording, Size, Twin};
use crate::layout::clear::ClearParams;

/// Writes one value to the first `count` words.
pub static CLEAR: Pass = Pass {
    name: "clear",
    module: "passes/clear",
    entry: "clear",
    features: &[],
    bindings: &[Binding::params("ClearParams"), Binding::write("words", "array<u32>")],
    makes: &[Makes::Tree],
    twin: Twin::None("one value in every word needs no second opinion"),
};

/// Records that the first `words` words of `buffer` become `value`.
pub fn clear(recording: &mut Recording, buffer: &'static str, value: u32, words: u32) {
    recording
        .run(&CLEAR, Size::Items(u64::from(words)))
        .params(&ClearParams { count: words, value })
        .bind("words", buffer);
}
