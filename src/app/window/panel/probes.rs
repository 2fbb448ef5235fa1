//! The numbers that shaders show (`probe("name", value)`): a name to choose, how its numbers are looked at, and how often which size is.

use egui::{CornerRadius, DragValue, Grid, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

use super::text;
use crate::app::window::legend::draw::{caption, rgb};
use crate::app::window::legend::short;
use crate::cpu::probe::{Histogram, colour};
use crate::engine::{Engine, Probing};
use crate::layout::probe::PROBE_LENGTH;
use crate::layout::view::ViewMode;
use crate::passes::probe::ProbeLook;
use crate::shader::Probe;

/// Bins of a histogram.
pub const BINS: usize = 64;

/// Height of its bars, points.
const BARS: f32 = 48.0;

/// Height of the list of names, points, at most.
const LIST: f32 = 132.0;

/// A name to choose, and how it is looked at; `histogram` is of what is shown, as it was last read. Says whether the picture is another.
pub fn show(ui: &mut Ui, engine: &mut Engine, histogram: Option<&Histogram>) -> bool {
    let (probes, before) = (engine.probes(), engine.probing().cloned());
    let mut chosen = before.clone();
    ScrollArea::vertical().id_salt("probes").max_height(LIST).show(ui, |ui| {
        Grid::new("probes").num_columns(2).show(ui, |ui| {
            let is_off = chosen.is_none();
            if ui.selectable_label(is_off, "off").clicked() {
                chosen = None;
            }
            ui.end_row();
            for probe in probes.iter() {
                line(ui, probe, &mut chosen);
                ui.end_row();
            }
        });
    });
    if let Some(Probing { name, look }) = &mut chosen {
        if !probes.iter().any(|probe| probe.name == *name) {
            text::line(ui, caption(&format!("no shader has probe(\"{name}\", ..) any more")));
        }
        looks(ui, look, histogram);
        if engine.view() == ViewMode::Probe {
            bars(ui, histogram, look.logarithmic);
        }
    }
    if chosen == before {
        return false;
    }
    match (&before, &chosen) {
        (_, None) if engine.view() == ViewMode::Probe => engine.set_view(ViewMode::Beauty),
        (None, Some(_)) => engine.set_view(ViewMode::Probe),
        (Some(old), Some(new)) if old.name != new.name => engine.set_view(ViewMode::Probe),
        _ => {}
    }
    engine.set_probe(chosen);
    true
}

/// A name and where it stands.
fn line(ui: &mut Ui, probe: &Probe, chosen: &mut Option<Probing>) {
    let is_chosen = chosen.as_ref().is_some_and(|chosen| chosen.name == probe.name);
    if ui.selectable_label(is_chosen, &probe.name).clicked() && !is_chosen {
        let look = chosen.as_ref().map(|chosen| ProbeLook { range: None, ..chosen.look }).unwrap_or_default();
        *chosen = Some(Probing { name: probe.name.clone(), look });
    }
    let places: Vec<String> =
        probe.places.iter().map(|place| format!("{}:{}", place.source.file, place.line)).collect();
    let more = if places.len() > 1 { format!(" and {} more", places.len() - 1) } else { String::new() };
    // The folder is shown where the pointer rests on it.
    let first = places.first().and_then(|place| place.rsplit('/').next()).unwrap_or_default();
    ui.label(caption(&format!("{first}{more}"))).on_hover_text(places.join("\n"));
}

/// Which bounce, which part of vectors, and which colours.
fn looks(ui: &mut Ui, look: &mut ProbeLook, histogram: Option<&Histogram>) {
    ui.horizontal_wrapped(|ui| {
        let mut at_bounce = look.bounce.is_some();
        ui.checkbox(&mut at_bounce, "bounce").on_hover_text("off: each pixel's first number, at whatever bounce");
        let mut bounce = look.bounce.unwrap_or(0);
        ui.add_enabled(at_bounce, DragValue::new(&mut bounce).range(0..=1023).speed(0.05));
        look.bounce = at_bounce.then_some(bounce);
        ui.separator();
        for (part, name) in [(0, "x"), (1, "y"), (2, "z"), (PROBE_LENGTH, "length")] {
            ui.selectable_value(&mut look.part, part, name).on_hover_text("of vectors");
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut look.logarithmic, "log");
        let mut bounded = look.range.is_some();
        ui.checkbox(&mut bounded, "from").on_hover_text("off: from the least number to the greatest");
        let [mut low, mut high] = look.range.or(histogram.map(|known| known.ends)).unwrap_or([0.0, 1.0]);
        let speed = f64::from((high - low).abs()).max(1e-6) * 0.01;
        ui.add_enabled(bounded, DragValue::new(&mut low).speed(speed).max_decimals(6));
        ui.label("to");
        ui.add_enabled(bounded, DragValue::new(&mut high).speed(speed).max_decimals(6));
        look.range = bounded.then_some([low, high.max(low)]);
    });
}

/// How often which size is, in the colours of the picture: in as much room whatever is known.
fn bars(ui: &mut Ui, histogram: Option<&Histogram>, logarithmic: bool) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), BARS), Sense::hover());
    ui.painter().rect_stroke(rect, CornerRadius::ZERO, Stroke::new(1.0, egui::Color32::DARK_GRAY), StrokeKind::Inside);
    let Some(known) = histogram else {
        text::line(ui, caption("not read yet"));
        return;
    };
    let most = known.bins.iter().copied().max().unwrap_or(0).max(1) as f32;
    let width = rect.width() / known.bins.len().max(1) as f32;
    for (bin, count) in known.bins.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = rect.left() + bin as f32 * width;
        // What is there at all is seen.
        let height = (rect.height() * *count as f32 / most).max(1.0);
        let bar = Rect::from_min_max(pos2(left, rect.bottom() - height), pos2(left + width, rect.bottom()));
        let place = (bin as f64 + 0.5) / known.bins.len() as f64;
        ui.painter().rect_filled(bar, CornerRadius::ZERO, rgb(colour(place)));
    }
    text::line(ui, caption(&told(known, logarithmic)));
}

/// The range, and how many pixels are in it.
fn told(known: &Histogram, logarithmic: bool) -> String {
    let Some([least, most]) = known.all else {
        let broken = if known.broken > 0 { format!("; {} pixels have no number", known.broken) } else { String::new() };
        return format!("no pixel shows a number of it{broken}");
    };
    let part = 100.0 * f64::from(known.shown) / f64::from(known.pixels.max(1));
    let broken = if known.broken > 0 { format!("; {} are no numbers", known.broken) } else { String::new() };
    let scale = if logarithmic { ", log" } else { "" };
    format!("{} to {}{scale}; in {part:.1} % of all pixels{broken}", short(least.into()), short(most.into()))
}

/// What is said where the view is chosen and no name is there to be.
pub fn none(ui: &mut Ui) {
    ui.label(RichText::new("nothing here calls probe(\"name\", ..): see shaders/README.md"));
}
