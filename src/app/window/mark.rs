//! How a selected mesh is marked over the picture: lines and a name.

use egui::{Align2, Color32, Context, FontId, Pos2, Rect, Stroke, pos2, vec2};

/// Of what is selected, in the picture and in the panel.
pub const COLOUR: Color32 = Color32::from_rgb(255, 200, 60);

/// Lines over a picture of any brightness: a light one in a wider dark one.
const STROKES: [Stroke; 2] =
    [Stroke { width: 3.0, color: Color32::from_black_alpha(150) }, Stroke { width: 1.25, color: COLOUR }];

/// A mark over the picture: lines in points of the window, and a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    pub lines: Vec<[Pos2; 2]>,
    pub name: String,
}

/// Draws it over the picture.
pub fn draw(context: &Context, picture: Rect, mark: &Mark) {
    let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(picture);
    for stroke in STROKES {
        mark.lines.iter().for_each(|line| _ = painter.line_segment(*line, stroke));
    }
    let around = Rect::from_points(mark.lines.as_flattened());
    if !around.intersects(picture) {
        // The mesh is elsewhere.
        return;
    }
    let text = painter.layout_no_wrap(mark.name.clone(), FontId::proportional(13.0), COLOUR);
    let at = label_place(around, picture, text.size());
    let back = Rect::from_min_size(at, text.size()).expand2(vec2(4.0, 2.0));
    painter.rect_filled(back, 3.0, Color32::from_black_alpha(190));
    painter.galley(at, text, COLOUR);
}

/// Above the lines where there is room, and in the picture in any case.
fn label_place(around: Rect, picture: Rect, size: egui::Vec2) -> Pos2 {
    const MARGIN: f32 = 6.0;
    let wanted =
        Align2::CENTER_BOTTOM.anchor_size(around.intersect(picture).center_top() - vec2(0.0, MARGIN), size).min;
    let room = picture.shrink(MARGIN);
    let [most_x, most_y] = [room.right() - size.x, room.bottom() - size.y];
    pos2(wanted.x.min(most_x).max(room.left()), wanted.y.min(most_y).max(room.top()))
}
