//! How fast frames follow each other, and how large the film is.

use std::time::{Duration, Instant};

use glam::UVec2;
use lucerna::app::window::pace::{self, Pace};

const WINDOW: UVec2 = UVec2::new(800, 600);

#[test]
fn a_picture_moves_until_it_was_left_alone_for_a_while() {
    let mut pace = Pace::new(u64::MAX);
    let now = Instant::now();
    assert!(!pace.moves(now));
    pace.moved(now);
    assert!(pace.moves(now) && pace.moves(now + pace::SETTLED / 2) && !pace.moves(now + pace::SETTLED));
}

#[test]
fn a_film_that_the_device_has_no_room_for_is_smaller() {
    assert_eq!(Pace::new(480_000).film_size(WINDOW), WINDOW);
    assert_eq!(Pace::new(479_999).film_size(WINDOW), UVec2::new(400, 300));
    assert_eq!(Pace::new(0).film_size(WINDOW), WINDOW);
}

#[test]
fn tracing_has_the_larger_part_of_a_frame() {
    assert_eq!(pace::still_step(Duration::ZERO), pace::STEP);
    assert_eq!(pace::still_step(Duration::from_millis(10)), Duration::from_millis(20));
    assert_eq!(pace::still_step(Duration::from_secs(1)), Duration::from_millis(100));
}
