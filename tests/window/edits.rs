//! A person who edits shaders and the scene while the window is open, and looks at it after every save.

use std::path::Path;

use super::person::Person;
use super::xvfb::{Screenshot, await_some};

const SHADER: &str = "shaders/lib/bsdf/lambert.wgsl";
const LOWER_J: u32 = 0x6a;
const LOWER_V: u32 = 0x76;
const ESCAPE: u32 = 0xff1b;

fn replace(file: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{} has no `{from}`", file.display());
    std::fs::write(file, text.replace(from, to)).unwrap();
}

/// Mean code of the picture's lower half, where nothing is written over it while nothing is wrong.
fn brightness(look: &Screenshot) -> f64 {
    let below = &look.pixels[look.pixels.len() / 2..];
    below.iter().flatten().map(|code| f64::from(*code)).sum::<f64>() / (3 * below.len()) as f64
}

/// How much of the window has the colour in which problems are written; little in the picture has it.
fn letters(look: &Screenshot) -> usize {
    look.pixels.iter().filter(|[r, g, b]| *r > 240 && (195..=212).contains(g) && (185..=202).contains(b)).count()
}

#[test]
fn a_person_edits_and_sees() {
    let mut person = Person::with_files();
    let file = |name: &str| person.folder.path().join(name);
    person.finish();
    let first = person.see("the picture", |look| brightness(look) > 20.0);

    // A right edit: all diffuse surfaces twice as bright where a light is asked.
    replace(&file(SHADER), "return kd * (INV_PI * cos_theta);", "return kd * (2.0 * INV_PI * cos_theta);");
    person.see("the brighter picture", |look| brightness(look) > 1.1 * brightness(&first));
    let bright = person.rendered_scene("scene.ron", "192x144");
    person.see("all its samples, once the notices are gone", |look| *look == bright);

    let calm = letters(&bright);
    let stderr = || std::fs::read_to_string(file("stderr")).unwrap();

    // A wrong one: the picture stays, and the message lies over it.
    replace(&file(SHADER), "2.0 * INV_PI", "2.0 * INV_PIE");
    let broken = person.see("the message", |look| letters(look) > calm + 100);
    // The rows above the message.
    assert!(broken.pixels[..4 * 192] == bright.pixels[..4 * 192], "the picture went with the mistake");
    let place = format!("{SHADER}:7:24: error: no definition in scope for identifier: `INV_PIE`");
    assert_eq!(stderr().matches(&place).count(), 1, "{}", stderr());

    // Mended.
    replace(&file(SHADER), "2.0 * INV_PIE", "2.0 * INV_PI");
    person.see("the picture without a message", |look| {
        letters(look) < calm + 50 && brightness(look) > 1.1 * brightness(&first)
    });

    // The scene, wrongly and rightly.
    replace(&file("scene.ron"), "fov_y: 60", "fov_y: 6o");
    person.see("the scene's message", |look| letters(look) > calm + 100);
    replace(&file("scene.ron"), "fov_y: 6o", "fov_y: 30");
    let near = person.see("the nearer view", |look| letters(look) < calm + 50 && look.difference(&bright) > 10.0);

    // Back to the first shader: the picture is that of the scene as it is now, without a window, to the bit.
    replace(&file(SHADER), "2.0 * INV_PI", "INV_PI");
    person.see("the darker picture", |look| brightness(look) < 0.95 * brightness(&near));
    person.finish();
    let headless = person.rendered_scene("scene.ron", "192x144");
    person.see("the headless render, once the notices are gone", |look| *look == headless);

    // What the last edit did: darker, in all the picture.
    person.display.key(LOWER_J);
    person.see("the verdict", |_| stderr().contains("means differ"));
    assert!(stderr().contains("the new one is darker"), "{}", stderr());
    person.display.key(LOWER_V);
    let half = |look: &Screenshot, right: bool| {
        let inside = |i: &usize| (i % 192 >= 96) == right && i / 192 > 40;
        let codes = (0..look.pixels.len()).filter(inside).map(|i| f64::from(look.pixels[i][1]));
        codes.sum::<f64>()
    };
    person.see("before beside after", |look| half(look, false) > 1.05 * half(look, true));

    person.display.key(ESCAPE);
    let status = await_some(person.process.id(), "the end", || person.process.try_wait().unwrap());
    assert_eq!(status.code(), Some(0), "{}", stderr());
}
