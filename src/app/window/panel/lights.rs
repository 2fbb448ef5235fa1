//! Every light without extent, with its numbers.

use bevy_ecs::prelude::*;
use egui::{CollapsingHeader, DragValue, Grid, Ui};
use glam::DVec3;

use crate::components::{Name, PointLight, SpotCone};

/// All lights by name; `size` is the scene's. Says whether one was written.
pub fn show(ui: &mut Ui, world: &mut World, size: f64) -> bool {
    let mut query = world.query::<(&Name, &mut PointLight)>();
    let mut lights: Vec<_> = query.iter_mut(world).collect();
    lights.sort_by_key(|(name, _)| *name);
    let mut edited = false;
    for (name, light) in &mut lights {
        CollapsingHeader::new(name.as_str()).id_salt(name.as_str()).show(ui, |ui| {
            let mut edit = **light;
            Grid::new("numbers").num_columns(2).show(ui, |ui| numbers(ui, &mut edit, size));
            edited |= light.set_if_neq(edit);
        });
    }
    if lights.is_empty() {
        ui.label("the scene has none");
    }
    edited
}

/// A line for each field.
fn numbers(ui: &mut Ui, light: &mut PointLight, size: f64) {
    ui.label("position").on_hover_text("in units of the scene");
    place(ui, &mut light.position, size);
    ui.label("intensity").on_hover_text(
        "radiant intensity, linear red, green and blue: at a distance d, a surface gets it divided by d squared",
    );
    ui.horizontal(|ui| {
        for channel in light.intensity.as_mut() {
            let speed = 0.01 * f64::from(channel.max(1e-3));
            let most = PointLight::MOST_INTENSITY as f32;
            ui.add(DragValue::new(channel).range(0.0..=most).speed(speed).max_decimals(4));
        }
    });
    ui.end_row();
    if let Some(cone) = &mut light.cone {
        ui.label("look_at").on_hover_text("a point on the axis of the cone, in units of the scene");
        place(ui, &mut cone.look_at, size);
        ui.label("angle").on_hover_text("between opposite edges of the cone, degrees");
        let [least, most] = SpotCone::ANGLES;
        ui.add(DragValue::new(&mut cone.angle).range(least..=most).speed(0.25).max_decimals(2));
        ui.end_row();
        ui.label("blend").on_hover_text("the part of the cone, from its edge inwards, over which the light grows");
        ui.add(DragValue::new(&mut cone.blend).range(0.0..=1.0).speed(5e-3).max_decimals(3));
        ui.end_row();
    }
}

fn place(ui: &mut Ui, point: &mut DVec3, size: f64) {
    ui.horizontal(|ui| {
        for coordinate in point.as_mut() {
            ui.add(DragValue::new(coordinate).speed(1e-3 * size).max_decimals(6));
        }
    });
    ui.end_row();
}
