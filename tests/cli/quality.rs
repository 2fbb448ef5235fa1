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
    let (told, bound) = (report["relative_error"].as_f64().unwrap(), report["relative_error_bound"].as_f64().unwrap());
    assert!(0.0 < told && told < bound && bound <= 1e-3 && report["error_wanted"] == 1e-3, "{report}");
    let fine = rendered(folder.path(), &["-o", "a.json", "--quality", "fine"]);
    assert!(
        fine["relative_error_bound"].as_f64().unwrap() <= 1e-4 && fine["spp"].as_u64() > report["spp"].as_u64(),
        "{fine}"
    );
    // The same again, to the sample: nothing depends on the clock where the time is enough.
    assert_eq!(rendered(folder.path(), &["-o", "a.json"])["mean"], report["mean"]);
    let run = lucerna(folder.path(), &["render", "a.ron", "-o", "a.json"]);
    let out = String::from_utf8(run.stdout).unwrap();
    let said: Vec<&str> = out.lines().filter(|line| line.contains("good: ")).collect();
    assert!(said.len() == 1 && said[0].contains("1e-3") && said[0].contains("--quality"), "{out}");
    assert!(out.lines().any(|line| line.contains(" (95 %: below ")), "{out}");
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
    for flags in [["--spp", "4"], ["--time", "1"], ["--error", "0.1"]] {
        let said = refused(2, folder.path(), &[&["render", "a.ron", "--quality", "good"], &flags[..]].concat());
        assert!(said.contains("cannot be used with"), "{said}");
    }
}

#[test]
fn an_error_that_is_asked_for_is_reached_or_samples_or_time_end_it() {
    let folder = folder_with("", b"");
    // The scene's own number of samples is no limit, one that is given is.
    let reached = rendered(folder.path(), &["-o", "a.json", "--error", "3e-3"]);
    assert_eq!((&reached["ended_by"], &reached["quality"]), (&"error".into(), &().into()), "{reached}");
    assert!(
        reached["relative_error_bound"].as_f64().unwrap() <= 3e-3 && reached["spp"].as_u64() > Some(2),
        "{reached}"
    );
    for (spp, ends) in [("2", 2), ("7", 7)] {
        let samples = rendered(folder.path(), &["-o", "a.json", "--error", "1e-9", "--spp", spp]);
        assert_eq!((&samples["ended_by"], &samples["spp"]), (&"samples".into(), &ends.into()), "{samples}");
    }
    let time = rendered(folder.path(), &["-o", "a.json", "--error", "1e-9", "--time", "0.2"]);
    assert_eq!((&time["ended_by"], &time["error_wanted"]), (&"time".into(), &1e-9.into()), "{time}");
    for error in ["0", "-1", "nan", "small"] {
        let said = refused(2, folder.path(), &["render", "a.ron", "--error", error]);
        assert!(said.contains("expected a relMSE from 1e-9 to 1e3"), "{said}");
    }
}
