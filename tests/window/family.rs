//! A person at a window on a family of scenes: steps, compares two members, and edits the file meanwhile.

use std::path::Path;
use std::time::{Duration, Instant};

use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use glam::UVec2;
use lucerna::app::window::family::Listing;
use lucerna::app::window::pair::{Pair, Seen};
use lucerna::app::window::panel::members;
use lucerna::app::window::thumbs::{Stand, Thumbs};
use lucerna::gpu::Fit;

#[cfg(target_os = "linux")]
use super::{
    person::Person,
    xvfb::{Screenshot, await_some},
};

fn listing(names: &[&str]) -> Listing {
    Listing::new(names.iter().map(|name| (*name).to_owned()).collect())
}

#[test]
fn a_list_steps_in_circles_and_keeps_what_is_wanted() {
    let mut list = listing(&["a", "b", "c"]);
    list.step(-1);
    assert_eq!(list.wanted(), Some("c"));
    list.step(2);
    assert_eq!(list.wanted(), Some("b"));
    // The one that is wanted is in another place; then it is gone, and the last takes its place.
    list.replace(["x", "a", "b"].map(str::to_owned).to_vec());
    assert_eq!((list.wanted(), list.place("b")), (Some("b"), Some(2)));
    list.replace(["x", "a"].map(str::to_owned).to_vec());
    assert_eq!(list.wanted(), Some("a"));
    assert!(!list.choose("b") && list.wanted() == Some("a") && list.choose("x") && list.wanted() == Some("x"));
    let mut none = listing(&[]);
    none.step(1);
    assert_eq!(none.wanted(), None);
    list.replace(Vec::new());
    assert_eq!(list.wanted(), None);
}

#[test]
fn two_members_are_side_by_side_once_the_first_is_left() {
    let seen = |name: &str| Seen { name: name.to_owned(), size: UVec2::ONE, fit: Fit::Fill, pixels: vec![[0; 4]] };
    let mut pair = Pair::default();
    pair.on = true;
    pair.keep(seen("a"));
    // Something was saved, and it is the same member still.
    assert!(!pair.follow("a") && pair.beside("a").is_none());
    pair.keep(seen("a"));
    assert!(pair.follow("b"));
    assert_eq!(pair.beside("b").map(|seen| seen.name.as_str()), Some("a"));
    pair.keep(seen("b"));
    assert!(!pair.follow("b"));
    assert_eq!(pair.beside("b").map(|seen| seen.name.as_str()), Some("a"));
    pair.on = false;
    assert_eq!(pair.beside("b"), None);
}

#[test]
fn a_click_in_the_panel_chooses_a_member() {
    let context = Context::default();
    context.all_styles_mut(|style| style.animation_time = 0.0);
    let list = listing(&["dull", "bright"]);
    let mut thumbs = Thumbs::default();
    let mut draw = |events: Vec<Event>| {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(300.0, 300.0)));
        let mut chosen = None;
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let drawn =
            context.run_ui(input, |ui| chosen = chosen.take().or(members::show(ui, &list, "dull", &mut thumbs)));
        (drawn.shapes, chosen)
    };
    draw(Vec::new());
    let (shapes, _) = draw(Vec::new());
    let place = shapes.iter().find_map(|shape| match &shape.shape {
        Shape::Text(text) if text.galley.text() == "bright" => Some(text.visual_bounding_rect().center()),
        _ => None,
    });
    let pos = place.expect("the member is listed");
    draw(vec![Event::PointerMoved(pos)]);
    let button =
        |pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    let (_, pressed) = draw(vec![button(true)]);
    let (_, released) = draw(vec![button(false)]);
    assert_eq!(pressed.or(released).as_deref(), Some("bright"));
}

#[test]
fn a_member_that_was_seen_has_a_small_picture() {
    let context = Context::default();
    let list = listing(&["dull", "bright"]);
    let mut thumbs = Thumbs::default();
    let begin = Instant::now();
    // Two pixels become one of the mean of their light: code 188, not 128.
    let pixels = [[0, 0, 0, 255], [255, 255, 255, 255]].repeat(128 * 128);
    let seen = Seen { name: "bright".to_owned(), size: UVec2::new(256, 128), fit: Fit::Fill, pixels };
    let at = |spp, finished| Stand { began: begin, spp, finished };
    assert!(!thumbs.wants("bright", at(0, false), begin), "it has no sample yet");
    assert!(thumbs.wants("bright", at(1, false), begin));
    thumbs.take(&seen, Some(at(1, false)), begin);
    let [soon, later] = [100, 1100].map(|milliseconds| begin + Duration::from_millis(milliseconds));
    assert!(!thumbs.wants("bright", at(1, false), later), "it is as it was");
    assert!(!thumbs.wants("bright", at(2, false), soon), "it grows");
    assert!(thumbs.wants("bright", at(2, false), later) && thumbs.wants("bright", at(2, true), soon));
    assert!(thumbs.wants("dull", at(1, false), soon), "another member has none");
    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(300.0, 300.0)));
    let input = RawInput { screen_rect, ..RawInput::default() };
    let drawn = context.run_ui(input, |ui| drop(members::show(ui, &list, "dull", &mut thumbs)));
    let deltas = drawn.textures_delta.set.iter().flat_map(|(id, deltas)| deltas.iter().map(move |delta| (*id, delta)));
    let images: Vec<_> = deltas.filter(|(_, delta)| delta.image.size() == [64, 32]).collect();
    let [(id, delta)] = &images[..] else { panic!("{} small pictures", images.len()) };
    let egui::ImageData::Color(image) = &delta.image;
    assert!(image.pixels.iter().all(|pixel| pixel.to_array() == [188, 188, 188, 255]), "{:?}", image.pixels[0]);
    let is_drawn = drawn.shapes.iter().any(|shape| shape.shape.texture_id() == *id);
    assert!(is_drawn && thumbs.texture(&context, "dull").is_none());
}

