//! What variant files say, and what members come to.

use lucerna::scene::variants::{Chosen, Goal, Member, is_family, plan};
use lucerna::scene::{Assets, Define, attempt_in};

use super::planning::{LIBRARY, MODEL, SCENE, folder, load_all, planned, shipped, with_family};

fn names(text: &str) -> Vec<String> {
    let folder = with_family(text);
    let family = planned(folder.path()).unwrap_or_else(|found| panic!("{found:?}"));
    family.members.into_iter().map(|member| member.name).collect()
}

#[test]
fn every_shipped_family_can_be_loaded() {
    let files = shipped();
    assert!(files.len() >= 6);
    for path in files {
        let assets = Assets::new();
        assert!(is_family(&path, &assets));
        let family = plan(&path, &[], &assets).unwrap_or_else(|found| panic!("{found:?}"));
        assert!((2..=12).contains(&family.members.len()), "{}: {}", family.name, family.members.len());
        for member in &family.members {
            let (loaded, _) = attempt_in(&family.scene, &member.defines, false, &Default::default(), &assets);
            let loaded = loaded.unwrap_or_else(|found| panic!("{}, {}: {found:?}", family.name, member.name));
            assert!(loaded.warnings.is_empty(), "{}, {}: {:?}", family.name, member.name, loaded.warnings);
        }
        let reads = assets.reads();
        assert!(reads.len() > 3 && reads.values().all(|count| *count == 1), "{reads:?}");
    }
}

#[test]
fn a_sweep_goes_over_its_grid_and_the_last_axis_is_fastest() {
    let text = r#"(extends: "a.ron", sweep: { "materials.a.ns": [10, 100], "camera": ["front", "side"] })"#;
    assert_eq!(names(text), ["10_front", "10_side", "100_front", "100_side"]);
    let folder = with_family(text);
    let family = planned(folder.path()).unwrap();
    assert_eq!(family.members[1].at, [0, 1]);
    assert_eq!(family.axes[1].labels, ["front", "side"]);
    let assets = Assets::new();
    let (loaded, files) = attempt_in(&family.scene, &family.members[3].defines, false, &Default::default(), &assets);
    let loaded = loaded.unwrap();
    assert_eq!(loaded.description.active, "side");
    assert!(files.len() >= 3);
}

