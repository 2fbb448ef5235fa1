//! Where the time goes, and what is left out.

use egui::{Color32, FontId, RichText, Stroke, TextFormat, TextStyle, Ui, text::LayoutJob};

use super::readings::Readings;
use super::text;
use crate::app::shared::spared;
use crate::passes::table::TABLE;

/// Every pass with how often it ran and its time, and every feature that shaders know: lists that stay as they are, whatever runs.
pub fn show(ui: &mut Ui, readings: &Readings, software: bool) {
    text::line(ui, note(readings, software));
    egui::Grid::new("passes").num_columns(3).striped(true).show(ui, |ui| {
        for pass in TABLE {
            let timed = readings.passes.iter().find(|timed| timed.name == pass.name);
            let count = timed.map(|timed| timed.count).or_else(|| readings.dispatched.get(pass.name).copied());
            let ran = count.is_some();
            ui.label(if ran { RichText::new(pass.name) } else { RichText::new(pass.name).weak() });
            let cell = |text: Option<String>, width: usize| format!("{:>width$}", text.unwrap_or("-".to_owned()));
            ui.monospace(cell(count.map(|count| format!("{count} x")), 7));
            ui.monospace(cell(timed.map(|timed| format!("{:.3} ms", timed.milliseconds)), 12));
            ui.end_row();
        }
    });
    ui.label(RichText::new("not done for this film").strong()).on_hover_text(
        "what was there already, or what nothing needs: bytes as they would be sent, milliseconds as last measured",
    );
    egui::Grid::new("spared").num_columns(2).show(ui, |ui| {
        let spared = readings.report.as_ref().map(|report| report.spared.clone()).unwrap_or_default();
        let tiles = readings.report.as_ref().and_then(|report| report.tiles);
        let idle = tiles.map(|tiles| format!("{} of {}", tiles.idle, tiles.tiles));
        for (what, value) in spared::rows(&spared).into_iter().chain([("tiles quiet enough", idle)]) {
            ui.label(what);
            ui.add(egui::Label::new(RichText::new(value.unwrap_or("-".to_owned())).monospace()).extend());
            ui.end_row();
        }
    });
    ui.label(RichText::new("features").strong())
        .on_hover_text("struck out: nothing in the scene needs it, and no shader has it");
    ui.label(features(ui, readings));
}

fn note(readings: &Readings, software: bool) -> &'static str {
    match (readings.passes.is_empty(), software) {
        (true, _) => "no times: nothing ran since, or the adapter has none",
        // Seen on llvmpipe: beside a window, a dispatch of 100 ms reads as 0.02 ms, and others as more than they are.
        (_, true) => "of a software driver beside a window, not exact",
        _ => "between the last two readings",
    }
}

/// All that shaders know; what is left out is struck out.
fn features(ui: &Ui, readings: &Readings) -> LayoutJob {
    let font: FontId = TextStyle::Body.resolve(ui.style());
    let [bright, dim]: [Color32; 2] = [ui.visuals().text_color(), ui.visuals().weak_text_color()];
    let mut job = LayoutJob::default();
    for (place, feature) in readings.features.iter().enumerate() {
        let left_out = !readings.needed.contains(feature);
        let colour = if left_out { dim } else { bright };
        let plain = TextFormat::simple(font.clone(), colour);
        let strikethrough = if left_out { Stroke::new(1.0, dim) } else { Stroke::NONE };
        if place > 0 {
            job.append(", ", 0.0, TextFormat::simple(font.clone(), dim));
        }
        job.append(feature, 0.0, TextFormat { strikethrough, ..plain });
    }
    job
}
