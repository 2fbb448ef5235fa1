//! Renders in bands: the picture is the whole one to the bit, and what is told of it is too, as far as bands can tell it.

use serde_json::{Value, json};

use super::{exr_of, lucerna, png_of, report, scene};

/// Bytes of a buffer: 16 rows of a film that is 64 pixels wide.
const SIXTEEN_ROWS: u64 = 64 << 10;

const OUTPUTS: [&str; 6] = ["-o", "x.png", "-o", "x.exr", "-o", "x.json"];

/// The first and the last row of each band, with its samples.
fn rows(report: &Value) -> Vec<[u64; 3]> {
    let bands = report["bands"].as_array().unwrap_or_else(|| panic!("no bands: {report}"));
    let of = |band: &Value| [&band["rows"][0], &band["rows"][1], &band["spp"]].map(|n| n.as_u64().unwrap());
    bands.iter().map(of).collect()
}

#[test]
fn a_film_in_bands_is_the_whole_one_to_the_bit() {
    let scene = scene("cornell-data");
    for (flags, bands) in [
        (&["--size", "64x64", "--reuse", "off"][..], vec![[0, 16, 3], [16, 32, 3], [32, 48, 3], [48, 64, 3]]),
        (&["--size", "64x64", "--reuse", "tiles"], vec![[0, 16, 3], [16, 32, 3], [32, 48, 3], [48, 64, 3]]),
        // A crop whose rows are no block's.
        (&["--size", "90x70", "--crop", "13,77,5,44", "--reuse", "tiles"], vec![[5, 16, 3], [16, 32, 3], [32, 44, 3]]),
        (&["--size", "63x20", "--reuse", "off", "--sampler", "pcg"], vec![[0, 16, 3], [16, 20, 3]]),
    ] {
        let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let arguments = [&["render", &scene, "--spp", "3"], flags, &OUTPUTS].concat();
        let told = report(whole.path(), None, &arguments);
        let banded = report(parts.path(), Some(SIXTEEN_ROWS), &arguments);
        assert_eq!((&told["bands"], &told["rest"]), (&Value::Null, &Value::Null), "{told}");
        assert_eq!(rows(&banded), bands, "{flags:?}");
        let exr = |folder: &tempfile::TempDir| exr_of(&folder.path().join("x.exr"));
        let (film, place, metadata) = exr(&whole);
        assert!(film.iter().any(|pixel| *pixel != [0; 3]), "a black film proves nothing");
        let (found, found_place, found_metadata) = exr(&parts);
        assert!(found == film && found_place == place, "{flags:?}: the films differ");
        let png = |folder: &tempfile::TempDir| png_of(&folder.path().join("x.png"));
        assert!(png(&whole).1 == png(&parts).1, "{flags:?}: the pictures differ");
        // What repeats it is the same command, in both kinds of file.
        assert_eq!(found_metadata, metadata);
        let text = |folder: &tempfile::TempDir| png(folder).2.into_iter().collect::<std::collections::BTreeMap<_, _>>();
        assert_eq!(text(&parts), text(&whole));
        for key in ["spp", "size", "crop", "samples", "rays", "bad_samples", "repeat", "ended_by", "outputs"] {
            assert_eq!(banded[key], told[key], "{key}: {flags:?}");
        }
        for channel in 0..3 {
            let [a, b] = [&told, &banded].map(|report| report["mean"][channel].as_f64().unwrap());
            assert!((a - b).abs() <= 1e-12 * a.abs(), "{a} {b}");
        }
        let [a, b] = [&told, &banded].map(|report| report["relative_error"].as_f64().unwrap());
        // The pixels around the cuts are told by fewer others.
        assert!((a - b).abs() < 0.1 * a, "{a} {b}");
        let written = std::fs::read(parts.path().join("x.json")).unwrap();
        assert_eq!(serde_json::from_slice::<Value>(&written).unwrap()["bands"], banded["bands"]);
    }
}

#[test]
fn tracing_in_bands_builds_and_compiles_once() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let arguments = ["render", &scene, "--spp", "1", "--size", "64x64", "-o", "x.json"];
    let banded = report(folder.path(), Some(SIXTEEN_ROWS), &arguments);
    for pass in banded["compiled"].as_array().unwrap() {
        assert_eq!(pass["count"], 1, "{pass}");
    }
    assert_eq!((rows(&banded).len(), &banded["samples"]), (4, &json!(64 * 64)));
    // Where the adapter times passes, each batch of each band is counted.
    let passes = banded["passes"].as_array().unwrap();
    for name in ["path", "accumulate", "display"] {
        let count = passes.iter().find(|pass| pass["name"] == name).map(|pass| pass["count"].as_u64().unwrap());
        assert!(passes.is_empty() || count >= Some(4), "{name}: {passes:?}");
    }
}

