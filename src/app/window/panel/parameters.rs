//! The parameters that shaders declare, each as a slider, a number or a tick.

use bevy_ecs::prelude::*;
use egui::{DragValue, Grid, Response, RichText, Slider, SliderClamping, Ui};

use crate::components::{ShaderValue, ShaderValues};
use crate::engine::Engine;
use crate::shader::{Parameter, ParameterKind};

/// A parameter, and whether anything reads it that the scene needs.
pub struct Shown {
    pub parameter: Parameter,
    pub is_read: bool,
}

/// All that the shaders declare, by name.
pub fn all(engine: &Engine) -> Vec<Shown> {
    let shown = |parameter: &Parameter| Shown { parameter: parameter.clone(), is_read: engine.reads(&parameter.name) };
    engine.parameters().iter().map(shown).collect()
}

/// A line for each. Says whether one was written.
pub fn show(ui: &mut Ui, world: &mut World, all: &[Shown]) -> bool {
    let mut query = world.query::<&mut ShaderValues>();
    let Some(mut held) = query.iter_mut(world).next() else { return false };
    let mut values = held.clone();
    Grid::new("parameters").num_columns(3).show(ui, |ui| {
        for Shown { parameter, is_read } in all {
            line(ui, parameter, *is_read, &mut values);
            ui.end_row();
        }
    });
    held.set_if_neq(values)
}

/// Its name, its value, and the way back to its default.
fn line(ui: &mut Ui, parameter: &Parameter, is_read: bool, values: &mut ShaderValues) {
    let name = RichText::new(&parameter.name);
    let label = ui.label(if is_read { name } else { name.weak() });
    let place = &parameter.place;
    let unread = if is_read { "" } else { "\nnothing that this scene needs reads it" };
    label.on_hover_text(format!("{parameter}\n{}:{}{unread}", place.source.file, place.line));
    let set = values.0.get(&parameter.name).map(|value| value.number());
    let mut value = parameter.value(set);
    if widget(ui, parameter, &mut value).changed() && parameter.fits(value) {
        let written = match parameter.kind {
            ParameterKind::Switch => ShaderValue::Switch(value != 0.0),
            _ => ShaderValue::Number(value),
        };
        values.0.insert(parameter.name.clone(), written);
    }
    let is_set = values.0.contains_key(&parameter.name);
    let reset = ui.add_enabled(is_set, egui::Button::new("reset").small());
    if reset.on_hover_text(format!("back to {}", parameter.default)).clicked() {
        values.0.remove(&parameter.name);
    }
}

fn widget(ui: &mut Ui, parameter: &Parameter, value: &mut f64) -> Response {
    let is_whole = parameter.kind != ParameterKind::Number;
    match (parameter.kind, parameter.range) {
        (ParameterKind::Switch, _) => {
            let mut on = *value != 0.0;
            let ticked = ui.checkbox(&mut on, "");
            *value = f64::from(u8::from(on));
            ticked
        }
        (_, Some([least, most])) if is_whole => ui.add(slider(value, least, most).integer()),
        (_, Some([least, most])) => ui.add(slider(value, least, most)),
        (ParameterKind::Whole, None) => ui.add(DragValue::new(value).range(0..=u32::MAX).speed(0.1)),
        (ParameterKind::Signed, None) => ui.add(DragValue::new(value).range(i32::MIN..=i32::MAX).speed(0.1)),
        (_, None) => {
            let speed = 0.01 * value.abs().max(0.01);
            ui.add(DragValue::new(value).speed(speed).max_decimals(6))
        }
    }
}

fn slider(value: &mut f64, least: f64, most: f64) -> Slider<'_> {
    Slider::new(value, least..=most).clamping(SliderClamping::Always)
}
