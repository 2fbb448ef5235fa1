//! The panel: what the engine does, and what can be changed about it.
//!
//! It stands at the right of the picture, and covers nothing of it. Every section keeps its height, whatever there is to say.
//! Nothing is read back from the device while it is closed. Every change but that of the view is an edit of components: the
//! engine finds out by itself what it makes undone.

mod copy;
pub mod curve;
pub mod debug;
mod edit_row;
pub mod edits;
pub mod errors;
pub mod lens;
pub mod lights;
mod maps;
pub mod materials;
pub mod members;
mod outcome;
pub mod parameters;
mod passes;
pub mod paths;
mod pixel;
pub mod probes;
mod progress;
mod readings;
mod save;
mod settings;
mod text;
mod view;

use std::path::PathBuf;
use std::time::Instant;

use egui::{CollapsingHeader, RichText, Ui};
use glam::UVec2;

use crate::app::window::dock;
use crate::app::window::family::Listing;
use crate::app::window::paths::ShownPaths;
use crate::app::window::thumbs::Thumbs;
use crate::components::Camera;
use crate::engine::{Engine, EngineError, MeshExtent};

use edits::EditsShown;
use errors::ErrorsShown;
pub use outcome::Outcome;
use readings::Readings;

/// What the panel shows of the session, beside the engine and its own readings.
pub struct PanelContext<'a> {
    /// What is looked through.
    pub camera: &'a Camera,
    /// The largest extent of the scene.
    pub scene_size: f64,
    pub family: Option<FamilyContext<'a>>,
    /// The name of the selected mesh.
    pub selected: Option<&'a str>,
    /// The brightest paths of a pixel, where they are shown.
    pub paths: Option<&'a ShownPaths>,
    /// What was saved since the window opened.
    pub edits: EditsShown<'a>,
    /// Where the error comes from.
    pub errors: ErrorsShown<'a>,
}

/// The family that the scene is a member of.
pub struct FamilyContext<'a> {
    pub members: &'a Listing,
    /// The name of the one that is shown.
    pub shown: &'a str,
    /// Their pictures.
    pub thumbs: &'a mut Thumbs,
}

/// The panel, and what it shows.
pub struct Panel {
    pub open: bool,
    /// As it was last drawn, or is to be at first, points.
    width: f32,
    /// The selected material is to be shown in the next frame.
    reveal: bool,
    /// Passes are timed: while they are shown.
    timed: bool,
    software: bool,
    readings: Readings,
    /// That of the scene's file, which pictures are named from.
    folder: PathBuf,
}

impl Panel {
    /// `features` are all that shaders know; `software` is whether the device is the processor; `folder` that of the scene's file.
    pub fn new(open: bool, features: Vec<String>, software: bool, folder: PathBuf) -> Self {
        let readings = Readings::new(features);
        Self { open, width: dock::WIDTH, reveal: false, timed: false, software, readings, folder }
    }

    /// Opens it, or closes it.
    pub fn toggle(&mut self, engine: &mut Engine) {
        self.open = !self.open;
        self.time(engine, false);
        self.readings.forget();
    }

    fn time(&mut self, engine: &mut Engine, on: bool) {
        if std::mem::replace(&mut self.timed, on) != on {
            engine.set_timing(on);
        }
    }

    /// Opens the section of materials in the next frame, and scrolls to it.
    pub fn reveal_materials(&mut self) {
        self.reveal = true;
    }

    /// The width that it wants, points; none while it is closed.
    pub fn width(&self) -> Option<f32> {
        self.open.then_some(self.width)
    }

    /// When it is to read the engine again; none while it shows all there is. `pixel` is that under the pointer,
    /// `began` when the film last started anew.
    pub fn next_reading(&self, engine: &mut Engine, pixel: Option<UVec2>, began: Instant) -> Option<Instant> {
        if self.open { self.readings.next(engine, pixel, began) } else { None }
    }

    /// Reads the engine, as far as it is time to. Says whether there is something new to show.
    pub fn read(
        &mut self,
        engine: &mut Engine,
        pixel: Option<UVec2>,
        began: Instant,
        now: Instant,
    ) -> Result<bool, EngineError> {
        if self.open { self.readings.read(engine, pixel, began, now) } else { Ok(false) }
    }

