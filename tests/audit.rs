//! What becomes of every statement of a material: each kind of statement, each fate, and where it stands.

use std::path::Path;
use std::process::Command;

use lucerna::scene::Fate::{self, Approximated, Honoured, Ignored};
use lucerna::scene::{Audit, Audited, audit};

use crate::mtl_maps::write_picture;

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";

/// A model of one material of some statements, and a scene with it.
fn audited(statements: &str, scene: &str) -> (Audit, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("m.mtl", &format!("newmtl a\n{statements}\n"));
    write("m.obj", &format!("{OBJ}usemtl a\nf 1/1 2/1 3/1\n"));
    write("s.ron", &format!("(models: [(path: \"m.obj\")],\n{scene})"));
    write_picture(&folder.path().join("t.png"));
    (audit(&folder.path().join("s.ron")), folder)
}

fn one(audit: &Audit) -> &Audited {
    assert!(audit.materials.len() == 1, "{}", audit.diagnostics);
    &audit.materials[0]
}

/// Statements of one material, what becomes of the first, and a part of the reason.
const FATES: &[(&str, Fate, &str)] = &[
    ("Kd 0.5 0.5 0.5", Honoured, ""),
    ("Kd 0.8 0.8 0.8\nKs 0.7 0.7 0.7", Approximated, "divided by 1.5"),
    ("Kd 0.5 0.5 0.5\nillum 4\nNi 1.5", Ignored, "glass reflects"),
    ("Kd 0 0 0\nmap_Kd t.png", Approximated, "the map counts alone"),
    ("Kd 0.5 0.5 0.5\nKd 0.4 0.4 0.4", Ignored, "line 3 says it again"),
    ("Kd red", Ignored, "is not a finite number"),
    ("Kd 2e6 0 0", Approximated, "is taken as"),
    ("Ks 0.2 0.2 0.2\nKd 0.5 0.5 0.5", Honoured, ""),
    ("Ns 20\nKd 0.5 0.5 0.5", Ignored, "no specular lobe"),
    ("Ns 20\nKd 0.5 0.5 0.5\nKs 0.2 0.2 0.2", Honoured, ""),
    ("Ns 20\nKs 0.2 0.2 0.2\nPr 0.5", Ignored, "GGX"),
    ("Ns 20\nKs 0.2 0.2 0.2\nillum 3", Ignored, "a mirror"),
    ("Pr 0.5\nKd 0.5 0.5 0.5", Ignored, "no specular lobe"),
    ("Pr 0.5\nPm 1\nKd 0.5 0.5 0.5", Honoured, ""),
    ("Pm 1\nKd 0 0 0", Ignored, "no `Kd`"),
    ("Ke 1 1 1", Honoured, ""),
    ("Le 1 1 1", Honoured, "as `Ke`"),
    ("Le 1 1 1\nKe 2 2 2", Ignored, "`Ke` and `Le`"),
    ("Ni 1.5\nKd 0.5 0.5 0.5", Ignored, "only glass refracts"),
    ("Ni 1.5\nillum 7", Honoured, ""),
    ("d 0.5\nKd 0.5 0.5 0.5", Honoured, ""),
    ("d -halo 0.5\nKd 0.5 0.5 0.5", Approximated, "halo"),
    ("Tr 0.25\nKd 0.5 0.5 0.5", Honoured, "as `d 0.75`"),
    ("Tr 0.25\nd 1\nKd 0.5 0.5 0.5", Ignored, "`d` counts"),
    ("Tr 1\nKd 0.5 0.5 0.5", Approximated, "as opacity"),
    ("Tf 0.5 1 1\nKd 0.5 0.5 0.5", Ignored, "nothing passes"),
    ("Tf 0.5 1 1\nillum 4", Honoured, ""),
    ("illum 2\nKd 0.5 0.5 0.5", Honoured, ""),
    ("illum 4\nKd 0.5 0.5 0.5", Ignored, "alone makes no glass"),
    ("illum 3\nKs 0.5 0.5 0.5", Honoured, "a mirror"),
    ("illum 5\nKs 0.5 0.5 0.5", Approximated, "at every angle"),
    ("illum 3\nKd 0.5 0.5 0.5", Ignored, "no specular lobe"),
    ("illum 1\nKs 0.5 0.5 0.5", Approximated, "`Ks` is rendered"),
    ("illum 10\nKd 0.5 0.5 0.5", Approximated, "shadow catcher"),
    ("illum 12\nKd 0.5 0.5 0.5", Ignored, "whole number"),
    ("map_Kd t.png", Honoured, ""),
    ("map_Kd no.png\nKd 0.5 0.5 0.5", Ignored, "no.png"),
    ("map_Kd -boost 2 t.png", Approximated, "-boost"),
    ("map_Ns t.png\nKs 0.2 0.2 0.2\nPr 0.5", Ignored, "GGX"),
    ("map_Bump t.png\nnorm t.png\nKd 0.5 0.5 0.5", Ignored, "`norm` counts"),
    ("disp t.png\nKd 0.5 0.5 0.5", Approximated, "no surface is moved"),
    ("disp t.png\nbump t.png\nKd 0.5 0.5 0.5", Ignored, "counts"),
    ("Ka 1 1 1\nKd 0.5 0.5 0.5", Ignored, "no meaning"),
    ("Pc 0.5\nKd 0.5 0.5 0.5", Honoured, ""),
    ("Pcr 0.1\nKd 0.5 0.5 0.5", Ignored, "no coat"),
    ("Pcr 0.1\nPc 1\nKd 0.5 0.5 0.5", Honoured, ""),
    ("Pc 1\nNi 1.5\nillum 7", Ignored, "`Ni` and `Tf` alone"),
    ("Ps 0.5\nKd 0.5 0.5 0.5", Ignored, "not honoured yet"),
    ("Ps 0\nKd 0.5 0.5 0.5", Honoured, "nothing to render"),
    ("Kf 1 1 1\nKd 0.5 0.5 0.5", Ignored, "unknown statement"),
];

