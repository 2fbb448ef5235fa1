//! Every kind of shader error, at its exact place in the file that holds it.

use lucerna::layout::{FieldLayout, FieldType, StructLayout};
use lucerna::shader::{ErrorKind, Features, Library, ShaderError};

use crate::shader::{features, library};

/// Links the first of some modules, which must fail.
fn error(modules: &[(&str, &str)]) -> ShaderError {
    library(modules).link(modules[0].0, &Features::new()).expect_err("a planted error was not found")
}

/// Links one module, and compares kind, line, column and part of the message.
#[track_caller]
fn check(text: &str, kind: ErrorKind, place: (usize, usize), message: &str) {
    let error = error(&[("t/p", text)]);
    assert_eq!((error.kind, error.line_column()), (kind, Some(place)), "{error:?}");
    assert_eq!(error.file(), Some("shaders/t/p.wgsl"));
    assert!(error.message.contains(message), "{error}");
    assert_eq!(error.to_string(), format!("shaders/t/p.wgsl:{}:{}: {}", place.0, place.1, error.message));
    assert!(!error.message.contains(" ["), "a handle of naga in: {error}");
}

#[test]
fn syntax_errors() {
    let check = |text: &str, place, message: &str| check(text, ErrorKind::Syntax, place, message);
    check("fn f() -> u32 {\n    return 1u +;\n}\n", (2, 16), "expected expression, found \";\"");
    check("fn f() -> u32 {\n    let a = 1u\n    return a;\n}\n", (3, 5), "expected `;`, found \"return\"");
    check("const a = 12zz;", (1, 13), "expected `;`");
    check("fn f(from: u32) {}", (1, 6), "reserved keyword");
    check("fn f() -> u32 {\n    let a = 1u;\n", (1, 15), "this `{` is never closed");
    check("fn f() {\n}\n}\n", (3, 1), "this `}` closes nothing");
    check("fn f(\n    a: u32 {\n}\n)\n{}\nfn g(x: array<u32, (2] >) {}", (6, 22), "does not close the `(` of line 6");
    check("const a = 1u;\nconst b = 2u\n// the end\n", (2, 11), "in the middle of a declaration");
    check("fn f() {}\n/* one /* two */\n", (2, 1), "this comment has no end");
}

#[test]
fn type_errors() {
    let check = |text: &str, place, message: &str| check(text, ErrorKind::Type, place, message);
    check("fn f() -> u32 {\n    return nothing + 1u;\n}\n", (2, 12), "`nothing`");
    check("fn f() {\n    let a: u32 = 1.5f;\n}\n", (2, 9), "the type of `a` is expected to be `u32`");
    check("fn f(x: f32) -> u32 {\n    let y = x;\n    return y + 1.0;\n}\n", (3, 12), "returns `y + 1.0`");
    check("fn f(x: f32) -> u32 {\n    let y = x * 2.0;\n    return y;\n}\n", (3, 5), "returns `y`, but");
    check(
        "fn f(b: f32) {\n    let c = 2u;\n    let d = c + b;\n}\n",
        (3, 13),
        "Add can't work with `c` (u32) and `b` (f32)",
    );
    check("fn g(a: u32) {}\nfn f(b: f32) {\n    g(b);\n}\n", (3, 5), "`g` wants `u32` as argument 1, which `b` is not");
    check("fn g(a: u32) {}\nfn f(b: f32) {\n    g();\n}\n", (3, 5), "Requires 1 arguments");
    check("fn f(b: f32) {\n    var a = 1u;\n    a = b;\n}\n", (3, 5), "cannot convert");
    check("struct S { a: u32 }\nfn f(s: S) -> u32 {\n    return s.b;\n}\n", (3, 14), "`b`");
    check("fn f(b: f32) {\n    if b {\n    }\n}\n", (2, 5), "`if` condition `b`");
    check("fn f() -> u32 {\n    var a: array<u32, 4>;\n    return a[4];\n}\n", (3, 12), "out of `a` bounds");
    check("fn f(b: u32) -> f32 {\n    return sqrt(b);\n}\n", (2, 12), "`sqrt`");
    check("fn f(a: f32) -> vec3<f32> {\n    return vec3<f32>(a, a);\n}\n", (2, 12), "2 were given");
    check("fn f(b: u32) -> u32 {\n    return f(b);\n}\n", (1, 4), "recursive");
    check("fn f(a: u32) {\n    switch a {\n        case 1u: {}\n    }\n}\n", (2, 5), "`default` case");
    check("// i64_\nfn f(a: i64) {}\n", (2, 9), "`i64`");
    check("@compute @workgroup_size(0)\nfn main() {}\n", (2, 4), "Workgroup size is out of range");
}

