//! Maps of MTL files: names, options, the numbers that they multiply, and a located warning for what is not honoured.

use std::path::Path;

use glam::{Vec2, Vec3};
use lucerna::components::{Channel, Wrap};
use lucerna::scene::{Diagnostic, MtlMaterial, TextureMap, check, load};

/// Pictures beside the library, and below its folder.
const PICTURES: &[&str] =
    &["wood.png", "there is one.png", "a #1.png", "Case.PNG", "9.png", "x -s 2.png", "textures/deep.png"];

/// Writes a picture of one texel.
pub fn write_picture(path: &Path) {
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    let mut encoder = png::Encoder::new(std::fs::File::create(path).expect("a file"), 1, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().expect("a header").write_image_data(&[90, 120, 150, 200]).expect("a texel");
}

/// A folder with pictures and a library of these statements, which a model uses.
fn folder(name: &str, mtl: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    PICTURES.iter().for_each(|picture| write_picture(&folder.path().join(picture)));
    let obj =
        format!("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl {name}\nf 1/1 2/2 3/3\n");
    std::fs::write(folder.path().join("m.obj"), obj).expect("a file");
    std::fs::write(folder.path().join("m.mtl"), mtl).expect("a file");
    folder
}

fn read(statements: &str) -> (MtlMaterial, Vec<Diagnostic>) {
    read_named("a", &format!("newmtl a\n{statements}\n"))
}

fn read_named(name: &str, mtl: &str) -> (MtlMaterial, Vec<Diagnostic>) {
    let folder = folder(name, mtl);
    let loaded = load(&folder.path().join("m.obj"), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    (loaded.description.materials[&format!("m:{name}")].clone(), loaded.warnings)
}

/// The map of one statement's options and name, without warnings.
fn map(text: &str) -> TextureMap {
    let (material, warnings) = read(&format!("Kd 1 1 1\nmap_Kd {text}"));
    assert_eq!(warnings, [], "{text}");
    material.maps.kd.unwrap_or_else(|| panic!("{text}"))
}

#[test]
fn names_may_have_spaces_quotes_signs_and_folders() {
    for (text, file) in [
        ("wood.png", "wood.png"),
        ("  wood.png  ", "wood.png"),
        ("there is one.png", "there is one.png"),
        ("\"there is one.png\"", "there is one.png"),
        ("a #1.png", "a #1.png"),
        ("a #1.png # the first", "a #1.png"),
        ("wood.png # of the table", "wood.png"),
        (".\\textures\\deep.png", "textures/deep.png"),
        ("textures/deep.png", "textures/deep.png"),
        ("9.png", "9.png"),
        ("-s 2 2 9.png", "9.png"),
        ("x -s 2.png", "x -s 2.png"),
        ("\"wood.png\" -s 2 2", "wood.png"),
        ("wood.png -s 2 2 1 # twice", "wood.png"),
        ("there\\ is\\ one.png", "there is one.png"),
    ] {
        let found = map(text).file;
        assert!(found.ends_with(file), "{text}: {}", found.display());
    }
}

#[test]
fn options_say_how_a_map_is_looked_up() {
    let scaled = map("-s 2 3 1 -o 0.5 -0.25 0 wood.png");
    assert_eq!((scaled.scale, scaled.offset), (Vec2::new(2.0, 3.0), Vec2::new(0.5, -0.25)));
    assert_eq!(map("wood.png -s 2 3 1 -o 0.5 -0.25 0").scale, scaled.scale);
    assert_eq!(map("-s 4 wood.png").scale, Vec2::new(4.0, 1.0));
    assert_eq!(map("-o 0.5 wood.png").offset, Vec2::new(0.5, 0.0));
    assert_eq!(map("-S 4 4 wood.png").scale, Vec2::splat(4.0));
    assert_eq!(map("-clamp on wood.png").wrap, [Wrap::Clamp; 2]);
    assert_eq!(map("-clamp off wood.png").wrap, [Wrap::Repeat; 2]);
    let mapped = map("-mm 0.25 0.5 wood.png");
    assert_eq!((mapped.base, mapped.gain), (0.25, 0.5));
    // Nothing of this changes anything.
    let plain = map("-blendu on -blendv on -cc off -t 0 0 0 -s 1 1 1 wood.png");
    assert_eq!(TextureMap { file: "".into(), ..plain }, TextureMap::new(""));
    for (letter, channel) in [
        ("r", Channel::Red),
        ("g", Channel::Green),
        ("b", Channel::Blue),
        ("m", Channel::Alpha),
        ("l", Channel::Luminance),
    ] {
        let (material, warnings) = read(&format!("Kd 1 1 1\nmap_d -imfchan {letter} wood.png"));
        assert_eq!((material.maps.d.unwrap().channel, warnings), (Some(channel), vec![]));
    }
    let (material, _) = read("Kd 1 1 1\nbump wood.png -bm 0.25");
    assert_eq!(material.maps.bump.unwrap().bump, 0.25);
}

#[test]
fn every_statement_has_its_map() {
    let all = "map_Kd wood.png\nmap_Ks wood.png\nmap_Ns wood.png\nmap_Ke wood.png\nmap_d wood.png\nmap_Pr wood.png\nmap_Pm wood.png\n";
    let (material, warnings) = read(&format!("{all}map_Bump wood.png\n"));
    assert_eq!(warnings, []);
    let maps = &material.maps;
    let none = [&maps.kd, &maps.ks, &maps.ns, &maps.ke, &maps.d, &maps.pr, &maps.pm, &maps.bump];
    assert!(none.iter().all(|map| map.is_some()) && maps.norm.is_none());
    for word in ["norm", "map_norm", "NORM"] {
        assert!(read(&format!("Kd 1 1 1\n{word} wood.png")).0.maps.norm.is_some(), "{word}");
    }
    for word in ["map_Bump", "map_bump", "bump", "disp", "map_Disp"] {
        assert!(read(&format!("Kd 1 1 1\n{word} wood.png")).0.maps.bump.is_some(), "{word}");
    }
    let (material, warnings) = read("Kd 1 1 1\ndisp there is one.png\nbump wood.png");
    assert!(material.maps.bump.unwrap().file.ends_with("wood.png"));
    assert!(warnings[0].message.contains("only `bump` counts"), "{warnings:?}");
}

#[test]
fn a_number_that_is_not_given_is_1_beside_its_map() {
    let (material, warnings) =
        read("map_Kd wood.png\nmap_Ks wood.png\nmap_Ke wood.png\nmap_Pr wood.png\nmap_Pm wood.png\nmap_Ns wood.png");
    assert_eq!((material.kd, material.ks, material.ke), (Vec3::ONE, Vec3::ONE, Vec3::ONE));
    assert_eq!((material.pr, material.pm, material.ns), (Some(1.0), 1.0, MtlMaterial::default().ns));
    assert_eq!(warnings, []);
    let (material, _) = read("Kd 0.5 0.25 1\nPr 0.5\nmap_Kd wood.png\nmap_Pr wood.png");
    assert_eq!((material.kd, material.pr), (Vec3::new(0.5, 0.25, 1.0), Some(0.5)));
    assert!(!material.maps.kd.unwrap().alone && !material.maps.pr.unwrap().alone);
    // `Le` is an emission too, and `Tr` an opacity.
    assert_eq!(read("Kd 1 1 1\nLe 2 2 2\nmap_Ke wood.png").0.ke, Vec3::splat(2.0));
    assert_eq!(read("Kd 1 1 1\nTr 0.25\nmap_d wood.png").0.d, 0.75);
    assert_eq!(read("Kd 1 1 1\nTr 1\nmap_d wood.png").0.d, 1.0);
    // A lamp by its map alone is one.
    let (material, warnings) = read_named("a_light", "newmtl a_light\nKd 1 1 1\nmap_Ke wood.png\n");
    assert_eq!((material.ke, warnings), (Vec3::ONE, vec![]));
}

#[test]
fn a_zero_beside_a_map_is_told_once_and_does_not_count() {
    let (material, warnings) = read(
        "Kd 0 0 0\nmap_Kd wood.png\nKe 0 0 0\nmap_Ke wood.png\nd 0\nmap_d wood.png\nnewmtl b\nKd 0 0 0\nmap_Kd wood.png",
    );
    assert_eq!((material.kd, material.ke, material.d), (Vec3::ONE, Vec3::ONE, 1.0));
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert!(warning.to_string().contains("m.mtl:2:1: warning: material `a` has `Kd` 0 beside its map"), "{warning}");
}

#[test]
fn without_its_picture_a_material_is_plain() {
    let (mut material, _) = read("map_Kd wood.png\nmap_Ke wood.png\nmap_Pr wood.png\nKs 0.5 0.5 0.5\nmap_Ks wood.png");
    let mapped = material.clone();
    material.settle(|_, _| false);
    assert_eq!((material.kd, material.ke, material.pr), (MtlMaterial::default().kd, Vec3::ZERO, None));
    assert_eq!(material.ks, Vec3::splat(0.5));
    assert_eq!(material.maps, mapped.maps);
    material.settle(|_, _| true);
    assert_eq!(material, mapped);
    material.maps.ke.as_mut().unwrap().off = true;
    material.settle(|_, _| true);
    assert_eq!((material.ke, material.kd), (Vec3::ZERO, Vec3::ONE));
    // A number that is moved by hand is given.
    let before = material.clone();
    material.kd = Vec3::splat(0.75);
    material.moved(&before);
    material.settle(|_, _| false);
    assert_eq!(material.kd, Vec3::splat(0.75));
}

#[test]
fn files_of_other_machines_are_found_and_told() {
    for (name, file) in [
        ("C:\\Users\\me\\scene\\textures\\deep.png", "textures/deep.png"),
        ("/home/me/textures/deep.png", "textures/deep.png"),
        ("/home/me/wood.png", "wood.png"),
        ("case.png", "Case.PNG"),
        ("\"D:\\My Maps\\there is one.png\"", "there is one.png"),
    ] {
        let (material, warnings) = read(&format!("Kd 1 1 1\nmap_Kd {name}\nmap_Ks {name}"));
        assert!(material.maps.kd.unwrap().file.ends_with(file), "{name}");
        let [warning] = warnings.as_slice() else { panic!("{name}: {warnings:?}") };
        assert!(warning.message.contains("is read, "), "{warning}");
        assert_eq!(warning.line, 3);
    }
}

#[test]
fn a_missing_file_is_told_once_and_kept_as_it_was_looked_for() {
    let folder = folder("a", "newmtl a\nKd 1 1 1\nmap_Kd -s 2 2 wod.png\nmap_Ks wod.png\n");
    let found = check(&folder.path().join("m.mtl")).diagnostics.list;
    let told: Vec<_> = found.iter().filter(|found| found.message.contains("there is no image")).collect();
    let [told] = told.as_slice() else { panic!("{found:?}") };
    assert_eq!((told.line, told.column), (3, 15));
    let help = told.help.as_deref().unwrap_or_default();
    assert_eq!(help, "`map_Kd` is rendered without this map; did you mean `wood.png`?");
    let loaded = load(&folder.path().join("m.obj"), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let maps = &loaded.description.materials["m:a"].maps;
    assert_eq!(maps.kd.as_ref().unwrap().file, folder.path().join("wod.png"));
}

/// A line after `newmtl a` and `Kd 0.5`, so the third; the column of its warning, and a part of the message.
const DOUBTFUL: &[(&str, u32, &str)] = &[
    ("map_Kd", 1, "names no file"),
    ("map_Kd -s 2 2", 13, "there is no image"),
    ("map_Kd -bm 1", 1, "names no file"),
    ("map_Kd -s 1 1 1", 15, "there is no image"),
    ("map_Kd -foo wood.png", 8, "unknown option"),
    ("map_Kd none.png", 8, "there is no image"),
    ("map_Kd none.png -s 2 2", 8, "/none.png`"),
    ("map_Kd none.png # lost", 8, "/none.png`"),
    ("map_Kd -t 1 1 1 wood.png", 8, "(turbulence) is not honoured"),
    ("map_Kd -blendu off wood.png", 8, "filtered along both axes"),
    ("map_Kd -texres 512 wood.png", 8, "pictures keep their size"),
    ("map_Kd -boost 2 wood.png", 8, "not sharpened"),
    ("map_Kd -cc on wood.png", 8, "colours are taken as they are"),
    ("map_Kd -imfchan r wood.png", 8, "this map is of three"),
    ("map_d -imfchan z wood.png", 7, "channels are r, g, b, m (alpha) and l (luminance)"),
    ("map_Kd -bm 2 wood.png", 8, "it is an option of `bump`"),
    ("norm -bm 2 wood.png", 6, "directions are taken as they are"),
    ("bump -mm 0 2 wood.png", 6, "directions and heights are taken as they are"),
    ("map_Kd -type sphere wood.png", 8, "it is an option of `refl`"),
    ("map_Kd -s 1e9 1 wood.png", 11, "`1e9` is taken as 1"),
    ("map_Kd -o nan 1 wood.png", 11, "`nan` is taken as 0"),
    ("map_Kd -mm 1e9 2 wood.png", 12, "`1e9` is taken as 0"),
    ("map_Kd -mm 0 1e9 wood.png", 14, "`1e9` is taken as 1"),
    ("map_Kd textures", 8, "this is a folder, not a file"),
    ("map_Kd -clamp wood.png", 8, "has no value that fits"),
    ("map_Ps wood.png", 1, "sheen, which is not rendered"),
    ("disp wood.png", 1, "rendered as bump"),
    ("bump wood.png\nnorm wood.png", 1, "only `norm` counts"),
    ("map_Kdd wood.png", 1, "did you mean `map_Kd`"),
    ("refl -type sphere wood.png", 1, "`refl` is not honoured yet"),
];

#[test]
fn each_line_that_is_not_honoured_is_a_warning_at_its_place() {
    for (text, column, message) in DOUBTFUL {
        let (_, warnings) = read(&format!("Kd 0.5\n{text}"));
        let found = warnings.iter().find(|found| found.to_string().contains(message));
        let found = found.unwrap_or_else(|| panic!("{text}: {warnings:?}"));
        assert_eq!((found.line, found.column), (3, *column), "{found}");
        assert_eq!(warnings.len(), 1, "{text}: {warnings:?}");
    }
}

#[test]
fn what_is_there_but_no_file_is_not_meant_again() {
    let (_, warnings) = read("Kd 0.5\nmap_Kd textures");
    let help = warnings[0].help.as_deref().unwrap_or_default();
    assert_eq!(help, "`map_Kd` is rendered without this map; the path is relative to the folder of the MTL file");
}

#[test]
fn what_a_material_looks_like_names_its_maps() {
    let reason = |text: &str| {
        let appearance = read(text).0.appearance();
        format!("{}: {}", appearance.kind, appearance.reason)
    };
    assert_eq!(reason("Kd 1 1 1\nmap_Kd wood.png"), "diffuse: Kd 1 1 1 x wood.png");
    assert_eq!(
        reason("Kd 1 1 1\nmap_d wood.png\nnorm there is one.png"),
        "diffuse: d 1 x wood.png, Kd 1 1 1, norm there is one.png"
    );
    assert_eq!(
        reason("Kd 0.5\nKs 0.25\nmap_Ks wood.png\nPr 0.5\nmap_Pr wood.png\nbump wood.png"),
        "glossy: Kd 0.5 0.5 0.5, Ks 0.25 0.25 0.25 x wood.png, Pr 0.5 x wood.png, bump wood.png"
    );
    assert_eq!(reason("map_Ke wood.png"), "light: Ke 1 1 1 x wood.png");
}
