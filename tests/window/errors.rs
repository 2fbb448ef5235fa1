//! The panel's section of the error, drawn without a window and used by a pointer.

use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use lucerna::app::window::panel::errors::{ErrorsAction, ErrorsShown, Over, show};

/// Draws the section, clicks on a text, and says what is wanted then.
fn clicked(shown: &ErrorsShown, text: &str) -> Option<ErrorsAction> {
    let context = Context::default();
    context.all_styles_mut(|style| style.animation_time = 0.0);
    let mut wanted = None;
    let mut draw = |events: Vec<Event>| {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 600.0)));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        context.run_ui(input, |ui| wanted = show(ui, shown).or(wanted)).shapes
    };
    let is_it = |shape: &ClippedShape| match &shape.shape {
        Shape::Text(drawn) if drawn.galley.text() == text => Some(drawn.visual_bounding_rect().center()),
        _ => None,
    };
    draw(Vec::new());
    let pos = draw(Vec::new()).iter().find_map(is_it).unwrap_or_else(|| panic!("`{text}` is not shown"));
    draw(vec![Event::PointerMoved(pos)]);
    for pressed in [true, false] {
        let button = PointerButton::Primary;
        draw(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
    }
    wanted
}

#[test]
fn a_click_says_what_is_wanted() {
    let idle = ErrorsShown::default();
    assert_eq!(clicked(&idle, "where it comes from"), Some(ErrorsAction::Begin));
    for (over, name) in [(Over::Bounce, "bounce"), (Over::Way, "way"), (Over::Robust, "robust mean")] {
        assert_eq!(clicked(&idle, name), Some(ErrorsAction::Over(over)));
        let shown = ErrorsShown { over, ..ErrorsShown::default() };
        assert_eq!(clicked(&shown, name), None, "it is shown already");
        assert_eq!(clicked(&shown, "nothing"), Some(ErrorsAction::Over(Over::Nothing)));
    }
}

#[test]
fn what_is_under_way_is_not_begun_again() {
    let busy = ErrorsShown { done: Some(0.25), ..ErrorsShown::default() };
    assert_eq!(clicked(&busy, "where it comes from: 25 %"), None);
}

#[test]
fn what_was_found_and_its_colours_are_shown() {
    let lines = ["7 % of the error: lamp".to_owned()];
    let legend = vec![([255, 0, 0], "bounce 0".to_owned())];
    let shown = ErrorsShown { lines: &lines, over: Over::Bounce, legend, ..ErrorsShown::default() };
    // Both are texts that nothing comes of.
    assert_eq!(clicked(&shown, &lines[0]), None);
    assert_eq!(clicked(&shown, "bounce 0"), None);
}
