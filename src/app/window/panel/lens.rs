//! The lens of the camera that is looked through.

use egui::{DragValue, Grid, Ui};

use crate::components::{Camera, Focus, Lens};

/// Its numbers, to be changed; `size` is the scene's. Returns the lens as it is to be, where it was changed.
pub fn show(ui: &mut Ui, camera: &Camera, size: f64) -> Option<Lens> {
    let mut lens = camera.lens;
    let before = camera.focus_distance();
    let mut distance = before;
    Grid::new("lens").num_columns(2).show(ui, |ui| {
        ui.label("aperture").on_hover_text("radius of the lens in units of the scene; 0 is a pinhole: all is sharp");
        ui.add(DragValue::new(&mut lens.aperture).range(0.0..=Lens::MOST_APERTURE).speed(1e-4 * size).max_decimals(6));
        ui.end_row();
        ui.label("focus").on_hover_text("distance along the viewing axis that is sharp, in units of the scene");
        let [nearest, farthest] = Lens::FOCUS_RANGE;
        ui.add(DragValue::new(&mut distance).range(nearest..=farthest).speed(1e-3 * size).max_decimals(6));
        ui.end_row();
        ui.label("shift").on_hover_text("of the film across the lens, in heights of the picture: right and up");
        ui.horizontal(|ui| {
            for part in [&mut lens.shift.x, &mut lens.shift.y] {
                ui.add(DragValue::new(part).range(-Lens::MOST_SHIFT..=Lens::MOST_SHIFT).speed(2e-3).max_decimals(4));
            }
        });
        ui.end_row();
    });
    if distance != before {
        lens.focus = Focus::Distance(distance);
    }
    (lens != camera.lens).then_some(lens)
}
