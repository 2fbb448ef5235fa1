//! The panel: what the engine does, and what can be changed about it.
//!
//! It stands at the right of the picture, and covers nothing of it. Every section keeps its height, whatever there is to say.
//! Nothing is read back from the device while it is closed. Every change but that of the view is an edit of components: the
//! engine finds out by itself what it makes undone.

mod copy;
pub mod curve;
pub mod debug;
pub mod edits;
pub mod lens;
pub mod lights;
mod maps;
pub mod materials;
pub mod members;
pub mod parameters;
mod passes;
mod pixel;
mod progress;
mod readings;
mod save;
mod settings;
mod text;
mod view;

use std::path::PathBuf;
use std::time::Instant;

use egui::{CollapsingHeader, RichText};
use glam::UVec2;

use crate::app::window::dock;
use crate::app::window::family::Listing;
use crate::app::window::thumbs::Thumbs;
use crate::components::{Camera, Lens};
use crate::engine::{Engine, EngineError};

use edits::{EditsAction, EditsShown};
use readings::Readings;

/// What a user did in the panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// A component was written, or another view chosen.
    pub edited: bool,
    /// Something that the picture follows by the hand, like a moving camera.
    pub moved: bool,
    /// A camera was chosen.
    pub camera: Option<String>,
    /// The lens as it is to be.
    pub lens: Option<Lens>,
    /// A member of the family was chosen.
    pub member: Option<String>,
    /// The scene's file is to have what was changed.
    pub save: bool,
    /// What was copied.
    pub said: Option<String>,
    /// What is wanted of the record of edits.
    pub edits: Option<EditsAction>,
}

impl Outcome {
    /// Adds what was done in a later pass of the same frame.
    pub fn add(&mut self, later: Outcome) {
        self.edited |= later.edited;
        self.moved |= later.moved;
        self.camera = later.camera.or(self.camera.take());
        self.lens = later.lens.or(self.lens.take());
        self.member = later.member.or(self.member.take());
        self.save |= later.save;
        self.said = later.said.or(self.said.take());
        self.edits = later.edits.or(self.edits);
    }
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

    /// Draws it at the right side of the window, as wide as a hand has made it. `view` is the camera and the size of the scene; `family` are
    /// its members, the name of the one that is shown, and their pictures; `selected` is the name of a mesh; `saved` is what was saved since the window opened.
    pub fn show(
        &mut self,
        ui: &mut egui::Ui,
        engine: &mut Engine,
        (camera, size): (&Camera, f64),
        family: Option<(&Listing, &str, &mut Thumbs)>,
        (selected, saved): (Option<&str>, &EditsShown),
    ) -> Outcome {
        let mut outcome = Outcome::default();
        let samples = wanted_samples(engine);
        let mut timed = false;
        let selected = selected.and_then(|mesh| Some((mesh, engine.mesh(mesh)?)));
        let reveal = std::mem::take(&mut self.reveal) && selected.is_some();
        let [least, most] = dock::widths(ui.max_rect().width());
        let frame = egui::Frame::side_top_panel(ui.style()).fill(egui::Color32::from_gray(24));
        let panel = egui::Panel::right("panel").frame(frame).default_size(self.width).size_range(least..=most);
        let shown = panel.show(ui, |ui| {
            // A child by itself: content that is too wide is to be scrolled, and makes the panel no wider.
            let rect = ui.available_rect_before_wrap();
            let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect));
            ui.advance_cursor_after_rect(rect);
            egui::ScrollArea::both().auto_shrink(false).show(&mut inner, |ui| {
                narrow(ui.spacing_mut());
                outcome.save = save::show(ui);
                section(ui, "Edits", true, |ui| outcome.edits = edits::show(ui, saved));
                if let Some((list, shown, thumbs)) = family {
                    section(ui, "Variants", true, |ui| outcome.member = members::show(ui, list, shown, thumbs));
                }
                section(ui, "Progress", true, |ui| progress::show(ui, &self.readings));
                let maps = engine.edit(materials::most_maps);
                section(ui, "Pixel", true, |ui| pixel::show(ui, self.readings.pixel.as_ref(), maps));
                section(ui, "View", true, |ui| {
                    outcome.edited |= view::show(ui, engine, self.readings.debug.as_ref());
                });
                section(ui, "Camera", true, |ui| {
                    outcome.camera = settings::cameras(ui, engine);
                    outcome.lens = lens::show(ui, camera, size);
                    if let Some((name, _)) = engine.camera() {
                        copy::camera(ui, &name, camera);
                    }
                });
                let parameters = parameters::all(engine);
                if !parameters.is_empty() {
                    section(ui, "Shader", true, |ui| {
                        outcome.moved |= engine.edit(|world| parameters::show(ui, world, &parameters));
                    });
                }
                engine.edit(|world| {
                    section(ui, "Settings", true, |ui| outcome.edited |= settings::show(ui, world));
                    let seen =
                        self.readings.pixel.as_ref().and_then(|pixel| pixel.surface.as_ref()?.material.as_deref());
                    section(ui, "Lights", false, |ui| outcome.moved |= lights::show(ui, world, size));
                    let open = reveal.then_some(true);
                    let header = CollapsingHeader::new(RichText::new("Materials").strong()).open(open);
                    let materials = header.show(ui, |ui| {
                        outcome.moved |= materials::show(ui, world, seen, selected.as_ref(), &self.folder)
                    });
                    if reveal {
                        materials.header_response.scroll_to_me(Some(egui::Align::Min));
                    }
                });
                timed = section(ui, "Passes", false, |ui| passes::show(ui, &self.readings, self.software));
            });
        });
        self.width = shown.response.rect.width();
        self.time(engine, timed);
        outcome.said = copy::said(ui.ctx());
        if wanted_samples(engine) != samples {
            // Who says how many there are to be wants no more.
            engine.set_endless(false);
        }
        outcome
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
fn section(ui: &mut egui::Ui, title: &str, open: bool, content: impl FnOnce(&mut egui::Ui)) -> bool {
    let header = CollapsingHeader::new(RichText::new(title).strong()).default_open(open);
    header.show(ui, content).openness > 0.0
}
