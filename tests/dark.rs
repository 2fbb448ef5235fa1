//! Scenes in which nothing sends out light are told, and no others.

use std::process::Command;

use lucerna::scene::{Define, check, load};

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";

const TOLD: &str = "nothing emits light";

/// Whether a scene of these fields is told to be dark, by what is loaded and by what is checked.
fn is_told(fields: &str, mtl: &str, defines: &[(&str, &str)]) -> bool {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("m.obj", OBJ);
    write("m.mtl", mtl);
    write("s.ron", &format!("(models: [(path: \"m.obj\")], {fields})"));
    let path = folder.path().join("s.ron");
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    let loaded = load(&path, &defines).unwrap_or_else(|errors| panic!("{fields}: {errors}"));
    let told = loaded.warnings.iter().any(|warning| {
        let says = warning.message.contains(TOLD);
        assert!(
            !says
                || warning.file == path && warning.help.as_ref().is_some_and(|help| help.contains("environment: Sky("))
        );
        says
    });
    let checked = check(&path).diagnostics.list.iter().filter(|found| found.message.contains(TOLD)).count();
    assert!(!defines.is_empty() || checked == usize::from(told), "{fields}");
    told
}

#[test]
fn a_scene_is_dark_where_nothing_of_it_sends_out_light() {
    let grey = "newmtl a\nKd 0.5 0.5 0.5\n";
    for dark in [
        "",
        "environment: Constant(0)",
        "environment: Sky(sun: (45, 0), strength: 0)",
        "lights: { \"a\": Point(position: (0, 0, 1), intensity: 0) }",
        "materials: { \"a\": (ke: 0) }",
    ] {
        assert!(is_told(dark, grey, &[]), "{dark}");
    }
    for lit in [
        "environment: Constant((0, 0, 0.1))",
        "environment: Sky(sun: (45, 0))",
        "lights: { \"a\": Point(position: (0, 0, 1), intensity: 1) }",
        "materials: { \"a\": (ke: (0, 1, 0)) }",
    ] {
        assert!(!is_told(lit, grey, &[]), "{lit}");
    }
    assert!(!is_told("", "newmtl a\nKe 1 1 1\n", &[]));
    assert!(is_told("environment: Constant(1)", grey, &[("environment", "None")]));
    assert!(!is_told("", grey, &[("environment", "Constant(1)")]));
    // A lamp that no mesh has lights nothing.
    assert!(is_told("", "newmtl a\nKd 0.5 0.5 0.5\nnewmtl lamp\nKe 1 1 1\n", &[]));
}

/// A model by itself is lit by day; the command renders what it shows, and says so where it is told to be dark.
#[test]
fn a_model_alone_is_rendered_in_light() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.obj"), OBJ).unwrap();
    std::fs::write(folder.path().join("m.mtl"), "newmtl a\nKd 0.5 0.5 0.5\n").unwrap();
    let render = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
        command.args(["render", "m.obj", "--size", "16x16", "--spp", "1", "--json", "-o", "a.json"]).args(more);
        let run = command.current_dir(folder.path()).output().unwrap();
        let said = String::from_utf8(run.stderr).unwrap();
        let report: serde_json::Value =
            serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {said}"));
        (report["mean"][1].as_f64().unwrap(), said)
    };
    let (mean, said) = render(&[]);
    assert!(mean > 0.05 && !said.contains(TOLD), "{mean}: {said}");
    let (mean, said) = render(&["-D", "environment=None"]);
    assert!(mean == 0.0 && said.contains("m.obj: warning: nothing emits light"), "{mean}: {said}");
}
