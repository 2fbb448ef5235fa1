//! Every way in which editors and tools save: caught, and one reload each.

use std::fs;
use std::io::Write;
use std::time::Duration;

use super::{Bench, MTL, SETTLED, save_quickly};
use crate::support::patience::Patience;

const FILE: &str = "shaders/passes/display/display.wgsl";

#[test]
fn each_way_of_saving_is_one_reload() {
    let mut bench = Bench::new();
    let original = bench.read(FILE);
    let path = bench.path(FILE);
    let beside = |name: &str| path.with_file_name(name);
    let text = |n: usize, tried: usize| original.replace("srgb8(linear)", &format!("srgb8(linear * {n}.{tried}5)"));
    type Save<'a> = Box<dyn Fn(&str) + 'a>;
    let ways: Vec<(&str, Save)> = vec![
        ("VS Code: truncate and write", Box::new(|text| fs::write(&path, text).unwrap())),
        (
            "vim: the old file becomes a backup, a new one is written, the backup deleted",
            Box::new(|text| {
                fs::write(beside("4913"), "").unwrap();
                fs::remove_file(beside("4913")).unwrap();
                fs::rename(&path, beside("display.wgsl~")).unwrap();
                fs::write(&path, text).unwrap();
                fs::remove_file(beside("display.wgsl~")).unwrap();
            }),
        ),
        (
            "sed -i: another file is written and renamed over it",
            Box::new(|text| {
                fs::write(beside("sedAb12Cd"), text).unwrap();
                fs::rename(beside("sedAb12Cd"), &path).unwrap();
            }),
        ),
        (
            "git: the file is deleted and written",
            Box::new(|text| {
                fs::remove_file(&path).unwrap();
                fs::write(&path, text).unwrap();
            }),
        ),
        (
            "two steps: truncated, and written after a while",
            Box::new(|text| {
                fs::write(&path, "").unwrap();
                std::thread::sleep(Duration::from_millis(150));
                fs::write(&path, text).unwrap();
            }),
        ),
        (
            "deleted, and made again after a while",
            Box::new(|text| {
                fs::remove_file(&path).unwrap();
                std::thread::sleep(Duration::from_millis(150));
                fs::write(&path, text).unwrap();
            }),
        ),
        (
            "in pieces",
            Box::new(|text| {
                let mut file = fs::File::create(&path).unwrap();
                for piece in text.as_bytes().chunks(200) {
                    file.write_all(piece).unwrap();
                    file.flush().unwrap();
                    std::thread::sleep(Duration::from_millis(1));
                }
            }),
        ),
    ];
    for (n, (way, save)) in ways.iter().enumerate() {
        save_quickly(&mut bench, |tried| save(&text(n, tried)));
        assert_eq!(bench.reloaded(), "picture", "{way}");
        assert_eq!(bench.count_for(SETTLED), (0, 0), "{way}: told twice");
    }
    // Saved without a change: nothing to do.
    fs::write(&path, fs::read(&path).unwrap()).unwrap();
    assert_eq!(bench.count_for(SETTLED), (0, 0), "the same text again");
    drop(ways);
}

#[test]
fn a_burst_of_files_is_one_reload() {
    let mut bench = Bench::new();
    // As a checkout does it: every shader, and the scene's files too.
    let (shaders, library) = (bench.path("shaders"), bench.path("room.mtl"));
    save_quickly(&mut bench, |tried| {
        let mut written = 0;
        let mut folders = vec![shaders.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let text = format!("{}\n// another branch\n", fs::read_to_string(&path).unwrap());
                fs::remove_file(&path).unwrap();
                fs::write(&path, text).unwrap();
                written += 1;
            }
        }
        fs::write(&library, MTL.replace("Kd 0.5 0.5 0.5", &format!("Kd 0.6 0.5 0.5{tried}"))).unwrap();
        assert!(written > 40, "{written} files are no burst");
    });
    assert_eq!(bench.reloaded(), "film");
    assert_eq!(bench.count_for(SETTLED), (0, 0));
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}

#[test]
fn files_come_and_go() {
    let mut bench = Bench::new();
    // A module that is not there yet: refused, and taken once it is.
    let import = "import package::lib::math::{largest_of};";
    bench.replace(
        "shaders/passes/trace/path.wgsl",
        import,
        &format!("{import}\nimport package::lib::added::{{twice}};"),
    );
    let (file, .., message) = bench.failed();
    assert_eq!(file, "shaders/passes/trace/path.wgsl");
    assert!(message.contains("lib/added"), "{message}");
    bench.write("shaders/lib/added.wgsl", "fn twice(x: f32) -> f32 {\n    return 2.0 * x;\n}\n");
    bench.reloaded();
    // It is watched from then on.
    bench.write("shaders/lib/added.wgsl", "fn twice(x: f32) -> f32 {\n    return 2.0 * ;\n}\n");
    let (file, line, ..) = bench.failed();
    assert_eq!((file.as_str(), line), ("shaders/lib/added.wgsl", 2));
    // Taken away for good, it is missed where it is imported.
    fs::remove_file(bench.path("shaders/lib/added.wgsl")).unwrap();
    let (file, ..) = bench.failed();
    assert_eq!(file, "shaders/passes/trace/path.wgsl");
    bench.write("shaders/lib/added.wgsl", "fn twice(x: f32) -> f32 {\n    return 2.0 * x;\n}\n");
    bench.reloaded();
    assert!(bench.engine.problems().is_empty());
}

/// As a change of branches does it.
#[test]
fn a_folder_that_goes_and_comes_back_is_watched_again() {
    let mut bench = Bench::new();
    for name in ["shaders/lib", "shaders"] {
        let (folder, aside) = (bench.path(name), bench.path("aside"));
        super::copy(&folder, &aside);
        fs::remove_dir_all(&folder).unwrap();
        bench.failed();
        fs::rename(&aside, &folder).unwrap();
        assert_eq!(bench.reloaded(), "nothing", "{name}");
        assert!(bench.engine.problems().is_empty(), "{name}");
        bench.replace(FILE, "srgb8(", "srgb8(0.9 * ");
        assert_eq!(bench.reloaded(), "picture", "{name}");
    }
}

#[test]
fn what_is_held_is_taken_up_once_it_is_not() {
    let mut bench = Bench::new();
    let before = bench.film();
    bench.engine.hold_saves(true);
    bench.replace("room.mtl", "Kd 0.5 0.5 0.5", "Kd 0.1 0.1 0.1");
    let mut patience = Patience::here();
    while !bench.engine.has_saves() {
        patience.wait("the save");
    }
    bench.finish();
    assert!(bench.events.is_empty() && bench.engine.has_saves() && bench.film().pixels == before.pixels);
    bench.engine.hold_saves(false);
    assert_eq!(bench.reloaded(), "film");
    assert!(bench.film().pixels == bench.fresh_film().pixels);
}
