//! A person focuses to what they click.

use super::person::{Person, camera_of};
use super::xvfb::await_some;

const CONTROL: u32 = 0xffe3;
const LOWER_C: u32 = 0x63;

#[test]
fn a_click_with_control_focuses_to_what_is_there() {
    let mut person = Person::new(&["-D", "cameras.front.aperture=0.1"]);
    person.finish();
    let near = person.rendered("192x144", &["-D", "cameras.front.aperture=0.1"]);
    person.see("the picture that is sharp at what is looked at", |look| *look == near);

    // High on the wall at the back, 3.5 from the camera along its axis, at the left of the boxes.
    person.display.point(72, 50);
    person.display.hold(CONTROL, true);
    person.display.button(1, true);
    person.display.button(1, false);
    person.display.hold(CONTROL, false);
    person.see("another picture", |look| look.difference(&near) > 0.5);
    person.finish();
    person.display.key(LOWER_C);
    let line = await_some(person.process.id(), "the camera", || person.said().lines().next().map(str::to_owned));
    let camera = camera_of(&line).to_owned();
    let distance = camera.split("focus: Distance(").nth(1).and_then(|rest| rest.split(')').next());
    let distance: f64 = distance.unwrap_or_else(|| panic!("no focus in {camera}")).parse().unwrap();
    assert!((distance - 3.5).abs() < 1e-5, "focused at {distance}");
    // All else is as it was.
    let far = person.rendered("192x144", &["-D", &format!("cameras.front={camera}")]);
    person.see("the picture that is sharp at the wall", |look| *look == far);
    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}
