//! How far the film is, and how its error falls.

use egui::{Color32, Ui};
use egui_plot::{Line, Plot, PlotPoints};

use super::readings::Readings;

/// Numbers as users read them: 1234567 is 1.23 M, and 0 is nothing yet.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "-".to_owned();
    }
    let (scaled, unit) = match value {
        v if v >= 1e9 => (v * 1e-9, " G"),
        v if v >= 1e6 => (v * 1e-6, " M"),
        v if v >= 1e3 => (v * 1e-3, " k"),
        v => (v, ""),
    };
    format!("{scaled:.2}{unit}")
}

/// Samples, rates, and the curve of the error.
pub fn show(ui: &mut Ui, readings: &Readings) {
    egui::Grid::new("progress").num_columns(2).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.label(name);
            ui.monospace(value);
            ui.end_row();
        };
        let of = readings.target.map_or(String::new(), |target| format!(" of {target}"));
        row("samples", format!("{}{of}", readings.spp));
        row("samples/s", short(readings.samples_per_second));
        row("rays/s", short(readings.rays_per_second));
        row("estimated relMSE", readings.error.map_or("-".to_owned(), |error| format!("{error:.3e}")));
        if let Some(report) = &readings.report {
            row("triangles", report.triangles.to_string());
            if report.bad_samples > 0 {
                row("bad samples", report.bad_samples.to_string());
            }
        }
    });
    if readings.curve.len() < 2 {
        return;
    }
    Plot::new("error")
        .height(130.0)
        .show_x(false)
        .show_y(false)
        .allow_scroll(false)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_boxed_zoom(false)
        .x_axis_formatter(|mark, _| short(10f64.powf(mark.value)))
        .y_axis_formatter(|mark, _| format!("{:.0e}", 10f64.powf(mark.value)))
        .label_formatter(|_| None)
        .show(ui, |plot| {
            plot.line(Line::new("relMSE", PlotPoints::from(readings.curve.clone())).color(Color32::LIGHT_GREEN));
        });
    ui.small("estimated relMSE over seconds, both logarithmic");
}
