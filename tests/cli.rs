//! The command line, by running it: exit codes, one message a mistake, and files that are whole.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// Runs the binary in a folder.
fn lucerna(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    // Where there is a display, `lucerna` alone would open a window.
    for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(display);
    }
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap()
}

/// What a failed run printed to stderr, after checks that hold for every failure.
fn refused(code: i32, folder: &Path, arguments: &[&str]) -> String {
    let run = lucerna(folder, arguments);
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(code), "{arguments:?} said:\n{text}");
    assert!(!text.contains("panicked") && !text.contains("RUST_BACKTRACE"), "{arguments:?} said:\n{text}");
    let errors = text.matches("error:").count();
    assert_eq!(errors, 1, "{arguments:?} has not exactly one message:\n{text}");
    assert!(run.stdout.is_empty(), "{arguments:?} wrote to stdout");
    text
}

const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (20, 12)),
    render: (spp: 2, max_depth: 3),
    environment: Constant((1, 1, 1)),
    materials: { "grey": (kd: (0.5, 0.5, 0.5)) },
)
"#;
const OBJ: &str = "mtllib a.mtl\no thing\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\n";

/// A folder with a small scene, of which one file may be another.
fn folder_with(name: &str, content: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (file, text) in [("a.ron", SCENE), ("a.obj", OBJ), ("a.mtl", MTL)] {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    if !name.is_empty() {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

/// The report of a render of the small scene.
fn rendered(folder: &Path, more: &[&str]) -> Value {
    let mut arguments = vec!["render", "a.ron", "--quiet", "--json"];
    arguments.extend(more);
    let run = lucerna(folder, &arguments);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{arguments:?} said:\n{said}");
    serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {:?}", run.stdout))
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn help_says_what_there_is_and_exit_codes() {
    for (arguments, code) in [(&["--help"][..], 0), (&["--version"], 0), (&["render", "--help"], 0), (&[], 2)] {
        assert_eq!(lucerna(Path::new("."), arguments).status.code(), Some(code), "{arguments:?}");
    }
    let help = String::from_utf8(lucerna(Path::new("."), &["--help"]).stdout).unwrap();
    for word in ["view", "render", "check", "doctor", "bench", "Exit codes", "130"] {
        assert!(help.contains(word), "--help lacks {word}");
    }
}

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn a_window_without_a_display_is_refused() {
    let text = refused(1, Path::new("."), &["view"]);
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
fn a_render_writes_all_its_files_whole_and_reports_them() {
    let folder = folder_with("", b"");
    let report = rendered(folder.path(), &[]);
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron", "result"]);
    assert_eq!(names(&folder.path().join("result")), ["a.exr", "a.json", "a.png"]);
    let keys = [
        "scene",
        "adapter",
        "size",
        "spp",
        "triangles",
        "nodes",
        "seconds",
        "samples",
        "rays",
        "rays_per_second",
        "mean",
        "relative_error",
        "bad_samples",
        "passes",
        "outputs",
    ];
    for key in keys {
        assert!(report.get(key).is_some_and(|value| !value.is_null()), "the report lacks {key}: {report}");
    }
    for key in ["start", "load", "build", "trace", "total"] {
        assert!(report["seconds"][key].as_f64().is_some_and(|seconds| seconds >= 0.0), "no seconds.{key}");
    }
    assert_eq!(report["scene"], "a");
    assert_eq!(report["size"], serde_json::json!([20, 12]));
    assert_eq!((&report["spp"], &report["triangles"], &report["nodes"]), (&2.into(), &1.into(), &0.into()));
    assert_eq!(report["samples"], 20 * 12 * 2);
    assert!(report["rays"].as_u64().unwrap() >= 20 * 12 * 2);
    assert_eq!(report["bad_samples"], 0);
    // Nothing but a grey triangle in a white world: darker than 1 by what the triangle swallows.
    let mean = report["mean"][0].as_f64().unwrap();
    assert!(mean > 0.5 && mean < 1.0, "mean {mean}");
    let outputs: Vec<&str> = report["outputs"].as_array().unwrap().iter().map(|o| o.as_str().unwrap()).collect();
    let expected: Vec<PathBuf> = ["png", "exr", "json"].map(|e| Path::new("result").join(format!("a.{e}"))).into();
    assert_eq!(outputs.iter().map(PathBuf::from).collect::<Vec<_>>(), expected);
    let written = std::fs::read(folder.path().join("result/a.json")).unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&written).unwrap(), report);
    let (width, height, text) = png_of(&folder.path().join("result/a.png"));
    assert_eq!((width, height), (20, 12));
    for key in ["scene", "spp", "seed", "integrator", "repeat"] {
        assert!(text.iter().any(|(k, v)| k == key && !v.is_empty()), "the PNG's text lacks {key}: {text:?}");
    }
    assert_eq!(exr_of(&folder.path().join("result/a.exr")).len(), 20 * 12);
}

fn png_of(path: &Path) -> (u32, u32, Vec<(String, String)>) {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    reader.finish().unwrap();
    let text = &reader.info().uncompressed_latin1_text;
    (frame.width, frame.height, text.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone())).collect())
}

fn exr_of(path: &Path) -> Vec<[f32; 3]> {
    let image = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| pixels[at.y() * *width + at.x()] = [r, g, b],
    );
    image.unwrap().layer_data.channel_data.pixels.1
}

