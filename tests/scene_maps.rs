//! Maps in scene files, and by `-D`.

use std::path::Path;

use glam::{Vec2, Vec3};
use lucerna::components::{Channel, Wrap};
use lucerna::scene::{Define, Diagnostics, Loaded, MtlMaterial, load};

use crate::mtl_maps::write_picture;

const MTL: &str = "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd wood.png\nnewmtl b\nmap_Ke wood.png\n";

/// A scene of a model below `models`, whose material `a` has a map, with pictures here and there.
fn load_scene(materials: &str, defines: &[(&str, &str)]) -> Result<Loaded, Diagnostics> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    ["models/wood.png", "oak.png", "Ash.png"].iter().for_each(|picture| write_picture(&folder.path().join(picture)));
    write("models/m.mtl", MTL);
    write(
        "models/m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n",
    );
    write(
        "s.ron",
        &format!("(environment: Constant(1), models: [(path: \"models/m.obj\")], materials: {{\n{materials}\n}})"),
    );
    let defines: Vec<_> = defines.iter().map(|(path, value)| Define::given(*path, *value)).collect();
    load(&folder.path().join("s.ron"), &defines)
}

fn material(materials: &str, defines: &[(&str, &str)]) -> MtlMaterial {
    let loaded = load_scene(materials, defines).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(loaded.warnings, []);
    loaded.description.materials["m:a"].clone()
}

fn file(material: &MtlMaterial) -> &str {
    let map = material.maps.kd.as_ref().expect("a map");
    map.file.file_name().and_then(|name| name.to_str()).expect("a name")
}

