//! Which module may know which: the arrows of ARCHITECTURE.md.

use std::fs;
use std::path::{Path, PathBuf};

/// Every Rust file below a folder, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// The code of a file, without line comments.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// Whether code names a path that starts with a crate or module: `wgpu::`, `use wgpu;`.
fn names(code: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).any(|(start, _)| {
        let (before, after) = (&code[..start], code[start + word.len()..].trim_start());
        !before.ends_with(is_part) && (after.starts_with("::") || after.starts_with(';') || after.starts_with(" as "))
    })
}

/// The files of src/ outside some modules.
fn outside(modules: &[&str]) -> Vec<PathBuf> {
    let inside = |path: &PathBuf| modules.iter().any(|module| path.starts_with(format!("src/{module}")));
    sources(Path::new("src")).into_iter().filter(|path| !inside(path)).collect()
}

fn refuse(files: &[PathBuf], word: &str) {
    for path in files {
        assert!(!names(&code(path), word), "{} may not name {word}", path.display());
    }
}

#[test]
fn the_search_finds_what_it_looks_for() {
    assert!(
        names("use wgpu::Device;", "wgpu") && names("fn f() -> wgpu::Device {}", "wgpu") && names("use wgpu;", "wgpu")
    );
    assert!(!names("use my_wgpu::Device; let wgpu = 1;", "wgpu"));
    assert!(sources(Path::new("src")).len() > 10);
}

#[test]
fn wgpu_and_naga_stay_where_they_belong() {
    refuse(&outside(&["gpu"]), "wgpu");
    refuse(&outside(&["gpu", "shader"]), "naga");
}

#[test]
fn modules_know_only_what_is_below_them() {
    let modules = [
        "app",
        "components",
        "cpu",
        "engine",
        "files",
        "gpu",
        "image",
        "layout",
        "oracle",
        "parallel",
        "passes",
        "prepare",
        "process",
        "scene",
        "shader",
        "stats",
        "stress",
        "systems",
        "watch",
    ];
    let below: [(&str, &[&str]); 19] = [
        ("components", &[]),
        ("image", &["components", "files", "parallel"]),
        ("layout", &[]),
        ("files", &[]),
        ("parallel", &[]),
        ("process", &[]),
        ("scene", &["components", "files", "image", "parallel"]),
        ("shader", &["files", "layout"]),
        ("passes", &["cpu", "layout"]),
        ("prepare", &["components", "image", "layout"]),
        ("stats", &[]),
        ("oracle", &["components"]),
        ("cpu", &["image", "layout", "parallel", "stats"]),
        ("gpu", &["files", "layout", "parallel", "shader", "passes"]),
        ("watch", &["components", "cpu", "files", "gpu", "layout", "passes", "scene", "shader"]),
        ("systems", &["components", "cpu", "files", "gpu", "layout", "passes", "prepare", "scene", "shader", "watch"]),
        (
            "engine",
            &["components", "cpu", "gpu", "layout", "parallel", "passes", "scene", "shader", "systems", "watch"],
        ),
        // What judges goes through every door, and is judged by none: only the command line knows it.
        (
            "stress",
            &[
                "components",
                "cpu",
                "engine",
                "gpu",
                "layout",
                "oracle",
                "parallel",
                "passes",
                "prepare",
                "process",
                "scene",
                "shader",
                "stats",
            ],
        ),
        // All but the phases: those are the engine's.
        (
            "app",
            &[
                "components",
                "cpu",
                "engine",
                "files",
                "gpu",
                "image",
                "layout",
                "oracle",
                "parallel",
                "passes",
                "prepare",
                "process",
                "scene",
                "shader",
                "stats",
                "stress",
                "watch",
            ],
        ),
    ];
    for (module, allowed) in below {
        for path in sources(&Path::new("src").join(module)) {
            let code = code(&path);
            for other in modules.iter().filter(|other| **other != module && !allowed.contains(other)) {
                let named = names(&code, &format!("crate::{other}"));
                assert!(!named, "{} may not name crate::{other}", path.display());
            }
        }
    }
}

#[test]
fn components_are_plain_data() {
    let known = ["bevy_ecs", "glam", "std", "core", "crate", "super", "self"];
    for path in sources(Path::new("src/components")) {
        for line in code(&path).lines() {
            let Some(path_used) = line.trim().strip_prefix("use ").or(line.trim().strip_prefix("pub use ")) else {
                continue;
            };
            let first = path_used.split([':', ';', ' ']).next().unwrap_or("");
            let own = first.starts_with(|c: char| c.is_lowercase())
                && Path::new("src/components").join(format!("{first}.rs")).exists();
            assert!(known.contains(&first) || own, "{} may not use {first}", path.display());
        }
    }
}
