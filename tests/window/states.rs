//! What is on the screen while the scene goes from one state to another: whole pictures of one of the two, coarse at first.

use std::time::{Duration, Instant};

use glam::UVec2;
use lucerna::passes::lattice::{COARSEST, corners};

use super::person::{Person, TICKS};
use super::xvfb::{Screenshot, await_some};
use crate::support;

const F12: u32 = 0xffc9;
const TAB: u32 = 0xff09;
const SPACE: u32 = 0x20;
const LOWER_B: u32 = 0x62;
const LOWER_F: u32 = 0x66;
const LOWER_H: u32 = 0x68;
const ONE: u32 = 0x31;

/// A picture of which only the corners of a level are there.
fn spread(whole: &Screenshot, level: u32) -> Screenshot {
    let shift = corners(level).shift;
    let corner = |i: u32| (UVec2::new(i % whole.width, i / whole.width) >> shift) << shift;
    let pixels =
        (0..whole.pixels.len() as u32).map(corner).map(|at| whole.pixels[(at.y * whole.width + at.x) as usize]);
    Screenshot { pixels: pixels.collect(), ..*whole }
}

/// Looks until the window has nothing left to do: its title is no sign, which follows later. Returns all that was seen, without
/// repetitions; the last is the finished picture.
fn watch(person: &Person) -> Vec<Screenshot> {
    let mut seen = vec![person.look()];
    let (mut since, mut taken) = (Instant::now(), person.taken());
    loop {
        let look = person.look();
        if seen.last() != Some(&look) {
            seen.push(look);
        }
        if since.elapsed() >= SPAN {
            let now = person.taken();
            if now - taken <= TICKS {
                return seen;
            }
            (since, taken) = (Instant::now(), now);
        }
    }
}

/// The window is at rest if it took next to no processor time for so long.
const SPAN: Duration = Duration::from_millis(1500);

#[test]
fn every_frame_is_of_one_state() {
    let person = Person::sized("560x420", Some("1"));
    let mut before = watch(&person).pop().unwrap();
    let mut levels = Vec::new();
    for key in [LOWER_F, ONE, LOWER_F] {
        person.display.key(key);
        let seen = watch(&person);
        assert!(seen.last() != Some(&before), "the key changed nothing");
        let after = seen.last().unwrap();
        for look in &seen {
            let level = (0..=COARSEST).find(|level| spread(after, *level) == *look);
            match level {
                Some(level) => levels.push(level),
                None if *look == before => {}
                None => {
                    let kept = std::env::temp_dir().join("lucerna-two-states.png");
                    look.write(&kept);
                    panic!("two states in one frame, see {}", kept.display());
                }
            }
        }
        before = seen.into_iter().next_back().unwrap();
    }
    // Otherwise nothing was shown of how it becomes finer.
    assert!(levels.iter().any(|level| *level >= 1), "{levels:?}");
}

#[test]
fn a_film_goes_on_until_it_is_paused() {
    let mut person = Person::sized("64x48", None);
    let title = || person.display.title(person.window);
    // The scene's file says 24.
    let spp = || title().split(": ").nth(1).and_then(|rest| rest.split(' ').next()?.parse::<u32>().ok());
    await_some(person.process.id(), "more samples than the scene's file says", || spp().filter(|spp| *spp > 200));
    assert!(!title().contains(" of "), "{}", title());
    person.display.key(SPACE);
    await_some(person.process.id(), "the pause", || title().contains("paused").then_some(()));
    let paused = spp();
    person.display.key(LOWER_B);
    std::thread::sleep(Duration::from_millis(400));
    assert!(title().contains("paused") && spp() == paused, "a brighter picture is no reason to go on: {}", title());
    person.display.key(SPACE);
    await_some(person.process.id(), "more samples", || spp().filter(|now| Some(*now) > paused));
    // Another film does not rest.
    person.display.key(SPACE);
    await_some(person.process.id(), "the pause", || title().contains("paused").then_some(()));
    person.display.key(LOWER_F);
    await_some(person.process.id(), "another film", || (!title().contains("paused")).then_some(()));
    person.quit();
}

