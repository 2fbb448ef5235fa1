//! Two pictures beside each other, before and after, with a divider between them that a hand can move: what was judged, or the last two members
//! of a family.

use egui::{Color32, Context, CursorIcon, Order, Rect, Sense, Stroke, TextureHandle, pos2, vec2};
use glam::UVec2;

use super::pair::Seen;
use crate::gpu::Fit;

/// Points at either side of the divider where the pointer can take it.
const REACH: f32 = 5.0;

/// The least part of the area that either picture keeps.
const LEAST: f32 = 0.02;

/// Between two pictures, as it is and under a hand.
const LINES: [Stroke; 2] =
    [Stroke { width: 1.0, color: Color32::WHITE }, Stroke { width: 3.0, color: Color32::from_rgb(120, 190, 255) }];

/// All of a texture.
pub(super) const WHOLE: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(1.0, 1.0) };

/// What lies beside each other, if anything does.
pub struct Beside {
    /// In place of the film: the size of one picture, and the sRGB of both, that of before first.
    split: Option<(UVec2, Vec<[u8; 4]>)>,
    /// The same, once it was drawn.
    drawn: Option<TextureHandle>,
    /// What was shown before, over the left of the film; and what to say of both.
    pair: Option<(Seen, String)>,
    drawn_pair: Option<TextureHandle>,
    /// Where the divider is: 0 at the left of the area, 1 at its right.
    divider: f32,
}

impl Default for Beside {
    fn default() -> Self {
        Self { split: None, drawn: None, pair: None, drawn_pair: None, divider: 0.5 }
    }
}

impl Beside {
    /// Whether there is the film alone.
    pub fn is_empty(&self) -> bool {
        self.split.is_none() && self.pair.is_none()
    }

    /// Shows this in place of the film from now on: the size of one picture, and both, that of before first.
    pub fn show_split(&mut self, pictures: Option<(UVec2, Vec<[u8; 4]>)>) {
        (self.split, self.drawn) = (pictures, None);
    }

    /// Shows what was seen before beside the film of the scene `now` from now on.
    pub fn show_pair(&mut self, before: Option<&Seen>, now: &str) {
        let pair = before.map(|before| (before.clone(), format!("{} | {now}", before.name)));
        if self.pair != pair {
            (self.pair, self.drawn_pair) = (pair, None);
        }
    }

    /// What to say of two members.
    pub fn names(&self) -> Option<&str> {
        self.pair.as_ref().map(|(_, names)| names.as_str())
    }

    /// Where the divider is: 0 at the left of the area, 1 at its right.
    pub fn divider(&self) -> f32 {
        self.divider
    }

    /// Whether something else lies over the film at a place: 0 at the left of the area, 1 at its right.
    pub fn hides(&self, place: f32) -> bool {
        self.split.is_some() || self.pair.is_some() && place < self.divider
    }

    /// Draws both over an area of the window, and follows a hand at the divider.
    pub fn draw(&mut self, context: &Context, area: Rect) {
        if self.is_empty() {
            return;
        }
        let is_held = self.follow_hand(context, area);
        let middle = area.left() + self.divider * area.width();
        let left = Rect::from_min_max(area.min, pos2(middle, area.bottom()));
        self.draw_pair(context, area, left);
        self.draw_split(context, area, left);
        let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(area);
        painter.vline(middle, area.y_range(), LINES[usize::from(is_held)]);
    }

    /// Moves the divider with a hand that drags it. Says whether the pointer is there.
    fn follow_hand(&mut self, context: &Context, area: Rect) -> bool {
        let middle = area.left() + self.divider * area.width();
        let handle = Rect::from_x_y_ranges(middle - REACH..=middle + REACH, area.y_range());
        let place = egui::Area::new(egui::Id::unique("divider")).fixed_pos(handle.min).order(Order::Middle);
        let shown = place.constrain(false).fade_in(false).show(context, |ui| ui.allocate_rect(handle, Sense::drag()));
        let hand = shown.inner;
        let is_held = hand.hovered() || hand.dragged();
        if is_held {
            context.set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        if let Some(pointer) = hand.interact_pointer_pos().filter(|_| hand.dragged()) {
            self.divider = ((pointer.x - area.left()) / area.width().max(1.0)).clamp(LEAST, 1.0 - LEAST);
        }
        is_held
    }

    /// Both of what was judged, in their own shape: one texture, before above after.
    fn draw_split(&mut self, context: &Context, area: Rect, left: Rect) {
        let Some((size, pixels)) = &self.split else { return };
        let both = UVec2::new(size.x, 2 * size.y);
        let texture = self.drawn.get_or_insert_with(|| texture(context, "split", both, pixels));
        let place = placed(context, Fit::Letterbox, *size, area);
        let right = Rect::from_min_max(pos2(left.right(), area.top()), area.max);
        for (part, half) in [(left, 0.0), (right, 0.5)] {
            let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(part);
            painter.rect_filled(part, 0.0, Color32::BLACK);
            let of = Rect::from_min_size(pos2(0.0, half), vec2(1.0, 0.5));
            painter.image(texture.id(), place, of, Color32::WHITE);
        }
    }

    /// The left part, as it lay on the window; black where nothing did.
    fn draw_pair(&mut self, context: &Context, area: Rect, left: Rect) {
        let Some((seen, _)) = &self.pair else { return };
        let texture = self.drawn_pair.get_or_insert_with(|| texture(context, "pair", seen.size, &seen.pixels));
        let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(left);
        painter.rect_filled(left, 0.0, Color32::BLACK);
        painter.image(texture.id(), placed(context, seen.fit, seen.size, area), WHOLE, Color32::WHITE);
    }
}

/// Where a picture lies on an area of the window, points.
pub(super) fn placed(context: &Context, fit: Fit, picture: UVec2, area: Rect) -> Rect {
    let points = context.pixels_per_point();
    let pixels = (glam::vec2(area.width(), area.height()) * points).round().as_uvec2();
    let (min, extent) = fit.place(picture, pixels);
    Rect::from_min_size(area.min + vec2(min.x, min.y) / points, vec2(extent.x, extent.y) / points)
}

pub(super) fn texture(context: &Context, name: &str, size: UVec2, pixels: &[[u8; 4]]) -> TextureHandle {
    let size = [size.x as usize, size.y as usize];
    let image = egui::ColorImage::from_rgba_unmultiplied(size, pixels.as_flattened());
    context.load_texture(name, image, egui::TextureOptions::NEAREST)
}
