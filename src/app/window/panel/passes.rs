//! Where the time goes, and what is left out.

use egui::{RichText, Ui};

use super::readings::Readings;
use crate::passes::table::TABLE;

/// Time by pass, passes that did not run, and features that are not compiled.
pub fn show(ui: &mut Ui, readings: &Readings, software: bool) {
    if software {
        // Seen on llvmpipe: beside a window, a dispatch of 100 ms reads as 0.02 ms, and others as more than they are.
        ui.label("of a software driver beside a window, not exact");
    }
    if readings.passes.is_empty() {
        ui.label("no times: nothing ran since, or the adapter has none");
    }
    egui::Grid::new("passes").num_columns(3).striped(true).show(ui, |ui| {
        for pass in &readings.passes {
            ui.label(pass.name);
            ui.monospace(format!("{:>5} x", pass.count));
            ui.monospace(format!("{:>9.3} ms", pass.milliseconds));
            ui.end_row();
        }
    });
    let idle: Vec<&str> = TABLE.iter().map(|pass| pass.name).filter(|n| !readings.dispatched.contains_key(n)).collect();
    list(ui, "not run", &idle.join(", "));
    let left_out: Vec<&str> =
        readings.features.iter().filter(|feature| !readings.needed.contains(feature)).map(String::as_str).collect();
    list(ui, "compiled in", &readings.needed.join(", "));
    list(ui, "left out", &left_out.join(", "));
}

fn list(ui: &mut Ui, title: &str, names: &str) {
    ui.label(RichText::new(title).strong());
    ui.label(if names.is_empty() { "nothing" } else { names });
}
