//! The members of a family to choose from.

use egui::{ScrollArea, TextStyle, Ui};

use crate::app::window::family::Listing;

/// Rows that are seen at once.
const ROWS: f32 = 8.0;

/// The members in the order of the file; the one that is shown is marked, and the one that is wanted too. Returns the one that was clicked.
pub fn show(ui: &mut Ui, members: &Listing, shown: &str) -> Option<String> {
    let mut chosen = None;
    let row = ui.text_style_height(&TextStyle::Button) + 2.0 * ui.spacing().button_padding.y;
    let all = ROWS * (row + ui.spacing().item_spacing.y);
    ScrollArea::vertical().id_salt("members").max_height(all).show_rows(ui, row, members.names().len(), |ui, rows| {
        for name in &members.names()[rows] {
            let waits = members.wanted() == Some(name) && name != shown;
            let text = if waits { format!("{name} ..") } else { name.clone() };
            if ui.selectable_label(name == shown, text).clicked() {
                chosen = Some(name.clone());
            }
        }
    });
    chosen
}
