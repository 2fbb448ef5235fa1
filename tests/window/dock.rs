//! What the window gives to the picture, and what to the panel; and a person who opens and closes that.

use glam::UVec2;
use lucerna::app::window::dock::{Opened, WIDTH, opened, picture_area, widths};

#[cfg(target_os = "linux")]
use super::person::Person;
#[cfg(target_os = "linux")]
use super::xvfb::Screenshot;

#[test]
fn the_panel_takes_its_width_and_leaves_the_rest() {
    let window = UVec2::new(1324, 768);
    assert_eq!(picture_area(window, None, 1.0), window);
    assert_eq!(picture_area(window, Some(WIDTH), 1.0), UVec2::new(1024, 768));
    // Points are pixels twice as many.
    assert_eq!(picture_area(2 * window, Some(WIDTH), 2.0), UVec2::new(2048, 1536));
}

#[test]
fn a_small_window_keeps_some_of_the_picture() {
    for width in [1, 2, 64, 192, 320, 800, 4000] {
        let [least, most] = widths(width as f32);
        assert!(least <= most && most < width as f32, "{width}");
        for wanted in [0.0, WIDTH, 1e6] {
            let area = picture_area(UVec2::new(width, 100), Some(wanted), 1.0);
            assert!(
                area.x >= 1 && f64::from(area.x) >= (0.4 * f64::from(width)).floor(),
                "{wanted} of {width}: {area}"
            );
        }
    }
}

#[test]
fn a_window_opens_with_both_as_far_as_the_screen_has_room() {
    let film = UVec2::new(1024, 768);
    let beside = f64::from(WIDTH);
    assert_eq!(opened(film, None, true), Opened { size: [1024.0 + beside, 768.0], panel: true });
    assert_eq!(opened(film, None, false), Opened { size: [1024.0, 768.0], panel: false });
    assert_eq!(opened(film, Some([1920.0, 1080.0]), true), opened(film, None, true));
    // The picture keeps its shape beside a panel of the same width.
    let small = opened(film, Some([1024.0, 768.0]), true);
    assert!(small.panel && small.size[0] <= 1024.0 && small.size[1] <= 768.0, "{small:?}");
    assert!(((small.size[0] - beside) / small.size[1] - 4.0 / 3.0).abs() < 1e-9, "{small:?}");
    // A small film has the size that it is to have.
    for film in [UVec2::new(1, 1), UVec2::new(64, 48), UVec2::new(192, 144), UVec2::new(201, 10)] {
        let Opened { size: [width, height], .. } = opened(film, None, true);
        let window = UVec2::new(width.round() as u32, height.round() as u32);
        assert_eq!(picture_area(window, Some(WIDTH), 1.0), film, "of {window}");
    }
    // A screen that has no room for both shows the picture.
    assert_eq!(opened(film, Some([480.0, 640.0]), true), Opened { size: [480.0, 360.0], panel: false });
}

/// The picture's part of a window with a panel.
#[cfg(target_os = "linux")]
fn picture(look: &Screenshot) -> Screenshot {
    let width = 192.min(look.width);
    let pixels = look.pixels.chunks(look.width as usize).flat_map(|row| &row[..width as usize]).copied().collect();
    Screenshot { width, height: look.height, pixels }
}

/// It opens with the panel beside a picture of the film's size, which is the one without a window; a hand in the panel moves no camera.
#[cfg(target_os = "linux")]
#[test]
fn the_panel_covers_nothing_of_the_picture() {
    const F2: u32 = 0xffbf;
    let mut person = Person::with_panel("192x144");
    person.finish();
    let headless = person.rendered("192x144", &[]);
    person.see("the whole picture beside the panel", |look| look.width == 480 && picture(look) == headless);
    person.display.point(400, 8);
    person.display.button(1, true);
    for x in [380, 360, 340] {
        person.display.point(x, 40);
    }
    person.display.button(1, false);
    std::thread::sleep(std::time::Duration::from_millis(500));
    person.finish();
    person.see("the same picture after a drag in the panel", |look| picture(look) == headless);
    person.display.key(F2);
    let wide = person.rendered("480x144", &[]);
    person.see("a picture as wide as the window", |look| *look == wide);
    person.display.key(F2);
    person.see("the picture beside the panel again", |look| picture(look) == headless);
    person.quit();
}
