//! `lucerna replay`: what it prints, and folders that give the same again.

use std::path::Path;

use serde_json::Value;

use super::{folder_with, lucerna, refused};

/// What a run printed, as JSON.
fn json(folder: &Path, arguments: &[&str]) -> Value {
    let run = lucerna(folder, arguments);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{arguments:?} said:\n{said}");
    serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {:?}", run.stdout))
}

/// The words of a command line behind the program's name. Nothing here needs quotes.
fn words(line: &str) -> Vec<&str> {
    line.strip_prefix("lucerna ").unwrap().split(' ').collect()
}

#[test]
fn a_path_is_told_vertex_by_vertex_in_100_columns() {
    let folder = folder_with("", b"");
    let run = lucerna(folder.path(), &["replay", "a.ron", "--pixel", "10,6", "--sample", "3"]);
    let out = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(out.starts_with("a: pixel 10,6 of 20x12, sample 3, seed 0: 2 rays\n"), "{out}");
    for part in [
        "vertex 1: ",
        "(material a:grey), triangle 0",
        "vertex 2: nothing",
        "drawn direction",
        "oracle: t ",
        "agree to",
    ] {
        assert!(out.contains(part), "no `{part}`:\n{out}");
    }
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
}

#[test]
fn a_bundle_gives_the_same_numbers() {
    let folder = folder_with("", b"");
    let first = json(
        folder.path(),
        &["replay", "a.ron", "--pixel", "9,5", "--sample", "7", "--seed", "4", "--json", "-q", "--bundle", "out"],
    );
    let out = folder.path().join("out");
    let readme = std::fs::read_to_string(out.join("README.md")).unwrap();
    let line = readme.lines().find(|line| line.starts_with("lucerna replay ")).unwrap();
    // It is elsewhere, and what it was made of is gone.
    let elsewhere = tempfile::tempdir().unwrap();
    let moved = elsewhere.path().join("moved");
    std::fs::rename(&out, &moved).unwrap_or_else(|_| copy(&out, &moved));
    drop(folder);
    let mut again = words(line);
    again.extend(["--json", "-q"]);
    let second = json(&moved, &again);
    for part in ["turns", "radiance", "film", "rays", "parting", "seed", "size"] {
        assert_eq!(first[part], second[part], "{part}");
    }
    assert!(first["turns"].as_array().unwrap().len() >= 2 && first["agrees"] == true, "{first}");
    assert_eq!(first["exact"], true);
    let said = refused(2, elsewhere.path(), &["replay", "moved/scene/a.ron", "--pixel", "1,1", "--bundle", "moved"]);
    assert!(said.contains("moved: is there already") && said.contains("--bundle DIR"), "{said}");
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(|entry| entry.unwrap().path()) {
        let place = to.join(entry.file_name().unwrap());
        if entry.is_dir() { copy(&entry, &place) } else { std::fs::copy(&entry, &place).map(drop).unwrap() }
    }
}

#[test]
fn what_is_no_pixel_is_refused() {
    let folder = folder_with("", b"");
    let said = refused(2, folder.path(), &["replay", "a.ron", "--pixel", "20,3"]);
    assert!(said.contains("--pixel 20,3 is outside of the picture of 20x12"), "{said}");
    for wrong in ["3", "3,", "-1,2", "a,b", "1.5,2"] {
        let said = refused(2, folder.path(), &["replay", "a.ron", "--pixel", wrong]);
        assert!(said.contains("counted from 0"), "{wrong}: {said}");
    }
}

/// A shader that gives NaN at one material: every bad sample of the render names the line that shows it, and the line names the vertex, the
/// material and the first number that is none.
#[test]
fn bad_samples_are_replayed_by_their_lines() {
    let scene = br#"(
        models: [(path: "a.obj")],
        cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40) },
        film: (size: (12, 8)), render: (spp: 2, max_depth: 3), environment: Constant((1, 1, 1)),
        materials: { "grey": (kd: (0.5, 0.5, 0.5)), "broken": (kd: (0.25, 0.5, 0.5)) },
    )"#;
    let folder = folder_with("a.ron", scene);
    let obj = "mtllib a.mtl\no left\nusemtl grey\nv -1 -1 0\nv 0 -1 0\nv 0 1 0\nf 1 2 3\no right\nusemtl broken\nv 1 1 0\nf 2 4 3\n";
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    std::fs::write(folder.path().join("a.mtl"), "newmtl grey\nKd 1 1 1\nnewmtl broken\nKd 1 1 1\n").unwrap();
    let shaders = folder.path().join("broken");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &shaders);
    let mixture = shaders.join("lib/bsdf/mixture.wgsl");
    let text = std::fs::read_to_string(&mixture).unwrap();
    let nan = "select(m.kd, vec3<f32>(bitcast<f32>(0x7fc00000u + m.flags)), m.kd.x < 0.3), at.pdf > 0.0";
    assert!(text.contains("m.kd, at.pdf > 0.0"), "mixture has changed: plant the error elsewhere");
    std::fs::write(&mixture, text.replace("m.kd, at.pdf > 0.0", nan)).unwrap();

    let render = ["render", "a.ron", "--shaders", "broken", "--json", "-o", "a.exr"];
    let run = lucerna(folder.path(), &render);
    let report: Value = serde_json::from_slice(&run.stdout).unwrap();
    let (count, log) = (report["bad_samples"].as_u64().unwrap(), report["bad_log"].as_array().unwrap());
    assert!(count >= 2 && log.len() as u64 == count, "all are kept: {report}");
    let said = String::from_utf8(run.stderr).unwrap();
    let line = log[0]["replay"].as_str().unwrap();
    assert!(said.contains(line), "{said}\n{line}");
    let mut order: Vec<_> =
        log.iter().map(|bad| (bad["sample"].as_u64(), bad["pixel"][1].as_u64(), bad["pixel"][0].as_u64())).collect();
    let listed = order.clone();
    order.sort();
    assert_eq!(listed, order);

    let mut again = words(line);
    again.extend(["--json", "-q"]);
    let told = json(folder.path(), &again);
    assert_eq!((&told["film"]["bad"], &told["film"]["vertex"]), (&"NaN".into(), &1.into()), "{told}");
    let parting = &told["parting"];
    assert_eq!((&parting["what"], &parting["vertex"]), (&"drawn weight".into(), &1.into()), "{parting}");
    assert_eq!((&parting["gpu"][0], &parting["why"]), (&"NaN".into(), &"the GPU's is no number".into()));
    assert_eq!(told["explained"], false);
    assert!(told["turns"][0]["material"].as_str().unwrap().contains("broken"), "{told}");
    let text = lucerna(folder.path(), &words(line));
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("none: a bad sample, NaN, at vertex 1") && text.contains("drawn weight"), "{text}");
}
