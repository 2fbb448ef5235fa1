//! What a render tells of its error: where it comes from, and where it hangs on single samples.

use super::{folder_with, lucerna, rendered};

#[test]
fn nothing_is_told_that_was_not_asked() {
    let folder = folder_with("", b"");
    let report = rendered(folder.path(), &["-o", "plain.exr"]);
    assert!(report["sources"].is_null() && report["robust"].is_null());
    let skipped = report["skipped"]["passes"].as_array().unwrap();
    assert!(["sources", "blocks"].iter().all(|pass| skipped.iter().any(|name| name == pass)), "{skipped:?}");
    // The picture is the same to the byte.
    rendered(folder.path(), &["--sources", "--robust", "-o", "asked.exr"]);
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("plain.exr") == bytes("asked.exr"));
}

#[test]
fn sources_and_robust_means_are_in_the_report_and_in_words() {
    let folder = folder_with("", b"");
    let report = rendered(folder.path(), &["--sources", "--robust", "--spp", "32"]);
    let sources = &report["sources"];
    assert_eq!((&sources["samples"], &sources["pixels"]), (&32.into(), &(20 * 12).into()), "{sources}");
    assert!(sources["relmse"].as_f64().unwrap() > 0.0 && sources["sentence"].as_str().unwrap().contains("sky"));
    for parts in ["ways", "by_bounce", "by_way", "by_light", "by_material"] {
        let parts = sources[parts].as_array().unwrap();
        let sum: f64 = parts.iter().map(|part| part["share"].as_f64().unwrap()).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{parts:?}");
    }
    // A triangle in a white world: the sky is all the light there is, seen, or found from the triangle, which sends it to nothing else.
    assert_eq!(sources["by_light"].as_array().unwrap().len(), 1);
    let materials: Vec<_> = sources["by_material"].as_array().unwrap().iter().map(|part| &part["material"]).collect();
    assert!(materials.len() <= 2 && materials.iter().any(|name| name.is_null()), "{materials:?}");
    let robust = &report["robust"];
    let mean: Vec<f64> = report["mean"].as_array().unwrap().iter().map(|channel| channel.as_f64().unwrap()).collect();
    let luminance = 0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2];
    assert!((robust["plain"].as_f64().unwrap() / luminance - 1.0).abs() < 1e-5, "{robust}");
    assert_eq!(robust["blocks"], 16);

    let run = lucerna(folder.path(), &["render", "a.ron", "--sources", "--robust", "--spp", "32", "-q"]);
    let said = String::from_utf8(run.stdout).unwrap();
    for part in [" of the error: sky", "by 32 more samples", "by bounce: ", "by light: sky 100 %", "robust mean "] {
        assert!(said.contains(part), "no `{part}` in:\n{said}");
    }
}
