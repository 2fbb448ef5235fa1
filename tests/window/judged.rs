//! A person who leaves the judge to itself: edits that are right and wrong get their verdicts, and the first one is gone back to.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use serde_json::Value;

use super::person::Person;
use super::xvfb::{Screenshot, await_some};

const F2: u32 = 0xffbf;
const SURFACE: &str = "shaders/lib/bsdf/mixture.wgsl";
const WEIGHT: &str = "vec3<f32>(0.0), m.kd, at.pdf";

/// What the record on the disk says, the newest first.
fn record(folder: &Path) -> Vec<Value> {
    let run =
        Command::new(env!("CARGO_BIN_EXE_lucerna")).args(["edits", "--json"]).current_dir(folder).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice::<Vec<Value>>(&run.stdout).unwrap()
}

fn state(edit: &Value) -> &str {
    edit["verdict"]["state"].as_str().unwrap()
}

/// Waits until the newest edits have these states.
fn await_states(person: &Person, states: &[&str]) -> Vec<Value> {
    await_some(person.process.id(), &format!("the verdicts {states:?}"), || {
        std::thread::sleep(Duration::from_millis(300));
        let edits = record(person.folder.path());
        let found: Vec<&str> = edits.iter().take(states.len()).map(state).collect();
        (found == states).then_some(edits)
    })
}

fn replace(person: &Person, file: &str, from: &str, to: &str) {
    let file = person.folder.path().join(file);
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains(from), "{} has no `{from}`", file.display());
    std::fs::write(file, text.replace(from, to)).unwrap();
}

/// Mean code of the part of the window that the panel leaves.
fn brightness(look: &Screenshot) -> f64 {
    let rows = look.pixels.chunks(look.width as usize);
    let left: Vec<u8> = rows.flat_map(|row| row[..WIDTH].as_flattened()).copied().collect();
    left.iter().map(|code| f64::from(*code)).sum::<f64>() / left.len() as f64
}

/// Of the window that shows the picture alone.
const WIDTH: usize = 300;

/// Half of what is reflected makes the part of the window darker that is not the sky, at least by this.
const DARKER: f64 = 0.95;

/// Both shaders are compiled by then, on a machine that is not too busy.
const COMPILED: Duration = Duration::from_secs(5);

#[test]
fn edits_are_judged_while_nobody_needs_the_device() {
    let mut person = Person::judging("700x300");
    let title = || person.display.title(person.window);
    await_some(person.process.id(), "some samples", || title().contains(" spp").then_some(()));
    let alone = person.see("a picture", |look| brightness(look) > 60.0);
    person.display.key(F2);

    let moves = |key: char, from: &Screenshot| {
        person.display.key(u32::from(key));
        person.see("another view", |look| look.difference(from) > 3.0);
    };
    // The picture is narrower from then on.
    person.see("the panel", |look| look.difference(&alone) > 3.0);
    moves('f', &person.look());
    moves('1', &person.look());
    let spp = || title().split_once(": ").and_then(|(_, rest)| rest.split(' ').next()?.parse::<u32>().ok());
    // The title follows within a second.
    std::thread::sleep(Duration::from_secs(1));
    await_some(person.process.id(), "a fine picture", || (spp()? > 8).then_some(()));
    let first = person.look();

    // Right: the same number by another way. Kernels are compiled for it first, which no hand can interrupt on this device.
    replace(&person, SURFACE, WEIGHT, "vec3<f32>(0.0), 0.5 * (m.kd + m.kd), at.pdf");
    let judges = || title().contains("rests while").then_some(());
    await_some(person.process.id(), "judging", judges);
    std::thread::sleep(COMPILED);
    // A hand that moves the camera has the device before the verdict, and films go on later.
    moves('f', &person.look());
    await_some(person.process.id(), "the film", || judges().is_none().then_some(()));
    await_some(person.process.id(), "judging that goes on", judges);
    let agreed = await_states(&person, &["agree", "none"]);
    assert!(agreed[0]["verdict"]["short"].as_str().unwrap().starts_with("agrees within "), "{agreed:?}");
    assert!(agreed[0]["pixels"].as_f64().unwrap() > 0.0 && agreed[0]["lint"] == "clean", "{agreed:?}");
    moves('1', &person.look());

    // Wrong: half of what is reflected.
    replace(&person, SURFACE, "0.5 * (m.kd + m.kd)", "0.5 * m.kd");
    person.see("the darker picture", |look| brightness(look) < DARKER * brightness(&first));
    let judged = await_states(&person, &["differ", "agree", "none"]);
    assert!(judged[0]["verdict"]["short"].as_str().unwrap().starts_with("DIFFERS by "), "{judged:?}");
    assert!(judged[0]["lint"]["warned"][0].as_str().unwrap().contains("mixture_sample"), "{judged:?}");
    assert_eq!(judged[0]["before"], judged[1]["number"], "{judged:?}");

    // A click on the first row, which is the last of the list.
    let stderr = || std::fs::read_to_string(person.folder.path().join("stderr")).unwrap();
    for y in (60..190).rev().step_by(8) {
        if stderr().contains("what the window opened with runs again") {
            break;
        }
        person.display.point(560, y);
        person.display.button(1, true);
        person.display.button(1, false);
        std::thread::sleep(Duration::from_millis(400));
    }
    person.see("the first picture again", |look| brightness(look) > 0.99 * brightness(&first));
    assert!(
        std::fs::read_to_string(person.folder.path().join(SURFACE)).unwrap().contains("0.5 * m.kd"),
        "no file is written"
    );

    // A save goes on from the files.
    replace(&person, SURFACE, "0.5 * m.kd", "0.25 * m.kd");
    person.see("what the files say", |look| brightness(look) < DARKER * brightness(&first));
    assert!(stderr().contains("from the files as they are; before it ran what the window opened with"), "{}", stderr());
    person.quit();
    let last = record(person.folder.path());
    assert_eq!((&last[0]["before"], last.len()), (&last[3]["number"], 4), "{last:?}");
}
