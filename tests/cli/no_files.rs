//! What is no file, given where a file is meant: refused at once, with what it is; or with where its link leads.

use std::os::unix::fs::symlink;
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{MTL, OBJ, SCENE, folder_with};
use crate::files::fifo;

/// Runs the binary, which must end by itself. Its exit code, and what it wrote to stderr.
#[track_caller]
fn ended(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let stderr = folder.join("stderr");
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null());
    let mut child = command.stderr(std::fs::File::create(&stderr).unwrap()).spawn().unwrap();
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return (status.code(), std::fs::read_to_string(stderr).unwrap());
        }
        if begin.elapsed() > Duration::from_secs(60) {
            let _ = child.kill();
            let _ = child.wait();
            panic!("{arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Makes something at a path that is no file.
type Make = fn(&Path);

/// What there is instead of a file, and what is said of it.
const KINDS: [(Make, &[&str]); 6] = [
    (fifo, &["FIFO"]),
    // The socket stays when its listener goes.
    (|path| drop(UnixListener::bind(path).unwrap()), &["socket"]),
    (|path| symlink("/dev/zero", path).unwrap(), &["device"]),
    (|path| symlink(path.file_name().unwrap(), path).unwrap(), &["leads back"]),
    (|path| symlink("gone/away", path).unwrap(), &["gone/away", "link"]),
    (|path| std::fs::create_dir(path).unwrap(), &["folder"]),
];

#[test]
fn what_is_no_file_is_refused_wherever_it_is_named() {
    for (make, words) in KINDS {
        let places: [(&str, &[&str]); 9] = [
            ("s.ron", &["render", "s.ron"]),
            ("s.obj", &["render", "s.obj"]),
            ("s.ron", &["watch", "s.ron"]),
            ("s.ron", &["judge", "s.ron", "--new", "."]),
            ("s.ron", &["bench", "./s.ron"]),
            ("old.json", &["bench", "./a.ron", "--against", "old.json"]),
            ("a.obj", &["render", "a.ron"]),
            ("sky.exr", &["render", "a.ron", "-D", "environment=Map(path: \"sky.exr\")"]),
            ("p.exr", &["compare", "p.exr", "p.exr"]),
        ];
        for (name, arguments) in places {
            let folder = folder_with("", b"");
            let _ = std::fs::remove_file(folder.path().join(name));
            make(&folder.path().join(name));
            let (code, said) = ended(folder.path(), arguments);
            assert_eq!(code, Some(1), "{arguments:?}: {said}");
            for word in words.iter().chain([&name]) {
                assert!(said.contains(word), "{arguments:?} does not say `{word}`:\n{said}");
            }
            assert!(!said.contains("panicked"), "{said}");
        }
    }
}

#[test]
fn what_is_no_library_is_a_warning_that_says_so() {
    for (make, words) in KINDS {
        let folder = folder_with("a.ron", SCENE.replace("\"grey\": (kd: (0.5, 0.5, 0.5))", "").as_bytes());
        std::fs::remove_file(folder.path().join("a.mtl")).unwrap();
        make(&folder.path().join("a.mtl"));
        let (code, said) = ended(folder.path(), &["check", "a.ron"]);
        assert_eq!(code, Some(0), "{said}");
        for word in words.iter().chain([&"a.mtl", &"a.obj:1:"]) {
            assert!(said.contains(word), "`{word}` is not in:\n{said}");
        }
    }
}

#[test]
fn a_folder_of_shaders_that_is_none_is_refused() {
    for (make, _) in &KINDS[..5] {
        let folder = folder_with("", b"");
        make(&folder.path().join("s"));
        let (code, said) = ended(folder.path(), &["render", "a.ron", "--shaders", "s"]);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains("s: this folder of shaders can't be read"), "{said}");
    }
}

#[test]
fn what_is_behind_links_is_rendered_as_what_is_not() {
    let folder = folder_with("", b"");
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("away")).unwrap();
    for name in ["a.ron", "a.obj", "a.mtl"] {
        std::fs::rename(path(name), path("away").join(name)).unwrap();
        symlink(Path::new("away").join(name), path(name)).unwrap();
    }
    symlink("a.ron", path("link.ron")).unwrap();
    let (code, said) = ended(folder.path(), &["render", "link.ron", "-o", "x.json", "--quiet"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(path("x.json").is_file());
    // A model is looked for beside the link, where people see the file.
    std::fs::remove_file(path("a.obj")).unwrap();
    std::fs::write(path("a.obj"), OBJ.replace("a.mtl", "b.mtl")).unwrap();
    std::fs::write(path("b.mtl"), MTL).unwrap();
    let (code, said) = ended(folder.path(), &["check", "link.ron"]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
}
