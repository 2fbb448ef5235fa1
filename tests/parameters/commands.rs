//! Parameters from outside: by `-D`, in scene files, in sweeps and along keys, and what is said of those that are wrong.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use lucerna::app::variants::record::Answer;
use tempfile::TempDir;

const SCENE: &str = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (20, 12)),
    render: (spp: 2, max_depth: 3),
    environment: Constant((1, 1, 1)),
)
"#;
const OBJ: &str = "mtllib a.mtl\nusemtl grey\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
const MTL: &str = "newmtl grey\nKd 0.6 0.6 0.6\n";

/// A scene beside shaders whose paths gather `TIMES` times as much light; `COAT_ONLY` is of surfaces with a coat, of which there is none.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |file: &str, text: &str| std::fs::write(folder.path().join(file), text).unwrap();
    crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &folder.path().join("shaders"));
    for (file, text) in [("a.ron", SCENE), ("a.obj", OBJ), ("a.mtl", MTL)].iter().chain(files) {
        write(file, text);
    }
    let edit = |file: &str, pairs: &[(&str, &str)]| {
        let text = std::fs::read_to_string(folder.path().join(file)).unwrap();
        let edited = pairs.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{file} has no `{from}`");
            text.replace(from, to)
        });
        write(file, &edited);
    };
    let head = "const LARGEST_F32";
    edit(
        "shaders/passes/trace/path.wgsl",
        &[
            (head, "@range(0.0, 16.0) override TIMES: f32 = 1.0;\noverride DARK: bool = false;\nconst LARGEST_F32"),
            ("(*state).radiance += light;", "(*state).radiance += select(TIMES, 0.0, DARK) * light;"),
        ],
    );
    let import = "import package::gen::{MaterialRecord};";
    edit("shaders/lib/bsdf/coat.wgsl", &[(import, &format!("{import}\noverride COAT_ONLY: u32 = 1;"))]);
    folder
}

fn lucerna(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap()
}

/// The mean of a render with some flags, and what it said beside.
fn rendered(folder: &Path, flags: &[&str]) -> (f64, String) {
    let run = lucerna(folder, &[&["render", "a.ron", "--json", "-o", "a.png"], flags].concat());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{flags:?}: {said}");
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    (report["mean"][0].as_f64().unwrap(), said)
}

/// What a command said that was refused.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let run = lucerna(folder, arguments);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(1), "{arguments:?}: {said}");
    said
}

#[test]
fn a_define_and_a_scene_file_set_them() {
    let folder = folder(&[("b.ron", "(extends: \"a.ron\", shader: { \"TIMES\": 4.0 })")]);
    let folder = folder.path();
    let (plain, _) = rendered(folder, &[]);
    let near = |value: f64, wanted: f64| (value / wanted - 1.0).abs() < 1e-6;
    assert!(near(rendered(folder, &["-D", "shader.TIMES=2"]).0, 2.0 * plain));
    assert_eq!(rendered(folder, &["-D", "shader.DARK=true"]).0, 0.0);
    let run = lucerna(folder, &["render", "b.ron", "--json", "-o", "b.png", "-D", "render.seed=0"]);
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(near(report["mean"][0].as_f64().unwrap(), 4.0 * plain));
    // What the report calls its repeat gives the same mean.
    let run = lucerna(folder, &["render", "b.ron", "--json", "-o", "b.png", "-D", "shader.TIMES=2"]);
    let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let repeat: Vec<&str> = report["repeat"].as_str().unwrap().split_whitespace().skip(1).collect();
    let run = lucerna(folder, &[&repeat[..], &["--json", "-o", "b.png"]].concat());
    let again: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(again["mean"], report["mean"], "{repeat:?}");
    let told = rendered(folder, &["-D", "shader.TIMES=2"]);
    assert!(!told.1.contains("warning"), "{}", told.1);
    let told = rendered(folder, &["-D", "shader.COAT_ONLY=3"]);
    assert!(told.1.contains("shader.COAT_ONLY is set, and nothing that this scene needs reads it"), "{}", told.1);
    assert_eq!(told.0, plain);
}