#[test]
fn binding_errors() {
    let check = |text: &str, place, message: &str| check(text, ErrorKind::Binding, place, message);
    let first = "@group(0) @binding(0) var<storage, read> a: array<u32>;\n";
    let main = |body: &str| format!("@compute @workgroup_size(1) fn main() {{ {body} }}\n");
    let missing = format!("var<storage, read> a: array<u32>;\n{}", main("let x = a[0];"));
    check(&missing, (1, 1), "`a` wants @group and @binding");
    let twice = format!("{first}{}{}", first.replace("a:", "b:"), main("let x = a[0] + b[0];"));
    check(&twice, (2, 23), "`main` uses another variable than `b` at @group(0) @binding(0)");
    check("@group(0) @binding(0) var a: texture_2d<f32>;\n", (1, 23), "passes have no other bindings");
    check("@group(0) @binding(0) var<uniform> a: f32;\n", (1, 23), "passes have no other bindings");
}

#[test]
fn a_buffer_for_reading_is_not_written() {
    let text = "@group(0) @binding(0) var<storage, read> a: array<u32>;\n\
                @compute @workgroup_size(1) fn main() {\n    a[0] = 1u;\n}\n";
    check(text, ErrorKind::Type, (3, 5), "`a[0]` can't be written");
}

#[test]
fn import_errors() {
    let kind = ErrorKind::Import;
    check("import package::t::nowhere::x;\n", kind, (1, 29), "there is no module `t/nowhere`");
    check("import package::lib;\n", kind, (1, 17), "names a module and what it takes");
    check("import package::gen::Missing;\n", kind, (1, 22), "package::gen has no struct or constant `Missing`");
    check("import super::x;\n", ErrorKind::Syntax, (1, 8), "starts with `package::`");
    check("import package::gen::LinkItem as Item;\n", ErrorKind::Syntax, (1, 31), "`as` is not supported");
    check("import package::gen::{LinkItem LinkParams};\n", ErrorKind::Syntax, (1, 32), "wants `,` or `}`");
    check("import package::gen::{1};\n", ErrorKind::Syntax, (1, 23), "wants a name");

    let a = ("t/a", "fn one() -> u32 { return 1u; }\n@if(never) fn two() {}\n");
    let missing = error(&[("t/p", "import package::t::a::{one,\n    two};\n"), a]);
    assert_eq!(missing.to_string(), "shaders/t/p.wgsl:2:5: `t/a` declares no `two` under these features");
    let whole = error(&[("t/p", "import package::t::a;\n"), a]);
    assert_eq!(whole.to_string(), "shaders/t/p.wgsl:1:20: there is no module `t`");
    assert_eq!(whole.help.as_deref(), Some("`t/a` is a module: name what to take from it"));
}

#[test]
fn an_error_in_an_import_is_at_its_own_place() {
    let root = ("t/p", "import package::t::a::one;\nfn f() -> u32 { return one(); }\n");
    let broken = ("t/a", "// Grüße\n@if(never)\nfn no() {}\nfn one() -> u32 { /* ä */ return 1.5f; }\n");
    let error = error(&[root, broken]);
    assert_eq!(error.file(), Some("shaders/t/a.wgsl"));
    assert_eq!(error.line_column(), Some((4, 34)));
    let line = "fn one() -> u32 { /* ä */ return 1.5f; }";
    let report = format!("{error}\n 4 | {line}\n   | {}^^^^", " ".repeat(33));
    assert_eq!(error.report(), report);
}