#[test]
fn a_scene_file_gives_exchanges_and_takes_away_maps() {
    assert_eq!(file(&material("", &[])), "wood.png");
    let exchanged = material("\"a\": (map_kd: \"oak.png\")", &[]);
    assert_eq!((file(&exchanged), exchanged.kd), ("oak.png", Vec3::splat(0.5)));
    for off in ["None", "Off"] {
        let none = material(&format!("\"a\": (map_kd: {off})"), &[]);
        assert_eq!((none.maps.kd, none.kd), (None, Vec3::splat(0.5)), "{off}");
    }
    let all = material(
        "\"a\": (map_ks: (file: \"oak.png\", scale: (2, 3), offset: (0.5, -1), clamp: (true, false), gain: 2, base: -1),
         map_d: (file: \"oak.png\", scale: 4, clamp: true, channel: Alpha), map_pr: \"oak.png\", map_pm: \"oak.png\",
         map_ns: \"oak.png\", map_ke: \"oak.png\", norm: (file: \"oak.png\", flip_green: true), bump: (file: \"oak.png\", bump: 0.5))",
        &[],
    );
    let ks = all.maps.ks.expect("a map");
    assert_eq!(
        (ks.scale, ks.offset, ks.wrap),
        (Vec2::new(2.0, 3.0), Vec2::new(0.5, -1.0), [Wrap::Clamp, Wrap::Repeat])
    );
    assert_eq!((ks.gain, ks.base), (2.0, -1.0));
    let d = all.maps.d.expect("a map");
    assert_eq!((d.scale, d.wrap, d.channel), (Vec2::splat(4.0), [Wrap::Clamp; 2], Some(Channel::Alpha)));
    assert!(all.maps.norm.expect("a map").flip_green);
    assert_eq!(all.maps.bump.expect("a map").bump, 0.5);
    // Numbers that were not given are 1 with their maps.
    assert_eq!((all.ks, all.ke, all.pr, all.pm), (Vec3::ONE, Vec3::ONE, Some(1.0), 1.0));
    let given = material("\"a\": (map_ks: \"oak.png\", ks: 0.25, map_ke: \"oak.png\", ke: 0)", &[]);
    assert_eq!((given.ks, given.ke), (Vec3::splat(0.25), Vec3::ZERO));
}

#[test]
fn a_map_that_counts_alone_leaves_the_default_behind() {
    let loaded = load_scene("\"b\": (map_ke: None)", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(loaded.description.materials["m:b"].ke, Vec3::ZERO);
    let loaded = load_scene("\"b\": (map_ke: (scale: 2))", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let b = &loaded.description.materials["m:b"];
    assert_eq!((b.ke, b.maps.ke.as_ref().map(|map| map.scale)), (Vec3::ONE, Some(Vec2::splat(2.0))));
}

#[test]
fn a_define_reaches_maps_and_what_is_in_them() {
    let scale = |material: &MtlMaterial| material.maps.kd.as_ref().expect("a map").scale;
    assert_eq!(file(&material("", &[("materials.a.map_kd", "\"oak.png\"")])), "oak.png");
    assert_eq!(material("", &[("materials.a.map_kd", "None")]).maps.kd, None);
    // Of the library's map, of one in the scene file, and of one that is a plain file there.
    let scaled = material("", &[("materials.a.map_kd.scale", "(3, 4)")]);
    assert_eq!((file(&scaled), scale(&scaled)), ("wood.png", Vec2::new(3.0, 4.0)));
    for scene in ["\"a\": (map_kd: (file: \"oak.png\", scale: 2))", "\"a\": (map_kd: \"oak.png\")"] {
        let scaled = material(scene, &[("materials.a.map_kd.scale", "5")]);
        assert_eq!((file(&scaled), scale(&scaled)), ("oak.png", Vec2::splat(5.0)), "{scene}");
    }
}

/// What stands in `materials`, on the second line; the column of the error, and a part of it.
const WRONG: &[(&str, u32, &str)] = &[
    ("\"a\": (map_kd: \"aok.png\")", 15, "did you mean `oak.png`?"),
    ("\"a\": (map_kd: \"no/where.png\")", 15, "relative to the folder of the scene file"),
    ("\"a\": (map_kd: (file: \"oka.png\"))", 22, "there is no image"),
    ("\"a\": (map_kd: (file: \"oak.png\", scael: 2))", 33, "unknown field `materials.a.map_kd.scael`"),
    ("\"a\": (map_kd: (file: \"oak.png\", scael: 2))", 33, "did you mean `scale`?"),
    ("\"a\": (map_kd: (file: \"oak.png\", xyz: 2))", 33, "known fields: file, scale, offset, clamp, gain, base"),
    ("\"a\": (map_d: (file: \"oak.png\", channel: Rde))", 41, "expected Red or Green or Blue or Alpha or Luminance"),
    ("\"a\": (map_kd: (file: \"oak.png\", channel: Red))", 33, "unknown field `materials.a.map_kd.channel`"),
    ("\"a\": (map_kd: (file: \"oak.png\", scale: (1, 2, 3)))", 40, "expected 2 numbers in parentheses"),
    ("\"a\": (map_kd: (file: \"oak.png\", clamp: 1))", 40, "expected true or false"),
    ("\"a\": (map_kd: (file: \"oak.png\", gain: 1e9))", 39, "expected a number from -1000000 to 1000000"),
    ("\"a\": (norm: (file: \"oak.png\", flip_green: 1))", 43, "expected true or false"),
    ("\"a\": (map_kd: 3)", 15, "expected \"wood.png\", (file: \"wood.png\", ..) or None, found `3`"),
    ("\"a\": (map_kd: (file: \"\"))", 22, "found an empty string"),
    ("\"a\": (map_ks: (scale: 2))", 15, "there is no `map_ks` that this could change"),
    ("\"a\": (map_dk: \"oak.png\")", 7, "unknown field `materials.a.map_dk`"),
];

#[test]
fn wrong_maps_are_told_at_their_place() {
    for (text, column, message) in WRONG {
        let Err(errors) = load_scene(text, &[]) else { panic!("taken: {text}") };
        let found = &errors.list[0];
        assert!(found.to_string().contains(message), "{text}\n{found}");
        assert_eq!((found.line, found.column), (2, *column), "{found}");
    }
    let Err(errors) = load_scene("", &[("materials.a.map_kd", "\"oek.png\"")]) else { panic!("taken") };
    assert_eq!((errors.list[0].file.as_path(), errors.list[0].line), (Path::new("-D"), 1), "{errors}");
    // As a shell hands it over.
    let Err(errors) = load_scene("", &[("materials.a.map_kd", "oak.png")]) else { panic!("taken") };
    assert!(
        errors.to_string().contains("double quotes; for a shell, with single ones around: '\"oak.png\"'"),
        "{errors}"
    );
}

#[test]
fn a_file_in_other_letters_is_found_and_told() {
    let loaded = load_scene("\"a\": (map_kd: \"ash.png\")", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(
        loaded.warnings[0].to_string().contains("s.ron:2:15: warning: there is no `ash.png`"),
        "{:?}",
        loaded.warnings
    );
    assert_eq!(file(&loaded.description.materials["m:a"]), "Ash.png");
}
