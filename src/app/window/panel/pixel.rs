//! The pixel under the pointer, or the last that it was on: what it holds and sees, and what shaders show of its first sample.

use egui::Ui;
use glam::Vec4;

use super::readings::{Probed, Readings};
use super::text;
use crate::engine::{Inspected, LookedUp};
use crate::layout::probe::{PROBE_BOOL, PROBE_U32, PROBE_VEC2, PROBE_VEC3};

/// Bounces whose numbers are listed, at most.
const MOST_BOUNCES: usize = 8;

/// Its linear values, and what is seen there, in as many lines whatever that is. `maps` are the maps that a material of the scene has at
/// most.
pub fn show(ui: &mut Ui, readings: &Readings, maps: usize) {
    let shown = readings.probed.as_ref().map_or_else(Vec::new, probed_lines);
    for line in lines(readings.pixel.as_ref(), maps).into_iter().chain(shown) {
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

/// What the chosen name shows, a line a bounce: in as many lines whatever the path does.
fn probed_lines(probed: &Probed) -> Vec<String> {
    let line = |(bounce, value): (usize, &Vec4)| format!("  bounce {bounce}  {}", channels(*value));
    let values = probed.values.as_deref().unwrap_or_default();
    let mut lines = vec![format!("probe \"{}\" of sample 0", probed.name)];
    lines.extend(values.iter().enumerate().take(MOST_BOUNCES).map(line));
    lines.resize(1 + MOST_BOUNCES, " ".to_owned());
    lines
}

/// A value with 1 + its type behind it.
fn channels(value: Vec4) -> String {
    let numbers = |count: usize| value.to_array()[..count].iter().map(|x| format!("{x:.5}")).collect::<Vec<_>>();
    match (value.w as u32).checked_sub(1) {
        None => "-".to_owned(),
        Some(PROBE_U32) => format!("{}", value.x),
        Some(PROBE_BOOL) => (value.x != 0.0).to_string(),
        Some(PROBE_VEC2) => numbers(2).join("  "),
        Some(PROBE_VEC3) => numbers(3).join("  "),
        Some(_) => numbers(1).join("  "),
    }
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
