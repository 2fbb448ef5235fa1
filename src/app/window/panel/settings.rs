//! Cameras to choose from, and how the scene is rendered.

use bevy_ecs::prelude::*;
use egui::{DragValue, Slider, Ui};

use crate::app::window::cameras;
use crate::components::{Film, Render};
use crate::engine::Engine;
use crate::scene::settings::{Choice, SETTINGS, Setting, Settings, Value};

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

/// The settings of film and render. Says whether one was written.
pub fn show(ui: &mut Ui, world: &mut World) -> bool {
    let mut query = world.query::<(&mut Film, &mut Render)>();
    let Some((mut film, mut render)) = query.iter_mut(world).next() else { return false };
    let mut settings = Settings { film: *film, render: *render };
    let mut lines: Vec<_> = SETTINGS.iter().filter_map(|setting| Some((setting.panel?, setting))).collect();
    lines.sort_by_key(|(panel, _)| panel.line);
    egui::Grid::new("settings").num_columns(2).show(ui, |ui| {
        for (panel, setting) in lines {
            let name = ui.label(panel.label);
            if let Some(flag) = setting.flag {
                name.on_hover_text(format!("{} (--{})", flag.help, flag.name));
            }
            widget(ui, setting, &mut settings);
            ui.end_row();
        }
    });
    // Written only if it is another value: a film starts anew by its numbers, and is not even looked at without.
    let film_edited = film.set_if_neq(settings.film);
    render.set_if_neq(settings.render) || film_edited
}

fn widget(ui: &mut Ui, setting: &Setting, settings: &mut Settings) {
    match setting.value {
        Value::Whole { least, most, at } => _ = ui.add(DragValue::new(at(settings)).range(least..=most)),
        Value::Stops { most, slider, at } => {
            let stops = at(settings);
            ui.add(Slider::new(stops, -slider..=slider).clamping(egui::SliderClamping::Never).suffix(" stops"));
            *stops = stops.clamp(-most, most);
        }
        Value::Switch(at) => _ = ui.checkbox(at(settings), ""),
        Value::Choice(at) => choice(ui, at(settings)),
        // The window decides about them.
        Value::Size(_) | Value::Crop(_) => {}
    }
}

fn choice(ui: &mut Ui, choice: &mut dyn Choice) {
    ui.horizontal(|ui| {
        for word in choice.words() {
            let label = ui.selectable_label(choice.index() == word.value, word.name);
            if label.on_hover_text(word.help).clicked() {
                choice.choose(word.value);
            }
        }
    });
}