#[test]
fn a_key_without_a_meaning_says_so_and_esc_ends_at_once() {
    let mut person = Person::new(&[]);
    person.finish();
    let headless = person.rendered("192x144", &[]);
    for key in [LOWER_H, TAB] {
        person.see("the picture alone", |look| *look == headless);
        person.display.key(key);
        person.see("a line over the picture", |look| *look != headless);
    }
    person.quit();
    if support::stress() {
        for _ in 0..5 {
            let mut person = Person::new(&[]);
            person.finish();
            let begin = Instant::now();
            person.quit();
            println!("ended {:.0} ms after Esc", begin.elapsed().as_secs_f64() * 1e3);
        }
    }
}

#[test]
fn what_was_saved_can_be_had_again_by_the_line_that_is_said() {
    let mut person = Person::new(&[]);
    person.finish();
    person.display.key(LOWER_F);
    person.display.key(LOWER_B);
    person.finish();
    let shown = || std::fs::read_to_string(person.folder.path().join("stderr")).unwrap();
    person.display.key(F12);
    let line = await_some(person.process.id(), "the command", || {
        shown().lines().find(|line| line.starts_with("lucerna render")).map(str::to_owned)
    });
    assert!(!shown().contains("without what was edited"), "{}", shown());
    let saved = Screenshot::read(&person.folder.path().join("result/cornell-box-1.png"));
    let again = person.folder.path().join("again.png");
    let command = line.replacen("lucerna", env!("CARGO_BIN_EXE_lucerna"), 1) + " --quiet -o again.png";
    let run =
        std::process::Command::new("sh").args(["-c", &command]).current_dir(person.folder.path()).output().unwrap();
    assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
    assert!(Screenshot::read(&again) == saved, "{command} gives another picture");
    person.quit();
}

/// How long after a key, a drag, another size or a save the first whole frame of the new state is there: wanted are 0.2 s on two quiet cores
/// without a graphics card, and 0.5 s after a save, and twice of that is too long. Busy cores say nothing, so it is asked with stress alone.
#[test]
fn time_to_the_first_frame_of_another_state() {
    if !support::stress() {
        return;
    }
    let person = Person::files_at("1024x768");
    person.see("the picture", |look| look.pixels.iter().any(|pixel| *pixel != [0; 3]));
    std::thread::sleep(Duration::from_secs(8));
    let median = |what: &str, wanted: f64, change: &mut dyn FnMut(u32)| {
        let mut times: Vec<f64> = (0..9)
            .map(|turn| {
                let before = person.look();
                let begin = Instant::now();
                change(turn);
                let is_as_before = |look: &Screenshot| {
                    look.is_black() || look.difference(&before.narrowed(look.width.min(before.width))) < 2.0
                };
                while is_as_before(&person.look()) {}
                let time = begin.elapsed().as_secs_f64();
                std::thread::sleep(Duration::from_millis(1500));
                time
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("{what}: median {:.0} ms, {:.0} to {:.0}", times[4] * 1e3, times[0] * 1e3, times[8] * 1e3);
        assert!(times[4] < 2.0 * wanted, "{what}: {times:?}");
    };
    median("key", 0.2, &mut |turn| person.display.key(if turn % 2 == 0 { LOWER_F } else { ONE }));
    person.display.point(300, 300);
    person.display.button(1, true);
    median("drag", 0.2, &mut |turn| person.display.point(300 + 25 * (turn as i16 + 1), 300));
    person.display.button(1, false);
    median("size", 0.2, &mut |turn| person.display.resize(person.window, 1024 - 10 * (turn + 1), 768));
    let file = person.folder.path().join("scene.ron");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("fov_y: 60"));
    median("save of the scene", 0.5, &mut |turn| {
        std::fs::write(&file, text.replace("fov_y: 60", &format!("fov_y: {}", 50 - 3 * (turn % 2)))).unwrap();
    });
}