#[test]
fn steps_are_even_or_of_one_factor() {
    let of = |values: &str| names(&format!(r#"(extends: "a.ron", sweep: {{ "materials.a.ns": {values} }})"#));
    assert_eq!(of("range(1, 2, 5)"), ["1", "1.25", "1.5", "1.75", "2"]);
    assert_eq!(of("log(1, 1000, 4)"), ["1", "10", "100", "1000"]);
    assert_eq!(of("range(3, 9, 1)"), ["3"]);
    assert_eq!(of(r#"named({ "dull": 4, "bright": 400 })"#), ["dull", "bright"]);
    // As many digits as keep them apart.
    assert_eq!(of("range(1, 1.0002, 3)"), ["1", "1.0001", "1.0002"]);
    // Names are short, values as they were written.
    assert_eq!(of("range(1024, 4096, 4)"), ["1024", "2048", "3072", "4096"]);
    let folder = with_family(r#"(extends: "a.ron", sweep: { "materials.a.ns": range(0.12345, 0.15, 3) })"#);
    let family = planned(folder.path()).unwrap();
    let swept: Vec<_> = family.members.iter().map(|member| (&*member.name, &*member.defines[0].value)).collect();
    assert_eq!(swept, [("0.123", "0.12345"), ("0.137", "0.136725"), ("0.15", "0.15")]);
}

#[test]
fn a_long_name_is_one_by_hand_and_is_cut_where_it_is_a_part() {
    let long = "a".repeat(60);
    let text = format!(
        r#"(extends: "a.ron", sweep: {{ "materials.a.ns": named({{ "{long}": 3 }}) }}, members: {{ "{long}": {{}} }})"#
    );
    assert_eq!(names(&text), ["a".repeat(40), long]);
}

#[test]
fn members_may_have_scenes_of_their_own() {
    let other = SCENE.replace("max_depth: 3", "max_depth: 5");
    let folder = folder(&[
        ("a.ron", SCENE),
        ("a.obj", MODEL),
        ("a.mtl", LIBRARY),
        ("b.ron", &other),
        ("v.ron", r#"(extends: "a.ron", sweep: { "scene": ["a.ron", "b.ron"] }, overrides: { "film.exposure": 1 })"#),
    ]);
    let family = planned(folder.path()).unwrap();
    let depth = |member: &Member| {
        let load = attempt_in(family.scene_of(member), &member.defines, false, &Default::default(), &Assets::new()).0;
        let scene = load.unwrap().description;
        (member.name.clone(), scene.render.max_depth, scene.film.exposure)
    };
    let all: Vec<_> = family.members.iter().map(depth).collect();
    assert_eq!(all, [("a.ron".to_owned(), 3, 1.0), ("b.ron".to_owned(), 5, 1.0)]);
    let folder = with_family(r#"(extends: "a.ron", members: { "m": { "scene": "c.ron" } })"#);
    let family = planned(folder.path()).unwrap();
    let wrong = load_all(&family).remove(0).1.unwrap()[0].to_string();
    assert!(wrong.contains("v.ron:1:") && wrong.contains("scene: there is no file"), "{wrong}");
}

#[test]
fn what_is_zipped_changes_together() {
    let text = r#"(extends: "a.ron", sweep: { "look": zip({
        "materials.a.ns": [10, 20, 30], "film.exposure": [0, 0, 1] }) }, members: { "by-hand": { "film.exposure": 3 } })"#;
    assert_eq!(names(text), ["10", "20", "30", "by-hand"]);
    let folder = with_family(text);
    let family = planned(folder.path()).unwrap();
    assert_eq!(family.axes[0].paths, ["materials.a.ns", "film.exposure"]);
    let paths: Vec<_> = family.members[2].defines.iter().map(|d| (d.path.as_str(), d.value.as_str())).collect();
    assert_eq!(paths, [("materials.a.ns", "30"), ("film.exposure", "1")]);
    assert!(family.members[3].at.is_empty());
}

#[test]
fn paths_are_relative_to_the_file_that_writes_them() {
    let scene = SCENE.replace("a.obj", "../models/a.obj");
    let other = MODEL.replace("v 0 1 0", "v 0 2 0");
    let folder = folder(&[
        ("scenes/a.ron", &scene),
        ("models/a.obj", MODEL),
        ("models/a.mtl", LIBRARY),
        ("variants/b.obj", &other),
        ("variants/a.mtl", LIBRARY),
        ("variants/more/lattice/x.wgsl", ""),
        (
            "variants/base.ron",
            r#"(extends: "../scenes/a.ron", overrides: { "film.exposure": 2 }, sweep: { "models.0.path": ["b.obj"] })"#,
        ),
        (
            "variants/more/v.ron",
            r#"(extends: "../base.ron", overrides: { "render.spp": 7 }, sweep: { "shaders": ["lattice"] }, members: {"m": {}})"#,
        ),
    ]);
    let path = folder.path().join("variants/more/v.ron");
    let family = plan(&path, &[Define::given("render.seed", "5")], &Assets::new()).unwrap();
    assert_eq!(family.files.len(), 2);
    let member = &family.members[0];
    assert_eq!(member.name, "b.obj_lattice");
    assert!(member.shaders.as_ref().unwrap().ends_with("variants/more/lattice"), "{:?}", member.shaders);
    let (loaded, files) = attempt_in(&family.scene, &member.defines, false, &Default::default(), &Assets::new());
    let description = loaded.unwrap_or_else(|found| panic!("{found:?}")).description;
    assert_eq!((description.film.exposure, description.render.spp, description.render.seed), (2.0, 7, 5));
    assert!(files.iter().any(|file| file.ends_with("../b.obj")), "{files:?}");
    assert_eq!(description.meshes.values().next().unwrap().geometry.positions[2].y, 2.0);
    assert_eq!(family.members[1].name, "m");
}

#[test]
fn goals_and_references_are_read() {
    let of = |text: &str| {
        let text = format!(r#"(extends: "a.ron", sweep: {{ "film.exposure": [0, 1] }}, {text})"#);
        let folder = with_family(&text);
        let family = planned(folder.path()).unwrap();
        (family.goal, family.reference)
    };
    assert_eq!(of("goal: (spp: 16)").0, Some(Goal::Samples(vec![16])));
    assert_eq!(of("goal: (time: [0.5, 2])").0, Some(Goal::Seconds(vec![0.5, 2.0])));
    assert_eq!(of("goal: (error: 1e-3)").0, Some(Goal::Error(1e-3)));
    assert_eq!(of(r#"reference: "1""#).1, Some(Chosen { member: "1".into(), spp: None }));
    assert_eq!(of(r#"reference: (member: "0", spp: 9)"#).1, Some(Chosen { member: "0".into(), spp: Some(9) }));
}

#[test]
fn files_are_read_once_for_all_members() {
    let folder =
        with_family(r#"(extends: "a.ron", sweep: { "materials.a.ns": range(1, 50, 6), "camera": ["front", "side"] })"#);
    let assets = Assets::new();
    let family = plan(&folder.path().join("v.ron"), &[], &assets).unwrap();
    for member in &family.members {
        attempt_in(&family.scene, &member.defines, false, &Default::default(), &assets).0.unwrap();
    }
    let reads = assets.reads();
    assert!(reads.len() == 4 && reads.values().all(|count| *count == 1), "{reads:?}");
    assert!(load_all(&family).iter().all(|(_, errors)| errors.is_none()));
}
