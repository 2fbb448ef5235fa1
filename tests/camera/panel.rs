//! The panel's lines of the lens, used by a pointer.

use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use lucerna::app::window::panel::lens;
use lucerna::components::{Camera, Focus, Lens};

#[test]
fn numbers_of_the_lens_are_dragged() {
    let context = Context::default();
    let mut camera = Camera { lens: Lens { aperture: 0.5, ..Lens::default() }, ..Camera::default() };
    let mut draw = |events: Vec<Event>| {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 300.0)));
        let mut shapes = Vec::new();
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        shapes.extend(
            context
                .run_ui(input, |ui| {
                    if let Some(changed) = lens::show(ui, &camera, 100.0) {
                        camera.lens = changed;
                    }
                })
                .shapes,
        );
        (shapes, camera.lens)
    };
    draw(Vec::new());
    let (shapes, before) = draw(Vec::new());
    assert_eq!(before, Lens { aperture: 0.5, ..Lens::default() });
    let place = |text: &str| {
        let found = shapes.iter().find_map(|shape| match &shape.shape {
            Shape::Text(drawn) if drawn.galley.text() == text => Some(drawn.visual_bounding_rect().center()),
            _ => None,
        });
        found.unwrap_or_else(|| panic!("`{text}` is not shown"))
    };
    let mut drag = |from: Pos2| {
        let button = |pos: Pos2, pressed: bool| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let to = from + Vec2::new(20.0, 0.0);
        draw(vec![Event::PointerMoved(from)]);
        draw(vec![button(from, true)]);
        draw(vec![Event::PointerMoved(from + Vec2::new(10.0, 0.0))]);
        draw(vec![Event::PointerMoved(to)]);
        draw(vec![button(to, false)]).1
    };
    let lens = drag(place("0.50"));
    assert!(lens.aperture > 0.5 && lens.focus == Focus::LookAt, "{lens:?}");
    // The distance of the point that is looked at, until it is another.
    let focused = drag(place("1.0"));
    assert!(matches!(focused.focus, Focus::Distance(distance) if distance > 1.0), "{focused:?}");
    assert_eq!(focused.aperture, lens.aperture);
}
