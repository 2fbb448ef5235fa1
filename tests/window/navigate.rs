//! Moving a camera: what each motion keeps, and that every camera can be written to a scene file.

use glam::{DVec2, DVec3};
use lucerna::app::window::navigate::{distance, fly, focus, frame, orbit, pan, zoom};
use lucerna::components::{Camera, Focus, Lens};
use lucerna::scene;
use lucerna::scene::edit::camera_line;

/// Cameras of several scenes: level, from above, far away, of another up.
fn cameras() -> Vec<Camera> {
    let camera = |position: [f64; 3], look_at: [f64; 3], up: [f64; 3], fov_y| Camera {
        position: position.into(),
        look_at: look_at.into(),
        up: up.into(),
        fov_y,
        ..Camera::default()
    };
    let lens = Lens { aperture: 0.1, focus: Focus::Distance(1.0 / 3.0), shift: DVec2::new(0.7, -0.2) };
    let at = Lens { focus: Focus::At(DVec3::new(0.1, 0.2, 0.3)), ..lens };
    vec![
        Camera { lens, ..camera([0.0, 1.0, 2.5], [0.0, 0.5, 0.0], [0.0, 1.0, 0.0], 50.0) },
        Camera { lens: at, ..camera([1.0, 2.0, 3.0], [0.1, 0.2, 0.3], [0.0, 1.0, 0.0], 30.0) },
        camera([0.0, 0.0, 2.5], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], 60.0),
        camera([30.0, 12.0, 0.0], [0.0, 2.5, 0.0], [0.0, 1.0, 0.0], 20.0),
        camera([1e6, 2e5, -3e5], [1e6 + 1.0, 2e5 - 3.0, -3e5 + 0.5], [0.0, 2.0, 0.0], 45.0),
        camera([1.0, 2.0, 3.0], [0.1, 0.2, 0.3], [0.0, 0.0, 1.0], 170.0),
        camera([0.0, 5.0, 1e-3], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], 39.3076),
    ]
}

/// Cosine of the angle between view and up.
fn steepness(camera: &Camera) -> f64 {
    (camera.look_at - camera.position).normalize().dot(camera.up.normalize())
}

/// Right of the picture.
fn right(camera: &Camera) -> DVec3 {
    (camera.look_at - camera.position).cross(camera.up).normalize()
}

#[test]
fn an_orbit_keeps_distance_and_target() {
    for camera in cameras() {
        let mut turned = camera;
        for i in 0..200 {
            turned = orbit(turned, DVec2::new(0.37 * f64::from(i % 7), 0.11 * f64::from(i % 5) - 0.2));
            // 200 turns, each within a few roundings of coordinates that may be 1e6.
            let rounding = 1e-13 * (1.0 + camera.look_at.length());
            assert!((distance(&turned) - distance(&camera)).abs() < 200.0 * rounding, "{camera:?} to {turned:?}");
            assert_eq!(turned.look_at, camera.look_at);
        }
    }
}

#[test]
fn an_orbit_never_flips_over_a_pole() {
    for camera in cameras() {
        for way in [1.0, -1.0] {
            let mut turned = camera;
            for _ in 0..100 {
                let next = orbit(turned, DVec2::new(0.0, 0.2 * way));
                assert!(right(&next).dot(right(&turned)) > 0.999, "{turned:?} turned over to {next:?}");
                assert!(steepness(&next).abs() < 1.0 - 1e-8, "{next:?} looks along up");
                turned = next;
            }
            // A hand that goes down lifts the camera, which then looks down.
            assert!(-steepness(&turned) * way > 0.999, "{turned:?}");
        }
    }
}

#[test]
fn the_scene_follows_the_hand() {
    let camera = cameras()[0];
    // The camera looks along -z: to the right is +x. A hand that pulls the scene right moves the camera left.
    assert!(orbit(camera, DVec2::new(0.1, 0.0)).position.x < 0.0);
    let panned = pan(camera, DVec2::new(0.25, 0.25));
    assert!(panned.position.x < 0.0 && panned.position.y > 0.0, "{panned:?}");
}

#[test]
fn a_pan_moves_both_points_across_the_view() {
    for camera in cameras() {
        let panned = pan(camera, DVec2::new(0.3, -0.7));
        let moved = panned.position - camera.position;
        let view = camera.look_at - camera.position;
        let rounding = 1e-9 * (1.0 + camera.position.length());
        assert!((panned.look_at - camera.look_at).distance(moved) < rounding);
        assert!(moved.dot(view.normalize()).abs() < rounding, "{camera:?} moved along its view");
        // So many heights of the picture at the target.
        let height = 2.0 * (camera.fov_y.to_radians() * 0.5).tan() * view.length();
        assert!((moved.length() / height - 0.3f64.hypot(0.7)).abs() < 1e-6);
    }
}

