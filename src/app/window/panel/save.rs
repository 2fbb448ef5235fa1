//! The way from the window into the scene's file.

use egui::Ui;

/// A button. Says whether it was clicked.
pub fn show(ui: &mut Ui) -> bool {
    let button = ui.button("save into the scene file");
    button
        .on_hover_text("what was changed in this window: camera, settings, lights, materials, parameters (Ctrl+S)")
        .clicked()
}
