//! The pixel under the pointer.

use egui::Ui;

use crate::engine::{Inspected, LookedUp};

/// Its linear values, and what is seen there.
pub fn show(ui: &mut Ui, pixel: Option<&Inspected>) {
    let Some(pixel) = pixel else {
        ui.label("point at the picture");
        return;
    };
    let [r, g, b] = pixel.radiance;
    ui.monospace(format!("({}, {})  {} samples", pixel.pixel.x, pixel.pixel.y, pixel.samples));
    ui.monospace(format!("{r:.4}  {g:.4}  {b:.4}"));
    if pixel.bad > 0 {
        ui.label(format!("{} bad samples", pixel.bad));
    }
    match &pixel.surface {
        Some(surface) => {
            ui.label(format!("mesh {}", surface.mesh));
            ui.label(format!("material {}", surface.material.as_deref().unwrap_or("(the default one)")));
            if let Some([u, v]) = surface.uv {
                ui.monospace(format!("uv {u:.4}  {v:.4}"));
            }
            for LookedUp { of, texture, texel, value: [r, g, b, _], level } in &surface.texels {
                ui.label(format!("{of}: {texture}"));
                ui.monospace(format!("  texel {}, {}  level {level:.1}  {r:.3} {g:.3} {b:.3}", texel.x, texel.y));
            }
        }
        None => {
            ui.label("the environment");
        }
    }
}