const FAMILY: &str = "\
(
    extends: \"scene.ron\",
    sweep: {
        \"materials.white.kd\": named({ \"white\": (0.7, 0.7, 0.7), \"blue\": (0.1, 0.1, 0.7) }),
    },
    members: { \"dark\": { \"film.exposure\": -2 } },
)
";

#[cfg(target_os = "linux")]
const KEYS: [u32; 4] = [0x5b, 0x5d, 0x76, 0xffbf];

#[cfg(target_os = "linux")]
#[test]
fn a_person_steps_through_a_family() {
    let [before, next, compare, panel] = KEYS;
    let folder = Person::files();
    std::fs::write(folder.path().join("family.ron"), FAMILY).unwrap();
    let mut person = Person::in_folder(folder, "family.ron", &[]);
    let file = |name: &str| person.folder.path().join(name);
    let title = |text: &str| {
        let shown = || person.display.title(person.window).contains(text).then_some(());
        await_some(person.process.id(), text, shown);
    };
    title("white (1 of 3)");
    person.finish();
    let white = person.rendered_by("scene.ron", "192x144", &["-D", "materials.white.kd=(0.7, 0.7, 0.7)"]);
    person.see("the first member", |look| *look == white);

    // To the second: its picture is that of its scene alone, to the bit.
    person.display.key(next);
    title("blue (2 of 3)");
    person.finish();
    let define = "materials.white.kd=(0.1, 0.1, 0.7)";
    let blue = person.rendered_by("scene.ron", "192x144", &["-D", define]);
    person.see("the second member, once the notices are gone", |look| *look == blue);
    assert!(blue.difference(&white) > 1.0);

    // The member before on the left, this one on the right, below the shadow of the line that names both.
    person.display.key(compare);
    let rows = |look: &Screenshot, columns: std::ops::Range<usize>| -> Vec<[u8; 3]> {
        look.pixels.chunks(192).skip(60).take(60).flat_map(|row| row[columns.clone()].to_vec()).collect()
    };
    person.see("both members", |look| {
        rows(look, 0..90) == rows(&white, 0..90) && rows(look, 100..192) == rows(&blue, 100..192)
    });
    // A hand at the line between them moves that, and no camera.
    person.display.point(96, 100);
    std::thread::sleep(Duration::from_millis(300));
    person.display.button(1, true);
    for x in [90, 70, 48] {
        person.display.point(x, 100);
        std::thread::sleep(Duration::from_millis(100));
    }
    person.display.button(1, false);
    person.display.point(150, 20);
    person.see("less of the first member", |look| {
        rows(look, 0..44) == rows(&white, 0..44) && rows(look, 52..192) == rows(&blue, 52..192)
    });
    person.display.key(compare);
    person.see("the second member alone", |look| *look == blue);

    // A member that is added while it runs; back behind the first is the last.
    let more = FAMILY.replace("members: {", "members: { \"late\": { \"film.exposure\": -3 },");
    std::fs::write(file("family.ron"), more).unwrap();
    title("(2 of 4)");
    person.display.key(before);
    title("white (1 of 4)");
    person.display.key(before);
    title("dark (4 of 4)");
    person.finish();
    let dark = person.rendered_by("scene.ron", "192x144", &["-D", "film.exposure=-2"]);
    person.see("the darker member", |look| *look == dark);

    // Its panel lists them.
    person.display.resize(person.window, 700, 500);
    person.display.key(panel);
    person.finish();
    person.see("the panel with the members", |look| look.width == 700 && bright(look) > 200);
    person.display.key(panel);

    // Taken away: what is in its place is shown.
    std::fs::write(file("family.ron"), FAMILY.replace("members: { \"dark\": { \"film.exposure\": -2 } },", ""))
        .unwrap();
    title("blue (2 of 2)");
    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}

/// Pixels of the right side that are as bright as letters.
#[cfg(target_os = "linux")]
fn bright(look: &Screenshot) -> usize {
    let right = look.pixels.chunks(look.width as usize).flat_map(|row| &row[row.len() / 2..]);
    right.filter(|pixel| pixel.iter().all(|code| *code > 120)).count()
}

/// A variant file is found by its name, and what is neither scene nor family says so.
#[cfg(target_os = "linux")]
#[test]
fn a_family_is_opened_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["scenes", "variants", "models"] {
        crate::reload::copy(&root.join("assets").join(name), &folder.path().join("assets").join(name));
    }
    let mut person = Person::in_folder(folder, "samplers", &[]);
    let shown = || person.display.title(person.window).contains("(1 of 4)").then_some(());
    await_some(person.process.id(), "the title", shown);
    person.quit();
}
