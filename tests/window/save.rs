//! A person who changes the scene in the window, and has it written into the scene's file.

use std::time::Duration;

use super::files::cornell_box;
use super::person::{Person, camera_of};
use super::xvfb::await_some;

const CONTROL: u32 = 0xffe3;
const F2: u32 = 0xffbf;
const LOWER_B: u32 = 0x62;
const LOWER_C: u32 = 0x63;
const LOWER_S: u32 = 0x73;

/// Presses Ctrl+S, and waits for the words about it.
fn save(person: &Person, words: &str) {
    let before = said(person).matches(words).count();
    person.display.hold(CONTROL, true);
    person.display.key(LOWER_S);
    person.display.hold(CONTROL, false);
    await_some(person.process.id(), words, || (said(person).matches(words).count() > before).then_some(()));
}

fn said(person: &Person) -> String {
    std::fs::read_to_string(person.folder.path().join("stderr")).unwrap()
}

fn drag(person: &Person, from: (i16, i16), steps: i16) {
    let display = &person.display;
    display.point(from.0, from.1);
    display.button(1, true);
    for step in 1..=steps {
        display.point(from.0 + 3 * step, from.1 + step);
        std::thread::sleep(Duration::from_millis(15));
    }
    display.button(1, false);
}

/// A member is no file of its own: where its values are to be edited is said, and nothing is written.
#[test]
fn a_member_of_a_family_is_not_saved_and_that_is_told() {
    let folder = cornell_box();
    let family = "(extends: \"scene.ron\", members: { \"dim\": { \"film.exposure\": -1 } })";
    std::fs::write(folder.path().join("family.ron"), family).unwrap();
    let first = std::fs::read_to_string(folder.path().join("scene.ron")).unwrap();
    let mut person = Person::in_folder(folder, "family.ron", &[]);
    person.finish();
    person.display.key(LOWER_B);
    save(&person, "dim: is a member of family.ron, and what is changed in the window is not saved into that");
    assert!(said(&person).contains("open scene.ron by itself"), "{}", said(&person));
    let read = |name: &str| std::fs::read_to_string(person.folder.path().join(name)).unwrap();
    assert_eq!((read("scene.ron"), read("family.ron")), (first, family.to_owned()));
    person.quit();
}

/// A name says nothing of where its file is: that of a scene that comes with the program would be written over.
#[test]
fn a_scene_that_was_opened_by_its_name_is_not_written_over() {
    let folder = cornell_box();
    let scenes = folder.path().join("assets").join("scenes");
    std::fs::create_dir_all(&scenes).unwrap();
    let file = scenes.join("own.ron");
    let text = std::fs::read_to_string(folder.path().join("scene.ron")).unwrap();
    let text = text.replace("cornell-box.obj", "../../cornell-box.obj");
    std::fs::write(&file, &text).unwrap();
    let mut person = Person::in_folder(folder, "own", &[]);
    person.finish();
    person.display.key(LOWER_B);
    save(&person, "own was opened by its name, and assets/scenes/own.ron is not written over");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    person.quit();
}

#[test]
fn what_was_changed_is_saved_and_the_film_goes_on() {
    let mut person = Person::with_files();
    let file = person.folder.path().join("scene.ron");
    let read = || std::fs::read_to_string(&file).unwrap();
    let first = read();
    person.finish();
    let before = person.look();
    drag(&person, (90, 70), 8);
    person.see("another view", |look| look.difference(&before) > 10.0);
    person.display.key(LOWER_B);
    // The film has another size now than the file says, and is to keep it.
    person.display.resize(person.window, 200, 120);
    person.see("the larger window", |look| look.width == 200);
    person.finish();

    // The line on the clipboard is the one that was printed.
    person.display.key(LOWER_C);
    let line = await_some(person.process.id(), "the camera", || person.said().lines().next().map(str::to_owned));
    let copied = await_some(person.process.id(), "the clipboard", || person.display.clipboard());
    assert_eq!(copied, line);

    save(&person, "scene.ron: 2 values changed (cameras.front, film.exposure)");
    let saved = read();
    let position = camera_of(&line).split_once("), ").unwrap().0.trim_start_matches('(');
    let wanted = first.replace("position: (0, 0, 2.5", position).replace("exposure: 0.5", "exposure: 1");
    assert_eq!(saved, wanted, "all but two values is as it was");

    // Once the notices are gone, the window shows what the file gives without a window, and nothing was traced anew for it.
    let headless = person.rendered_scene("scene.ron", "200x120");
    person.see("the headless render of the saved file", |look| *look == headless);
    assert!(!said(&person).contains("taken up"), "{}", said(&person));

    save(&person, "scene.ron: nothing to save");
    person.display.key(LOWER_B);
    save(&person, "scene.ron: 1 value changed (film.exposure)");
    assert_eq!(read(), saved.replace("exposure: 1", "exposure: 1.5"));

    // With the panel open, which hears keys first.
    let calm = person.look();
    person.display.key(F2);
    person.see("the panel with its button", |look| look.difference(&calm) > 10.0);
    save(&person, "scene.ron: nothing to save");

    // Somebody else's save is taken up, and what was changed here stays.
    std::fs::write(&file, read().replace("max_depth: 16", "max_depth: 3")).unwrap();
    await_some(person.process.id(), "the other save", || said(&person).contains("scene.ron taken up").then_some(()));
    person.display.key(LOWER_B);
    save(&person, "scene.ron: 1 value changed (film.exposure)");
    assert!(read().contains("max_depth: 3") && read().contains("exposure: 2"), "{}", read());
    let stderr = person.quit();
    assert!(!stderr.contains("error") && !stderr.contains("panicked"), "{stderr}");
}
