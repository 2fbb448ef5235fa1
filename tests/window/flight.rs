//! Flying, whatever the frame rate.

use std::time::Duration;

use glam::DVec3;
use lucerna::app::window::flight::Flight;

/// A second of flying ahead and half a second of coming to rest, in so many frames a second.
fn journey(frames: u32) -> DVec3 {
    let mut flight = Flight::default();
    let frame = Duration::from_secs(1) / frames;
    let ahead = (0..frames).map(|_| flight.advance(DVec3::Z, frame)).sum::<DVec3>();
    ahead + (0..frames / 2).map(|_| flight.advance(DVec3::ZERO, frame)).sum::<DVec3>()
}

#[test]
fn the_way_does_not_depend_on_the_frame_rate() {
    let exact = journey(1000);
    // What starts slowly ends slowly: a second of full speed in all.
    assert!((exact.z - 1.0).abs() < 0.005, "{exact}");
    for frames in [10, 24, 60, 144] {
        let way = journey(frames);
        // A frame in which a flight ends leaves out a hundredth of full speed for 0.08 s at most.
        assert!(way.distance(exact) < 1e-3, "{frames} frames a second: {way} instead of {exact}");
    }
}

#[test]
fn a_flight_ends() {
    let mut flight = Flight::default();
    assert!(!flight.is_under_way());
    flight.advance(DVec3::X, Duration::from_millis(100));
    assert!(flight.is_under_way());
    for _ in 0..60 {
        flight.advance(DVec3::ZERO, Duration::from_millis(16));
    }
    assert!(!flight.is_under_way());
    assert_eq!(flight.advance(DVec3::ZERO, Duration::from_secs(1)), DVec3::ZERO);
}

#[test]
fn two_keys_are_no_faster_than_one() {
    let mut flight = Flight::default();
    let way = flight.advance(DVec3::new(1.0, 1.0, 1.0), Duration::from_secs(10));
    assert!(way.length() <= 10.0);
}
