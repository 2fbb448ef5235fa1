//! How large the film is while the picture moves.

use std::time::{Duration, Instant};

use glam::UVec2;
use lucerna::app::window::pace::{self, Pace, divided, divisor};

const WINDOW: UVec2 = UVec2::new(800, 600);

#[test]
fn a_moving_film_is_halved_until_a_sample_is_quick() {
    let pixels = 480_000.0;
    // Samples a second for a whole sample of 50 ms, and somewhat more and less than that.
    for (seconds, expected) in
        [(0.01, 1), (0.049, 1), (0.051, 2), (0.19, 2), (0.21, 4), (0.79, 4), (0.81, 8), (100.0, 8)]
    {
        assert_eq!(divisor(WINDOW, pixels / seconds), expected, "{seconds} s a sample");
    }
    assert_eq!(divisor(WINDOW, 0.0), 1);
    assert_eq!(divided(UVec2::new(801, 5), 8), UVec2::new(100, 1));
}

#[test]
fn it_is_small_only_while_it_moves() {
    let mut pace = Pace::new(u64::MAX);
    pace.learn(480_000, 0.5);
    let now = Instant::now();
    assert_eq!(pace.film_size(WINDOW), WINDOW);
    assert!(!pace.settle(now));
    pace.moved(now);
    assert_eq!(pace.film_size(WINDOW), UVec2::new(200, 150));
    assert!(!pace.settle(now + pace::SETTLED / 2));
    let still = now + pace::SETTLED;
    assert_eq!(pace.settles_at(), Some(still));
    assert!(pace.settle(still) && !pace.settle(still));
    assert_eq!(pace.film_size(WINDOW), WINDOW);
}

#[test]
fn a_fast_device_moves_the_whole_film() {
    let mut pace = Pace::new(u64::MAX);
    pace.learn(480_000, 0.001);
    pace.moved(Instant::now());
    assert_eq!(pace.film_size(WINDOW), WINDOW);
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
