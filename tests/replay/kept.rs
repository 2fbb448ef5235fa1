//! The struct that the kernel keeps of each ray, and what is read of it.

use glam::{Vec2, Vec3};
use lucerna::cpu::turn::{RayKind, turns_of};
use lucerna::layout::ray::NO_HIT;
use lucerna::layout::replay::{
    PathTurn, RAY_SEGMENT, RAY_SHADOW, Replayed, TURN_DRAWN, TURN_GOES_ON, TURN_LIGHT, TURN_SURFACE,
};

#[test]
fn its_layout_has_no_gap() {
    assert_eq!((PathTurn::LAYOUT.size, PathTurn::LAYOUT.align), (288, 16));
    assert_eq!((Replayed::LAYOUT.size, Replayed::LAYOUT.align), (32, 16));
    let mut end = 0;
    for field in PathTurn::LAYOUT.fields {
        assert_eq!(field.offset, end, "{}", field.name);
        end += field.size;
    }
    assert_eq!(end, PathTurn::LAYOUT.size);
}

#[test]
fn what_is_not_done_is_not_there() {
    let bare = PathTurn { kind: RAY_SEGMENT, triangle: NO_HIT, found_pdf: 3.0, bounce: 2, ..PathTurn::default() };
    let shadow = PathTurn { kind: RAY_SHADOW, bounce: 3, added: Vec3::X, ..bare };
    let [segment, shadow] = turns_of(&[bare, shadow]).try_into().unwrap();
    assert_eq!((segment.met, segment.surface, segment.light, segment.drawn), (None, None, None, None));
    assert_eq!(segment.found_pdf, 0.0, "nothing was weighted by it");
    assert_eq!((shadow.kind, shadow.bounce, shadow.is_seen()), (RayKind::Shadow, 2, true));

    let done = TURN_SURFACE | TURN_LIGHT | TURN_DRAWN | TURN_GOES_ON;
    let whole = PathTurn {
        triangle: 7,
        done,
        light_triangle: 3,
        choices: Vec2::splat(0.5),
        drawn_u: Vec2::new(0.25, 0.75),
        drawn_weight: Vec3::ONE,
        drawn_pdf: 2.0,
        ..bare
    };
    let turn = turns_of(&[whole]).remove(0);
    assert_eq!((turn.met.unwrap().triangle, turn.light.unwrap().triangle), (7, Some(3)));
    let drawn = turn.drawn.unwrap();
    assert!(drawn.goes_on && drawn.pdf == 2.0 && drawn.u.y == 0.75 && turn.surface.is_some());
    // A density of nothing is none.
    let nothing = PathTurn { drawn_weight: Vec3::ZERO, ..whole };
    assert_eq!(turns_of(&[nothing])[0].drawn.unwrap().pdf, 0.0);
}
