//! What lies over the picture besides the panel: the keys, a notice, and problems that stand.

use std::time::{Duration, Instant};

use egui::{Align2, Color32, Context, Rect, RichText, Ui};
use glam::UVec2;

use super::beside::Beside;
use super::keys::KEYS;
use super::pair::Seen;

/// How long a notice is shown.
const NOTICE: Duration = Duration::from_secs(4);

/// What there is to show over the picture.
#[derive(Default)]
pub struct Overlay {
    /// The keys are shown.
    pub help: bool,
    /// A line at the bottom, for a while.
    pub notice: Option<String>,
    /// When that goes.
    notice_ends: Option<Instant>,
    /// Each stays until it is no longer listed: a shader that doesn't compile, a device that has no room.
    pub problems: Vec<String>,
    /// Two pictures in place of the film, or one over a part of it.
    pub beside: Beside,
}

impl Overlay {
    /// Whether nothing of it is to be seen.
    pub fn is_empty(&self) -> bool {
        !self.help && self.notice.is_none() && self.problems.is_empty() && self.beside.is_empty()
    }

    /// Says something at the bottom of the window, for a while.
    pub fn notify(&mut self, text: String, now: Instant) {
        (self.notice, self.notice_ends) = (Some(text), Some(now + NOTICE));
    }

    /// When the notice goes; none if it doesn't, or there is none.
    pub fn expires_at(&self) -> Option<Instant> {
        self.notice_ends
    }

    /// Removes a notice whose time is over. Says whether there was one.
    pub fn expire(&mut self, now: Instant) -> bool {
        let over = self.notice_ends.take_if(|at| *at <= now).is_some();
        self.notice.take_if(|_| over);
        over
    }

    /// Shows both pictures of what was judged in place of the film from now on.
    pub fn show_split(&mut self, pictures: Option<(UVec2, Vec<[u8; 4]>)>) {
        self.beside.show_split(pictures);
    }

    /// Shows what was seen before beside the film of the scene `now` from now on.
    pub fn show_pair(&mut self, before: Option<&Seen>, now: &str) {
        self.beside.show_pair(before, now);
    }

    /// Draws it over the picture's area of the window, and a line about what is judged. Takes no input but for selecting the text of
    /// problems, and for the divider between two pictures.
    pub fn show(&mut self, context: &Context, picture: Rect, judged: Option<&str>) {
        self.beside.draw(context, picture);
        show_problems(context, picture, &self.problems);
        if let Some(judged) = judged {
            show_line(context, picture, "judged", Align2::CENTER_TOP, judged);
        } else if let Some(names) = self.beside.names() {
            show_line(context, picture, "pair", Align2::CENTER_TOP, names);
        }
        if let Some(notice) = &self.notice {
            show_line(context, picture, "notice", Align2::CENTER_BOTTOM, notice);
        }
        if self.help {
            show_keys(context, picture);
        }
    }
}

/// A line of text at an edge of the picture.
fn show_line(context: &Context, picture: Rect, name: &str, at: Align2, text: &str) {
    let area = egui::Area::new(egui::Id::unique(name)).interactable(false).fade_in(false);
    let shift = if at == Align2::CENTER_TOP { 10.0 } else { -10.0 };
    area.constrain_to(picture).anchor(at, [0.0, shift]).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width(room(picture).x);
            ui.add(egui::Label::new(text));
        });
    });
}

fn show_problems(context: &Context, picture: Rect, problems: &[String]) {
    if problems.is_empty() {
        return;
    }
    let area = egui::Area::new(egui::Id::unique("problems")).fade_in(false);
    area.constrain_to(picture).anchor(Align2::LEFT_TOP, [8.0, 8.0]).show(context, |ui| {
        let frame = egui::Frame::popup(ui.style()).fill(Color32::from_rgba_unmultiplied(60, 8, 8, 235));
        frame.show(ui, |ui| {
            let room = room(picture);
            take_room(ui, room);
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

/// The table of keys, to be scrolled where the picture is too small for it.
fn show_keys(context: &Context, picture: Rect) {
    let area = egui::Area::new(egui::Id::unique("keys")).fade_in(false);
    area.constrain_to(picture).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            let room = room(picture);
            take_room(ui, room);
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

/// Lets something be as large as its room is now: an area is else no larger than it once was, in a window that was small.
fn take_room(ui: &mut Ui, room: egui::Vec2) {
    ui.set_max_width(room.x);
    ui.set_max_height(room.y);
}

/// What the picture's area leaves to something that lies in it with a frame.
fn room(picture: Rect) -> egui::Vec2 {
    (picture.size() - egui::vec2(32.0, 32.0)).max(egui::Vec2::splat(16.0))
}
