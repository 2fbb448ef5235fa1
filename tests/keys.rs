//! The table of material keys: docs/materials.md has it, and every reader knows all of it.

use std::collections::BTreeSet;

use lucerna::scene::{Define, KEYS, Value, load};

/// The lines of docs/materials.md's table of keys, down to the first that is of MTL files alone.
fn table() -> Vec<String> {
    let page = std::fs::read_to_string("docs/materials.md").expect("docs/materials.md");
    let lines = page.lines().skip_while(|line| !line.starts_with("| statement | in a scene file |")).skip(2);
    lines.take_while(|line| !line.starts_with("| `Le` |")).map(str::to_owned).collect()
}

#[test]
fn the_page_on_materials_has_the_table_of_keys() {
    let rows: Vec<String> = KEYS.iter().map(|key| key.row()).collect();
    assert_eq!(table().join("\n"), rows.join("\n"));
}

#[test]
fn no_name_stands_for_two_keys() {
    let statements: BTreeSet<String> = KEYS.iter().filter_map(|key| key.mtl).map(str::to_ascii_lowercase).collect();
    assert_eq!(statements.len(), KEYS.iter().filter(|key| key.mtl.is_some()).count());
    assert_eq!(KEYS.iter().map(|key| key.scene).collect::<BTreeSet<_>>().len(), KEYS.len());
}

/// A value of a key that is not its default.
fn value_of(value: &Value) -> &'static str {
    match value {
        Value::Colour(..) => "0.25",
        Value::Number(range, _) if range.least > 0.25 => "2.5",
        Value::Number(..) | Value::Optional(..) => "0.25",
        Value::Switch(_) => "true",
        Value::Whole(..) => "5",
        Value::Map(..) => "\"t.png\"",
    }
}

#[test]
fn a_define_and_a_statement_reach_every_key() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    crate::mtl_maps::write_picture(&folder.path().join("t.png"));
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    write("s.ron", "(models: [(path: \"m.obj\")], materials: { \"a\": () })");
    let loaded = |mtl: &str, defines: &[Define]| {
        write("m.mtl", mtl);
        let loaded = load(&folder.path().join("s.ron"), defines).unwrap_or_else(|errors| panic!("{errors}"));
        loaded.description.materials["m:a"].clone()
    };
    // What gives a material a colour, so that no key is the first to.
    let plain = loaded("newmtl a\nKd 0.75\nKs 0.125\n", &[]);
    for key in KEYS {
        let value = value_of(&key.value);
        let defined =
            loaded("newmtl a\nKd 0.75\nKs 0.125\n", &[Define::given(format!("materials.a.{}", key.scene), value)]);
        assert_ne!(defined, plain, "{}", key.scene);
        if let Some(statement) = key.mtl {
            let written = loaded(&format!("newmtl a\nKd 0.75\nKs 0.125\n{statement} {value}\n"), &[]);
            assert_eq!(written, defined, "{statement}");
        }
    }
}
