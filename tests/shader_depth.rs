//! Shaders that nest deeper than any stack carries: an error with a place, on a thread as small as a test's own.

use lucerna::shader::{ErrorKind, Features, Library, ShaderError};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::shader::library;

/// A kernel with some declarations before it, and a body in which `x`, `k` and `b` are values.
fn kernel(before: &str, body: &str) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read_write> o: array<f32>;\n{before}\n\
         @compute @workgroup_size(1) fn main() {{\nlet x = o[1]; var k = i32(o[2]); var b = x > 0.0;\n{body}\n}}\n"
    )
}

/// Something that nests `n` deep.
type Shape = (&'static str, fn(usize) -> String);

const SHAPES: &[Shape] = &[
    ("minus", |n| kernel("", &format!("o[0] = {}x;", "- ".repeat(n)))),
    ("not", |n| kernel("", &format!("b = {}b;", "!".repeat(n)))),
    ("complement", |n| kernel("", &format!("k = {}k;", "~".repeat(n)))),
    ("pointers", |n| kernel("", &format!("k = {}k;", "*&".repeat(n)))),
    ("pointers on the left", |n| kernel("", &format!("{}k = 1;", "*&".repeat(n)))),
    ("sum", |n| kernel("", &format!("o[0] = x{};", " + x".repeat(n)))),
    ("sum of products", |n| kernel("", &format!("o[0] = x{};", " + x * 2.0".repeat(n)))),
    ("constant sum", |n| kernel(&format!("const C = 1.0{};", " + 1.0".repeat(n)), "o[0] = C;")),
    ("and", |n| kernel("", &format!("b = b{};", " && x > 1.0".repeat(n)))),
    ("or", |n| kernel("", &format!("if b{} {{ k = 1; }}", " || b".repeat(n)))),
    ("members", |n| kernel("", &format!("o[0] = vec4<f32>(x){}.x;", ".xyzw".repeat(n)))),
    ("else if", |n| kernel("", &format!("if b {{ k = 1; }}{}", " else if x > 1.0 { k = 2; }".repeat(n)))),
    ("parentheses", |n| kernel("", &format!("o[0] = {}x{};", "(".repeat(n), ")".repeat(n)))),
    ("parentheses on the right", |n| kernel("", &format!("o[0] = {}x{};", "x + (".repeat(n), ")".repeat(n)))),
    ("calls in calls", |n| kernel("", &format!("o[0] = {}x{};", "abs(".repeat(n), ")".repeat(n)))),
    ("indices", |n| kernel("", &format!("var a = array<i32, 2>(1, 0); k = {}k{};", "a[".repeat(n), "]".repeat(n)))),
    ("index behind index", |n| {
        let ty = format!("{}f32{}", "array<".repeat(n), ", 1>".repeat(n));
        kernel("", &format!("var a: {ty}; o[0] = a{};", "[k]".repeat(n)))
    }),
    ("lists of types", |n| kernel("", &format!("var a: {}f32{};", "array<".repeat(n), ", 1>".repeat(n)))),
    ("pointer types", |n| {
        let ty = format!("{}f32{}", "ptr<function, ".repeat(n), ">".repeat(n));
        kernel(&format!("fn f(a: {ty}) {{}}"), "")
    }),
    ("blocks", |n| kernel("", &format!("{}k = 1;{}", "{".repeat(n), "}".repeat(n)))),
    ("ifs", |n| kernel("", &format!("{}k = 1;{}", "if b { ".repeat(n), "}".repeat(n)))),
    ("elses", |n| kernel("", &format!("{}k = 1;{}", "if b { } else { ".repeat(n), "}".repeat(n)))),
    ("loops", |n| kernel("", &format!("{}{}", "loop { ".repeat(n), "break; }".repeat(n)))),
    ("whiles", |n| kernel("", &format!("{}k = 1;{}", "while b { ".repeat(n), "}".repeat(n)))),
    ("switches", |n| kernel("", &format!("{}k = 1;{}", "switch k { default: { ".repeat(n), "} }".repeat(n)))),
    ("conditions", |n| format!("@if({}a{}) fn f() {{}}", "(".repeat(n), ")".repeat(n))),
    ("unbalanced", |n| kernel("", &format!("o[0] = {};", "(".repeat(n)))),
    ("types of types", |n| {
        let chain: String = (0..n).map(|i| format!("struct T{} {{ a: T{i} }}\n", i + 1)).collect();
        kernel(&format!("struct T0 {{ a: f32 }}\n{chain}"), &format!("var a: T{n}; a.a = T{}(); k = 1;", n - 1))
    }),
    ("aliases of arrays", |n| {
        let chain: String = (0..n).map(|i| format!("alias T{} = array<T{i}, 1>;\n", i + 1)).collect();
        kernel(&format!("alias T0 = f32;\n{chain}"), &format!("var a: T{n}; k = 1;"))
    }),
    ("functions that call", |n| {
        let chain: String = (0..n).map(|i| format!("fn g{}(x: f32) -> f32 {{ return g{i}(x); }}\n", i + 1)).collect();
        kernel(&format!("fn g0(x: f32) -> f32 {{ return x; }}\n{chain}"), &format!("o[0] = g{n}(x);"))
    }),
];

fn link(text: &str) -> Result<(), ShaderError> {
    library(&[("t/p", text)]).link("t/p", &Features::new()).map(drop)
}

/// An error at a place that the file has.
#[track_caller]
fn located(name: &str, text: &str) -> ShaderError {
    let error = link(text).expect_err(name);
    let (line, column) = error.line_column().expect(name);
    assert_eq!(error.file(), Some("shaders/t/p.wgsl"), "{name}: {}", error.message);
    assert!(line <= text.lines().count(), "{name}: line {line}, {}", error.message);
    assert!(
        column <= text.lines().nth(line - 1).unwrap().chars().count(),
        "{name}: column {column}, {}",
        error.message
    );
    error
}

#[test]
fn deep_code_is_an_error_with_a_place() {
    for (name, shape) in SHAPES {
        for n in [3_000, 12_000] {
            let error = located(name, &shape(n));
            assert!(matches!(error.kind, ErrorKind::Syntax | ErrorKind::Type), "{name}: {error}");
        }
    }
}

#[test]
fn what_is_too_deep_is_named_where_it_becomes_so() {
    let error = located("minus", &kernel("", &format!("o[0] = {}x;", "- ".repeat(5_000))));
    // The sign behind the thousandth.
    assert_eq!(error.line_column(), Some((5, 8 + 2 * 999)), "{error}");
    let error = located("parentheses", &kernel("", &format!("o[0] =\n{}x{};", "(".repeat(300), ")".repeat(300))));
    assert_eq!((error.line_column(), error.help.is_some()), (Some((6, 100)), true), "{error}");
}

#[test]
fn long_code_is_not_deep() {
    let numbers: String = (0..2_000).map(|i| format!("{i}.5 * 2.0, ")).collect();
    let table = kernel(&format!("const T = array<f32, 2000>({numbers});"), "o[0] = T[k];");
    let vectors: String = (0..2_000).map(|i| format!("vec3<f32>({i}.0, -1.0, 2.0 + 1.0), ")).collect();
    let vectors =
        kernel(&format!("var<private> t: array<vec3<f32>, 2000> = array<vec3<f32>, 2000>({vectors});"), "k = 1;");
    let branches = |n| format!("if b {{ k = 1; }}{} else {{ k = 3; }}", " else if x > 1.0 { k = 2; }".repeat(n));
    let lets: String = (0..2_000).map(|i| format!("let a{i} = x + f32({i}); k += i32(a{i} * 2.0);\n")).collect();
    let cases: String = (0..1_000).map(|i| format!("case {i}: {{ k = {}; }}\n", i + 1)).collect();
    let functions: String = (0..2_000).map(|i| format!("fn f{i}_() -> f32 {{ return {i}.0; }}\n")).collect();
    for (name, text) in [
        ("a table", table),
        ("a table of vectors", vectors),
        ("300 branches", kernel("", &branches(300))),
        ("branches again and again", kernel("", &branches(40).repeat(60))),
        ("a sum of 400 terms", kernel("", &format!("o[0] = x{};", " + vec3<f32>(x, 1.0, o[3]).y * 2.0".repeat(400)))),
        ("statements", kernel("", &lets)),
        ("cases", kernel("", &format!("switch k {{ {cases} default: {{}} }}"))),
        ("functions", kernel(&functions, "o[0] = f7_();")),
        ("comparisons", kernel("", &"b = x < 1.0 && x > f32(array<i32, 2>(1, 2)[k]);\n".repeat(1_500))),
    ] {
        if let Err(error) = link(&text) {
            panic!("{name}: {error}");
        }
    }
    for (name, shape) in
        SHAPES.iter().filter(|(name, _)| !matches!(*name, "unbalanced" | "conditions" | "pointer types"))
    {
        if let Err(error) = link(&shape(40)) {
            panic!("{name}, 40 deep: {error}");
        }
    }
}

#[test]
fn a_hundred_thousand_declarations_are_too_many() {
    let chain: String = (0..100_000).rev().map(|i| format!("const c{} = c{i} + 1u;\n", i + 1)).collect();
    let error = located("declarations", &format!("{chain}const c0 = 1u;\n"));
    assert!(error.message.contains("20000 names"), "{error}");
}

#[test]
fn a_long_chain_of_imports_links() {
    let mut modules = vec![("t/m0".to_owned(), "fn f0_() {}\n".to_owned())];
    modules.extend((1..1_000).map(|i| {
        let text = format!("import package::t::m{}::f{}_;\nfn f{i}_() {{}}\n", i - 1, i - 1);
        (format!("t/m{i}"), text)
    }));
    let library = modules.iter().fold(Library::embedded(), |library, (name, text)| library.with(name, text));
    library.link("t/m999", &Features::new()).unwrap();
}

/// Pieces that open something, and what closes it.
const OPENERS: &[(&str, &str)] = &[
    ("(", ")"),
    ("-", ""),
    ("!", ""),
    ("x + ", ""),
    ("abs(", ")"),
    ("o[u32(", ")]"),
    ("x * (1.0 + ", ")"),
    ("vec2<f32>(", ", 1.0).x"),
    ("select(0.0, ", ", b)"),
    ("array<f32, 1>(", ")[0]"),
    ("b && (x > ", ")"),
];

fn config() -> ProptestConfig {
    ProptestConfig { cases: 64, failure_persistence: None, rng_seed: RngSeed::Fixed(11), ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn anything_within_anything_ends_in_a_place(
        openers in prop::collection::vec((prop::sample::select(OPENERS), 1usize..400), 1..8),
        closed in any::<bool>(),
    ) {
        let repeat = |part: fn(&(&'static str, &'static str)) -> &'static str, (opener, n): &((&'static str, &'static str), usize)| part(opener).repeat(*n);
        let open: String = openers.iter().map(|one| repeat(|o| o.0, one)).collect();
        let close: String = openers.iter().rev().map(|one| repeat(|o| o.1, one)).collect();
        let text = kernel("", &format!("o[0] = {open}x{};", if closed { &close } else { "" }));
        if link(&text).is_err() {
            located("fuzz", &text);
        }
    }
}
