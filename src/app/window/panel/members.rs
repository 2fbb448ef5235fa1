//! The members of a family to choose from.

use egui::{Image, Rect, ScrollArea, Sense, Ui, Vec2};

use crate::app::window::family::Listing;
use crate::app::window::thumbs::{SIDE, Thumbs};

/// Rows that are seen at once.
const ROWS: f32 = 6.0;

/// Height of a small picture, points; its width is at most that of a side.
const HEIGHT: f32 = 40.0;

/// The members in the order of the file, each with its picture if it was seen; the one that is shown is marked, and the one that is wanted
/// too. Returns the one that was clicked.
pub fn show(ui: &mut Ui, members: &Listing, shown: &str, thumbs: &mut Thumbs) -> Option<String> {
    let mut chosen = None;
    let all = ROWS * (HEIGHT + ui.spacing().item_spacing.y);
    let room = Vec2::new(SIDE as f32, HEIGHT);
    ScrollArea::vertical().id_salt("members").max_height(all).show_rows(
        ui,
        HEIGHT,
        members.names().len(),
        |ui, rows| {
            for name in &members.names()[rows] {
                let waits = members.wanted() == Some(name) && name != shown;
                let text = if waits { format!("{name} ..") } else { name.clone() };
                ui.horizontal(|ui| {
                    let (rect, pressed) = ui.allocate_exact_size(room, Sense::click());
                    if let Some(texture) = thumbs.texture(ui.ctx(), name) {
                        let size = texture.size_vec2() * (room / texture.size_vec2()).min_elem();
                        Image::new(texture).paint_at(ui, Rect::from_center_size(rect.center(), size));
                    }
                    if ui.selectable_label(name == shown, text).clicked() || pressed.clicked() {
                        chosen = Some(name.clone());
                    }
                });
            }
        },
    );
    chosen
}
