//! What a session keeps, by itself: where the user is, how the film comes along, and whether there is anything to do.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::DVec3;
use lucerna::app::window::activity::Activity;
use lucerna::app::window::pace;
use lucerna::app::window::tracing::Tracing;
use lucerna::app::window::viewpoint::Viewpoint;
use lucerna::components::Camera;
use lucerna::engine::Progress;

const FRAME: Duration = Duration::from_millis(16);

fn progress(spp: u32) -> Progress {
    Progress { spp, target: 16, samples: 1000, dispatches: 1, finished: spp >= 16 }
}

#[test]
fn a_flight_is_followed_until_it_rests() {
    let camera = Camera { position: DVec3::Z, look_at: DVec3::ZERO, up: DVec3::Y, fov_y: 45.0, ..Camera::default() };
    let mut viewpoint = Viewpoint::new(camera, BTreeMap::new());
    assert!(!viewpoint.moved && !viewpoint.flies(DVec3::ZERO) && viewpoint.flies(DVec3::X));
    viewpoint.fly(DVec3::X, FRAME, 2.0);
    assert!(viewpoint.moved && viewpoint.camera.position.x > 0.0);
    // It flies on for a while with no key held.
    assert!(viewpoint.flies(DVec3::ZERO));
    viewpoint.rest_at(camera);
    assert!(!viewpoint.moved && !viewpoint.flies(DVec3::ZERO) && viewpoint.camera == camera);
}

#[test]
fn a_film_of_fewer_samples_is_another_one() {
    let begin = Instant::now();
    let mut tracing = Tracing::new(1 << 24, begin);
    assert!(!tracing.is_whole());
    tracing.learn(progress(0), begin);
    assert!(!tracing.is_whole());
    tracing.learn(progress(2), begin);
    assert!(tracing.is_whole() && tracing.began == begin);
    let later = begin + FRAME;
    tracing.learn(progress(1), later);
    assert_eq!(tracing.began, later);
}

#[test]
fn a_frame_has_the_more_time_for_tracing_the_slower_a_processor_draws() {
    let now = Instant::now();
    let mut tracing = Tracing::new(1 << 24, now);
    assert_eq!(tracing.budget(true, now), pace::STEP);
    for _ in 0..20 {
        tracing.learn_drawing(Duration::from_millis(40));
    }
    assert!(tracing.budget(true, now) > Duration::from_millis(70));
    assert_eq!(tracing.budget(false, now), pace::STEP);
    tracing.pace.moved(now);
    assert_eq!((tracing.budget(true, now), tracing.budget(false, now)), (pace::MOVING_STEP, pace::STEP));
}

#[test]
fn a_window_starts_once_and_draws_when_the_interface_is_due() {
    let now = Instant::now();
    let mut activity = Activity::new(now);
    assert!(activity.starts() && !activity.starts());
    assert_eq!(activity.begin_frame(now + FRAME), FRAME);
    // A long frame does not make a flight longer.
    assert_eq!(activity.begin_frame(now + Duration::from_secs(9)), Duration::from_millis(100));
    (activity.redraw, activity.ui_again) = (false, Some(now + FRAME));
    activity.expire(now);
    assert!(!activity.redraw && activity.ui_again.is_some());
    activity.expire(now + FRAME);
    assert!(activity.redraw && activity.ui_again.is_none());
}