#[test]
fn equal_seeds_give_equal_bytes_and_others_do_not() {
    let folder = folder_with("", b"");
    for (seed, name) in [("7", "one.exr"), ("7", "two.exr"), ("8", "three.exr")] {
        rendered(folder.path(), &["--seed", seed, "-o", name, "-o", "same.png"]);
    }
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("one.exr") == bytes("two.exr"), "equal seeds, unequal files");
    assert_ne!(exr_of(&folder.path().join("one.exr")), exr_of(&folder.path().join("three.exr")));
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron", "one.exr", "same.png", "three.exr", "two.exr"]);
}

#[test]
fn the_command_line_in_the_metadata_repeats_the_render() {
    let folder = folder_with("", b"");
    let report = rendered(
        folder.path(),
        &[
            "--seed",
            "3",
            "--spp",
            "3",
            "--crop",
            "4,12,2,9",
            "-D",
            "materials.grey.kd=(0.9, 0.1, 0.1)",
            "-o",
            "one.exr",
        ],
    );
    assert_eq!(report["crop"], serde_json::json!([4, 12, 2, 9]));
    let repeat = report["repeat"].as_str().unwrap();
    let run = Command::new("sh")
        .args(["-c", &repeat.replacen("lucerna", &format!("'{}'", env!("CARGO_BIN_EXE_lucerna")), 1)])
        .arg("sh")
        .current_dir(folder.path())
        .output();
    // Windows has no sh; elsewhere the command must work as it stands.
    let Ok(run) = run else { return };
    assert!(run.status.success(), "{repeat}: {}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(exr_of(&folder.path().join("one.exr")), exr_of(&folder.path().join("result/a.exr")));
}

#[test]
fn flags_change_what_they_say() {
    let folder = folder_with("", b"");
    let with = |flags: &[&str]| rendered(folder.path(), flags);
    assert_eq!(with(&["--size", "7x5", "-o", "x.json"])["samples"], 7 * 5 * 2);
    assert_eq!(with(&["--spp", "5", "-o", "x.json"])["spp"], 5);
    let timed = with(&["--time", "0.2", "-o", "x.json"]);
    assert!(timed["spp"].as_u64().unwrap() >= 1 && timed["interrupted"] == false, "{timed}");
    assert_eq!(with(&["--time", "1000", "--spp", "2", "-o", "x.json"])["spp"], 2);
    let dark = with(&["-D", "environment=Constant(0.5)", "--roulette", "off", "--max-depth", "1", "-o", "x.json"]);
    assert!(dark["mean"][1].as_f64().unwrap() <= 0.5, "{dark}");
    assert_eq!((&dark["roulette"], &dark["max_depth"]), (&false.into(), &1.into()));
}

#[test]
fn huge_films_render_or_are_refused_without_a_panic() {
    let folder = folder_with("", b"");
    let run = lucerna(
        folder.path(),
        &["render", "a.ron", "--size", "16384x16384", "--crop", "16380,16384,16380,16384", "--quiet", "-o", "x.exr"],
    );
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(exr_of(&folder.path().join("x.exr")).len(), 16);
}

#[test]
fn check_reads_assets_and_links_every_pass() {
    let folder = folder_with("", b"");
    let run = lucerna(folder.path(), &["check", "."]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(String::from_utf8(run.stdout).unwrap().starts_with("3 assets: 0 errors, 0 warnings"));
    std::fs::write(folder.path().join("a.ron"), "(film: 3)").unwrap();
    let run = lucerna(folder.path(), &["check", "."]);
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8(run.stderr).unwrap().contains("a.ron:1:"));

    let run = lucerna(Path::new(env!("CARGO_MANIFEST_DIR")), &["check"]);
    let (out, said) = (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap());
    assert_eq!(run.status.code(), Some(0), "{out}{said}");
    assert!(out.contains("passes") && said.is_empty(), "our own assets are without a fault:\n{out}{said}");
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

#[test]
fn doctor_names_the_adapter_that_is_used() {
    let run = lucerna(Path::new("."), &["doctor"]);
    let out = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{out}");
    assert!(out.contains("ready: renders use") && out.contains("driver:"), "{out}");
    let none = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["render", "cornell-box", "--quiet"])
        .current_dir(tempfile::tempdir().unwrap().path())
        .env("LUCERNA_ADAPTER", "99")
        .output()
        .unwrap();
    assert_eq!(none.status.code(), Some(3));
}

#[test]
fn a_reader_that_has_gone_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["check", "assets/scenes/teapot.ron"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && !said.contains("panicked"), "{:?}: {said}", run.status);
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_there_is() {
    use std::io::Read;
    let folder = folder_with("", b"");
    let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
        .args(["render", "a.ron", "--time", "600", "--json", "--quiet", "-o", "x.exr", "-o", "x.json"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // Signals during the start are kept until the first step, so any moment after the handler is set will do; -o is
    // tried out after that.
    std::thread::sleep(std::time::Duration::from_secs(3));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let mut out = String::new();
    child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let report: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(report["interrupted"], true);
    assert!(report["samples"].as_u64().unwrap() > 0);
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron", "x.exr", "x.json"]);
    assert_eq!(exr_of(&folder.path().join("x.exr")).len(), 20 * 12);
}
