//! What is refused, with one message at its place.

use super::{SCENE, folder_with, lucerna, names, refused, rendered};

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn a_window_without_a_display_is_refused() {
    let text = refused(1, std::path::Path::new("."), &["view"]);
    assert!(text.contains("no display") && text.contains("lucerna render"), "{text}");
    assert!(!text.contains(".rs:"), "the message names a source file:\n{text}");
}

#[test]
fn meaningless_flags_are_refused_before_anything_is_read() {
    let folder = folder_with("", b"");
    let bad: &[&[&str]] = &[
        &["--sp", "3"],
        &["--spp", "0"],
        &["--spp", "-1"],
        &["--spp", "4294967296"],
        &["--spp", "NaN"],
        &["--time", "0"],
        &["--time", "NaN"],
        &["--time", "inf"],
        &["--time", "1e300"],
        &["--size", "0x5"],
        &["--size", "16385x1"],
        &["--size", "99999999999x99999999999"],
        &["--size", "5"],
        &["--crop", "0,0,0,1"],
        &["--crop", "5,1,0,1"],
        &["--crop", "0,1,0"],
        &["--crop", "-1,1,0,1"],
        &["--crop", "0,4294967296,0,1"],
        &["--max-depth", "0"],
        &["--max-depth", "1025"],
        &["--roulette", "maybe"],
        &["--integrator", "bdsf"],
        &["--exposure", "NaN"],
        &["--exposure", "1e9"],
        &["-D", "nothing"],
        &["-D", "=1"],
        &["-o", "picture.jpg"],
        &["-o", "picture"],
        &["--seed", "-1"],
    ];
    for flags in bad {
        let mut arguments = vec!["render", "a.ron"];
        arguments.extend(*flags);
        let text = refused(2, folder.path(), &arguments);
        let name = flags[0];
        assert!(text.contains(name) || text.contains(&name[..4]), "{flags:?} are not named:\n{text}");
    }
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron"]);
}

#[test]
fn what_the_scene_decides_is_refused_too() {
    let folder = folder_with("", b"");
    let text = refused(2, folder.path(), &["render", "a.ron", "--crop", "0,21,0,4"]);
    assert!(text.contains("20x12"), "{text}");
    let text = refused(2, folder.path(), &["render", "a.ron", "--camera", "frnt"]);
    assert!(text.contains("front"), "{text}");
    let text = refused(1, folder.path(), &["render", "a.ron", "-o", "a.obj/picture.png"]);
    assert!(text.contains("a.obj"), "{text}");
}

/// A mistake: the file that has it, its content, where it is said to be (`file:line`), and a word of the message.
type Mistake = (&'static str, &'static [u8], &'static str, &'static str);

const MISTAKES: &[Mistake] = &[
    ("a.obj", b"", "a.obj", "face"),
    ("a.obj", b"\x00\xff\x13\x37\xfe\x01\x00\x00", "a.obj", ""),
    ("a.obj", b"v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n", "a.obj:2", ""),
    ("a.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 2147483648\n", "a.obj:4", "2147483648"),
    ("a.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 2147483647\n", "a.obj:4", "2147483647"),
    ("a.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 x\n", "a.obj:4", "x"),
    ("a.ron", b"(models: [(path: \"a.obj\")],\n camras: {},\n)", "a.ron:2", "cameras"),
    ("a.ron", b"(models: [(path: \"b.obj\")])", "a.ron:1", "b.obj"),
    ("a.ron", b"(film: (size: (0, 5)))", "a.ron:1", "size"),
    ("a.ron", b"(film: (size: (5, 5))", "a.ron:1", ""),
    ("a.ron", b"\xff\xfe\x00\x01", "a.ron", ""),
    ("a.ron", b"(environment: Map(path: \"x.exr\"))", "a.ron:1", "x.exr"),
    ("a.ron", b"(models: [(path: \"a.obj\")], materials: { \"gray\": (kd: (1, 1, 1)) })", "a.ron:1", "grey"),
];