#[test]
fn what_no_shader_has_is_refused_where_it_is_written() {
    let folder = folder(&[
        ("b.ron", "(\n    extends: \"a.ron\",\n    shader: { \"TIMES\": 20.0 },\n)"),
        ("fam.ron", "(extends: \"a.ron\", sweep: { \"shader.TIMES\": [1, 20] })"),
    ]);
    let folder = folder.path();
    let said = refused(folder, &["render", "a.ron", "-D", "shader.TIMSE=2"]);
    assert!(
        said.contains("shader.TIMSE: no module has `override TIMSE`") && said.contains("did you mean `TIMES`?"),
        "{said}"
    );
    assert!(said.contains("-D:1:8"), "{said}");
    let said = refused(folder, &["render", "a.ron", "-D", "shader.TIMES=true"]);
    assert!(said.contains("expected a number from 0 to 16, found `true`"), "{said}");
    let said = refused(folder, &["render", "a.ron", "-D", "shader.TIMES=\"much\""]);
    assert!(said.contains("shader.TIMES: expected a number, true or false"), "{said}");
    let said = refused(folder, &["render", "b.ron"]);
    assert!(said.contains("b.ron:3:24: error: shader.TIMES: expected a number from 0 to 16, found `20`"), "{said}");
    assert!(
        said.contains("shaders/passes/trace/path.wgsl:") && said.contains("@range(0, 16) override TIMES"),
        "{said}"
    );
    let said = refused(folder, &["judge", "a.ron", "--new", "shaders", "-D", "shader.TIMSE=2"]);
    assert!(said.contains("no module has `override TIMSE`"), "{said}");
    // Of a family, the member alone is wrong.
    let run = lucerna(folder, &["variants", "fam.ron", "--json", "--quiet"]);
    let said = String::from_utf8_lossy(&run.stderr).into_owned() + &String::from_utf8_lossy(&run.stdout);
    assert!(run.status.code() != Some(0) && said.contains("expected a number from 0 to 16, found `20`"), "{said}");
}

#[test]
fn members_and_frames_differ_in_them_and_share_all_code() {
    let animated = SCENE
        .replace("environment:", "animate: (frames: 3, keys: { \"shader.TIMES\": { 0: 1, 2: 3 } }),\n    environment:");
    let folder =
        folder(&[("fam.ron", "(extends: \"a.ron\", sweep: { \"shader.TIMES\": [1, 2, 4] })"), ("move.ron", &animated)]);
    for (command, times) in [(["variants", "fam.ron"], [1.0, 2.0, 4.0]), (["animate", "move.ron"], [1.0, 2.0, 3.0])] {
        let run = lucerna(folder.path(), &[&command[..], &["--json", "--quiet"]].concat());
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert_eq!(run.status.code(), Some(0), "{said}");
        let answer: Answer = serde_json::from_slice(&run.stdout).unwrap();
        let first = answer.records[0].mean[0];
        for (record, times) in answer.records.iter().zip(times) {
            assert!((record.mean[0] / first - times).abs() < 1e-5, "{}: {:?} {first}", record.name, record.mean);
        }
        let paths: u64 = answer.records.iter().filter_map(|record| record.work.compiled.get("path")).sum();
        assert_eq!(paths, 1, "one kernel for all");
    }
}

#[test]
fn judged_shaders_may_differ_in_what_can_be_set() {
    let folder = folder(&[]);
    // The shipped shaders have no such parameter, and are as bright as the edited ones with 1.
    let flags = ["--size", "16x10", "--films", "4", "--quiet", "-D", "shader.TIMES=2"];
    let run = lucerna(folder.path(), &[&["judge", "a.ron", "--new", "shaders"], &flags[..]].concat());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(matches!(run.status.code(), Some(0 | 5 | 6)), "{:?} {said}", run.status);
}
