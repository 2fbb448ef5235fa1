//! The maps of one material: a line each, to switch it off and on, and to choose another picture.

use std::collections::BTreeMap;

use egui::{ComboBox, Ui};

use crate::scene::{KEYS, MapUse, MtlMaterial, TextureMap, Value};

/// The maps that the scene's materials have, by what they are looked up for: each may take another's place.
pub struct Choices(BTreeMap<MapUse, Vec<TextureMap>>);

impl Choices {
    /// Those of some materials, in the order of their files. Of maps of one file that are looked up alike, there is one.
    pub fn of<'a>(materials: impl Iterator<Item = &'a MtlMaterial>) -> Self {
        let mut by_use: BTreeMap<MapUse, Vec<TextureMap>> = BTreeMap::new();
        for (map, used) in materials.flat_map(|material| material.maps.uses()) {
            let choice = TextureMap { alone: false, off: false, ..map.clone() };
            let list = by_use.entry(used).or_default();
            if !list.contains(&choice) {
                list.push(choice);
            }
        }
        by_use.values_mut().for_each(|list| list.sort_by(|a, b| a.file.cmp(&b.file)));
        Self(by_use)
    }

    fn for_use(&self, used: MapUse) -> &[TextureMap] {
        self.0.get(&used).map_or(&[], Vec::as_slice)
    }
}

/// The maps of a material, if it has any.
pub fn show(ui: &mut Ui, material: &mut MtlMaterial, choices: &Choices) {
    egui::Grid::new("maps").num_columns(2).show(ui, |ui| {
        for key in KEYS {
            let Value::Map(used, at) = key.value else { continue };
            if let Some(map) = at(material) {
                ui.label(key.label());
                ui.horizontal(|ui| line(ui, key.scene, map, choices.for_use(used)));
                ui.end_row();
            }
        }
    });
}

/// A tick, and the file among those that could take its place.
fn line(ui: &mut Ui, key: &str, map: &mut TextureMap, choices: &[TextureMap]) {
    let mut on = !map.off;
    ui.checkbox(&mut on, "");
    map.off = !on;
    let path = map.file.display().to_string();
    let list = ComboBox::from_id_salt(key).selected_text(label(map)).show_ui(ui, |ui| {
        for choice in choices {
            let chosen = TextureMap { alone: map.alone, off: map.off, ..choice.clone() };
            let same = chosen == *map;
            if ui.selectable_label(same, label(choice)).on_hover_text(choice.file.display().to_string()).clicked() {
                *map = chosen;
            }
        }
    });
    list.response.on_hover_text(path);
}

/// A map's file, without its folder, and how often it is repeated, if not once.
fn label(map: &TextureMap) -> String {
    let file = map.file.file_name().unwrap_or(map.file.as_os_str()).to_string_lossy().into_owned();
    if map.scale == glam::Vec2::ONE { file } else { format!("{file}  {} x {}", map.scale.x, map.scale.y) }
}
