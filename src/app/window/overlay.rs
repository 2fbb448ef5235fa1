//! What lies over the picture besides the panel: the keys, a notice, and problems that stand.

use egui::{Align2, Color32, Context, RichText};

use super::keys::KEYS;

/// What there is to show over the picture.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// The keys are shown.
    pub help: bool,
    /// A line at the bottom, for a while.
    pub notice: Option<String>,
    /// Each stays until it is no longer listed: a shader that doesn't compile, a device that has no room.
    pub problems: Vec<String>,
}

impl Overlay {
    /// Whether nothing of it is to be seen.
    pub fn is_empty(&self) -> bool {
        !self.help && self.notice.is_none() && self.problems.is_empty()
    }

    /// Draws it. Takes no input but for selecting the text of problems.
    pub fn show(&self, context: &Context) {
        show_problems(context, &self.problems);
        if let Some(notice) = &self.notice {
            let area = egui::Area::new(egui::Id::unique("notice")).interactable(false).fade_in(false);
            area.anchor(Align2::CENTER_BOTTOM, [0.0, -10.0]).show(context, |ui| {
                egui::Frame::popup(ui.style()).show(ui, |ui| ui.add(egui::Label::new(notice).extend()));
            });
        }
        if self.help {
            show_keys(context);
        }
    }
}

fn show_problems(context: &Context, problems: &[String]) {
    if problems.is_empty() {
        return;
    }
    let area = egui::Area::new(egui::Id::unique("problems")).fade_in(false);
    area.anchor(Align2::LEFT_TOP, [8.0, 8.0]).show(context, |ui| {
        let frame = egui::Frame::popup(ui.style()).fill(Color32::from_rgba_unmultiplied(60, 8, 8, 235));
        frame.show(ui, |ui| {
            let room = room(context);
            ui.set_max_width(room.x);
            egui::ScrollArea::both().max_height(room.y).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for line in problems.iter().flat_map(|problem| problem.lines()) {
                    let text = RichText::new(line).monospace().color(Color32::from_rgb(255, 205, 195));
                    let label = egui::Label::new(text).selectable(true);
                    // A source line is not wrapped: the mark below it points at the text above it.
                    if line.contains(" | ") {
                        ui.add(label.extend());
                    } else {
                        ui.scope(|ui| {
                            ui.set_max_width(room.x);
                            ui.add(label.wrap());
                        });
                    }
                }
            });
        });
    });
}

/// The table of keys, to be scrolled in a window that is too small for it.
fn show_keys(context: &Context) {
    let area = egui::Area::new(egui::Id::unique("keys")).fade_in(false);
    area.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            let room = room(context);
            egui::ScrollArea::both().max_width(room.x).max_height(room.y).show(ui, |ui| {
                egui::Grid::new("keys").num_columns(2).spacing([16.0, 3.0]).show(ui, |ui| {
                    for (key, meaning) in KEYS {
                        ui.add(egui::Label::new(RichText::new(*key).strong()).extend());
                        ui.add(egui::Label::new(*meaning).extend());
                        ui.end_row();
                    }
                });
            });
        });
    });
}

/// What the window leaves to something that lies in it with a frame.
fn room(context: &Context) -> egui::Vec2 {
    (context.viewport_rect().size() - egui::vec2(32.0, 32.0)).max(egui::Vec2::splat(16.0))
}
