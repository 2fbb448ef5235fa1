//! `lucerna check` of folders of shaders.

use std::path::Path;

use super::lucerna;

/// A copy of the shaders, of which one module is another.
fn shaders(module: &str, change: impl Fn(&str) -> String) -> tempfile::TempDir {
    fn copy(from: &Path, to: &Path) {
        std::fs::create_dir_all(to).unwrap();
        for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
            let to = to.join(entry.file_name());
            if entry.path().is_dir() {
                copy(&entry.path(), &to)
            } else {
                std::fs::copy(entry.path(), to).map(drop).unwrap()
            }
        }
    }
    let folder = tempfile::tempdir().unwrap();
    copy(Path::new("shaders"), &folder.path().join("s"));
    let path = folder.path().join("s").join(module);
    let text = std::fs::read_to_string(&path).unwrap();
    let changed = change(&text);
    assert_ne!(text, changed, "{module} has no such place");
    std::fs::write(path, changed).unwrap();
    folder
}

fn check(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = lucerna(folder, &[&["check"], arguments].concat());
    (run.status.code(), String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap())
}

/// A mistake under a feature that the shipped scenes hardly need is one all the same, and is told once.
#[test]
fn a_broken_folder_is_refused() {
    let folder = shaders("lib/bsdf/coat.wgsl", |text| format!("{text}\nfn broken() -> f32 {{ return true; }}\n"));
    for arguments in [&["s"] as &[&str], &["--shaders", "s"]] {
        let (code, out, said) = check(folder.path(), arguments);
        assert_eq!(code, Some(1), "{arguments:?}: {out}{said}");
        assert!(said.contains("s/lib/bsdf/coat.wgsl:") && said.matches("error:").count() == 1, "{said}");
        assert!(out.contains("1 error"), "{out}");
    }
}

/// What no pass imports is held to the grammar too.
#[test]
fn modules_that_no_pass_imports_are_checked() {
    let folder = shaders("window/picture.wgsl", |text| text.replacen("fn ", "fnn ", 1));
    let (code, out, said) = check(folder.path(), &["s"]);
    assert!(code == Some(1) && said.contains("s/window/picture.wgsl:"), "{out}{said}");
}

/// A folder may hold what it changes alone, as those of families do.
#[test]
fn some_modules_alone_are_checked_in_the_place_of_others() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("s/lib")).unwrap();
    let path = folder.path().join("s/lib/sampling.wgsl");
    let text = std::fs::read_to_string("shaders/lib/sampling.wgsl").unwrap();
    std::fs::write(&path, format!("{text}\n// a word\n")).unwrap();
    let (code, out, said) = check(folder.path(), &["s"]);
    assert!(code == Some(0) && out.contains("passes in") && out.contains("0 errors, 0 warnings"), "{out}{said}");
    std::fs::write(&path, text.replacen("fn ", "fnn ", 1)).unwrap();
    assert_eq!(check(folder.path(), &["s"]).0, Some(1));
    // By itself, it is no whole library.
    assert_eq!(check(folder.path(), &["--shaders", "s"]).0, Some(1));
}

/// Surfaces whose sampling and evaluation part ways are found, though all links; those that changed both alike are not.
#[test]
fn surfaces_are_linted_where_they_are_other_code() {
    let lambert = |text: &str| text.replace("return INV_PI * cos_theta;", "return 0.5 * INV_PI;");
    let folder = shaders("lib/bsdf/lambert.wgsl", lambert);
    let (code, out, said) = check(folder.path(), &["s"]);
    assert!(code == Some(0) && said.contains("lib/bsdf/lambert.wgsl: ") && said.contains("warning:"), "{out}{said}");
    let path = folder.path().join("s/lib/sampling.wgsl");
    let text = std::fs::read_to_string(&path).unwrap();
    let uniform = text.replace("return Angle(sqrt(1.0 - u), sqrt(u));", "return Angle(1.0 - u, sqrt(u * (2.0 - u)));");
    assert_ne!(uniform, text);
    std::fs::write(&path, uniform).unwrap();
    let (code, out, said) = check(folder.path(), &["s"]);
    assert!(code == Some(0) && out.contains("sampling and evaluation of surfaces agree"), "{out}{said}");
    assert!(out.contains("0 errors, 0 warnings"), "{out}{said}");
}
