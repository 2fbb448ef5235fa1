//! Lines for a scene file, on the clipboard.

use std::path::Path;

use egui::Ui;

use crate::components::Camera;
use crate::scene::{MtlMaterial, edit};

/// A button that copies a camera. Returns what to say where that was done.
pub fn camera(ui: &mut Ui, name: &str, camera: &Camera) -> Option<String> {
    button(ui, "camera", name, || edit::camera_line(name, camera))
}

/// A button that copies a material, `model:material`, whose pictures are named from a folder. Returns what to say where that was done.
pub fn material(ui: &mut Ui, name: &str, material: &MtlMaterial, folder: &Path) -> Option<String> {
    let bare = name.split_once(':').map_or(name, |(_, bare)| bare);
    button(ui, "material", bare, || edit::material_line(bare, material, Some(folder)))
}

fn button(ui: &mut Ui, kind: &str, name: &str, line: impl FnOnce() -> String) -> Option<String> {
    let button = ui.small_button("copy as RON").on_hover_text(format!("as a line for the scene file's `{kind}s`"));
    button.clicked().then(|| {
        ui.ctx().copy_text(line());
        format!("the {kind} {name} is on the clipboard")
    })
}
