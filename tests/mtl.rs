//! MTL files: values, policies, and a located warning for each line that is not honoured.

use glam::Vec3;
use lucerna::components::{Lobe, Material, Passage};
use lucerna::scene::{Diagnostic, MtlMaterial, Severity, load};

/// Reads a library through an OBJ file that uses its material `a`.
fn read(mtl: &str) -> (MtlMaterial, Vec<Diagnostic>) {
    read_named("a", mtl)
}

fn read_named(name: &str, mtl: &str) -> (MtlMaterial, Vec<Diagnostic>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let obj = format!("mtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl {name}\nf 1 2 3\n");
    std::fs::write(folder.path().join("m.obj"), obj).expect("a file");
    std::fs::write(folder.path().join("my materials.mtl"), mtl).expect("a file");
    let loaded = load(&folder.path().join("m.obj"), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let material = loaded.description.materials[&format!("m:{name}")].clone();
    (material, loaded.warnings)
}

#[test]
fn a_whole_material_arrives_without_warnings() {
    let (material, warnings) = read(
        "# a comment\nnewmtl other\nKd 0 0 0\n\nnewmtl a\nKd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 33\nKe 1 2 3\nNi 1.5\nd 1\n\
         Tr 0\nTf 1 0.5 1\nPr 0.25\nPm 0.75\nPc 0.5\nPcr 0.125\nillum 2\n",
    );
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(material.kd, Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(material.ks, Vec3::new(0.4, 0.5, 0.6));
    assert_eq!(material.ns, 33.0);
    assert_eq!(material.ke, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!((material.ni, material.d, material.tf, material.illum), (1.5, 1.0, Vec3::new(1.0, 0.5, 1.0), 2));
    assert_eq!((material.pr, material.pm), (Some(0.25), 0.75));
    assert_eq!((material.pc, material.pcr), (0.5, 0.125));
    assert!(!material.one_sided);
}

#[test]
fn what_asks_for_nothing_is_not_told() {
    let (_, warnings) =
        read("newmtl a\nKd 1 1 1\nPs 0.000000\nPc 0.000000\nPcr 0.030000\naniso 0.000000\nanisor 0.000000\n");
    assert_eq!(warnings, []);
}

#[test]
fn one_value_is_grey() {
    let (material, warnings) = read("newmtl a\nKd 0.5\n");
    assert_eq!(material.kd, Vec3::splat(0.5));
    assert!(warnings.is_empty(), "{warnings:?}");
}

#[test]
fn what_is_not_given_is_black_unless_nothing_is() {
    assert_eq!(read("newmtl a\nKs 1 1 1\n").0.kd, Vec3::ZERO);
    let (material, warnings) = read("newmtl a\nNs 3\n");
    assert_eq!(material.kd, Vec3::splat(0.6));
    assert!(warnings[0].message.contains("rendered grey"), "{warnings:?}");
}

#[test]
fn glass_needs_no_colour() {
    let (material, warnings) = read("newmtl a\nNi 1.5\nillum 7\n");
    assert_eq!((material.illum, material.ni), (7, 1.5));
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(read("newmtl a\nKd 0 0 0\nKs 0 0 0\nillum 4\n").1, []);
}

#[test]
fn emission_is_ke_or_le() {
    assert_eq!(read("newmtl a\nKe 1 1 1\n").0.ke, Vec3::ONE);
    assert_eq!(read("newmtl a\nKd 1 1 1\nLe 2 2 2\n").0.ke, Vec3::splat(2.0));
    assert_eq!(read("newmtl a\nKe 1 1 1\nLe 2 2 2\n").0.ke, Vec3::ONE);
    assert_eq!(read_named("a_light", "newmtl a_light\nKe 1 1 1\nLe 2 2 2\n").0.ke, Vec3::splat(2.0));
    assert_eq!(read_named("a_light", "newmtl a_light\nKe 1 1 1\nLe 0 0 0\n").0.ke, Vec3::ONE);
    let (_, warnings) = read_named("a_light", "newmtl a_light\nKd 1 1 1\n");
    assert!(warnings[0].message.contains("emits nothing"), "{warnings:?}");
}

#[test]
fn tr_counts_only_without_d() {
    let dissolve = |text: &str| read(&format!("newmtl a\nKd 1 1 1\n{text}\n")).0.d;
    assert_eq!(dissolve("d 0.25"), 0.25);
    assert_eq!(dissolve("Tr 0.25"), 0.75);
    assert_eq!(dissolve("Tr 0.25\nd 0.5"), 0.5);
    assert_eq!(dissolve("d 0.5\nTr 0.5"), 0.5);
    assert_eq!(dissolve("d -halo 0.5"), 0.5);
}

#[test]
fn a_material_given_twice_is_the_later_one() {
    let (material, warnings) = read("newmtl a\nKd 0 0 0\nKs 1 1 1\nnewmtl a\nKd 1 1 1\n");
    assert_eq!((material.kd, material.ks), (Vec3::ONE, Vec3::ZERO));
    assert_eq!((warnings[0].line, warnings[0].column), (4, 8));
}

/// A line after `newmtl a` and `Kd 0.5 0.5 0.5`, so the third; the column of its warning, and a part of the message.
const DOUBTFUL: &[(&str, u32, &str)] = &[
    ("Kd 1 2", 1, "needs three values, or one for grey, and has 2"),
    ("Kd", 1, "and has 0"),
    ("Kd 1 1 1 1", 10, "what follows is left out"),
    ("Kd nan 0 0", 4, "`nan` is not a finite number"),
    ("Kd 1e999 0 0", 4, "not a finite number"),
    ("Kd one 0 0", 4, "`one` is not a finite number"),
    ("Kd -1 0 0", 4, "taken as 0"),
    ("Ke 1e9 0 0", 4, "taken as 1000000"),
    ("Kd spectral file.rfl 1", 4, "spectral curves are not supported"),
    ("Ks xyz 1 1 1", 4, "CIE XYZ"),
    ("Ns", 1, "needs a value"),
    ("Ns x", 4, "not a finite number"),
    ("Ns 1e6", 4, "taken as 100000"),
    ("Ns 1 2", 6, "has one value"),
    ("Ni 0.5", 4, "taken as 1"),
    ("d 2", 3, "taken as 1"),
    ("d -halo 0.5", 3, "`-halo` is not honoured"),
    ("Tr 0.5", 1, "it is taken as `d 0.5`"),
    ("illum 11", 1, "from 0 to 10, not `11`"),
    ("illum", 1, "from 0 to 10"),
    ("illum -1", 1, "from 0 to 10"),
    ("illum 7\nNi 1.5", 1, "is glass (illum 7)"),
    ("illum 7", 1, "`illum 7` alone makes no glass of material `a`, which is diffuse"),
    ("Kd -nan(ind) 0 0", 4, "`-nan(ind)` is not a finite number"),
    ("Ks 1.#QNAN 0 0", 4, "`1.#QNAN` is not a finite number"),
    ("Ns 1.#INF", 4, "`1.#INF` is not a finite number"),
    ("d -1.#IND00", 3, "`-1.#IND00` is not a finite number"),
    ("Ks 255 128 0", 1, "looks like bytes"),
    ("Tr 1", 1, "here it is taken as opacity"),
    ("illum 10", 1, "shadow catcher"),
    ("Ka 1 1 1", 1, "no meaning in path tracing"),
    ("Pr 2", 4, "taken as 1"),
    ("Pm -1", 4, "taken as 0"),
    ("aniso 0.5", 1, "`aniso` is not honoured yet"),
    ("map_Pc coat.png", 1, "`map_Pc` is not honoured yet"),
    ("Kdd 1 1 1", 1, "did you mean `Kd`"),
    ("something 1", 1, "unknown statement `something`"),
    ("newmtl", 1, "without a name"),
    ("Kd 0.1 \\\nnan 0", 0, "not a finite number"),
];

#[test]
fn each_line_that_is_not_honoured_is_a_warning_at_its_place() {
    for (text, column, message) in DOUBTFUL {
        let (material, warnings) = read(&format!("newmtl a\nKd 0.5 0.5 0.5\n{text}\n"));
        let found = warnings.iter().find(|found| found.to_string().contains(message));
        let found = found.unwrap_or_else(|| panic!("{text}: {warnings:?}"));
        assert_eq!(found.severity, Severity::Warning);
        assert!(found.file.ends_with("my materials.mtl"));
        let place = if *column == 0 { (4, 1) } else { (3, *column) };
        assert_eq!((found.line, found.column), place, "{found}");
        assert!(material.kd.is_finite() && material.ks.is_finite() && material.ke.is_finite());
        if found.message.contains("left out") && text.starts_with("Kd") && !text.contains("1 1 1 1") {
            assert_eq!(material.kd, Vec3::splat(0.5), "{text}");
        }
    }
}

/// What follows `newmtl a` and `Kd 0.8 0.1 0.1`, by exporters and by hand; how light gets through; and its kind in words.
const LOOKS: &[(&str, Passage, &str)] = &[
    // Maya, Cinema 4D, DAZ Studio, 3ds Max, Blender old and new: opaque.
    ("illum 4\nKa 0 0 0\nTf 1.00 1.00 1.00\nNi 1.00", Passage::Opaque, "diffuse"),
    ("Ka 1 1 1\nKs 1 1 1\nNs 50\nillum 7", Passage::Opaque, "glossy"),
    ("Ns 900\nd 1\nTr 1\nTf 1 1 1\nillum 4\nKs 0.1 0.1 0.1", Passage::Opaque, "glossy"),
    ("Ns 10\nNi 1.5\nd 1\nTr 0\nTf 1 1 1\nillum 2\nKs 0 0 0", Passage::Opaque, "diffuse"),
    ("Ni 1.45\nd 1\nillum 2\nKs 0.5 0.5 0.5\nNs 250", Passage::Opaque, "glossy"),
    ("illum 4\nTf 0 0 0\nNi 1", Passage::Opaque, "diffuse"),
    ("illum 6\nNi 0", Passage::Opaque, "diffuse"),
    ("illum 9\nd 1.0", Passage::Opaque, "diffuse"),
    ("illum 4\nKd 0 0 0\nKs 0 0 0", Passage::Opaque, "black"),
    // What the numbers call transparent.
    ("illum 4\nNi 1.5", Passage::Glass(1.5), "glass"),
    ("illum 6\nNi 1.2\nTf 1 1 1", Passage::Glass(1.2), "glass"),
    ("illum 7\nNi 2.4\nd 1", Passage::Glass(2.4), "glass"),
    ("illum 9\nNi 1.33\nd 0.3", Passage::Glass(1.33), "glass"),
    ("illum 4\nTf 0.5 0.9 0.5\nNi 1", Passage::Glass(1.0), "glass"),
    ("illum 7\nTf 0.98 1 0.99", Passage::Glass(1.0), "glass"),
    ("illum 4\nd 0.5\nNi 1.00\nTf 1 1 1", Passage::SeeThrough(0.5), "see-through"),
    ("illum 4\nTr 0.5", Passage::SeeThrough(0.5), "see-through"),
    ("illum 2\nd 0.5\nNi 1.5", Passage::SeeThrough(0.5), "see-through"),
    ("illum 2\nd 0", Passage::SeeThrough(0.0), "invisible"),
    ("illum 2\nd 0\nTf 0.5 0.5 0.5", Passage::SeeThrough(0.0), "see-through"),
    // Others.
    ("illum 3\nKs 0.9 0.9 0.9", Passage::Opaque, "mirror"),
    ("illum 8\nKs 0.9 0.9 0.9", Passage::Opaque, "mirror"),
    ("illum 3", Passage::Opaque, "diffuse"),
    ("illum 3\nKs 0.9 0.9 0.9\nPr 0.3", Passage::Opaque, "glossy"),
    ("Pr 0.3\nPm 1", Passage::Opaque, "metal"),
    ("Pc 1", Passage::Opaque, "coated"),
    ("Pc 0.5\nPcr 0.2\nKs 0.1 0.1 0.1", Passage::Opaque, "coated"),
    ("Pc 1\nPm 1\nPr 0.3", Passage::Opaque, "metal"),
    ("Pc 1\nd 0.5", Passage::SeeThrough(0.5), "see-through"),
    ("Ke 1 1 1\nillum 4", Passage::Opaque, "light"),
];

#[test]
fn a_material_is_what_its_numbers_say_and_not_illum_alone() {
    for (text, passage, kind) in LOOKS {
        let (material, warnings) = read(&format!("newmtl a\nKd 0.8 0.1 0.1\n{text}\nnewmtl other\nKd 0 0 1\n"));
        assert_eq!(material.passage(), *passage, "{text}");
        let look = material.appearance();
        assert_eq!(look.kind, *kind, "{text}: {look:?}");
        let told = material.asks_for_glass() && !matches!(passage, Passage::Glass(_));
        assert_eq!(look.reason.contains("alone makes no glass"), told, "{text}: {look:?}");
        let warned = warnings.iter().any(|warning| warning.message.contains("alone makes no glass"));
        assert_eq!(warned, told && !matches!(*kind, "black" | "light"), "{text}: {warnings:?}");
    }
    assert_eq!(read("newmtl a\nKs 1 1 1\nillum 8\n").0.lobe(), Lobe::Mirror);
}

#[test]
fn an_illum_and_an_index_on_everything_are_a_constant() {
    let wood = "newmtl a\nKd 0.5 0.3 0.1\nNi 1.5\nillum 7\n";
    let wall = "newmtl wall\nKd 0.8 0.8 0.8\nNi 1.5\nillum 7\n";
    let sofa = "newmtl sofa\nKd 0.2 0.2 0.7\nNi 1.5\nillum 7\n";
    let alike = "newmtl sofa\nKd 0.5 0.3 0.1\nNi 1.5\nillum 7\n";
    let clear = "newmtl clear\nKd 0 0 0\nNi 1.5\nillum 7\n";
    let matte = "newmtl matte\nKd 0.5 0.5 0.5\nNi 1.5\nillum 2\n";
    let filter = "newmtl filter\nKd 0.2 0.2 0.7\nTf 0.5 0.5 1\nNi 1.5\nillum 7\n";
    let index = "newmtl gem\nKd 0.2 0.2 0.7\nNi 2.4\nillum 7\n";
    let part = "newmtl part\nKd 0.2 0.2 0.7\nd 0.4\nNi 1.5\nillum 7\n";
    for (texts, glass) in [
        (vec![wood, wall, sofa], false),
        (vec![wood, wall], true),
        (vec![wood], true),
        (vec![wood, wall, clear], true),
        (vec![wood, wall, matte], true),
        (vec![wood, wall, filter], true),
        (vec![wood, wall, index], true),
        (vec![wood, wall, part], true),
        (vec![wood, alike, &wood.replace("newmtl a", "newmtl c")], true),
    ] {
        let (material, warnings) = read(&texts.concat());
        assert_eq!(material.is_glass(), glass, "{texts:?}");
        let told = warnings.iter().any(|warning| warning.message.contains("an exporter's constant"));
        assert_eq!(told, !glass, "{texts:?}: {warnings:?}");
    }
    let (material, _) = read(&[wood, wall, sofa].concat().replace("illum", "Tr 1\nillum"));
    assert_eq!((material.passage(), material.d), (Passage::Opaque, 1.0));
}

#[test]
fn tr_that_would_hide_most_of_a_library_is_opacity() {
    let library = |values: &[&str]| -> String {
        let names = ["a", "b", "c", "d", "e"];
        names.iter().zip(values).map(|(name, value)| format!("newmtl {name}\nKd 1 1 1\n{value}\n")).collect()
    };
    for (values, dissolve) in [
        (vec!["Tr 1"], 1.0),
        (vec!["Tr 1.0000", "Tr 1.0"], 1.0),
        (vec!["Tr 1", "Tr 0.3"], 1.0),
        (vec!["Tr 0.3", "Tr 1"], 0.3),
        (vec!["Tr 0.3", "Tr 1", "Tr 1", "", "Tr 1"], 0.3),
        (vec!["Tr 0", "Tr 1", "Tr 1", "Tr 1"], 1.0),
        (vec!["Tr 1\nillum 4\nNi 1\nTf 1 1 1", "Tr 1\nillum 4"], 1.0),
        // As written.
        (vec!["Tr 1", ""], 0.0),
        (vec!["Tr 1", "Tr 0"], 0.0),
        (vec!["Tr 1", "Tr 0", "Tr 0.5", "Tr 1", "Tr 0"], 0.0),
        (vec!["Tr 0.3", "Tr 0.3"], 0.7),
        (vec!["Tr 0"], 1.0),
        (vec!["Tr 1\nd 1", "Tr 1\nd 1"], 1.0),
        (vec!["Tr 1\nd 0", "Tr 1\nd 0"], 0.0),
    ] {
        let (material, warnings) = read(&library(&values));
        assert_eq!(material.d, dissolve, "{values:?}");
        let flipped = warnings.iter().any(|warning| warning.message.contains("taken as opacity"));
        let written =
            values[0].starts_with("Tr 1") && dissolve == 0.0 || values.iter().all(|value| value.contains('d'));
        assert!(!(flipped && written), "{values:?}: {warnings:?}");
    }
    assert!(read(&library(&["Tr 1"])).1.iter().any(|warning| warning.message.contains("taken as opacity")));
}

#[test]
fn colours_in_bytes_are_told_and_taken_as_written() {
    for (text, help) in [("204 26 26", "0.8 0.102 0.102"), ("255", "1 1 1"), ("0 0 128", "0 0 0.502")] {
        let (material, warnings) = read(&format!("newmtl a\nKd {text}\n"));
        assert!(warnings[0].to_string().contains(&format!("did you mean `Kd {help}`?")), "{warnings:?}");
        assert!(material.kd.max_element() > 100.0);
    }
    for text in ["1 1 1", "0.8 0.1 0.1", "1.5 1 1", "2 2 2"] {
        assert_eq!(read(&format!("newmtl a\nKd {text}\n")).1, [], "{text}");
    }
    assert_eq!(read("newmtl a\nKd 0 0 0\nKe 255 200 100\n").1, []);
}

#[test]
fn a_library_of_very_many_materials_is_read_in_little_time() {
    let text: String = (0..100_000).map(|i| format!("newmtl m{i}\nKd 1 1 1\n")).collect();
    let started = std::time::Instant::now();
    read(&(text + "newmtl a\nKd 1 1 1\n"));
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
}

#[test]
fn texts_may_end_as_those_of_dos_do() {
    for end in ["\u{1a}", "\n\u{1a}", "\u{1a}\u{1a}\n"] {
        assert_eq!(read(&format!("newmtl a\nKd 1 1 1{end}")), read("newmtl a\nKd 1 1 1\n"), "{end:?}");
    }
    let (material, warnings) = read("newmtl a\nKd 1 1 1\n\0\0\0");
    assert_eq!(material.kd, Vec3::ONE);
    assert!(warnings[0].message.contains("zero bytes fill the end"), "{warnings:?}");
}

#[test]
fn statements_before_the_first_material_are_left_out() {
    let (material, warnings) = read("Kd 1 0 0\nnewmtl a\nKd 0 1 0\n");
    assert_eq!(material.kd, Vec3::Y);
    assert!(warnings[0].to_string().contains(":1:1: warning: `Kd` stands before any `newmtl`"), "{warnings:?}");
}

#[test]
fn a_library_that_is_no_text_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.obj"), "mtllib m.mtl\nv 0 0 0\nusemtl a\nf 1 1 1\n").unwrap();
    std::fs::write(folder.path().join("m.mtl"), b"newmtl a\n\x80\x81").unwrap();
    let errors = load(&folder.path().join("m.obj"), &[]).unwrap_err();
    assert!(errors.to_string().contains("m.mtl:2:1: error: byte 0x80"), "{errors}");
    std::fs::write(folder.path().join("m.mtl"), "").unwrap();
    let loaded = load(&folder.path().join("m.obj"), &[]).unwrap();
    assert!(loaded.warnings.iter().any(|found| found.message.contains("no material in this file")));
}

#[test]
fn every_material_has_numbers_that_come_to_it() {
    let grey = Material { specular: Vec3::splat(0.2), metallic: 0.25, one_sided: true, ..Material::default() };
    let grey = Material { coat: 0.5, coat_roughness: 0.25, ..grey };
    for lobe in [Lobe::Phong(30.0), Lobe::Ggx(0.4), Lobe::Mirror] {
        for passage in [Passage::Opaque, Passage::SeeThrough(0.5), Passage::SeeThrough(0.0)] {
            let material = Material { lobe, passage, filter: Vec3::new(1.0, 0.5, 0.25), emission: Vec3::X, ..grey };
            assert_eq!(MtlMaterial::from(material).material(), material);
        }
    }
    for (index, filter) in [(1.5, Vec3::ONE), (1.0, Vec3::new(1.0, 0.5, 0.25))] {
        let glass = Material { passage: Passage::Glass(index), filter, ..grey };
        assert_eq!(MtlMaterial::from(glass).material(), glass);
        let pane = Material { passage: Passage::Pane(index), ..glass };
        assert_eq!(MtlMaterial::from(pane).material(), pane);
    }
    // What neither bends nor filters is not there.
    let nothing = Material { passage: Passage::Glass(1.0), ..grey };
    assert!(MtlMaterial::from(nothing).material().is_invisible());
    assert_eq!(MtlMaterial::default().material(), Material::default());
}
