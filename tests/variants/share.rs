//! What members share: each thing is done once, and each film is that of its scene alone.

use std::collections::BTreeMap;
use std::path::Path;

use lucerna::image::PictureFile;
use lucerna::scene::Assets;
use lucerna::scene::variants::plan;

use super::{answer, folder, member, run};
use crate::support::families::{alone, bits, done};

/// Numbers of a material, cameras and samplers: 18 members.
const SWEEP: &str = r#"(
    extends: "a.ron",
    sweep: {
        "materials.grey.ns": [5, 50, 500],
        "camera": ["front", "left", "near"],
        "render.sampler": [Sobol, Pcg],
    },
)
"#;

#[test]
fn a_sweep_does_each_thing_once_and_members_are_as_alone() {
    let folder = folder(SWEEP);
    let answer = answer(folder.path(), &["--out", "out"], 0);
    assert_eq!(done(&answer).len(), 18);

    let (mut read, mut trees, mut compiled, mut triangles) = (0, 0, BTreeMap::new(), 0);
    for record in &answer.records {
        read += record.work.read;
        trees += record.work.trees;
        triangles += u32::from(record.work.uploaded.contains_key("triangles"));
        for (pass, count) in &record.work.compiled {
            *compiled.entry(pass.as_str()).or_insert(0) += count;
        }
    }
    assert_eq!((read, trees, triangles), (3, 1, 1), "a.ron, a.obj and a.mtl");
    // The kernel has another code for each sampler; all else has one.
    assert_eq!(compiled.remove("path"), Some(2));
    assert!(compiled.values().all(|count| *count == 1), "{compiled:?}");

    let family = plan(&folder.path().join("fam.ron"), &[], &Assets::new()).unwrap();
    for of in &family.members {
        let file = folder.path().join("out/fam/members").join(format!("{}.exr", of.name));
        let pixels = PictureFile::open(&file).unwrap().read_all().unwrap();
        assert_eq!(bits(&pixels), alone(&folder.path().join("a.ron"), &of.defines), "{}", of.name);
    }
}

/// Members that differ in their exposure share a film, and pictures differ.
#[test]
fn exposures_share_a_film() {
    let folder = folder(r#"(extends: "a.ron", sweep: {"film.exposure": [0, 2]}, goal: (spp: [2, 8]))"#);
    let answer = answer(folder.path(), &["--out", "out"], 0);
    let [first, second] = &answer.records[..] else { panic!("two members") };
    assert_eq!(second.film_of.as_ref(), Some(&first.name));
    assert_eq!((&first.snapshots, first.film_of.is_none()), (&second.snapshots, true));
    assert!(second.work.uploaded.keys().all(|name| name == "params"), "{:?}", second.work);
    let file = |name: &str, ending: &str| {
        std::fs::read(folder.path().join("out/fam/members").join(format!("{name}.{ending}"))).unwrap()
    };
    assert_ne!(file(&first.name, "png"), file(&second.name, "png"));
    let pixels = |name: &str| {
        let path = folder.path().join("out/fam/members").join(format!("{name}.exr"));
        bits(&PictureFile::open(&path).unwrap().read_all().unwrap())
    };
    assert_eq!(pixels(&first.name), pixels(&second.name));
}

/// Two folders of the same shaders are one code; a folder of others is another, and keeps the tree.
#[test]
fn folders_of_shaders_keep_the_tree() {
    let folder = folder(
        r#"(extends: "a.ron", members: {"same": {"shaders": "one"}, "other": {"shaders": "two"}, "again": {"shaders": "one"}})"#,
    );
    for name in ["one", "two"] {
        crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), &folder.path().join(name));
    }
    let path = folder.path().join("two/passes/trace/path.wgsl");
    let text = std::fs::read_to_string(&path).unwrap();
    let brighter = text.replace("(*state).radiance += light;", "(*state).radiance += 2.0 * light;");
    assert_ne!(text, brighter);
    std::fs::write(&path, brighter).unwrap();
    let answer = answer(folder.path(), &["--out", "out"], 0);
    assert_eq!(answer.records.iter().map(|record| record.work.trees).sum::<u64>(), 1);
    let [same, other, again] = ["same", "other", "again"].map(|name| member(&answer, name));
    assert!((other.mean[0] / same.mean[0] - 2.0).abs() < 1e-3 && same.mean == again.mean);
    assert!(again.work.compiled.is_empty());
}

#[test]
fn folders_of_shaders_are_laid_over_the_shipped_ones_and_values_set() {
    let family = r#"(extends: "a.ron", overrides: { "shaders": "bright" },
        members: { "1": {}, "2": { "shader.TWICE": 2 }, "4": { "shader.TWICE": 4 }, "shipped": { "shaders": None } })"#;
    let folder = folder(family);
    let path = std::fs::read_to_string("shaders/passes/trace/path.wgsl").unwrap();
    let (right, wrong) = ("(*state).radiance += light;", "(*state).radiance += TWICE * light;");
    let head = "@compute @workgroup_size(8, 8)";
    assert!(path.contains(right) && path.contains(head));
    let text = path.replace(right, wrong).replace(head, &format!("override TWICE: f32 = 1.0;\n\n{head}"));
    std::fs::create_dir_all(folder.path().join("bright/passes/trace")).unwrap();
    std::fs::write(folder.path().join("bright/passes/trace/path.wgsl"), text).unwrap();
    let shaders = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let answer = answer(folder.path(), &["--shaders", shaders.to_str().unwrap()], 0);
    let mean = |name: &str| member(&answer, name).mean[0];
    assert!((mean("2") / mean("1") - 2.0).abs() < 1e-3, "{} {}", mean("1"), mean("2"));
    assert!((mean("4") / mean("1") - 4.0).abs() < 1e-3);
    assert_eq!(mean("shipped"), mean("1"));
    // What is to be repeated is all of it.
    let again = &member(&answer, "2").repeat;
    assert!(again.starts_with("lucerna variants fam.ron --only 2 --shaders "), "{again}");
    assert!(member(&answer, "shipped").repeat.contains("--shaders "));

    std::fs::write(
        folder.path().join("fam.ron"),
        r#"(extends: "a.ron", sweep: { "shader.THRICE": [1, 2] }, overrides: { "shaders": "bright" })"#,
    )
    .unwrap();
    let run = run(folder.path(), &["--list"]);
    let said = String::from_utf8_lossy(&run.stderr).into_owned() + &String::from_utf8_lossy(&run.stdout);
    assert!(said.contains("override THRICE"), "{said}");
}
