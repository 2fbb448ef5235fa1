//! Every material with its numbers and maps.

use std::collections::BTreeMap;
use std::path::Path;

use bevy_ecs::prelude::*;
use egui::{CollapsingHeader, Color32, DragValue, RichText, Slider, Ui};
use glam::Vec3;

use super::copy;
use super::maps::{self, Choices};
use super::outcome::Outcome;
use crate::components::{Maps, Material, Name, Texture};
use crate::engine::MeshExtent;
use crate::scene::{Colour, KEYS, Key, MtlMaterial, Range, Value};

/// What is selected, as it is marked in the picture.
const SELECTED: Color32 = crate::app::window::mark::COLOUR;

/// Colours nearer than this are taken as one.
const COLOUR_STEP: f32 = 1e-4;

/// All materials by name, that under the pointer marked; above them the selected mesh, if there is one, with its material opened. `folder` is
/// that of the scene's file.
pub fn show(
    ui: &mut Ui,
    world: &mut World,
    seen: Option<&str>,
    selected: Option<&(&str, MeshExtent)>,
    folder: &Path,
) -> Outcome {
    let textures = textures(world);
    let choices = Choices::of(world.query::<&MtlMaterial>().iter(world));
    let mut query = world.query::<(&Name, &mut MtlMaterial, &mut Material, &mut Maps)>();
    let mut materials: Vec<_> = query.iter_mut(world).collect();
    materials.sort_by_key(|(name, ..)| *name);
    let chosen = selected.and_then(|(mesh, extent)| {
        ui.label(RichText::new(told(mesh, extent)).color(SELECTED));
        extent.material.as_deref()
    });
    // Its own first, and all others as they were.
    materials.sort_by_key(|(name, ..)| chosen != Some(name.as_str()));
    let mut outcome = Outcome::default();
    for (name, numbers, material, rendered) in &mut materials {
        let title = RichText::new(name.as_str());
        let title = if seen == Some(name.as_str()) { title.strong().underline() } else { title };
        let is_chosen = chosen == Some(name.as_str());
        let title = if is_chosen { title.color(SELECTED) } else { title };
        // Known by another name than in its usual place: so it is open when it comes, and there as it was when it has gone.
        CollapsingHeader::new(title).id_salt((name.as_str(), is_chosen)).default_open(is_chosen).show(ui, |ui| {
            let mut edit = (**numbers).clone();
            sliders(ui, &mut edit);
            maps::show(ui, &mut edit, &choices);
            outcome.said = copy::material(ui, name.as_str(), &edit, folder).or(outcome.said.take());
            if edit != **numbers {
                edit.moved(numbers);
                let (comes_to, maps) = edit.rendered(&textures);
                numbers.set_if_neq(edit);
                material.set_if_neq(comes_to);
                rendered.set_if_neq(maps);
                outcome.moved = true;
            }
        });
    }
    if materials.is_empty() {
        ui.label("the scene has none");
    }
    outcome
}

/// A selected mesh in a line.
fn told(mesh: &str, extent: &MeshExtent) -> String {
    let material = if extent.material.is_none() { ", of the default material" } else { "" };
    format!("selected: {mesh}, {} triangles{material}", extent.triangles)
}

/// The maps that a material of the scene has at most.
pub fn most_maps(world: &mut World) -> usize {
    world.query::<&MtlMaterial>().iter(world).map(|material| material.maps.uses().count()).max().unwrap_or(0)
}

/// The scene's textures, by their names.
fn textures(world: &mut World) -> BTreeMap<String, Entity> {
    let mut query = world.query_filtered::<(&Name, Entity), With<Texture>>();
    query.iter(world).map(|(name, entity)| (name.as_str().to_owned(), entity)).collect()
}

/// The numbers of one material: a line for each key.
fn sliders(ui: &mut Ui, material: &mut MtlMaterial) {
    egui::Grid::new("numbers").num_columns(2).show(ui, |ui| {
        for key in KEYS.iter().filter(|key| !matches!(key.value, Value::Map(..))) {
            ui.label(key.label()).on_hover_text(key.doc);
            ui.horizontal(|ui| widget(ui, key, material));
            ui.end_row();
        }
    });
}

fn widget(ui: &mut Ui, key: &Key, material: &mut MtlMaterial) {
    match key.value {
        Value::Colour(Colour::Radiance, at) => channels(ui, at(material), Colour::Radiance.most_in_scene(), 0.05),
        Value::Colour(kind, at) => colour(ui, at(material), kind.most_in_scene()),
        Value::Number(range, at) => number(ui, at(material), range),
        Value::Optional(range, at) => optional(ui, at(material), range),
        Value::Switch(at) => _ = ui.checkbox(at(material), ""),
        Value::Whole(most, at) => {
            let look = material.appearance();
            ui.add(DragValue::new(at(material)).range(0..=most))
                .on_hover_text(format!("{}: {}", look.kind, look.reason));
        }
        // Maps have lines of their own.
        Value::Map(..) => {}
    }
}

/// A number beyond the slider's range, from a file, stays as it is until it is moved.
fn number(ui: &mut Ui, value: &mut f32, range: Range) {
    let slider = Slider::new(value, range.of_slider()).logarithmic(range.logarithmic);
    ui.add(slider.clamping(egui::SliderClamping::Edits));
}

/// A number that need not be there: in the middle of its slider at first.
fn optional(ui: &mut Ui, value: &mut Option<f32>, range: Range) {
    let mut given = value.is_some();
    ui.checkbox(&mut given, "");
    *value = given.then(|| value.unwrap_or(0.5 * (range.slider[0] + range.slider[1])));
    if let Some(value) = value {
        ui.add(Slider::new(value, range.of_slider()));
    }
}

fn colour(ui: &mut Ui, value: &mut Vec3, most: f32) {
    // The button turns the colour into hue and saturation and back: what differs by a rounding was not touched.
    let mut picked = value.to_array();
    ui.color_edit_button_rgb(&mut picked);
    let picked = Vec3::from_array(picked).max(Vec3::ZERO);
    if !picked.abs_diff_eq(*value, COLOUR_STEP) {
        *value = picked;
    }
    for channel in value.as_mut() {
        ui.add(DragValue::new(channel).range(0.0..=most).speed(0.005).max_decimals(3));
    }
}

fn channels(ui: &mut Ui, value: &mut Vec3, most: f32, speed: f64) {
    for channel in value.as_mut() {
        ui.add(DragValue::new(channel).range(0.0..=most).speed(speed));
    }
}
