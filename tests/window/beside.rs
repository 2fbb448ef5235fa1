//! Two pictures with a divider between them, drawn without a window: a hand moves it, and it stays there.

use egui::{Context, CursorIcon, Event, Modifiers, PointerButton, RawInput, Rect, pos2};
use glam::UVec2;
use lucerna::app::window::beside::Beside;
use lucerna::app::window::pair::Seen;
use lucerna::gpu::Fit;

/// The picture's area: the panel has the rest of the window.
const AREA: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(400.0, 300.0) };

const SIZE: UVec2 = UVec2::new(4, 3);

fn pixels(count: u32) -> Vec<[u8; 4]> {
    vec![[9, 9, 9, 255]; (SIZE.x * SIZE.y * count) as usize]
}

/// Draws it after some events, and once more; returns the cursor.
fn draw(context: &Context, beside: &mut Beside, events: Vec<Event>) -> CursorIcon {
    let mut icon = CursorIcon::Default;
    for events in [events, Vec::new()] {
        let screen_rect = Some(Rect { max: pos2(700.0, 300.0), ..AREA });
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        icon = context.run_ui(input, |ui| beside.draw(ui.ctx(), AREA)).platform_output.cursor_icon;
    }
    icon
}

fn point(context: &Context, beside: &mut Beside, x: f32) -> CursorIcon {
    draw(context, beside, vec![Event::PointerMoved(pos2(x, 150.0))])
}

fn press(context: &Context, beside: &mut Beside, x: f32, pressed: bool) {
    let (pos, button, modifiers) = (pos2(x, 150.0), PointerButton::Primary, Modifiers::NONE);
    draw(context, beside, vec![Event::PointerButton { pos, button, pressed, modifiers }]);
}

/// Drags from one place to another.
fn drag(context: &Context, beside: &mut Beside, from: f32, to: f32) {
    point(context, beside, from);
    press(context, beside, from, true);
    for part in [0.3, 0.7, 1.0] {
        point(context, beside, from + part * (to - from));
    }
    press(context, beside, to, false);
}

#[test]
fn a_hand_moves_the_divider_of_both_kinds() {
    let judged = |beside: &mut Beside| beside.show_split(Some((SIZE, pixels(2))));
    let members = |beside: &mut Beside| {
        let seen = Seen { name: "a".to_owned(), size: SIZE, fit: Fit::Fill, pixels: pixels(1) };
        beside.show_pair(Some(&seen), "b");
    };
    let kinds: [&dyn Fn(&mut Beside); 2] = [&judged, &members];
    for show in kinds {
        let (context, mut beside) = (Context::default(), Beside::default());
        drag(&context, &mut beside, 200.0, 100.0);
        assert_eq!(beside.divider(), 0.5, "there is nothing to divide yet");
        show(&mut beside);
        assert_eq!(point(&context, &mut beside, 300.0), CursorIcon::Default);
        assert_eq!(point(&context, &mut beside, 203.0), CursorIcon::ResizeHorizontal);
        drag(&context, &mut beside, 200.0, 100.0);
        assert_eq!(beside.divider(), 0.25);
        // A drag elsewhere is not its own; one beyond the edge leaves a part of both.
        drag(&context, &mut beside, 300.0, 350.0);
        assert_eq!(beside.divider(), 0.25);
        drag(&context, &mut beside, 100.0, 690.0);
        assert!(beside.divider() > 0.9 && beside.divider() < 1.0, "{}", beside.divider());
    }
}

#[test]
fn what_lies_over_the_film_hides_it() {
    let mut beside = Beside::default();
    assert!(beside.is_empty() && !beside.hides(0.1) && !beside.hides(0.9));
    let seen = Seen { name: "a".to_owned(), size: SIZE, fit: Fit::Fill, pixels: pixels(1) };
    beside.show_pair(Some(&seen), "b");
    assert!(beside.hides(0.1) && !beside.hides(0.9) && beside.names() == Some("a | b"));
    beside.show_pair(None, "b");
    beside.show_split(Some((SIZE, pixels(2))));
    assert!(beside.hides(0.1) && beside.hides(0.9) && beside.names().is_none());
}
