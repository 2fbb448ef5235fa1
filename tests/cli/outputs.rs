//! Several outputs, of which some can't be written.

use super::{folder_with, lucerna, names, refused};

/// Exit code, JSON report and stderr of a render of the small scene.
fn render(folder: &std::path::Path, outputs: &[&str]) -> (Option<i32>, serde_json::Value, String) {
    let outputs = outputs.iter().flat_map(|output| ["-o", *output]);
    let run = lucerna(folder, &["render", "a.ron", "--quiet", "--json"].into_iter().chain(outputs).collect::<Vec<_>>());
    let text = String::from_utf8(run.stderr).unwrap();
    (run.status.code(), serde_json::from_slice(&run.stdout).unwrap(), text)
}

#[test]
fn the_others_are_written_and_each_failure_is_told() {
    let folder = folder_with("", b"");
    std::fs::create_dir(folder.path().join("taken.exr")).unwrap();
    let (code, report, text) = render(folder.path(), &["taken.exr", "x.png", "a.obj/x.json", "y.exr", "./x.png"]);
    assert_eq!(code, Some(1), "{text}");
    assert_eq!(report["outputs"], serde_json::json!(["x.png", "y.exr"]));
    assert_eq!(text.matches("error:").count(), 2, "{text}");
    assert!(text.contains("taken.exr: is a folder") && text.contains("a.obj") && text.contains("help:"), "{text}");
    assert!(text.contains("choose another place with -o FILE"), "{text}");
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron", "taken.exr", "x.png", "y.exr"]);
}

#[test]
fn where_none_can_be_written_nothing_is_rendered() {
    let folder = folder_with("", b"");
    let text = refused(1, folder.path(), &["render", "a.ron", "--spp", "4000000000", "-o", "a.mtl/x.png"]);
    assert!(text.contains("a.mtl"), "{text}");
}

#[cfg(unix)]
#[test]
fn a_link_is_written_through() {
    let folder = folder_with("", b"");
    std::fs::create_dir(folder.path().join("elsewhere")).unwrap();
    for name in ["x.png", "x.exr", "x.json"] {
        std::os::unix::fs::symlink(format!("elsewhere/{name}"), folder.path().join(name)).unwrap();
    }
    let (code, report, text) = render(folder.path(), &["x.png", "x.exr", "x.json", "elsewhere/x.png"]);
    assert_eq!((code, text.as_str()), (Some(0), ""));
    assert_eq!(report["outputs"], serde_json::json!(["x.png", "x.exr", "x.json"]));
    for name in ["x.png", "x.exr", "x.json"] {
        assert!(std::fs::symlink_metadata(folder.path().join(name)).unwrap().is_symlink(), "{name}");
    }
    assert_eq!(names(&folder.path().join("elsewhere")), ["x.exr", "x.json", "x.png"]);
}

/// The scene, its model and library, and pictures that are compared: by name, through a link, and as a scene told by its content.
#[test]
fn what_is_read_is_not_written_over() {
    let folder = folder_with("", b"");
    let at = |name: &str| folder.path().join(name);
    let (code, _, text) = render(folder.path(), &["x.png", "y.exr"]);
    assert_eq!(code, Some(0), "{text}");
    std::fs::copy(at("a.ron"), at("scene.json")).unwrap();
    let held = |name: &str| std::fs::read(at(name)).unwrap();
    let before = ["scene.json", "a.obj", "x.png", "y.exr"].map(held);
    let text = refused(1, folder.path(), &["render", "scene.json", "-o", "./scene.json"]);
    assert!(text.contains("scene.json: is one of the files that are read") && text.contains("help:"), "{text}");
    for arguments in [["compare", "x.png", "y.exr", "-o", "x.png"], ["compare", "y.exr", "x.png", "-o", "./x.png"]] {
        let run = lucerna(folder.path(), &arguments);
        let text = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(1) && text.contains("is one of the files that are read"), "{text}");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a.obj", at("model.png")).unwrap();
        let text = refused(1, folder.path(), &["render", "a.ron", "-o", "model.png"]);
        assert!(text.contains("model.png: is one of the files"), "{text}");
    }
    assert_eq!(["scene.json", "a.obj", "x.png", "y.exr"].map(held), before);
}
