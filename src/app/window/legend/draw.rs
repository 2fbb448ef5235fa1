//! Draws a legend, in the panel or over the picture.

use egui::{
    Align2, Color32, Context, CornerRadius, FontId, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, Vec2,
    pos2, vec2,
};

use super::{Bar, Legend};

/// Height of a bar of colours, points.
const BAR: f32 = 12.0;

/// Side of a swatch, points.
const SWATCH: f32 = 10.0;

/// Swatches over the picture, at most.
const MOST_SWATCHES: usize = 8;

/// Draws all of it, in the width and, of many swatches, the height that there is.
pub fn show(ui: &mut Ui, legend: &Legend) {
    ui.add(egui::Label::new(caption(legend.title)).truncate());
    if let Some(bar) = &legend.bar {
        draw_bar(ui, bar);
    }
    if !legend.swatches.is_empty() {
        ScrollArea::vertical().id_salt("swatches").max_height(ui.available_height()).show(ui, |ui| {
            // Rows are as high as a swatch and its name.
            ui.spacing_mut().interact_size.y = SWATCH;
            ui.horizontal_wrapped(|ui| {
                for (colour, name) in &legend.swatches {
                    swatch(ui, *colour, name);
                }
            });
        });
    }
}

/// Words beside colours: a little smaller than other text.
pub fn caption(text: &str) -> RichText {
    RichText::new(text).size(11.0)
}

/// A colour as the toolkit has it.
pub fn rgb([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// Draws it over the lower left of the picture, small; of many swatches the first ones.
pub fn over(context: &Context, picture: Rect, mut legend: Legend) {
    let more = legend.swatches.len().saturating_sub(MOST_SWATCHES);
    legend.swatches.truncate(MOST_SWATCHES);
    let room = (picture.size() - Vec2::splat(32.0)).max(Vec2::splat(16.0)).min(vec2(260.0, 120.0));
    let area = egui::Area::new(egui::Id::unique("legend")).interactable(false).fade_in(false);
    area.constrain_to(picture).anchor(Align2::LEFT_BOTTOM, [8.0, -8.0]).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_width(room.x);
            ui.set_max_height(room.y);
            ui.spacing_mut().item_spacing.y = 2.0;
            show(ui, &legend);
            if more > 0 {
                ui.label(caption(&format!("and {more} more: F2 shows all")));
            }
        });
    });
}

/// The colours, and the numbers below them.
fn draw_bar(ui: &mut Ui, bar: &Bar) {
    let font = FontId::proportional(10.0);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), BAR + 16.0), Sense::hover());
    // Half a number at either end.
    let colours = Rect::from_min_size(rect.min, vec2(rect.width(), BAR)).shrink2(vec2(12.0, 0.0));
    let width = colours.width() / bar.colours.len().max(1) as f32;
    let painter = ui.painter();
    for (place, [r, g, b]) in bar.colours.iter().enumerate() {
        let left = colours.left() + place as f32 * width;
        let cell = Rect::from_min_max(pos2(left, colours.top()), pos2(left + width + 0.5, colours.bottom()));
        painter.rect_filled(cell.intersect(colours), CornerRadius::ZERO, Color32::from_rgb(*r, *g, *b));
    }
    painter.rect_stroke(colours, CornerRadius::ZERO, Stroke::new(1.0, Color32::GRAY), StrokeKind::Outside);
    for (place, number) in &bar.marks {
        let x = colours.left() + place * colours.width();
        painter.vline(x, colours.bottom()..=colours.bottom() + 3.0, Stroke::new(1.0, Color32::GRAY));
        let colour = ui.visuals().text_color();
        painter.text(pos2(x, colours.bottom() + 4.0), Align2::CENTER_TOP, number, font.clone(), colour);
    }
}

/// A colour and its name, which stay together.
fn swatch(ui: &mut Ui, [r, g, b]: [u8; 3], name: &str) {
    let text = ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(11.0), ui.visuals().text_color());
    let size = vec2(SWATCH + 4.0 + text.size().x, text.size().y.max(SWATCH));
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let square = Rect::from_min_size(pos2(rect.left(), rect.center().y - 0.5 * SWATCH), Vec2::splat(SWATCH));
    ui.painter().rect_filled(square, CornerRadius::same(2), Color32::from_rgb(r, g, b));
    let at = pos2(square.right() + 4.0, rect.center().y - 0.5 * text.size().y);
    ui.painter().galley(at, text, ui.visuals().text_color());
}