    /// Draws it at the right side of the window, as wide as a hand has made it.
    pub fn show(&mut self, ui: &mut Ui, engine: &mut Engine, context: PanelContext) -> Outcome {
        let samples = wanted_samples(engine);
        let [least, most] = dock::widths(ui.max_rect().width());
        let frame = egui::Frame::side_top_panel(ui.style()).fill(egui::Color32::from_gray(24));
        let panel = egui::Panel::right("panel").frame(frame).default_size(self.width).size_range(least..=most);
        let shown = panel.show(ui, |ui| {
            // A child by itself: content that is too wide is to be scrolled, and makes the panel no wider.
            let rect = ui.available_rect_before_wrap();
            let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect));
            ui.advance_cursor_after_rect(rect);
            let scrolled = egui::ScrollArea::both().auto_shrink(false);
            scrolled.show(&mut inner, |ui| self.show_sections(ui, engine, context)).inner
        });
        self.width = shown.response.rect.width();
        if wanted_samples(engine) != samples {
            // Who says how many there are to be wants no more.
            engine.set_endless(false);
        }
        shown.inner
    }

    fn show_sections(&mut self, ui: &mut Ui, engine: &mut Engine, context: PanelContext) -> Outcome {
        let PanelContext { camera, scene_size, family, selected, paths: bright, edits, errors } = context;
        let mut outcome = Outcome::default();
        let selected = selected.and_then(|mesh| Some((mesh, engine.mesh(mesh)?)));
        narrow(ui.spacing_mut());
        outcome.save = save::show(ui);
        section(ui, "Edits", true, |ui| outcome.edits = edits::show(ui, &edits));
        if let Some(FamilyContext { members: list, shown, thumbs }) = family {
            section(ui, "Variants", true, |ui| outcome.member = members::show(ui, list, shown, thumbs));
        }
        section(ui, "Progress", true, |ui| progress::show(ui, &self.readings));
        section(ui, "Error", false, |ui| outcome.errors = errors::show(ui, &errors));
        let maps = engine.edit(materials::most_maps);
        section(ui, "Pixel", true, |ui| pixel::show(ui, &self.readings, maps));
        section(ui, "Paths", true, |ui| (outcome.paths, outcome.said) = paths::show(ui, bright));
        section(ui, "View", true, |ui| outcome.edited |= view::show(ui, engine, &self.readings));
        if engine.probing().is_some() || !engine.probes().is_empty() {
            section(ui, "Probes", true, |ui| {
                outcome.edited |= probes::show(ui, engine, self.readings.histogram.as_ref());
            });
        }
        section(ui, "Camera", true, |ui| {
            outcome.camera = settings::cameras(ui, engine);
            outcome.lens = lens::show(ui, camera, scene_size);
            if let Some((name, _)) = engine.camera() {
                outcome.said = copy::camera(ui, &name, camera).or(outcome.said.take());
            }
        });
        let parameters = parameters::all(engine);
        if !parameters.is_empty() {
            section(ui, "Shader", true, |ui| {
                outcome.moved |= engine.edit(|world| parameters::show(ui, world, &parameters));
            });
        }
        section(ui, "Settings", true, |ui| outcome.edited |= engine.edit(|world| settings::show(ui, world)));
        section(ui, "Lights", false, |ui| outcome.moved |= engine.edit(|world| lights::show(ui, world, scene_size)));
        outcome.add(self.show_materials(ui, engine, selected.as_ref()));
        let timed = section(ui, "Passes", false, |ui| passes::show(ui, &self.readings, self.software));
        self.time(engine, timed);
        outcome
    }

    /// The section of materials, opened and scrolled to where that of the selected mesh is to be shown.
    fn show_materials(&mut self, ui: &mut Ui, engine: &mut Engine, selected: Option<&(&str, MeshExtent)>) -> Outcome {
        let reveal = std::mem::take(&mut self.reveal) && selected.is_some();
        let seen = self.readings.pixel.as_ref().and_then(|pixel| pixel.surface.as_ref()?.material.as_deref());
        let header = CollapsingHeader::new(RichText::new("Materials").strong()).open(reveal.then_some(true));
        let shown = header.show(ui, |ui| engine.edit(|world| materials::show(ui, world, seen, selected, &self.folder)));
        if reveal {
            shown.header_response.scroll_to_me(Some(egui::Align::Min));
        }
        shown.body_returned.unwrap_or_default()
    }
}

/// Samples a pixel that the settings say.
fn wanted_samples(engine: &Engine) -> Option<u32> {
    engine.settings().map(|(_, render)| render.spp)
}

/// Has a colour with its three numbers fit in the width that the panel has at first.
fn narrow(spacing: &mut egui::Spacing) {
    (spacing.item_spacing.x, spacing.button_padding.x) = (5.0, 4.0);
    (spacing.interact_size.x, spacing.indent) = (32.0, 12.0);
}

/// Says whether it is open.
fn section(ui: &mut Ui, title: &str, open: bool, content: impl FnOnce(&mut Ui)) -> bool {
    let header = CollapsingHeader::new(RichText::new(title).strong()).default_open(open);
    header.show(ui, content).openness > 0.0
}