#[test]
fn zooming_never_passes_the_target_and_comes_back() {
    for camera in cameras() {
        let range = [1e-3, 1e3].map(|bound| bound * distance(&camera));
        let mut near = camera;
        for _ in 0..200 {
            near = zoom(near, 0.8, range);
            let ahead = (camera.look_at - near.position).dot(camera.look_at - camera.position);
            assert!(ahead > 0.0 && distance(&near) > 0.999 * range[0], "{near:?}");
        }
        assert!(distance(&near) < 1.001 * range[0]);
        let back = zoom(near, 1000.0, range);
        assert!(back.position.distance(camera.position) < 1e-5 * (1.0 + camera.position.length()), "{back:?}");
        let far = (0..200).fold(camera, |far, _| zoom(far, 1.5, range));
        assert!((distance(&far) / range[1] - 1.0).abs() < 1e-3, "{far:?}");
        // Who is beyond a bound already is not thrown to it.
        assert_eq!(zoom(near, 0.5, range.map(|bound| 10.0 * bound)), zoom(near, 1.0, [0.0, f64::MAX]));
        assert_eq!(zoom(far, 2.0, range.map(|bound| 0.1 * bound)), zoom(far, 1.0, [0.0, f64::MAX]));
    }
}

#[test]
fn flying_keeps_the_view_and_height() {
    for camera in cameras() {
        let flown = fly(camera, DVec3::new(2.0, 0.0, 3.0));
        let rounding = 1e-9 * (1.0 + camera.position.length());
        assert!((flown.look_at - flown.position).distance(camera.look_at - camera.position) < rounding);
        let raised = fly(camera, DVec3::Y);
        assert!((raised.position - camera.position).distance(camera.up.normalize()) < rounding);
    }
}

#[test]
fn a_framed_box_is_all_in_view() {
    let (low, high) = (DVec3::new(-1.0, 2.0, -3.0), DVec3::new(4.0, 5.0, 6.0));
    for camera in cameras() {
        for aspect in [0.3, 1.0, 2.5] {
            let framed = frame(camera, low, high, aspect);
            let forward = (framed.look_at - framed.position).normalize();
            let right = right(&framed);
            let tan = (framed.fov_y.to_radians() * 0.5).tan();
            for corner in 0..8 {
                let at = |axis: usize| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] };
                let p = DVec3::new(at(0), at(1), at(2)) - framed.position;
                let depth = p.dot(forward);
                assert!(depth > 0.0);
                let shift = 2.0 * framed.lens.shift;
                let (x, y) =
                    (p.dot(right) / depth / tan - shift.x, p.dot(right.cross(forward)) / depth / tan - shift.y);
                let x = x / aspect;
                assert!(x.abs() <= 1.0 && y.abs() <= 1.0, "{corner} at {x}, {y} by {framed:?}");
            }
        }
        // An empty scene gives no reason to move.
        assert_eq!(frame(camera, DVec3::INFINITY, DVec3::NEG_INFINITY, 1.0), camera);
        assert_eq!(frame(camera, DVec3::ONE, DVec3::ONE, 1.0), camera);
    }
}

#[test]
fn focusing_changes_the_focus_alone() {
    for camera in cameras() {
        let focused = focus(camera, 0.25);
        assert_eq!(focused.focus_distance(), 0.25);
        assert_eq!(Camera { lens: camera.lens, ..focused }, camera);
        assert!(focus(camera, 0.0).focus_distance() > 0.0 && focus(camera, f64::MAX).focus_distance() <= 1e12);
    }
}

#[test]
fn the_line_of_a_camera_reads_back_exactly() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cameras.ron");
    let mut moved = cameras();
    moved.extend(cameras().iter().map(|camera| orbit(pan(*camera, DVec2::new(0.123, 0.456)), DVec2::new(1.1, 0.3))));
    for camera in moved {
        let line = camera_line("a \"quoted\" one", &camera);
        assert_eq!(line.lines().count(), 1);
        std::fs::write(&path, format!("(cameras: {{ {line} }})")).unwrap();
        let loaded = scene::load(&path, &[]).unwrap_or_else(|error| panic!("{line}: {error}"));
        assert_eq!(loaded.description.cameras["a \"quoted\" one"], camera);
    }
}
