//! How far the film is, and how its error falls.

use egui::{RichText, Ui};

use super::readings::Readings;
use super::{curve, text};
use crate::app::shared::memory::shown;
use crate::app::window::legend::draw::caption;

/// What is not known yet.
const NOTHING: &str = "-";

/// Numbers as users read them: 1234567 is 1.23 M, and 0 is nothing yet.
fn short(value: f64) -> String {
    if value == 0.0 {
        return NOTHING.to_owned();
    }
    let (scaled, unit) = match value {
        v if v >= 1e9 => (v * 1e-9, " G"),
        v if v >= 1e6 => (v * 1e-6, " M"),
        v if v >= 1e3 => (v * 1e-3, " k"),
        v => (v, ""),
    };
    format!("{scaled:.2}{unit}")
}

/// Samples, rates, and the curve of the error: all lines are there from the start, so that nothing below them moves.
pub fn show(ui: &mut Ui, readings: &Readings) {
    let nothing = || NOTHING.to_owned();
    let of = readings.target.map_or(String::new(), |target| format!(" of {target}"));
    let (triangles, bad) = match &readings.report {
        Some(report) => (report.triangles.to_string(), report.bad_samples),
        None => (nothing(), 0),
    };
    let device = readings.report.as_ref().map(|report| report.memory.held);
    let device = device.map_or_else(nothing, |held| shown(held.most));
    let mut rows = vec![
        ("samples", format!("{}{of}", readings.spp)),
        ("samples/s", short(readings.samples_per_second)),
        ("rays/s", short(readings.rays_per_second)),
        ("estimated relMSE", readings.error.map_or_else(nothing, |error| format!("{error:.3e}"))),
        ("triangles", triangles),
        ("bad samples", bad.to_string()),
        ("buffers, most", device),
    ];
    // Known of a process from its start, or never.
    rows.extend(readings.process_peak.map(|bytes| ("process, most", shown(bytes))));
    egui::Grid::new("progress").num_columns(2).show(ui, |ui| {
        for (name, value) in rows {
            ui.label(name);
            let value = RichText::new(value).monospace();
            let warns = name == "bad samples" && bad > 0;
            let value = if warns { value.color(ui.visuals().warn_fg_color) } else { value };
            ui.add(egui::Label::new(value).extend());
            ui.end_row();
        }
    });
    curve::show(ui, &readings.curve);
    text::line(ui, caption("estimated relMSE over seconds, both logarithmic"));
}