#[test]
fn a_mistake_in_a_file_is_one_message_with_its_place() {
    for (file, content, place, word) in MISTAKES {
        let folder = folder_with(file, content);
        let text = refused(1, folder.path(), &["render", "a.ron"]);
        assert!(text.contains(place) && text.contains(word), "{place} or `{word}` is not in:\n{text}");
        assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron"], "{place} left files");
    }
}

#[test]
fn what_can_be_rendered_all_the_same_is_a_warning_with_its_place() {
    let cases: &[Mistake] = &[
        ("a.mtl", b"newmtl grey\nKd 1 x\n", "a.mtl:2", "Kd"),
        ("a.mtl", b"newmtl grey\nKdd 1 1 1\n", "a.mtl:2", "Kdd"),
        ("a.obj", b"mtllib no.mtl\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n", "a.obj:1", "no.mtl"),
    ];
    for (file, content, place, word) in cases {
        let folder = folder_with(file, content);
        let scene = SCENE.replace("\"grey\": (kd: (0.5, 0.5, 0.5))", "");
        std::fs::write(folder.path().join("a.ron"), scene).unwrap();
        for command in ["render", "check"] {
            let run = lucerna(folder.path(), &[command, "a.ron"]);
            let text = String::from_utf8(run.stderr).unwrap();
            let located = text.lines().any(|line| line.contains(place) && line.contains(word));
            assert!(located, "{command}: {place} and `{word}` are not in:\n{text}");
            assert!(!text.contains("panicked"), "{text}");
            assert!(matches!(run.status.code(), Some(0 | 1)), "{:?}", run.status);
        }
    }
}

#[test]
fn one_number_is_a_grey() {
    let folder = folder_with("a.mtl", b"newmtl grey\nKd 1\n");
    rendered(folder.path(), &["-o", "x.json"]);
}

#[test]
fn scenes_that_are_none_are_refused() {
    let folder = folder_with("empty.obj", b"");
    for (scene, word) in
        [("corneel-box", "cornell-box"), ("none.ron", "none.ron"), (".", ""), ("empty.obj", "empty.obj"), ("", "")]
    {
        let text = refused(1, folder.path(), &["render", scene]);
        assert!(text.contains(word) && text.contains("help:"), "{scene}:\n{text}");
    }
}

#[test]
fn a_define_with_a_mistake_is_refused_at_its_place() {
    let folder = folder_with("", b"");
    for (define, word) in [
        ("materials.grey.ns=abc", "ns"),
        ("materials.gray.ns=3", "grey"),
        ("materials.grey.nss=3", "ns"),
        ("film.size=(0,1)", "size"),
        ("render.spp=-3", "spp"),
        ("a..b=3", "a..b"),
    ] {
        let text = refused(1, folder.path(), &["render", "a.ron", "-D", define]);
        assert!(text.contains("-D") && text.contains(word), "{define}:\n{text}");
    }
}

#[test]
fn a_broken_shader_is_one_message_with_its_line() {
    let folder = folder_with("", b"");
    let library = lucerna::shader::Library::embedded();
    for module in library.modules() {
        let path = folder.path().join("shaders").join(format!("{module}.wgsl"));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        let text = library.text(module).unwrap();
        // The error is on a line of its own, behind all others.
        let wrong = if module == "lib/rng" { "fn wrong() -> u32 {\n    return 1.5;\n}\n" } else { "" };
        std::fs::write(path, format!("{text}{wrong}")).unwrap();
    }
    let line = library.text("lib/rng").unwrap().lines().count() + 2;
    let text = refused(1, folder.path(), &["render", "a.ron"]);
    assert!(text.starts_with(&format!("shaders/lib/rng.wgsl:{line}:")), "not at line {line}:\n{text}");
    assert!(text.contains(&format!("{line} |     return 1.5;\n")), "the line is not shown:\n{text}");
    let run = lucerna(folder.path(), &["check"]);
    let said = String::from_utf8(run.stderr).unwrap();
    assert_eq!((run.status.code(), said.matches("error:").count()), (Some(1), 1), "{said}");
}
