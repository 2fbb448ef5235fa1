//! The panel: what the engine does, and what can be changed about it.
//!
//! Nothing is read back from the device while it is closed. Every change but that of the view is an edit of components: the
//! engine finds out by itself what it makes undone.

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
mod settings;

use std::time::Instant;

use glam::UVec2;

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
        self.edits = later.edits.or(self.edits);
    }
}

/// The panel, and what it shows.
pub struct Panel {
    pub open: bool,
    software: bool,
    readings: Readings,
}

impl Panel {
    /// Closed. `features` are all that shaders know; `software` is whether the device is the processor.
    pub fn new(features: Vec<String>, software: bool) -> Self {
        Self { open: false, software, readings: Readings::new(features) }
    }

    /// Opens it, or closes it; passes are timed while it is open.
    pub fn toggle(&mut self, engine: &mut Engine) {
        self.open = !self.open;
        engine.set_timing(self.open);
        self.readings.forget();
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

    /// Draws it, at the right side of the window. `view` is the camera and the size of the scene; `family` are its members, the name of the one
    /// that is shown, and their pictures; `saved` is what was saved since the window opened.
    pub fn show(
        &self,
        ui: &mut egui::Ui,
        engine: &mut Engine,
        (camera, size): (&Camera, f64),
        family: Option<(&Listing, &str, &mut Thumbs)>,
        saved: &EditsShown,
    ) -> Outcome {
        let mut outcome = Outcome::default();
        let samples = wanted_samples(engine);
        let fill = egui::Color32::from_rgba_unmultiplied(24, 24, 24, 235);
        let frame = egui::Frame::side_top_panel(ui.style()).fill(fill);
        egui::Panel::right("panel").frame(frame).default_size(300.0).show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                section(ui, "Edits", true, |ui| outcome.edits = edits::show(ui, saved));
                if let Some((list, shown, thumbs)) = family {
                    section(ui, "Variants", true, |ui| outcome.member = members::show(ui, list, shown, thumbs));
                }
                section(ui, "Progress", true, |ui| progress::show(ui, &self.readings));
                section(ui, "Pixel", true, |ui| pixel::show(ui, self.readings.pixel.as_ref()));
                section(ui, "View", true, |ui| {
                    outcome.edited |= settings::view(ui, engine, self.readings.debug.as_ref());
                });
                section(ui, "Camera", true, |ui| {
                    outcome.camera = settings::cameras(ui, engine);
                    outcome.lens = lens::show(ui, camera, size);
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
                    section(ui, "Materials", false, |ui| outcome.moved |= materials::show(ui, world, seen));
                });
                section(ui, "Passes", false, |ui| passes::show(ui, &self.readings, self.software));
            });
        });
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

fn section(ui: &mut egui::Ui, title: &str, open: bool, content: impl FnOnce(&mut egui::Ui)) {
    egui::CollapsingHeader::new(egui::RichText::new(title).strong()).default_open(open).show(ui, content);
}
