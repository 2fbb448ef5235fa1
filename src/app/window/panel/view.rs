//! What the picture shows, to choose from, and what its colours mean.

use egui::{Ui, UiBuilder, vec2};

use super::{debug, text};
use crate::app::window::legend::draw::{self, caption};
use crate::app::window::legend::legend;
use crate::engine::{DebugRange, Engine};
use crate::layout::view::ViewMode;

/// Room for the legend of any view, points: what lies below it stays where it is.
const LEGEND: f32 = 66.0;

/// All views, and the legend of the one that is shown; `debug` is what is known of view "debug". Says whether another was chosen.
pub fn show(ui: &mut Ui, engine: &mut Engine, debug: Option<&DebugRange>) -> bool {
    let before = engine.view();
    let mut mode = before;
    ui.horizontal_wrapped(|ui| {
        for (choice, name) in ViewMode::ALL {
            ui.selectable_value(&mut mode, choice, name);
        }
    });
    engine.set_view(mode);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LEGEND), egui::Sense::hover());
    let mut room = ui.new_child(UiBuilder::new().max_rect(rect));
    room.shrink_clip_rect(rect);
    room.spacing_mut().item_spacing.y = 2.0;
    match (legend(mode, engine.view_reach(), &engine.material_names()), debug) {
        (Some(legend), _) => draw::show(&mut room, &legend),
        (None, Some(range)) if mode == ViewMode::Debug => debug::legend(&mut room, range),
        (None, None) if mode == ViewMode::Debug => {
            text::line(&mut room, caption("what shaders show of themselves: not read yet"))
        }
        _ => text::line(&mut room, caption("the film, by its exposure and tone")),
    }
    mode != before
}
