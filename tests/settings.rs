//! The table of settings: scene files, flags and defaults have all of it.

use std::collections::BTreeSet;

use lucerna::components::{Film, Render};
use lucerna::scene::settings::{Group, SETTINGS, Setting, Settings, Value};
use lucerna::scene::{Define, load};

/// A value that is not the default, as a scene file has it, and as a flag.
fn other(setting: &Setting) -> (String, String) {
    let pair = |text: &str| (text.to_owned(), text.to_owned());
    match setting.value {
        Value::Whole { .. } => pair("7"),
        Value::Stops { .. } => pair("1.5"),
        Value::Switch(_) => ("false".to_owned(), "off".to_owned()),
        Value::Choice(at) => {
            let words = at(&mut Settings::default()).words();
            let word = words.iter().find(|word| word.value != at(&mut Settings::default()).index()).expect("another");
            (word.variant.to_owned(), word.name.to_owned())
        }
        Value::Size(_) => ("(32, 24)".to_owned(), "32x24".to_owned()),
        Value::Crop(_) => ("(1, 9, 2, 8)".to_owned(), "1,9,2,8".to_owned()),
    }
}

#[test]
fn a_scene_file_reaches_every_setting_and_no_other() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = folder.path().join("s.ron");
    std::fs::write(&scene, "(film: (), render: ())").expect("a file");
    for setting in SETTINGS {
        let (variant, text) = other(setting);
        let group = if setting.group == Group::Film { "film" } else { "render" };
        let defines = [Define::given(format!("{group}.{}", setting.field), &variant)];
        let loaded = load(&scene, &defines).unwrap_or_else(|errors| panic!("{errors}")).description;
        let read = Settings { film: loaded.film, render: loaded.render };
        assert_ne!(read, Settings::default(), "{}", setting.field);
        let shown = if setting.flag.is_some() { text } else { variant };
        assert_eq!(setting.text(&read), shown, "{}", setting.field);
        let mut copied = Settings { film: Film::default(), render: Render::default() };
        setting.copy(&read, &mut copied);
        assert_eq!(copied, read, "{}", setting.field);
    }
}

#[test]
fn every_setting_is_told_apart_and_every_flag_is_one_of_render() {
    let fields: BTreeSet<&str> = SETTINGS.iter().map(|setting| setting.field).collect();
    assert_eq!(fields.len(), SETTINGS.len());
    let lines: BTreeSet<u8> = SETTINGS.iter().filter_map(|setting| Some(setting.panel?.line)).collect();
    assert_eq!(lines.len(), SETTINGS.iter().filter(|setting| setting.panel.is_some()).count());
    let lucerna = std::process::Command::new(env!("CARGO_BIN_EXE_lucerna")).args(["render", "-h"]).output();
    let help = String::from_utf8(lucerna.expect("a help text").stdout).expect("text");
    for flag in SETTINGS.iter().filter_map(|setting| setting.flag) {
        let line = format!("--{} <{}>", flag.name, flag.value);
        assert!(help.lines().any(|found| found.contains(&line) && found.contains(flag.help)), "{line}");
    }
}
