//! Cameras and views to choose from, and how the scene is rendered.

use bevy_ecs::prelude::*;
use egui::{DragValue, Slider, Ui};

use crate::app::window::cameras;
use crate::components::{Energy, Film, Integrator, Render, Sampler};
use crate::engine::Engine;
use crate::layout::view::ViewMode;

/// The scene's cameras by name. Returns the one that was clicked.
pub fn cameras(ui: &mut Ui, engine: &Engine) -> Option<String> {
    let rendered = engine.camera().map(|(name, _)| name);
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        for name in engine.read(cameras::all).into_keys() {
            let is_rendered = rendered.as_ref() == Some(&name);
            if ui.selectable_label(is_rendered, &name).clicked() {
                chosen = Some(name);
            }
        }
    });
    chosen
}

/// What the picture shows. Says whether another was chosen.
pub fn view(ui: &mut Ui, engine: &mut Engine) -> bool {
    let before = engine.view();
    let mut mode = before;
    ui.horizontal_wrapped(|ui| {
        for (choice, name) in ViewMode::ALL {
            ui.selectable_value(&mut mode, choice, name);
        }
    });
    engine.set_view(mode);
    mode != before
}

/// The settings of film and render. Says whether one was written.
pub fn show(ui: &mut Ui, world: &mut World) -> bool {
    let mut query = world.query::<(&mut Film, &mut Render)>();
    let Some((mut film, mut render)) = query.iter_mut(world).next() else { return false };
    let (mut shown, mut rendered) = (*film, *render);
    egui::Grid::new("settings").num_columns(2).show(ui, |ui| {
        ui.label("exposure");
        ui.add(Slider::new(&mut shown.exposure, -8.0..=8.0).clamping(egui::SliderClamping::Never).suffix(" stops"));
        ui.end_row();
        ui.label("samples");
        ui.add(DragValue::new(&mut rendered.spp).range(1..=u32::MAX));
        ui.end_row();
        ui.label("integrator");
        choice(ui, &mut rendered.integrator, &[("path", Integrator::Path), ("bsdf", Integrator::Bsdf)]);
        ui.end_row();
        ui.label("sampler");
        choice(ui, &mut rendered.sampler, &[("sobol", Sampler::Sobol), ("pcg", Sampler::Pcg)]);
        ui.end_row();
        ui.label("longest path");
        ui.add(DragValue::new(&mut rendered.max_depth).range(1..=Render::MAX_DEPTH));
        ui.end_row();
        ui.label("roulette");
        ui.checkbox(&mut rendered.roulette, "");
        ui.end_row();
        ui.label("energy");
        choice(ui, &mut rendered.energy, &[("preserve", Energy::Preserve), ("as written", Energy::AsWritten)]);
        ui.end_row();
        ui.label("seed");
        ui.add(DragValue::new(&mut rendered.seed));
        ui.end_row();
    });
    shown.exposure = shown.exposure.clamp(-64.0, 64.0);
    // Written only if it is another value: a film starts anew by its numbers, and is not even looked at without.
    let film_edited = film.set_if_neq(shown);
    render.set_if_neq(rendered) || film_edited
}

fn choice<T: PartialEq + Copy>(ui: &mut Ui, value: &mut T, choices: &[(&str, T)]) {
    ui.horizontal(|ui| {
        for (name, choice) in choices {
            ui.selectable_value(value, *choice, *name);
        }
    });
}
