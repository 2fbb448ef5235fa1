//! The panel's lines of maps, drawn without a window and used by a pointer: components change as a person says.

use bevy_ecs::prelude::*;
use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, OutputCommand, PointerButton, Pos2, RawInput, Rect, Shape, Vec2, pos2};
use glam::Vec3;
use lucerna::app::window::panel::materials;
use lucerna::app::window::scene_file::{Kept, save};
use lucerna::components::{Maps, Name};
use lucerna::scene::{MtlMaterial, SceneDescription, TextureMap, apply, describe, load};

use super::maps::description;

/// The panel's section of materials, and what was drawn of it last.
pub struct Section {
    context: Context,
    pub world: World,
    shapes: Vec<ClippedShape>,
    edited: bool,
    /// What was put on the clipboard last.
    pub copied: Option<String>,
}

impl Section {
    pub fn new(description: &SceneDescription) -> Self {
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        let mut world = World::new();
        apply(&mut world, description);
        let mut section = Self { context, world, shapes: Vec::new(), edited: false, copied: None };
        section.draw(Vec::new());
        section
    }

    /// Draws what comes of some events, and what that leads to.
    fn draw(&mut self, events: Vec<Event>) {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(500.0, 2000.0)));
        for events in [events, Vec::new(), Vec::new()] {
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            let (world, edited) = (&mut self.world, &mut self.edited);
            let output = self
                .context
                .run_ui(input, |ui| *edited |= materials::show(ui, world, None, None, std::path::Path::new("")).moved);
            self.shapes = output.shapes;
            for command in output.platform_output.commands {
                if let OutputCommand::CopyText(text) = command {
                    self.copied = Some(text);
                }
            }
        }
    }

    /// Where a text is drawn: lines first, and then what lies over them.
    fn all(&self, text: &str) -> Vec<Rect> {
        let of = |shape: &ClippedShape| match &shape.shape {
            Shape::Text(drawn) if drawn.galley.text() == text => Some(drawn.visual_bounding_rect()),
            _ => None,
        };
        self.shapes.iter().filter_map(of).collect()
    }

    fn find(&self, text: &str) -> Option<Rect> {
        self.all(text).pop()
    }

    fn click(&mut self, pos: Pos2) {
        self.draw(vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let button = PointerButton::Primary;
            self.draw(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
        }
    }

    fn click_on(&mut self, text: &str) {
        let rect = self.find(text).unwrap_or_else(|| panic!("`{text}` is not shown"));
        self.click(rect.center());
    }

    /// Clicks the tick of the line whose map is of some file.
    fn tick(&mut self, file: &str) {
        let text = self.find(file).unwrap_or_else(|| panic!("`{file}` is not shown"));
        // The tick, a space, and the button that has the text.
        let spacing = self.context.global_style().spacing.clone();
        let left = text.left() - spacing.button_padding.x - spacing.item_spacing.x - 0.5 * spacing.icon_width;
        self.click(pos2(left, text.center().y));
    }

    /// The numbers of a material, and the name of the texture of its diffuse lobe.
    fn material(&mut self, name: &str) -> (MtlMaterial, Option<String>) {
        let mut query = self.world.query::<(&Name, &MtlMaterial, &Maps)>();
        let found = query.iter(&self.world).find(|(own, ..)| own.as_str() == name).unwrap();
        let (numbers, diffuse) = (found.1.clone(), found.2.diffuse);
        (numbers, diffuse.map(|texture| self.world.get::<Name>(texture).unwrap().to_string()))
    }
}

/// The scene of the tests of maps, with a second material that another picture is a map of; the names of both.
fn two_materials() -> (SceneDescription, [String; 2]) {
    let mut scene = description();
    let names: Vec<String> = scene.materials.keys().take(2).cloned().collect();
    scene.materials.get_mut(&names[1]).unwrap().maps.kd = Some(TextureMap::new("oak.png"));
    (scene, names.try_into().unwrap())
}

#[test]
fn the_tick_of_a_map_switches_it_off_and_on() {
    let (scene, [name, other]) = two_materials();
    let mut section = Section::new(&scene);
    assert_eq!(section.find("wood.png"), None, "a material is closed at first");
    section.click_on(&name);
    assert!(section.find("leaf.png").is_some() && section.find("oak.png").is_none());
    let before = section.material(&name);
    let beside = section.material(&other);
    assert!(before.1.as_deref() == Some("wood.png, colour") && !section.edited, "looking is no edit");

    section.tick("wood.png");
    let (numbers, texture) = section.material(&name);
    assert!(section.edited && numbers.maps.kd.as_ref().unwrap().off && texture.is_none());
    // The map counts alone: without it the number is the default.
    assert_eq!(numbers.kd, MtlMaterial::default().kd);
    assert_eq!(numbers.maps.d, before.0.maps.d);

    section.tick("wood.png");
    assert!(section.material(&name) == before && section.material(&other) == beside);
}

#[test]
fn another_picture_is_chosen_for_a_map() {
    let (scene, [name, other]) = two_materials();
    let mut section = Section::new(&scene);
    section.click_on(&name);
    let beside = section.material(&other);
    section.click_on("wood.png");
    assert!(section.find("oak.png").is_some(), "the list is open");
    section.click_on("oak.png");
    let (numbers, texture) = section.material(&name);
    let map = numbers.maps.kd.unwrap();
    assert!(section.edited && map.file.as_os_str() == "oak.png" && map.alone && !map.off);
    assert_eq!((texture.as_deref(), numbers.kd), (Some("oak.png, colour"), Vec3::ONE));
    assert!(section.material(&other) == beside);
    // It is closed, and the line shows what was chosen; a number's map can't be taken for a colour.
    assert!(section.find("wood.png").is_none() && section.find("oak.png").is_some());
    section.click_on("leaf.png");
    assert_eq!((section.all("leaf.png").len(), section.all("oak.png").len()), (2, 1));
}

/// What a slider was moved to goes into the scene's file; a copied line makes another scene the same.
#[test]
fn a_moved_slider_is_saved_and_a_material_copied() {
    let folder = super::files::cornell_box();
    let path = folder.path().join("scene.ron");
    let loaded = load(&path, &[]).unwrap();
    let taken = Kept { text: loaded.text, description: loaded.description };
    let mut section = Section::new(&taken.description);
    section.click_on("cornell-box:ball");
    let (label, widest) = (section.find("Pm").unwrap(), section.find("one sided").unwrap());
    section.click(pos2(widest.right() + 60.0, label.center().y));
    let moved = section.material("cornell-box:ball").0;
    assert!(section.edited && moved.pm > 0.1 && moved.pm < 0.9, "{}", moved.pm);
    let saved = save(&taken, None, &describe(&section.world, "scene")).unwrap();
    assert_eq!(saved.edited.summary(), "1 value added (materials.ball)");
    let text = std::fs::read_to_string(&path).unwrap();
    let wanted = format!("ks: 0.05, ns: 60, pm: {}),\n    }},", moved.pm);
    assert!(text.contains(&wanted) && text.starts_with("// The Cornell box"), "{text}");

    section.click_on("copy as RON");
    let line = section.copied.clone().expect("a line");
    assert!(line.starts_with("\"ball\": (kd: 0.8, ks: 0.05, ns: 60, pm: "), "{line}");
    let copy = format!("(models: [(path: \"cornell-box.obj\")], materials: {{ {line} }})");
    std::fs::write(folder.path().join("copy.ron"), copy).unwrap();
    let copied = load(&folder.path().join("copy.ron"), &[]).unwrap().description;
    assert_eq!(copied.materials["cornell-box:ball"], moved);
}
