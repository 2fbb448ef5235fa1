//! A display of two pixels a point: sizes, pointer and magnifier go by pixels, words and widths by points.

use super::person::Person;
use super::selection::{click, marked};

const CONTROL: u32 = 0xffe3;

#[test]
fn a_fine_display_shows_more_pixels_and_takes_the_pointer_where_it_is() {
    let mut person = Person::on_a_fine_display("96x72");
    person.finish();
    let headless = person.rendered("192x144", &[]);
    // The screen is less than 640 points wide: it has no room for the panel.
    person.see("a picture of twice as many pixels a side", |look| *look == headless);
    click(&person, 120, 110);
    person.see("the edges of the ball", |look| marked(look, 0..192));
    click(&person, 4, 70);
    person.see("nothing selected", |look| !marked(look, 0..192));
    // Larger pixels, about the pointer: that one stays where it is.
    person.see("the picture alone again", |look| *look == headless);
    person.display.point(50, 40);
    // As slow as a hand: a wheel without Control would come closer.
    let pause = || std::thread::sleep(std::time::Duration::from_millis(200));
    pause();
    person.display.hold(CONTROL, true);
    pause();
    person.display.button(4, true);
    person.display.button(4, false);
    pause();
    person.display.hold(CONTROL, false);
    let there = headless.pixels[40 * 192 + 50];
    // Once the notice is gone, which covers most of so small a window.
    person.see("larger pixels", |look| look.pixels[40 * 192 + 50] == there && look.difference(&headless) > 5.0);
    let stderr = person.quit();
    assert!(!stderr.contains("error"), "{stderr}");
}
