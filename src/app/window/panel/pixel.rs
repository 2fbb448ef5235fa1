//! The pixel under the pointer, or the last that it was on.

use egui::Ui;

use super::text;
use crate::engine::{Inspected, LookedUp};

/// Its linear values, and what is seen there, in as many lines whatever that is. `maps` are the maps that a material of the scene has at
/// most.
pub fn show(ui: &mut Ui, pixel: Option<&Inspected>, maps: usize) {
    for line in lines(pixel, maps) {
        text::numbers(ui, line);
    }
}

/// The lines: their number depends on `maps` alone.
fn lines(pixel: Option<&Inspected>, maps: usize) -> Vec<String> {
    let count = if maps == 0 { 4 } else { 5 + 2 * maps };
    let mut lines = pixel.map_or_else(|| vec!["point at the picture".to_owned()], told);
    // A line that is empty has no height.
    lines.resize(count, " ".to_owned());
    lines
}

fn told(pixel: &Inspected) -> Vec<String> {
    let [r, g, b] = pixel.radiance;
    let bad = if pixel.bad > 0 { format!(", {} bad", pixel.bad) } else { String::new() };
    let mut lines = vec![
        format!("({}, {})  {} samples{bad}", pixel.pixel.x, pixel.pixel.y, pixel.samples),
        format!("{r:.4}  {g:.4}  {b:.4}"),
    ];
    let Some(surface) = &pixel.surface else {
        lines.push("the environment".to_owned());
        return lines;
    };
    lines.push(format!("mesh {}", surface.mesh));
    lines.push(format!("material {}", surface.material.as_deref().unwrap_or("(the default one)")));
    if let Some([u, v]) = surface.uv {
        lines.push(format!("uv {u:.4}  {v:.4}"));
    }
    for LookedUp { of, texture, texel, value: [r, g, b, _], level } in &surface.texels {
        lines.push(format!("{of}: {texture}"));
        lines.push(format!("  {}, {}  level {level:.1}  {r:.3} {g:.3} {b:.3}", texel.x, texel.y));
    }
    lines
}
