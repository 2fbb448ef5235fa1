//! What the picture shows, to choose from, and what its colours mean.

use egui::{Ui, UiBuilder, vec2};

use super::readings::Readings;
use super::{debug, probes, text};
use crate::app::window::legend::draw::{self, caption};
use crate::app::window::legend::{legend, of_probe};
use crate::engine::{Engine, Probing};
use crate::layout::view::ViewMode;

/// Room for the legend of any view, points: what lies below it stays where it is.
const LEGEND: f32 = 66.0;

/// All views, and the legend of the one that is shown; `readings` are what is known of what shaders show. Says whether another was chosen.
pub fn show(ui: &mut Ui, engine: &mut Engine, readings: &Readings) -> bool {
    let before = engine.view();
    let mut mode = before;
    ui.horizontal_wrapped(|ui| {
        for (choice, name) in ViewMode::ALL {
            ui.selectable_value(&mut mode, choice, name);
        }
    });
    engine.set_view(mode);
    if mode == ViewMode::Probe && engine.probing().is_none() {
        let first = engine.probes().first().map(|probe| probe.name.clone());
        engine.set_probe(first.map(|name| Probing { name, ..Probing::default() }));
    }
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LEGEND), egui::Sense::hover());
    let mut room = ui.new_child(UiBuilder::new().max_rect(rect));
    room.shrink_clip_rect(rect);
    room.spacing_mut().item_spacing.y = 2.0;
    let unread = |ui: &mut Ui| text::line(ui, caption("what shaders show of themselves: not read yet"));
    match mode {
        ViewMode::Debug => match &readings.debug {
            Some(range) => debug::legend(&mut room, range),
            None => unread(&mut room),
        },
        ViewMode::Probe => match (engine.probing(), &readings.histogram) {
            (None, _) => probes::none(&mut room),
            (Some(probing), Some(known)) => draw::show(&mut room, &of_probe(known, probing.look.logarithmic)),
            (Some(_), None) => unread(&mut room),
        },
        _ => match legend(mode, engine.view_reach(), &engine.material_names()) {
            Some(legend) => draw::show(&mut room, &legend),
            None => text::line(&mut room, caption("the film, by its exposure and tone")),
        },
    }
    mode != before
}