#[test]
fn each_band_is_traced_to_the_error() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let arguments = ["render", &scene, "--error", "0.05", "--size", "64x64", "-o", "x.exr"];
    let banded = report(folder.path(), Some(SIXTEEN_ROWS), &arguments);
    let bands = banded["bands"].as_array().unwrap();
    assert_eq!((bands.len(), &banded["ended_by"]), (4, &json!("error")));
    let bound = |told: &Value| told["relative_error_bound"].as_f64().unwrap();
    assert!(bands.iter().all(|band| bound(band) <= 0.05 && band["ended_by"] == "error"), "{bands:?}");
    // Of more pixels, more is known.
    assert!(bound(&banded) <= 0.05 && banded["relative_error"].as_f64().unwrap() <= 0.05, "{banded}");
    let least = rows(&banded).iter().map(|[.., spp]| *spp).min();
    assert_eq!(banded["spp"].as_u64(), least);
    let (film, _, metadata) = exr_of(&folder.path().join("x.exr"));
    assert_eq!(metadata["spp"], least.unwrap().to_string());
    // The clock had no say: the same again, by the command line that says so.
    let most = rows(&banded).iter().map(|[.., spp]| *spp).max();
    assert!(most > least, "bands of unlike samples are what is tested: {banded}");
    let repeat: Vec<&str> = banded["repeat"].as_str().unwrap().split(' ').skip(1).collect();
    assert!(repeat.contains(&"--error") && metadata["repeat"] == banded["repeat"], "{banded}");
    let again = report(folder.path(), Some(SIXTEEN_ROWS), &[&repeat[..], &["-o", "y.exr"]].concat());
    assert_eq!(again["bands"], banded["bands"]);
    assert!(exr_of(&folder.path().join("y.exr")).0 == film, "another film");
    let samples = report(
        folder.path(),
        Some(SIXTEEN_ROWS),
        &["render", &scene, "--error", "1e-9", "--spp", "2", "--size", "64x64", "-o", "x.json"],
    );
    assert_eq!((&samples["ended_by"], rows(&samples)[3]), (&json!("samples"), [48, 64, 2]));
}

#[test]
fn bands_share_the_time_and_each_has_a_sample() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let timed = |seconds: &str| {
        let arguments = ["render", &scene, "--time", seconds, "--size", "64x64", "-o", "x.json"];
        report(folder.path(), Some(SIXTEEN_ROWS), &arguments)
    };
    // So short that all of it is over before the first band is: none is left out.
    let short = timed("0.001");
    assert!(rows(&short).len() == 4 && rows(&short).iter().all(|[.., spp]| *spp >= 1), "{short}");
    assert_eq!((&short["ended_by"], &short["interrupted"]), (&json!("time"), &json!(false)));
    let long = timed("6");
    let samples: Vec<u64> = rows(&long).iter().map(|[.., spp]| *spp).collect();
    let [least, most] = [samples.iter().min().unwrap(), samples.iter().max().unwrap()];
    // Compiling is on the first one's time; the others are alike.
    assert!(
        samples.len() == 4 && *most > 8 && samples[1..].iter().all(|spp| *spp * 20 > *most),
        "{least}: {samples:?}"
    );
    let traced = long["seconds"]["trace"].as_f64().unwrap();
    assert!(traced < 12.0, "{traced}");
}

#[test]
fn what_is_told_names_the_bands() {
    let (folder, scene) = (tempfile::tempdir().unwrap(), scene("cornell-data"));
    let arguments = ["render", &scene, "--spp", "1", "--size", "64x64", "-o", "x.png", "--stats"];
    let run = lucerna(folder.path(), Some(SIXTEEN_ROWS), &arguments);
    let out = String::from_utf8(run.stdout).unwrap();
    assert!(run.status.success() && out.contains("traced in 4 bands of rows"), "{out}");
    let whole = lucerna(folder.path(), None, &arguments);
    let out = String::from_utf8(whole.stdout).unwrap();
    assert!(whole.status.success() && !out.contains("bands"), "{out}");
}