#[test]
fn a_name_needs_its_import() {
    let root = ("t/p", "import package::t::a::one;\nfn f() -> u32 {\n    return one() + two();\n}\n");
    let a = ("t/a", "import package::t::b::two;\nfn one() -> u32 { return two(); }\n");
    let b = ("t/b", "fn two() -> u32 { return 2u; }\n");
    let used = error(&[root, a, b]);
    assert_eq!(used.to_string(), "shaders/t/p.wgsl:3:20: `two` is not imported here");
    assert_eq!(used.help.as_deref(), Some("import package::t::b::two;"));
    let unknown = error(&[("t/p", "fn f() -> u32 {\n    return two();\n}\n"), b]);
    assert_eq!(unknown.to_string(), "shaders/t/p.wgsl:2:12: no definition in scope for identifier: `two`");
    assert_eq!(unknown.help.as_deref(), Some("import package::t::b::two;"));
}

#[test]
fn cycles_and_duplicates() {
    let cycle = error(&[
        ("t/p", "import package::t::a::one;\n"),
        ("t/a", "import package::t::b::two;\nfn one() {}\n"),
        ("t/b", "\nimport package::t::a::one;\nfn two() {}\n"),
    ]);
    assert_eq!(cycle.kind, ErrorKind::Cycle);
    assert_eq!(cycle.to_string(), "shaders/t/b.wgsl:2:23: these modules import each other: t/a -> t/b -> t/a");
    let itself = error(&[("t/p", "import package::t::p::one;\nfn one() {}\n")]);
    assert_eq!(itself.to_string(), "shaders/t/p.wgsl:1:23: these modules import each other: t/p -> t/p");

    let twice =
        error(&[("t/p", "import package::t::a::one;\nfn two() {}\n"), ("t/a", "fn one() {}\nconst two = 1;\n")]);
    assert_eq!(twice.kind, ErrorKind::Duplicate);
    assert_eq!(twice.to_string(), "shaders/t/p.wgsl:2:4: `two` is declared twice: first at shaders/t/a.wgsl:2:7");
    let generated = error(&[("t/p", "import package::gen::LinkItem;\nstruct LinkItem { a: u32 }\n")]);
    assert_eq!(generated.kind, ErrorKind::Duplicate);
    assert_eq!(generated.line_column(), Some((2, 8)));
}

#[test]
fn condition_errors() {
    let check = |text: &str, place, message: &str| check(text, ErrorKind::Syntax, place, message);
    check("@if fn f() {}\n", (1, 5), "wants `(`");
    check("@if() fn f() {}\n", (1, 5), "a feature's name belongs here");
    check("@if(a fn f() {}\n", (1, 4), "never closed");
    check("@if(a b) fn f() {}\n", (1, 7), "wants `)`");
    check("@if(a)\n", (2, 1), "wants a declaration, statement");
    check("fn f() {\n    @if(a)\n}\n", (3, 1), "wants a declaration, statement");
    check("@else fn f() {}\n", (1, 1), "follows no @if");
    check("@if(a) fn f() {}\n@else fn f() {}\n@else fn f() {}\n", (3, 1), "follows no @if");
    check("@if(a) @if(b) fn f() {}\n", (1, 8), "one for each item");
    let deep = format!("fn f() {{ {}{} }}\n", "@if(a) { ".repeat(80), "}".repeat(80));
    check(&deep, (1, 10 + 63 * 9 + 7), "more than 64 deep");
    let parentheses = format!("@if({}a{}) fn f() {{}}\n", "(".repeat(10_000), ")".repeat(10_000));
    assert_eq!(error(&[("t/p", &parentheses)]).kind, ErrorKind::Syntax);
}

