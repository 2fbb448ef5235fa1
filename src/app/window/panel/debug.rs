//! The legend of view "debug": the range of what code shows of itself.

use egui::Ui;

use super::text;
use crate::app::window::legend::draw::caption;
use crate::engine::DebugRange;

/// What colours there are, and what is seen of them.
pub fn legend(ui: &mut Ui, range: &DebugRange) {
    if range.shown == 0 {
        ui.label("nothing here calls debug(..): see shaders/README.md");
        return;
    }
    for (name, channel) in [("red", 0), ("green", 1), ("blue", 2)] {
        ui.monospace(format!("{name:5}  {:.4} to {:.4}", range.least[channel], range.most[channel]));
    }
    let part = 100.0 * f64::from(range.shown) / f64::from(range.pixels.max(1));
    let broken = if range.broken > 0 { format!("; {} pixels are no numbers", range.broken) } else { String::new() };
    let said = format!("0 to 1 as light, no exposure; in {part:.1} % of all pixels{broken}");
    text::line(ui, caption(&said));
}
