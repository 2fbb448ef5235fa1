//! Which files an `mtllib` statement means.

use std::path::Path;

use glam::Vec3;
use lucerna::scene::{Loaded, load};

/// Names and contents.
type Files<'a> = &'a [(&'a str, Vec<u8>)];

const RED: Vec3 = Vec3::new(0.8, 0.1, 0.1);
const BLUE: Vec3 = Vec3::new(0.1, 0.1, 0.8);

fn red(name: &str) -> Vec<u8> {
    format!("newmtl {name}\nKd 0.8 0.1 0.1\n").into_bytes()
}

fn blue(name: &str) -> Vec<u8> {
    format!("newmtl {name}\nKd 0.1 0.1 0.8\n").into_bytes()
}

/// Loads `m.obj`, of two triangles in the materials `a` and `b`, with this `mtllib` line and these files beside it.
fn read(statement: &str, files: Files) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &Path, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    };
    files.iter().for_each(|(name, bytes)| put(Path::new(name), bytes));
    let obj = format!("{statement}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    put(Path::new("m.obj"), obj.as_bytes());
    load(&folder.path().join("m.obj"), &[]).unwrap_or_else(|errors| panic!("{statement}: {errors}"))
}

fn colours(loaded: &Loaded) -> [Vec3; 2] {
    ["m:a", "m:b"].map(|name| loaded.description.materials[name].kd)
}

fn said(loaded: &Loaded) -> String {
    loaded.warnings.iter().map(|warning| format!("{warning}\n")).collect()
}

#[test]
fn several_names_spaces_and_quotes_are_found_without_a_word() {
    let both = || [red("a"), blue("b")].concat();
    let cases: &[(&str, Files)] = &[
        ("mtllib one.mtl two.mtl", &[("one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib one.mtl\ttwo.mtl  # both", &[("one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib one.mtl\nmtllib two.mtl", &[("one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib one two", &[("one", red("a")), ("two", blue("b"))]),
        ("mtllib my colours.mtl his colours.MTL", &[("my colours.mtl", red("a")), ("his colours.MTL", blue("b"))]),
        ("mtllib one.mtl two.mtl", &[("one.mtl two.mtl", both())]),
        ("mtllib my colours.mtl", &[("my colours.mtl", both())]),
        ("mtllib \"my colours.mtl\"", &[("my colours.mtl", both())]),
        ("mtllib \"my one.mtl\" \"two.mtl\"", &[("my one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib \"my one.mtl\" two.mtl", &[("my one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib ./one.mtl .\\two.mtl", &[("one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib sub\\one.mtl sub/two.mtl", &[("sub/one.mtl", red("a")), ("sub/two.mtl", blue("b"))]),
        ("mtllib my\\ one.mtl two.mtl", &[("my one.mtl", red("a")), ("two.mtl", blue("b"))]),
        ("mtllib my\\ fine\\ colours", &[("my fine colours", both())]),
        ("mtllib x.mtl   ", &[("x.mtl", both())]),
        ("mtllib m.obj.mtl", &[("m.obj.mtl", both())]),
    ];
    for (statement, files) in cases {
        let loaded = read(statement, files);
        assert_eq!(colours(&loaded), [RED, BLUE], "{statement}");
        assert_eq!(said(&loaded), "", "{statement}");
    }
}

/// A statement, the file that is there, and what is said.
const OTHERWISE: &[(&str, &str, &str)] = &[
    ("mtllib LIB.MTL", "lib.mtl", "letters of another case"),
    ("mtllib lib.mtl", "Lib.Mtl", "letters of another case"),
    ("mtllib Sub/lib.mtl", "sub/LIB.mtl", "letters of another case"),
    ("mtllib C:\\Users\\me\\Desktop\\lib.mtl", "lib.mtl", "folder it names is not here"),
    ("mtllib C:\\Users\\me\\my things\\my lib.mtl", "my lib.mtl", "folder it names is not here"),
    ("mtllib \"D:\\work\\sub\\lib.mtl\"", "sub/lib.mtl", "folder it names is not here"),
    ("mtllib \\\\server\\share\\LIB.mtl", "lib.mtl", "folder it names is not here"),
    ("mtllib /home/me/no/such/lib.mtl", "lib.mtl", "folder it names is not here"),
    ("mtllib textures/lib.mtl", "lib.mtl", "folder it names is not here"),
    ("mtllib none.mtl", "m.mtl", "of the model's own name, is read"),
    ("mtllib none.mtl", "M.MTL", "of the model's own name, is read"),
    ("mtllib none.mtl", "m.obj.mtl", "of the model's own name, is read"),
    ("# no library", "m.mtl", "no `mtllib` names one"),
    ("mtllib", "m.mtl", "`mtllib` without a file name is left out"),
];

#[test]
fn names_of_another_machine_are_found_and_told() {
    for (statement, file, word) in OTHERWISE {
        let loaded = read(statement, &[(file, [red("a"), blue("b")].concat())]);
        assert_eq!(colours(&loaded), [RED, BLUE], "{statement}");
        let said = said(&loaded);
        assert!(said.contains(word) && said.contains("warning"), "{statement}: {said}");
        assert!(!said.contains("rendered grey\n"), "{statement}: {said}");
    }
}

#[test]
fn what_is_not_found_is_told_with_what_was_meant() {
    let library = || red("a");
    for (statement, files, column, words) in [
        ("mtllib coluors.mtl", vec![("colours.mtl", library())], 8, ["coluors.mtl", "did you mean `colours.mtl`"]),
        (
            "mtllib C:\\x\\coluors.mtl",
            vec![("colours.mtl", library())],
            8,
            ["coluors.mtl", "did you mean `colours.mtl`"],
        ),
        ("mtllib things.mtl", vec![("one.mtl", library()), ("two.mtl", library())], 8, ["things", "one.mtl, two.mtl"]),
        ("mtllib things.mtl", vec![], 8, ["things.mtl", "rendered grey"]),
        // Two files of which either could be meant.
        ("mtllib LIB.mtl", vec![("lib.mtl", library()), ("Lib.mtl", library())], 8, ["LIB.mtl", "did you mean"]),
        ("mtllib one.mtl gone.mtl", vec![("one.mtl", library())], 16, ["gone.mtl", "one.mtl"]),
    ] {
        let alike = files.len() == 2 && files[0].0.eq_ignore_ascii_case(files[1].0);
        if alike && cfg!(any(windows, target_os = "macos")) {
            continue;
        }
        let loaded = read(statement, &files);
        let found = loaded.warnings.iter().find(|warning| warning.message.contains("there is no material library"));
        let found = found.unwrap_or_else(|| panic!("{statement}: {}", said(&loaded)));
        assert!(words.iter().all(|word| found.to_string().contains(word)), "{found}");
        assert_eq!((found.line, found.column), (1, column), "{found}");
    }
}

#[test]
fn a_library_of_the_models_own_name_is_read_only_where_no_other_is_there() {
    let loaded = read("mtllib other.mtl", &[("other.mtl", red("a")), ("m.mtl", [blue("a"), blue("b")].concat())]);
    assert_eq!(colours(&loaded)[0], RED);
    assert_eq!(loaded.description.materials["m:b"].kd, Vec3::splat(0.6));
}

#[test]
fn odd_statements_end_soon() {
    let many = format!("mtllib {}", "x.mtl ".repeat(5000));
    let deep = format!("mtllib {}x.mtl", "a/".repeat(1500));
    let long = format!("mtllib {}", "y".repeat(100_000));
    let quotes = format!("mtllib {}", "\"\" \" ".repeat(1000));
    let words = format!("mtllib {}", "z ".repeat(200_000));
    for statement in [many, deep, long, quotes, words] {
        let started = std::time::Instant::now();
        read(&statement, &[("l.mtl", red("a"))]);
        assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
    }
}

/// The bytes of `m.obj` and `m.mtl`, which use one name for a red material.
fn read_bytes(name_in_obj: &[u8], name_in_mtl: &[u8], library: &[u8]) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    let obj = [
        b"mtllib ",
        library,
        b"\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng W\xe4nde\no \xb2\xc4\nusemtl ",
        name_in_obj,
        b"\nf 1 2 3\n",
    ];
    std::fs::write(folder.path().join("m.obj"), obj.concat()).unwrap();
    let others = [b"newmtl caf\xe8\nKd 0 1 0\nnewmtl \x80\nKd 0 1 0\nnewmtl \x81\nKd 0 1 0\nnewmtl ", name_in_mtl];
    let mtl = [&others.concat(), b"\nKd 0.8 0.1 0.1 # r\xf6tlich\nmap_Kd b\xf6se.png\n".as_slice()].concat();
    std::fs::write(folder.path().join("b\u{f6}hm.mtl"), &mtl).unwrap();
    std::fs::write(folder.path().join("l.mtl"), mtl).unwrap();
    load(&folder.path().join("m.obj"), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn names_are_bytes() {
    let names: &[&[u8]] = &[
        b"K\xf6ln",
        b"caf\xe9",
        // GBK and Shift-JIS, one whose last byte is a backslash, and bytes that are no letters anywhere.
        b"\xc4\xbe\xcd\xb7",
        b"\xca\xaf\xd7\xa9",
        b"\x95\x5c",
        b"\x82",
        b"\xff\xfe",
        "Köln".as_bytes(),
        "木头".as_bytes(),
        b"with spaces \xe9\xa0 and more",
    ];
    for name in names {
        let loaded = read_bytes(name, name, b"l.mtl");
        let said = said(&loaded);
        assert!(!said.contains("no library has a material"), "{}: {said}", name.escape_ascii());
        assert_eq!(loaded.description.materials.len(), 1);
        let material = loaded.description.materials.values().next().unwrap();
        assert_eq!(material.kd, RED, "{}", name.escape_ascii());
    }
    let other = read_bytes(b"caf\xe9", b"caf\xea", b"l.mtl");
    assert!(said(&other).contains("no library has a material `café`"), "{}", said(&other));
    // Quotes belong to no name, in either file.
    for (obj, mtl) in [(&b"\"K\xf6ln\""[..], &b"K\xf6ln"[..]), (b"a", b"\"a\""), (b"a b  ", b"a b\t")] {
        assert_eq!(read_bytes(obj, mtl, b"l.mtl").description.materials.values().next().unwrap().kd, RED);
    }
}

#[test]
fn a_library_is_found_whatever_encoding_its_name_is_in() {
    for library in [b"b\xf6hm.mtl".as_slice(), "b\u{f6}hm.mtl".as_bytes(), b"B\xd6HM.mtl"] {
        let loaded = read_bytes(b"a", b"a", library);
        assert_eq!(loaded.description.materials["m:a"].kd, RED, "{}: {}", library.escape_ascii(), said(&loaded));
    }
}