/// Says what `LinkItem` would be if Rust had put its second field elsewhere.
static WRONG_OFFSET: StructLayout = StructLayout {
    name: "Wrong",
    size: 16,
    align: 4,
    fields: &[
        FieldLayout { name: "a", ty: FieldType::Plain("u32"), offset: 0, size: 4 },
        FieldLayout { name: "b", ty: FieldType::Array(&FieldType::Plain("u32"), 2), offset: 8, size: 8 },
    ],
};
static WRONG_STRIDE: StructLayout = StructLayout {
    name: "Wrong",
    size: 36,
    align: 16,
    fields: &[FieldLayout { name: "a", ty: FieldType::Array(&FieldType::Plain("vec3<f32>"), 3), offset: 0, size: 36 }],
};
static WRONG_SIZE: StructLayout = StructLayout {
    name: "Wrong",
    size: 12,
    align: 16,
    fields: &[FieldLayout { name: "a", ty: FieldType::Plain("vec3<f32>"), offset: 0, size: 12 }],
};

#[test]
fn layouts_that_differ_from_wgsl() {
    for (layout, place, message) in [
        (&WRONG_OFFSET, (3, 5), "`Wrong.b` is 8 bytes at offset 8 in Rust, 8 at 4 in WGSL"),
        (&WRONG_STRIDE, (2, 5), "`Wrong.a` is 36 bytes at offset 0 in Rust, 48 at 0 in WGSL"),
        (&WRONG_SIZE, (1, 8), "`Wrong` is 12 bytes aligned to 16 in Rust, 16 aligned to 16 in WGSL"),
    ] {
        let library = Library::embedded().with_layouts(&[layout], &[]);
        let error = library.with("t/p", "import package::gen::Wrong;\n").link("t/p", &features(&[])).unwrap_err();
        assert_eq!((error.kind, error.file()), (ErrorKind::Layout, Some("<generated layout>")));
        assert_eq!(error.line_column(), Some(place), "{error:?}");
        assert_eq!(error.message, message);
    }
}

#[test]
fn errors_without_a_file() {
    let unknown = Library::embedded().link("t/none", &Features::new()).unwrap_err();
    assert_eq!((unknown.kind, unknown.place.is_none()), (ErrorKind::Import, true));
    let missing = Library::open(std::path::Path::new("no/such/folder")).err().unwrap();
    assert_eq!(missing.kind, ErrorKind::Read);
    assert!(missing.to_string().starts_with("no/such/folder: "), "{missing}");
}

#[test]
fn a_file_that_is_no_text_is_an_error_only_where_it_is_imported() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("lib")).unwrap();
    std::fs::write(folder.path().join("lib/noise.wgsl"), [0xff, 0xfe, 0x00]).unwrap();
    std::fs::write(folder.path().join("good.wgsl"), "fn f() {}\n").unwrap();
    std::fs::write(folder.path().join("bad.wgsl"), "fn f() {}\nimport package::lib::noise::hiss;\n").unwrap();
    let library = Library::open(folder.path()).unwrap();
    assert_eq!(library.modules().collect::<Vec<_>>(), ["bad", "good", "lib/noise"]);
    library.link("good", &Features::new()).unwrap();
    let error = library.link("bad", &Features::new()).unwrap_err();
    assert_eq!((error.kind, error.line_column()), (ErrorKind::Read, Some((1, 1))));
    assert!(error.file().is_some_and(|file| file.ends_with("lib/noise.wgsl")), "{error}");
}

/// A file, the place of its first wrong byte, and words of the message and of its help.
type NoText<'a> = (&'a [u8], (usize, usize), &'a str, &'a str);

#[test]
fn a_file_that_is_not_utf_8_is_named_with_the_byte() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [NoText; 4] = [
        (b"fn f() {}\n// caf\xe9\n", (2, 7), "byte 16 of this file, 0xe9", "in Latin-1 this byte is `\u{e9}`"),
        (b"\xff\xfef\0n\0", (1, 1), "byte 0 of this file, 0xff", "UTF-16"),
        (b"// \xc3\xa9\xc3\n", (1, 5), "byte 5 of this file, 0xc3", "UTF-8"),
        (b"fn f() {}\n\x80", (2, 1), "byte 10 of this file, 0x80", "UTF-8"),
    ];
    for (bytes, place, message, help) in cases {
        std::fs::write(folder.path().join("p.wgsl"), bytes).unwrap();
        std::fs::write(folder.path().join("q.wgsl"), "\nimport package::p::f;\n").unwrap();
        for module in ["p", "q"] {
            let library = Library::open(folder.path()).unwrap();
            let error = library.link(module, &Features::new()).unwrap_err();
            assert_eq!((error.kind, error.line_column()), (ErrorKind::Read, Some(place)), "{error}");
            assert!(error.file().is_some_and(|file| file.ends_with("/p.wgsl")), "{error}");
            assert!(error.message.contains(message), "{error}");
            assert!(error.help.as_deref().is_some_and(|text| text.contains(help)), "{:?}", error.help);
        }
    }
}

