//! Parameters in linked texts: words of a buffer, read where the name stands.

use lucerna::shader::{ErrorKind, Linked, ResourceKind, SHADER_VALUES};

use crate::shader::{features, library};

const USER: &str = "import package::t::a::{SIZE, TURN};
override OWN: u32 = 3;
override LOST: i32 = -3;
@group(0) @binding(4) var<storage, read_write> out: array<f32>;
@compute @workgroup_size(1)
fn main() {
    if (TURN) {
        out[OWN] = SIZE * SIZE;
    }
}
@compute @workgroup_size(1)
fn other() { out[0] = 1.0; }
";
const OWNER: &str = "@range(0.0, 16.0) override SIZE: f32 = 8.0;
override TURN: bool = false;
fn f() -> i32 { return 1; }
";

fn link(user: &str, owner: &str) -> Linked {
    library(&[("t/p", user), ("t/a", owner)]).link("t/p", &features(&[])).unwrap()
}

#[test]
fn names_read_words_and_only_those_that_are_read_count() {
    let linked = link(USER, OWNER);
    let words: Vec<_> = linked.parameters.iter().map(|l| (l.parameter.name.as_str(), l.is_read)).collect();
    assert_eq!(words, [("SIZE", true), ("TURN", true), ("OWN", true), ("LOST", false)]);
    let main = linked.entry("main").unwrap();
    let bound: Vec<_> = main.bindings.iter().map(|b| (b.name.as_str(), b.binding, b.kind, b.size)).collect();
    assert_eq!(
        bound,
        [("out", 4, ResourceKind::StorageReadWrite, 4), (SHADER_VALUES, 5, ResourceKind::StorageRead, 16)]
    );
    // What reads none has no such buffer.
    assert_eq!(linked.entry("other").unwrap().bindings.len(), 1);
    assert!(linked.module.overrides.is_empty());
}

#[test]
fn another_default_or_range_is_no_other_code_and_another_name_is() {
    let before = link(USER, OWNER);
    let moved = OWNER.replace("@range(0.0, 16.0)", "@range(1.0, 4.0)").replace("8.0", "2.0");
    let after = link(USER, &moved);
    assert_eq!(before.fingerprint(), after.fingerprint());
    assert_eq!(after.parameters[0].parameter.default, 2.0);
    // But it does something else, where the default counts; a range alone does not.
    assert!(!before.is_same(&after));
    assert!(before.is_same(&link(USER, &OWNER.replace("@range(0.0, 16.0)", "@range(1.0, 9.0)"))));
    assert!(before.is_same(&link(&USER.replace("= -3", "= -4"), OWNER)), "of what nothing reads");
    let renamed = link(&USER.replace("OWN", "OTHER"), OWNER);
    assert_ne!(before.fingerprint(), renamed.fingerprint());
}

/// Some module, linked with a parameter's declaration in its second line.
fn error(body: &str) -> (ErrorKind, (usize, usize), String) {
    let text = format!("// A module.\noverride SIZE: f32 = 8.0;\n{body}");
    let error = library(&[("t/p", &text)]).link("t/p", &features(&[])).expect_err(body);
    assert_eq!(error.file(), Some("shaders/t/p.wgsl"), "{error}");
    (error.kind, error.line_column().unwrap(), error.message)
}

#[test]
fn errors_beside_a_name_are_at_their_own_places() {
    let behind = error("fn f() -> f32 {\n    return SIZE * SIZE + nothing;\n}\n");
    assert_eq!((behind.0, behind.1), (ErrorKind::Type, (4, 26)), "{}", behind.2);
    let at = error("fn f() -> u32 {\n    let a = 1u + SIZE;\n    return a;\n}\n");
    assert_eq!((at.0, at.1.0), (ErrorKind::Type, 4), "{}", at.2);
    let syntax = error("fn f() -> f32 {\n    return SIZE SIZE;\n}\n");
    assert_eq!((syntax.0, syntax.1), (ErrorKind::Syntax, (4, 17)), "{}", syntax.2);
}

#[test]
fn a_parameter_is_neither_written_nor_a_constant() {
    let written = error("@compute @workgroup_size(1) fn main() {\n    SIZE = 2.0;\n}\n");
    assert_eq!(written.1, (4, 5), "{}", written.2);
    let constant = error("const TWICE = 2.0 * SIZE;\nfn f() -> f32 {\n    return TWICE;\n}\n");
    assert_eq!(constant.1.0, 3, "{}", constant.2);
}

#[test]
fn its_name_means_nothing_else_where_it_is_known() {
    let (kind, place, message) = error("fn f(SIZE: f32) -> f32 {\n    return SIZE;\n}\n");
    assert_eq!((kind, place), (ErrorKind::Duplicate, (2, 10)), "{message}");
    // A module that knows nothing of it may have the name.
    let apart = "import package::t::a::{f};\nfn g() -> i32 {\n    let SIZE = f();\n    return SIZE;\n}\n";
    link(apart, OWNER);
}

#[test]
fn a_name_without_its_import_is_told() {
    let modules = [("t/p", "import package::t::a::{f};\nfn g() -> f32 { return SIZE; }\n"), ("t/a", OWNER)];
    let error = library(&modules).link("t/p", &features(&[])).unwrap_err();
    assert_eq!((error.kind, error.line_column()), (ErrorKind::Import, Some((2, 24))), "{error}");
    assert_eq!(error.help.as_deref(), Some("import package::t::a::SIZE;"));
}
