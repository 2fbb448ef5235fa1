//! Lines of text that keep their height, whatever they say.

use egui::{Label, RichText, Ui};

/// A line of prose, cut where it is too long: all of it is shown where the pointer rests on it.
pub fn line(ui: &mut Ui, text: impl Into<RichText>) {
    ui.add(Label::new(text.into()).truncate());
}

/// The same of numbers: digits of one width.
pub fn numbers(ui: &mut Ui, text: impl Into<String>) {
    line(ui, RichText::new(text.into()).monospace());
}
