//! The panel's lines of shaders' parameters, drawn without a window and used by a pointer, with an engine behind them.

use std::path::Path;
use std::time::Duration;

use bevy_ecs::prelude::*;
use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2, pos2};
use lucerna::Engine;
use lucerna::app::window::panel::{debug, parameters};
use lucerna::components::{ShaderValue, ShaderValues};
use lucerna::engine::DebugRange;
use lucerna::scene;
use lucerna::shader::Library;

use crate::support;

const STEP: Duration = Duration::from_millis(20);

/// What was drawn last of something.
struct Drawn {
    context: Context,
    shapes: Vec<ClippedShape>,
}

impl Drawn {
    fn new() -> Self {
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        Self { context, shapes: Vec::new() }
    }

    /// Draws what comes of some events, and what that leads to. Says whether anything was edited.
    fn draw(&mut self, events: Vec<Event>, mut show: impl FnMut(&mut egui::Ui) -> bool) -> bool {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(500.0, 800.0)));
        let mut edited = false;
        for events in [events, Vec::new()] {
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            self.shapes = self.context.run_ui(input, |ui| edited |= show(ui)).shapes;
        }
        edited
    }

    fn texts(&self) -> Vec<(String, Rect)> {
        let of = |shape: &ClippedShape| match &shape.shape {
            Shape::Text(drawn) => Some((drawn.galley.text().to_owned(), drawn.visual_bounding_rect())),
            _ => None,
        };
        self.shapes.iter().filter_map(of).collect()
    }

    fn find(&self, text: &str) -> Rect {
        let found = self.texts().into_iter().find(|(drawn, _)| drawn == text);
        found.unwrap_or_else(|| panic!("`{text}` is not among {:?}", self.texts())).1
    }

    fn says(&self, part: &str) -> bool {
        self.texts().iter().any(|(drawn, _)| drawn.contains(part))
    }
}

/// The Cornell box, whose paths gather so many times as much light as a parameter says.
fn open() -> Engine {
    let library = Library::shipped();
    let path = library.text("passes/trace/path").unwrap();
    let declared = "@range(0.0, 16.0) override TIMES: f32 = 1.0;\n@range(1, 9) override UNUSED: i32 = 3;\noverride DARK: bool = false;\n";
    let text = path.replace("const LARGEST_F32", &format!("{declared}const LARGEST_F32"));
    let text = text.replace("(*state).radiance += light;", "(*state).radiance += select(TIMES, 0.0, DARK) * light;");
    let library = library.clone().with("passes/trace/path", &text);
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/cornell-box.ron");
    let defines =
        [("film.size", "(16,12)"), ("render.spp", "2"), ("render.integrator", "Bsdf"), ("render.sampler", "Pcg")];
    let defines = defines.map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(&scene, &defines).unwrap_or_else(|e| panic!("{e:?}")).description;
    let mut engine = Engine::open(support::gpu(), library, &description).unwrap();
    engine.set_live(true);
    finish(&mut engine);
    engine
}

fn finish(engine: &mut Engine) {
    while !engine.step(STEP).unwrap().finished {}
}

fn show(drawn: &mut Drawn, engine: &mut Engine, events: Vec<Event>) -> bool {
    let all = parameters::all(engine);
    drawn.draw(events, |ui| engine.edit(|world| parameters::show(ui, world, &all)))
}

fn click(drawn: &mut Drawn, engine: &mut Engine, pos: Pos2) -> bool {
    let mut edited = show(drawn, engine, vec![Event::PointerMoved(pos)]);
    for pressed in [true, false] {
        let button = PointerButton::Primary;
        edited |= show(drawn, engine, vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
    }
    edited
}

fn value(engine: &mut Engine, name: &str) -> Option<ShaderValue> {
    let name = name.to_owned();
    engine.edit(|world: &mut World| world.query::<&ShaderValues>().single(world).unwrap().0.get(&name).copied())
}

#[test]
fn a_moved_slider_has_its_first_pixels_without_a_compile() {
    let mut engine = open();
    let mut drawn = Drawn::new();
    assert!(!show(&mut drawn, &mut engine, Vec::new()), "looking is no edit");
    for name in ["TIMES", "UNUSED", "DARK"] {
        drawn.find(name);
    }
    let before = engine.film().unwrap();
    let compiled = engine.compiled();

    // Somewhere on the rail, which begins behind the names.
    let (label, reset) = (drawn.find("TIMES"), drawn.find("reset"));
    let rail = pos2(drawn.find("UNUSED").right() + 60.0, label.center().y);
    assert!(rail.x < reset.left());
    assert!(click(&mut drawn, &mut engine, rail));
    let Some(ShaderValue::Number(moved)) = value(&mut engine, "TIMES") else { panic!("nothing was set") };
    assert!(moved > 1.5 && moved < 15.5, "{moved}");
    engine.step(STEP).unwrap();
    assert!(engine.picture().unwrap().is_some(), "first pixels");
    assert_eq!(engine.compiled(), compiled);
    finish(&mut engine);
    let after = engine.film().unwrap();
    let times = after.mean[1] / before.mean[1];
    assert!((times / moved - 1.0).abs() < 1e-3, "{times} {moved}");
    assert_eq!(engine.compiled(), compiled);

    // The tick, and the way back.
    let tick = pos2(rail.x - 52.0, drawn.find("DARK").center().y);
    assert!(click(&mut drawn, &mut engine, tick));
    assert_eq!(value(&mut engine, "DARK"), Some(ShaderValue::Switch(true)));
    finish(&mut engine);
    assert_eq!(engine.film().unwrap().mean, [0.0; 3]);
    for name in ["TIMES", "DARK"] {
        let line = drawn.find(name).center().y;
        let resets = drawn.texts().into_iter().filter(|(text, _)| text == "reset");
        let nearest = resets.min_by_key(|(_, rect)| (rect.center().y - line).abs() as i32).unwrap().1;
        click(&mut drawn, &mut engine, nearest.center());
        assert_eq!(value(&mut engine, name), None, "{name}");
    }
    finish(&mut engine);
    assert!(engine.film().unwrap().pixels == before.pixels);
    assert_eq!(engine.compiled(), compiled);
}

#[test]
fn the_debug_view_has_a_legend_of_its_range() {
    let mut drawn = Drawn::new();
    let mut legend = |range: DebugRange| {
        drawn.draw(Vec::new(), |ui| {
            debug::legend(ui, &range);
            false
        });
        drawn.texts().into_iter().map(|(text, _)| text).collect::<Vec<_>>().join("\n")
    };
    let nothing = legend(DebugRange { pixels: 4, ..DebugRange::default() });
    assert!(nothing.contains("nothing here calls debug(..)"), "{nothing}");
    let (least, most) = (glam::Vec3::new(-0.5, 0.0, 0.25), glam::Vec3::new(2.0, 1.0, 0.25));
    let some = legend(DebugRange { pixels: 8, shown: 6, broken: 1, least, most });
    for part in ["red    -0.5000 to 2.0000", "blue   0.2500 to 0.2500", "75.0 %", "1 pixels are no numbers"] {
        assert!(some.contains(part), "{part}: {some}");
    }
    assert!(!drawn.says("nothing here"));
}
