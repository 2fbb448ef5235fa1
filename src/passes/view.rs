//! What is seen first through the middle of every pixel, as a picture: in place of the film's.

use super::trace::TEXTURED;
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::view::ViewParams;

/// sRGB codes in `picture`, as `display` leaves them; black where nothing is hit.
pub static VIEW: Pass = Pass {
    name: "view",
    module: "passes/trace/view",
    entry: "view",
    bindings: &[
        Binding::read("nodes", "array<vec4<u32>>"),
        Binding::read("leaves", "array<vec4<u32>>"),
        Binding::params("ViewParams"),
        Binding::read("materials", "array<vec4<u32>>"),
        Binding::write("picture", "array<u32>"),
        Binding::read("shading", "array<Shading>").when(&["normals"]),
        Binding::read("uvs", "array<vec4<u32>>").when(TEXTURED),
        Binding::read("textures", "array<vec4<u32>>").when(TEXTURED),
        Binding::read("texels", "array<u32>").when(TEXTURED),
        Binding::read("material_maps", "array<vec4<u32>>").when(TEXTURED),
    ],
    makes: &[Makes::Picture],
    twin: twin!(view::ViewScene::view),
};

/// Records the picture of its window.
pub fn record(recording: &mut Recording, params: &ViewParams) {
    let size =
        Size::Pixels { width: params.trace_params.window_width, height: params.trace_params.window_height, layers: 1 };
    recording.run(&VIEW, size).params(params);
}