/// Modules before and behind, so that a place in the joined text is not one in the file.
#[test]
fn what_naga_gives_no_place_is_placed_all_the_same() {
    let other = (
        "t/a",
        "// one\n// two\nfn one(v: vec3<f32>) -> f32 {\n    if v[2] > 1.0 { return v[0]; }\n    return 3.0;\n}\n",
    );
    let cases: &[(&str, (usize, usize), &str)] = &[
        ("fn f(v: vec3<f32>) -> f32 {\n    return v[3];\n}\n", (3, 13), "Index 3 is out of bounds"),
        ("fn f(m: mat3x3<f32>) -> vec3<f32> {\n    let a = m[0];\n    return m[3] + a;\n}\n", (4, 13), "Index 3"),
        (
            "fn f() -> f32 {\n    var v = vec2<f32>(1.0);\n    if v[0] > v[2] {\n        return 1.0;\n    }\n    return v[1];\n}\n",
            (4, 16),
            "Index 2",
        ),
        (
            "fn g(v: vec4<f32>) -> f32 { return v[3]; }\nfn f(v: ptr<function, vec3<f32>>) -> f32 {\n    for (var i = 0; i < 3; i++) {\n        (*v)[i] = 1.0;\n        (*v)[3u] = 2.0;\n    }\n    return 0.0;\n}\n",
            (6, 13),
            "Index 3",
        ),
        ("struct S { m: mat2x2<f32> }\nfn f(s: S) -> f32 {\n    return s.m[1][2];\n}\n", (4, 18), "Index 2"),
        (
            "fn f(k: i32) -> f32 {\n    let v = vec3<f32>(1.0);\n    switch k {\n        case 1: { return v[4]; }\n        default: { return v[1]; }\n    }\n}\n",
            (5, 27),
            "Index 4",
        ),
        ("fn f() {\n    var x: array<f32, 4294967295>;\n}\n", (3, 5), "array<f32, 4294967295>"),
        ("var<private> big: array<vec4<f32>, 4000000000>;\nfn f() {}\n", (2, 1), "array<vec4<f32>, 4000000000>"),
        ("struct S { a: array<vec4<f32>, 4000000000> }\nfn f(s: S) {}\n", (2, 12), "struct member is too large"),
    ];
    for (text, place, message) in cases {
        let root = format!("import package::t::a::one;\n{text}");
        let found = error(&[("t/p", &root), other]);
        assert_eq!(found.file(), Some("shaders/t/p.wgsl"), "{text}: {found}");
        assert_eq!(found.line_column(), Some(*place), "{text}: {found}");
        assert!(found.message.contains(message) && !found.message.contains(" ["), "{text}: {found}");
        // The same in a module that is imported.
        let inner = [("t/p", "import package::t::b::f;\n\n"), ("t/b", &root), other];
        let found = error(&inner);
        assert_eq!((found.file(), found.line_column()), (Some("shaders/t/b.wgsl"), Some(*place)), "{text}: {found}");
    }
}

#[test]
fn miette_shows_the_original_line() {
    let error = error(&[("t/p", "fn f() -> u32 {\n    return 1u +;\n}\n")]);
    let mut shown = String::new();
    miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::none())
        .render_report(&mut shown, &error)
        .unwrap();
    assert!(shown.contains("shaders/t/p.wgsl:2:16") && shown.contains("return 1u +;"), "{shown}");
}
