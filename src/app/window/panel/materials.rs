//! Every material with its numbers.

use bevy_ecs::prelude::*;
use egui::{CollapsingHeader, DragValue, RichText, Slider, Ui};
use glam::Vec3;

use crate::components::{Material, Name};

/// Colours nearer than this are taken as one.
const COLOUR_STEP: f32 = 1e-4;

/// All materials by name, that under the pointer marked. Says whether one was written.
pub fn show(ui: &mut Ui, world: &mut World, seen: Option<&str>) -> bool {
    let mut query = world.query::<(&Name, &mut Material)>();
    let mut materials: Vec<(&Name, Mut<Material>)> = query.iter_mut(world).collect();
    materials.sort_by_key(|(name, _)| *name);
    let mut edited = false;
    for (name, material) in &mut materials {
        let title = RichText::new(name.as_str());
        let title = if seen == Some(name.as_str()) { title.strong().underline() } else { title };
        CollapsingHeader::new(title).id_salt(name.as_str()).show(ui, |ui| {
            let mut numbers = (**material).clone();
            sliders(ui, &mut numbers);
            edited |= material.set_if_neq(numbers);
        });
    }
    if materials.is_empty() {
        ui.label("the scene has none");
    }
    edited
}

/// The numbers of one material, by the names of the MTL format.
fn sliders(ui: &mut Ui, material: &mut Material) {
    egui::Grid::new("numbers").num_columns(2).show(ui, |ui| {
        colour(ui, "Kd", &mut material.kd);
        colour(ui, "Ks", &mut material.ks);
        number(ui, "Ns", Slider::new(&mut material.ns, 0.0..=1e5).logarithmic(true));
        ui.label("Pr");
        ui.horizontal(|ui| {
            let mut rough = material.roughness.is_some();
            ui.checkbox(&mut rough, "");
            material.roughness = rough.then(|| material.roughness.unwrap_or(0.5));
            if let Some(roughness) = &mut material.roughness {
                ui.add(Slider::new(roughness, 0.0..=1.0));
            }
        });
        ui.end_row();
        number(ui, "Pm", Slider::new(&mut material.metallic, 0.0..=1.0));
        ui.label("Ke");
        ui.horizontal(|ui| {
            for channel in material.emission.as_mut() {
                ui.add(DragValue::new(channel).range(0.0..=1e6).speed(0.05));
            }
        });
        ui.end_row();
        ui.label("one side");
        ui.checkbox(&mut material.one_sided, "");
        ui.end_row();
        number(ui, "Ni", Slider::new(&mut material.ni, 1.0..=3.0));
        number(ui, "d", Slider::new(&mut material.dissolve, 0.0..=1.0));
        colour(ui, "Tf", &mut material.tf);
        ui.label("illum");
        let look = material.appearance();
        ui.add(DragValue::new(&mut material.illum).range(0..=10))
            .on_hover_text(format!("{}: {}", look.kind, look.reason));
        ui.end_row();
    });
}

fn number(ui: &mut Ui, name: &str, slider: Slider) {
    ui.label(name);
    // A number beyond the slider's range, from a file, stays as it is until it is moved.
    ui.add(slider.clamping(egui::SliderClamping::Edits));
    ui.end_row();
}

fn colour(ui: &mut Ui, name: &str, value: &mut Vec3) {
    ui.label(name);
    ui.horizontal(|ui| {
        // The button turns the colour into hue and saturation and back: what differs by a rounding was not touched.
        let mut picked = value.to_array();
        ui.color_edit_button_rgb(&mut picked);
        let picked = Vec3::from_array(picked).max(Vec3::ZERO);
        if !picked.abs_diff_eq(*value, COLOUR_STEP) {
            *value = picked;
        }
        for channel in value.as_mut() {
            ui.add(DragValue::new(channel).range(0.0..=1e3).speed(0.005).max_decimals(3));
        }
    });
    ui.end_row();
}
