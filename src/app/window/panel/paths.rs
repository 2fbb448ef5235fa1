//! The brightest paths of a pixel: a button that shows them, and a line for each, with the command that replays it.

use egui::{Button, RichText, Sense, Ui, vec2};

use super::text;
use crate::app::window::brightest::{BrightPath, KEPT, SAMPLES};
use crate::app::window::legend::draw::{caption, rgb};
use crate::app::window::legend::short;
use crate::app::window::paths::ShownPaths;

/// Says whether they are to be shown, or taken away, and what there is to tell.
pub fn show(ui: &mut Ui, shown: Option<&ShownPaths>) -> (bool, Option<String>) {
    let label = if shown.is_some() { "take paths away (P)" } else { "brightest paths of the pixel (P)" };
    let clicked = ui.button(label).clicked();
    let Some(shown) = shown else { return (clicked, None) };
    let mut said = None;
    let bad = if shown.bad > 0 { format!("; {} bad", shown.bad) } else { String::new() };
    let (x, y) = (shown.pixel.x, shown.pixel.y);
    text::line(ui, caption(&format!("pixel {x},{y}: {} of {SAMPLES} samples bring most{bad}", shown.paths.len())));
    for ((path, colour), command) in shown.paths.iter().zip(&shown.colours).zip(&shown.commands) {
        ui.horizontal(|ui| said = line(ui, path, *colour, command.as_deref()).or(said.take()));
    }
    // As high with fewer.
    for _ in shown.paths.len()..KEPT {
        ui.horizontal(|ui| ui.label(" "));
    }
    (clicked, said)
}

/// A path. Says what was done.
fn line(ui: &mut Ui, path: &BrightPath, colour: [u8; 3], command: Option<&str>) -> Option<String> {
    let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
    ui.painter().rect_filled(rect, 2.0, rgb(colour));
    let copy = ui.add_enabled(command.is_some(), Button::new("copy").small());
    let copy = match command {
        Some(command) => copy.on_hover_text(command),
        None => copy.on_disabled_hover_text("a member of a family has no command of its own"),
    };
    let [r, g, b] = path.radiance.to_array().map(|channel| short(channel.into()));
    text::line(ui, RichText::new(format!("{:>2}  {r}  {g}  {b}  {} rays", path.sample, path.rays)).monospace());
    let command = command.filter(|_| copy.clicked())?;
    ui.ctx().copy_text(command.to_owned());
    Some(format!("the command that replays sample {} is on the clipboard", path.sample))
}