#[test]
fn every_statement_has_a_fate() {
    for (statements, fate, why) in FATES {
        let (audit, _folder) = audited(statements, "");
        let material = one(&audit);
        assert_eq!(material.statements.len(), statements.lines().count(), "{statements}");
        let first = &material.statements[0];
        assert!(first.fate == *fate && first.why.contains(why), "{statements}: {first:?}");
        assert_eq!(why.is_empty(), first.why.is_empty(), "{statements}: {first:?}");
        assert_eq!((first.place.line, first.place.column), (2, 1), "{statements}");
        assert_eq!(first.place.file.file_name(), Some("m.mtl".as_ref()));
        let written = statements.lines().next().unwrap();
        assert_eq!(first.statement, written);
    }
}

#[test]
fn scenes_say_over_libraries_and_by_which_policies() {
    let statements = "Kd 0.8 0.8 0.8\nKs 0.7 0.7 0.7\nmap_Kd t.png\nNs 30";
    let (audit, _folder) = audited(statements, "materials: { \"a\": (ns: 9) }");
    let material = one(&audit);
    assert_eq!((material.name.as_str(), material.energy), ("m:a", [1.5, 1.0]));
    assert!(material.policies.iter().any(|policy| policy.contains("Preserve")), "{:?}", material.policies);
    assert!(material.policies.iter().any(|policy| policy.contains("Multiply")), "{:?}", material.policies);
    let ns = &material.statements[3];
    assert!(ns.fate == Ignored && ns.why.contains("s.ron:2 gives another `ns`"), "{ns:?}");
    assert!(material.edits.len() == 1 && material.edits[0].0 == "ns");

    let (audit, _folder) = audited(statements, "render: (energy: AsWritten, texture: Replace)");
    let material = one(&audit);
    assert_eq!(material.energy, [1.5, 1.5]);
    assert!(material.statements[0].fate == Ignored && material.statements[1].fate == Honoured);
}

#[test]
fn an_exporters_constant_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.mtl");
    let material = |name: &str, kd: f32| format!("newmtl {name}\nKd {kd} 0.5 0.5\nillum 7\nNi 1.5\n");
    std::fs::write(&path, material("a", 0.1) + &material("b", 0.2) + &material("c", 0.3)).unwrap();
    let audit = audit(&path);
    assert_eq!(audit.materials.len(), 3);
    for material in &audit.materials {
        assert!(material.policies.iter().any(|policy| policy.contains("exporter")), "{material:?}");
        assert!(material.statements[1].fate == Ignored && material.statements[1].why.contains("exporter"));
        assert_eq!(material.statements[0].fate, Honoured);
    }
}

fn check(arguments: &[&str], folder: &Path) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_lucerna")).args(arguments).current_dir(folder).output().unwrap();
    (output.status.code(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn the_command_prints_a_table_or_json() {
    let (_, folder) = audited("Kd 0.8 0.8 0.8\nKs 0.7 0.7 0.7\nNi 1.5", "");
    let (code, table) = check(&["check", "s.ron", "--materials"], folder.path());
    assert_eq!(code, Some(0));
    for part in ["m:a: glossy", "kd + ks 1.500, rendered 1.000", "Ni 1.5", "ignored", "m.mtl:4"] {
        assert!(table.contains(part), "no `{part}`:\n{table}");
    }
    let (code, text) = check(&["check", "m.obj", "--materials", "--json"], folder.path());
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, &json["errors"]), (Some(0), &0.into()));
    let material = &json["files"][0]["materials"][0];
    assert_eq!(material["name"], "a");
    assert_eq!(material["statements"][2]["fate"], "ignored");
    assert_eq!(material["statements"][2]["line"], 4);
    let (code, table) = check(&["check", "glass", "--materials"], Path::new(env!("CARGO_MANIFEST_DIR")));
    assert!(code == Some(0) && table.contains("glass:glass_ball: glass"), "{table}");
    assert_eq!(check(&["check", "none.ron", "--materials"], folder.path()).0, Some(1));
    assert_eq!(check(&["check", "--materials"], folder.path()).0, Some(2));
}

/// A family has the materials of its members: those of equal ones once.
#[test]
fn the_materials_of_a_family_are_those_of_its_members() {
    let (_, folder) = audited("Kd 0.8 0.8 0.8\nKs 0.7 0.7 0.7\nNs 20", "environment: Constant(1)");
    let sweep = r#"(extends: "s.ron", sweep: { "materials.a.ns": [8, 64], "film.exposure": [0, 1] })"#;
    std::fs::write(folder.path().join("v.ron"), sweep).unwrap();
    let (code, text) = check(&["check", "v.ron", "--materials", "--json"], folder.path());
    assert_eq!(code, Some(0), "{text}");
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let files = json["files"].as_array().unwrap();
    assert_eq!((files.len(), files[0]["members"].as_array().unwrap().len()), (2, 2), "{json:#}");
    let (code, table) = check(&["check", "v.ron", "--materials"], folder.path());
    assert!(code == Some(0) && table.contains("v.ron: 8_0, 8_1\n") && table.contains("m:a: glossy"), "{table}");
}
