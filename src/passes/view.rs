//! What is seen first through the middle of every pixel, as a picture: in place of the film's.

use super::textures::{TEXTURED, texture_bindings};
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::view::ViewParams;

/// sRGB codes in `picture`, as `display` leaves them; black where nothing is hit.
pub static VIEW: Pass = Pass {
    name: "view",
    module: "passes/trace/view",
    entry: "view",
    features: &[],
    bindings: &Binding::list::<10>(&[
        &[
            Binding::read("nodes", "array<vec4<u32>>"),
            Binding::read("leaves", "array<vec4<u32>>"),
            Binding::params("ViewParams"),
            Binding::read("materials", "array<vec4<u32>>"),
            Binding::write("picture", "array<u32>"),
            Binding::read("shading", "array<Shading>").when(&["normals"]),
        ],
        &texture_bindings(TEXTURED),
    ]),
    makes: &[Makes::Picture],
    twin: twin!(view::ViewScene::view),
};

/// Records the picture of its window.
pub fn record(recording: &mut Recording, params: &ViewParams) {
    let size =
        Size::Pixels { width: params.trace_params.window_width, height: params.trace_params.window_height, layers: 1 };
    recording.run(&VIEW, size).params(params);
}
