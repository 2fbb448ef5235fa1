//! Without a number of samples, a picture is traced until it is good.

use super::{SCENE, folder_with, lucerna, refused, rendered};

/// The small scene without its number of samples, and with shadows and light enough to be noisy.
fn folder() -> tempfile::TempDir {
    folder_with("a.ron", SCENE.replace("spp: 2, ", "").as_bytes())
}

#[test]
fn a_scene_without_samples_is_traced_to_an_error() {
    let folder = folder();
    let report = rendered(folder.path(), &["-o", "a.json"]);
    assert_eq!((&report["quality"], &report["ended_by"]), (&"good".into(), &"error".into()), "{report}");
    assert!(report["relative_error"].as_f64().unwrap() <= 1e-3 && report["spp"].as_u64().unwrap() >= 16, "{report}");
    let fine = rendered(folder.path(), &["-o", "a.json", "--quality", "fine"]);
    assert!(
        fine["relative_error"].as_f64().unwrap() <= 1e-4 && fine["spp"].as_u64() > report["spp"].as_u64(),
        "{fine}"
    );
    // The same again, to the sample: nothing depends on the clock where the time is enough.
    assert_eq!(rendered(folder.path(), &["-o", "a.json"])["mean"], report["mean"]);
    let run = lucerna(folder.path(), &["render", "a.ron", "-o", "a.json"]);
    let out = String::from_utf8(run.stdout).unwrap();
    let said: Vec<&str> = out.lines().filter(|line| line.contains("good: ")).collect();
    assert!(said.len() == 1 && said[0].contains("1e-3") && said[0].contains("--quality"), "{out}");
}

#[test]
fn samples_and_time_count_where_they_are_given() {
    let folder = folder();
    let samples = rendered(folder.path(), &["-o", "a.json", "--spp", "3"]);
    assert_eq!(
        (&samples["spp"], &samples["quality"], &samples["ended_by"]),
        (&3.into(), &().into(), &"samples".into())
    );
    let defined = rendered(folder.path(), &["-o", "a.json", "-D", "render.spp=5"]);
    assert_eq!(defined["spp"], 5);
    let time = rendered(folder.path(), &["-o", "a.json", "--time", "0.2"]);
    assert_eq!((&time["quality"], &time["ended_by"]), (&().into(), &"time".into()));
    // What the scene says, a wish for quality goes over.
    let own = folder_with("", b"");
    assert_eq!(rendered(own.path(), &["-o", "a.json"])["spp"], 2);
    assert_eq!(rendered(own.path(), &["-o", "a.json", "--quality", "draft"])["ended_by"], "error");
    for flags in [["--spp", "4"], ["--time", "1"]] {
        let said = refused(2, folder.path(), &[&["render", "a.ron", "--quality", "good"], &flags[..]].concat());
        assert!(said.contains("cannot be used with"), "{said}");
    }
}
