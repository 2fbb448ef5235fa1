//! The panel stays as it is under a hand: no section moves when numbers come, or the pointer goes over the picture.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use glam::UVec2;
use lucerna::Engine;
use lucerna::app::edits::{Edit, Kind, Lint, State, Verdict};
use lucerna::app::window::edits::record::Record;
use lucerna::app::window::panel::curve::{Decades, power};
use lucerna::app::window::panel::edits::EditsShown;
use lucerna::app::window::panel::errors::ErrorsShown;
use lucerna::app::window::panel::{Panel, PanelContext};
use lucerna::layout::view::ViewMode;
use lucerna::shader::Library;

use super::maps::description;
use crate::support;

const SECTIONS: [&str; 11] =
    ["Edits", "Progress", "Error", "Pixel", "Paths", "View", "Camera", "Settings", "Lights", "Materials", "Passes"];

/// Something that was saved.
fn saved(kind: Kind) -> Edit {
    let (scene, verdict) = ("box".to_owned(), Verdict::new(State::None, ""));
    Edit { kind, scene, files: vec!["lambert.wgsl".to_owned()], saved: 0, pixels: None, lint: Lint::NotLinted, verdict }
}

/// A panel in a window that is high enough for all of it.
struct Drawn {
    context: Context,
    panel: Panel,
    record: Record,
    /// What is said of where the error comes from.
    lines: Vec<String>,
    engine: Engine,
    began: Instant,
    /// Of readings: later than any that was.
    now: Instant,
}

impl Drawn {
    fn new() -> Self {
        let mut scene = description();
        scene.film.size = UVec2::new(32, 24);
        // More than are ever traced here: each reading has something new.
        scene.render.spp = 1 << 20;
        let engine = Engine::open(support::gpu(), Library::shipped(), &scene).unwrap();
        let features = Library::shipped().features().unwrap().into_iter().collect();
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        let now = Instant::now();
        let panel = Panel::new(true, features, true, PathBuf::new());
        let record = Record::new(saved(Kind::Opened), Library::shipped());
        Self { context, panel, record, lines: Vec::new(), engine, began: now, now }
    }

    fn draw(&mut self, events: Vec<Event>) -> Vec<ClippedShape> {
        let (_, camera) = self.engine.camera().unwrap();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(900.0, 3000.0)));
        let mut shapes = Vec::new();
        for events in [events, Vec::new(), Vec::new()] {
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            let (panel, engine) = (&mut self.panel, &mut self.engine);
            let (record, lines) = (&self.record, &self.lines[..]);
            let show = |ui: &mut egui::Ui| {
                let edits = EditsShown { record, automatic: true, rests: false };
                let (camera, scene_size) = (&camera, 1.0);
                let errors = ErrorsShown { lines, ..ErrorsShown::default() };
                panel.show(
                    ui,
                    engine,
                    PanelContext { camera, scene_size, family: None, selected: None, paths: None, edits, errors },
                );
            };
            shapes = self.context.run_ui(input, show).shapes;
        }
        shapes
    }

    /// All texts, and where they are.
    fn texts(&mut self) -> Vec<(String, Rect)> {
        let shapes = self.draw(Vec::new());
        let of = |shape: &ClippedShape| match &shape.shape {
            Shape::Text(text) => Some((text.galley.text().to_owned(), text.visual_bounding_rect())),
            _ => None,
        };
        shapes.iter().filter_map(of).collect()
    }

    /// Where every section's title is, and what is last; the width of the panel.
    fn places(&mut self) -> BTreeMap<String, Rect> {
        let places: BTreeMap<_, _> = self
            .texts()
            .into_iter()
            .filter(|(text, _)| SECTIONS.contains(&text.as_str()) || text == "features")
            .collect();
        let width = self.panel.width().unwrap();
        places.into_iter().chain([("width".to_owned(), Rect::from_min_size(Pos2::ZERO, Vec2::splat(width)))]).collect()
    }

    fn click_on(&mut self, text: &str) {
        let found = self.texts().into_iter().find(|(drawn, _)| drawn == text);
        self.click(found.unwrap_or_else(|| panic!("`{text}` is not shown")).1.center());
    }

    fn click(&mut self, pos: Pos2) {
        self.draw(vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let button = PointerButton::Primary;
            self.draw(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
        }
    }

    /// Traces for a while, and reads what there is then, with the pointer on a pixel or on none.
    fn read(&mut self, pixel: Option<UVec2>) {
        self.engine.step(Duration::from_millis(20)).unwrap();
        self.now += Duration::from_secs(20);
        assert!(self.panel.read(&mut self.engine, pixel, self.began, self.now).unwrap(), "there was something to read");
    }
}

