//! Where the film's error comes from: a button, what was found, and what of it lies over the picture.

use egui::{ScrollArea, Sense, Ui, UiBuilder, vec2};

use super::text;
use crate::app::window::legend::Legend;
use crate::app::window::legend::draw::{self, caption};

/// Room for what was found, points: what lies below it stays where it is.
const FOUND: f32 = 190.0;

/// Room for the colours, points.
const LEGEND: f32 = 50.0;

/// What lies over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    #[default]
    Nothing,
    /// The bounce that has most of each pixel's error.
    Bounce,
    /// The way.
    Way,
    /// The film's robust means.
    Robust,
}

/// All choices, as they are named.
const OVERS: [(Over, &str); 4] =
    [(Over::Nothing, "nothing"), (Over::Bounce, "bounce"), (Over::Way, "way"), (Over::Robust, "robust mean")];

/// What the section shows.
#[derive(Default)]
pub struct ErrorsShown<'a> {
    /// How much of it is done, of 1; none where nothing is under way.
    pub done: Option<f64>,
    /// What was found.
    pub lines: &'a [String],
    pub over: Over,
    /// Colours that lie over the picture.
    pub legend: Vec<([u8; 3], String)>,
}

/// What is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorsAction {
    /// Finding out where the error comes from.
    Begin,
    Over(Over),
}

/// Draws the section; says what is wanted in it.
pub fn show(ui: &mut Ui, shown: &ErrorsShown) -> Option<ErrorsAction> {
    let mut action = None;
    let name = match shown.done {
        Some(done) => format!("where it comes from: {:.0} %", 100.0 * done),
        None => "where it comes from".to_owned(),
    };
    let button = ui.add_enabled(shown.done.is_none(), egui::Button::new(name));
    if button
        .on_hover_text("traces some samples more, and tells which light brings the error, and by which way")
        .clicked()
    {
        action = Some(ErrorsAction::Begin);
    }
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), FOUND), Sense::hover());
    let mut room = ui.new_child(UiBuilder::new().max_rect(rect));
    room.shrink_clip_rect(rect);
    ScrollArea::vertical().id_salt("errors").show(&mut room, |ui| {
        shown.lines.iter().for_each(|line| text::line(ui, caption(line)));
    });
    ui.horizontal_wrapped(|ui| {
        ui.label("over the picture:");
        for (over, name) in OVERS {
            if ui.selectable_label(shown.over == over, name).clicked() && shown.over != over {
                action = Some(ErrorsAction::Over(over));
            }
        }
    });
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LEGEND), Sense::hover());
    let mut room = ui.new_child(UiBuilder::new().max_rect(rect));
    room.shrink_clip_rect(rect);
    let title = match shown.over {
        Over::Nothing => "the film alone",
        Over::Bounce => "the bounce that brings most of a pixel's error; the brighter, the more of it",
        Over::Way => "the way that brings most of a pixel's error; the brighter, the more of it",
        Over::Robust => "without rare bright samples, and what light they bring; the film itself keeps them",
    };
    draw::show(&mut room, &Legend { title, swatches: shown.legend.clone(), ..Legend::default() });
    action
}
