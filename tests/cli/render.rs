//! What a render writes, and what flags change in it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use super::{folder_with, lucerna, names, rendered};

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
    let seconds = |key: &str| report["seconds"][key].as_f64().unwrap_or_else(|| panic!("no seconds.{key}"));
    let phases = ["load", "extract", "compile", "build", "trace", "estimate", "read"].map(seconds);
    assert!(phases.iter().all(|seconds| *seconds >= 0.0) && seconds("start") > 0.0);
    // The device is opened beside all that.
    assert!(phases.iter().sum::<f64>() <= seconds("total") && seconds("start") <= seconds("total"), "{report}");
    assert!(seconds("compile") > 0.0 && seconds("read") > 0.0);
    for picture in ["png", "exr"] {
        let name = Path::new("result").join(format!("a.{picture}")).display().to_string();
        assert!(report["seconds"]["write"][&name].as_f64().is_some_and(|seconds| seconds > 0.0), "{report}");
    }
    let compiled = report["compiled"].as_array().unwrap().iter().find(|pass| pass["name"] == "path").unwrap();
    assert_eq!(compiled["count"], 1);
    assert!(compiled["link_milliseconds"].as_f64().unwrap() > 0.0);
    assert_eq!(report["scene"], "a");
    assert_eq!(report["size"], serde_json::json!([20, 12]));
    assert_eq!((&report["spp"], &report["triangles"], &report["nodes"]), (&2.into(), &1.into(), &0.into()));
    assert_eq!(report["samples"], 20 * 12 * 2);
    assert!(report["rays"].as_u64().unwrap() >= 20 * 12 * 2);
    assert_eq!((&report["bad_samples"], &report["full_halves"]), (&0.into(), &0.into()));
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
fn an_exporters_illum_of_glass_hides_nothing() {
    let folder = folder_with("", b"");
    let mean = |mtl: &str| {
        std::fs::write(folder.path().join("a.mtl"), format!("newmtl grey\nKd 0.5 0.5 0.5\n{mtl}")).unwrap();
        rendered(folder.path(), &["-o", "x.json"])["mean"].clone()
    };
    let matte = mean("");
    for mtl in ["illum 4\nKa 0 0 0\nTf 1.00 1.00 1.00\nNi 1.00\n", "illum 7\n", "Tr 1\n", "illum 9\nTr 1\nNi 1\n"] {
        assert_eq!(mean(mtl), matte, "{mtl}");
    }
    assert_ne!(mean("illum 7\nNi 1.5\n"), matte);
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_there_is() {
    use std::io::Read;
    use std::time::Duration;
    let folder = folder_with("", b"");
    // Told too early, there is nothing to write yet: how long the start takes, the machine decides.
    let (code, out) = [3, 6, 12, 24, 48, 96, 192]
        .into_iter()
        .find_map(|seconds| {
            let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
                .args(["render", "a.ron", "--time", "600", "--json", "--quiet", "-o", "x.exr", "-o", "x.json"])
                .current_dir(folder.path())
                .stdout(Stdio::piped())
                .spawn()
                .unwrap();
            std::thread::sleep(Duration::from_secs(seconds));
            assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
            let mut out = String::new();
            child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
            let code = child.wait().unwrap().code();
            (!out.is_empty()).then_some((code, out))
        })
        .expect("a render has samples after three minutes");
    assert_eq!(code, Some(130));
    let report: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(report["interrupted"], true);
    assert!(report["samples"].as_u64().unwrap() > 0);
    assert_eq!(names(folder.path()), ["a.mtl", "a.obj", "a.ron", "x.exr", "x.json"]);
    assert_eq!(exr_of(&folder.path().join("x.exr")).len(), 20 * 12);
}