#[test]
fn no_section_moves_when_numbers_come() {
    let mut drawn = Drawn::new();
    let passes = drawn.places()["Passes"];
    drawn.click(passes.center());
    drawn.click_on("Error");
    let before = drawn.places();
    assert_eq!(before.len(), SECTIONS.len() + 2, "{before:?}");
    // Nothing under the pointer, the scene, what is beside it; more of them as the film grows.
    for pixel in [None, Some(UVec2::new(16, 20)), Some(UVec2::new(0, 12)), Some(UVec2::new(16, 12)), None] {
        drawn.read(pixel);
        assert_eq!(drawn.places(), before, "with the pointer on {pixel:?}");
    }
    for (view, name) in ViewMode::ALL {
        drawn.engine.set_view(view);
        drawn.read(Some(UVec2::new(3, 3)));
        assert_eq!(drawn.places(), before, "in view {name}");
    }
    for n in 0..110 {
        drawn.record.take(saved(Kind::Shaders), &Library::shipped().with("lib/own", &format!("// {n}\n")), true);
        if !(6..=97).contains(&n) {
            assert_eq!(drawn.places(), before, "with {} rows of edits", drawn.record.rows().len());
        }
    }
    drawn.lines =
        (0..40).map(|n| format!("{n} % of the error: a lamp of a long name, found by chance through glass")).collect();
    assert_eq!(drawn.places(), before, "with all that is known of the error");
    assert!(drawn.record.dropped() > 0, "the line that says so is seen too");
}

#[test]
fn every_word_fits_in_the_width_that_the_panel_has_at_first() {
    let mut drawn = Drawn::new();
    for section in ["Passes", "Materials", "Lights", "Error"] {
        drawn.click_on(section);
    }
    let material = description().materials.keys().next().unwrap().clone();
    drawn.click_on(&material);
    let inner = drawn.panel.width().unwrap();
    for (view, name) in ViewMode::ALL {
        drawn.engine.set_view(view);
        drawn.read(Some(UVec2::new(16, 20)));
        assert_eq!(drawn.panel.width(), Some(inner));
        for (text, rect) in drawn.texts().into_iter().filter(|(text, _)| !text.trim().is_empty()) {
            assert!(rect.left() >= 900.0 - inner && rect.right() <= 900.0, "`{text}` is cut at {rect} in view {name}");
        }
    }
}

#[test]
fn the_numbers_of_the_plot_are_powers_of_ten_that_do_not_touch() {
    let words: Vec<String> = (-5..=5).map(power).collect();
    assert_eq!(words, ["1e-5", "1e-4", "0.001", "0.01", "0.1", "1", "10", "100", "1000", "1e4", "1e5"]);
    let none = Decades { first: -1, last: 1 };
    let around = |powers: &[f64]| Decades::around(powers.iter().copied(), none);
    assert_eq!(around(&[]), none);
    assert_eq!(around(&[0.2, 0.7]), Decades { first: 0, last: 1 });
    assert_eq!(around(&[-2.5, 1.0]), Decades { first: -3, last: 1 });
    assert_eq!(around(&[2.0]), Decades { first: 2, last: 3 });
    for last in 1..20 {
        let marks = Decades { first: 0, last }.marks();
        assert!((2..=6).contains(&marks.len()) && marks[0] == 0, "{marks:?}");
    }
}
