//! Lines for a scene file, on the clipboard.

use std::path::Path;

use egui::{Context, Id, Ui};

use crate::app::window::navigate::to_ron;
use crate::components::Camera;
use crate::scene::{MtlMaterial, edit};

/// A button that copies a camera.
pub fn camera(ui: &mut Ui, name: &str, camera: &Camera) {
    button(ui, "camera", name, || to_ron(name, camera));
}

/// A button that copies a material, `model:material`, whose pictures are named from a folder.
pub fn material(ui: &mut Ui, name: &str, material: &MtlMaterial, folder: &Path) {
    let bare = name.split_once(':').map_or(name, |(_, bare)| bare);
    button(ui, "material", bare, || format!("{bare:?}: {},", edit::material(material, Some(folder))));
}

fn button(ui: &mut Ui, kind: &str, name: &str, line: impl FnOnce() -> String) {
    let button = ui.small_button("copy as RON").on_hover_text(format!("as a line for the scene file's `{kind}s`"));
    if button.clicked() {
        ui.ctx().copy_text(line());
        let said = format!("the {kind} {name} is on the clipboard");
        ui.ctx().data_mut(|data| data.insert_temp(id(), said));
    }
}

/// What was copied in this frame.
pub fn said(context: &Context) -> Option<String> {
    context.data_mut(|data| data.remove_temp(id()))
}

fn id() -> Id {
    Id::unique("copied")
}
