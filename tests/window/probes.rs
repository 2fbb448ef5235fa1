//! The panel's section of numbers that shaders show, drawn without a window and used by a pointer, with an engine behind it.

use std::path::Path;
use std::time::Duration;

use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use lucerna::Engine;
use lucerna::app::window::legend::of_probe;
use lucerna::app::window::panel::probes::{self, BINS};
use lucerna::cpu::probe::{Histogram, NO_NUMBER, NOTHING};
use lucerna::layout::view::ViewMode;
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

const STEP: Duration = Duration::from_millis(20);

/// The section, and what was drawn of it last.
struct Section {
    context: Context,
    shapes: Vec<ClippedShape>,
    engine: Engine,
    /// Whether the picture became another at some time.
    edited: bool,
}

impl Section {
    fn new(engine: Engine) -> Self {
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        let mut section = Self { context, shapes: Vec::new(), engine, edited: false };
        section.draw(Vec::new());
        section
    }

    /// What is known of the numbers that are shown.
    fn histogram(&self) -> Option<Histogram> {
        let (values, probing) = (self.engine.probe_values().unwrap()?, self.engine.probing()?);
        Some(Histogram::of(&values, &probing.look.colours(values.len() as u32), BINS))
    }

    fn draw(&mut self, events: Vec<Event>) {
        let histogram = self.histogram();
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(320.0, 600.0)));
        for events in [events, Vec::new()] {
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            let Self { context, engine, edited, .. } = self;
            self.shapes = context.run_ui(input, |ui| *edited |= probes::show(ui, engine, histogram.as_ref())).shapes;
        }
    }

    fn texts(&self) -> Vec<(String, Rect)> {
        let of = |shape: &ClippedShape| match &shape.shape {
            Shape::Text(drawn) => Some((drawn.galley.text().to_owned(), drawn.visual_bounding_rect())),
            _ => None,
        };
        self.shapes.iter().filter_map(of).collect()
    }

    fn says(&self, part: &str) -> bool {
        self.texts().iter().any(|(drawn, _)| drawn.contains(part))
    }

    /// Clicks what has a text, and lets the engine follow.
    fn click(&mut self, text: &str) {
        let found = self.texts().into_iter().find(|(drawn, _)| drawn == text);
        let pos = found.unwrap_or_else(|| panic!("`{text}` is not among {:?}", self.texts())).1.center();
        self.draw(vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let button = PointerButton::Primary;
            self.draw(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
        }
        finish(&mut self.engine);
        self.draw(Vec::new());
    }
}

fn finish(engine: &mut Engine) {
    while !engine.step(STEP).unwrap().finished {}
}

/// The Cornell box, whose paths show where they go.
fn open() -> Engine {
    let library = Library::shipped();
    let text = library.text("passes/trace/path").unwrap().to_owned();
    let missed = "    let missed = hit.triangle == NO_HIT;\n";
    assert!(text.contains(missed));
    let calls = "    probe(\"distance\", hit.t);\n    probe(\"direction\", (*state).direction);\n    if (missed) {\n        probe(\"distance\", 0.0);\n    }\n";
    let library = library.with("passes/trace/path", &text.replace(missed, &format!("{missed}{calls}")));
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-data.ron");
    let defines =
        [("film.size", "(16,12)"), ("render.spp", "2"), ("render.integrator", "Bsdf"), ("render.sampler", "Pcg")];
    let defines = defines.map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&scene, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    let mut engine = Engine::open(support::gpu(), library, &description).unwrap();
    engine.set_live(true);
    finish(&mut engine);
    engine
}

#[test]
fn a_name_is_chosen_looked_at_and_let_go() {
    let mut section = Section::new(open());
    assert!(
        section.says("distance")
            && section.says("direction")
            && section.says("path.wgsl")
            && section.says("and 1 more")
    );
    assert!(!section.says("log") && !section.edited, "nothing is chosen yet");

    section.click("distance");
    assert!(section.edited);
    assert_eq!((section.engine.view(), section.engine.probing().unwrap().name.as_str()), (ViewMode::Probe, "distance"));
    assert!(section.says("in 100.0 % of all pixels"), "{:?}", section.texts());
    let known = section.histogram().unwrap();
    assert_eq!(known.bins.iter().sum::<u32>(), 16 * 12);
    let compiled = section.engine.compiled();

    section.click("log");
    assert!(section.engine.probing().unwrap().look.logarithmic && section.says(", log; in"));
    section.click("direction");
    section.click("y");
    section.click("bounce");
    let look = section.engine.probing().unwrap().look;
    assert_eq!((look.part, look.bounce, look.logarithmic), (1, Some(0), true), "looks stay with the section");
    section.click("log");
    let [least, most] = section.histogram().unwrap().all.unwrap();
    assert!((-1.0..0.0).contains(&least) && (0.0..=1.0).contains(&most), "{least} {most}");
    section.click("from");
    assert_eq!(section.engine.probing().unwrap().look.range, Some([least, most]), "from where it was");
    assert_eq!(section.engine.compiled(), compiled, "all of it is data");

    section.click("off");
    assert_eq!((section.engine.view(), section.engine.probing()), (ViewMode::Beauty, None));
}

#[test]
fn the_legend_has_the_numbers_of_its_colours() {
    let mut section = Section::new(open());
    section.click("distance");
    let known = section.histogram().unwrap();
    let legend = of_probe(&known, false);
    let bar = legend.bar.unwrap();
    let number = |place: usize| bar.marks[place].1.parse::<f32>().unwrap();
    let [least, most] = known.all.unwrap();
    assert!((number(0) - least).abs() < 0.01 * most && (number(4) - most).abs() < 0.01 * most, "{:?}", bar.marks);
    let named: Vec<[u8; 3]> = legend.swatches.iter().map(|(colour, _)| *colour).collect();
    assert_eq!(named, [NOTHING, NO_NUMBER]);
    // The pixels of the least and the greatest number have the colours of the ends.
    let values = section.engine.probe_values().unwrap().unwrap();
    let picture = section.engine.picture().unwrap().unwrap();
    for (end, colour) in [(least, bar.colours[0]), (most, *bar.colours.last().unwrap())] {
        let at = values.iter().position(|value| value.x == end).unwrap();
        assert_eq!(picture[at][..3], colour[..]);
    }
    assert_eq!(of_probe(&Histogram::default(), true).bar, None, "nothing was shown");
}

#[test]
fn a_name_that_is_gone_is_said_to_be() {
    let mut section = Section::new(open());
    section.click("distance");
    let shipped = section.engine.remake(Library::shipped()).unwrap();
    section.engine.run(shipped);
    finish(&mut section.engine);
    section.draw(Vec::new());
    assert!(section.says("no shader has probe(\"distance\", ..) any more"), "{:?}", section.texts());
    assert!(section.says("no pixel shows a number of it"));
    section.click("off");
    assert_eq!(section.engine.probing(), None);
}
