//! A click selects what is seen there: its edges lie where the camera sees them, and a person selects and lets go.

use glam::{DVec2, DVec3, UVec2};
use lucerna::app::window::outline::edges;
use lucerna::components::{Camera, Lens};
use lucerna::cpu::view::through_middle;
use lucerna::layout::trace::TraceParams;
use lucerna::prepare::camera::{aim, crop};

#[cfg(target_os = "linux")]
use super::person::Person;
#[cfg(target_os = "linux")]
use super::xvfb::Screenshot;

const FILM: UVec2 = UVec2::new(320, 200);

fn cameras() -> [Camera; 3] {
    let plain = Camera {
        position: DVec3::new(1.0, 2.0, 5.0),
        look_at: DVec3::new(0.5, -0.3, 0.2),
        up: DVec3::Y,
        fov_y: 50.0,
        ..Camera::default()
    };
    let lens = Lens { shift: DVec2::new(0.3, -0.2), ..plain.lens };
    [plain, Camera { lens, ..plain }, Camera { up: DVec3::Z, fov_y: 100.0, ..plain }]
}

#[test]
fn a_point_lies_where_the_ray_through_it_starts() {
    for camera in cameras() {
        let mut params = TraceParams::default();
        aim(&mut params, &camera, FILM, DVec3::ZERO);
        crop(&mut params, lucerna::components::Crop { min: UVec2::ZERO, max: FILM });
        for pixel in [UVec2::ZERO, UVec2::new(319, 199), UVec2::new(160, 100), UVec2::new(33, 150)] {
            let point = camera.position + 3.0 * through_middle(&params, pixel).as_dvec3();
            let around = DVec3::splat(1e-9);
            let lines = edges(&camera, FILM, point - around, point + around);
            assert_eq!(lines.len(), 12);
            for end in lines.as_flattened() {
                // Rays are f32.
                assert!(end.distance(pixel.as_dvec2() + 0.5) < 1e-2, "{end} for {pixel} by {camera:?}");
            }
        }
    }
}

#[test]
fn what_is_behind_the_camera_is_not_drawn() {
    for camera in cameras() {
        let behind = camera.position + 2.0 * (camera.position - camera.look_at);
        assert_eq!(edges(&camera, FILM, behind - 0.1, behind + 0.1), Vec::<[DVec2; 2]>::new());
        // A box all around has edges that are cut, and none that is no number.
        let around = edges(&camera, FILM, camera.position - 3.0, camera.position + 3.0);
        assert!(!around.is_empty() && around.as_flattened().iter().all(|end| end.is_finite()), "{around:?}");
    }
    assert!(edges(&cameras()[0], FILM, DVec3::INFINITY, DVec3::NEG_INFINITY).is_empty());
}

/// Whether the colour of what is selected is in a part of a window, from the left.
#[cfg(target_os = "linux")]
pub fn marked(look: &Screenshot, columns: std::ops::Range<usize>) -> bool {
    let yellow = |pixel: &[u8; 3]| pixel[0] > 240 && pixel[1].abs_diff(200) < 12 && pixel[2].abs_diff(60) < 24;
    look.pixels.chunks(look.width as usize).any(|row| row[columns.clone()].iter().any(yellow))
}

#[cfg(target_os = "linux")]
pub fn click(person: &Person, x: i16, y: i16) {
    person.display.point(x, y);
    // As long as a hand takes: the button is pressed where the pointer is seen to be.
    std::thread::sleep(std::time::Duration::from_millis(150));
    person.display.button(1, true);
    // A hand is never quite still.
    person.display.point(x + 1, y);
    person.display.button(1, false);
}

#[cfg(target_os = "linux")]
#[test]
fn a_click_selects_and_another_lets_go() {
    let mut person = Person::with_panel("192x144");
    person.finish();
    person.see("the picture beside the panel", |look| look.width == 480 && !marked(look, 0..480));
    // The ball.
    click(&person, 120, 110);
    person.see("the edges of the ball", |look| marked(look, 0..192));
    person.see("the ball and its material in the panel", |look| marked(look, 192..480));
    assert!(person.display.title(person.window).contains("6 of 6 spp"), "a click is no motion");
    click(&person, 120, 110);
    person.see("nothing selected after a second click", |look| !marked(look, 0..480));
    // The box, and then beside the scene.
    click(&person, 85, 80);
    person.see("the edges of the box", |look| marked(look, 0..192));
    click(&person, 4, 70);
    person.see("nothing selected after a click on nothing", |look| !marked(look, 0..480));
    // A drag orbits as ever, and selects nothing.
    let before = person.look();
    person.display.point(100, 70);
    person.display.button(1, true);
    for x in [104, 112, 120] {
        person.display.point(x, 70);
        std::thread::sleep(std::time::Duration::from_millis(30));
    }
    person.display.button(1, false);
    let moved = person.see("another view", |look| look.difference(&before) > 5.0);
    assert!(!marked(&moved, 0..192));
    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}
