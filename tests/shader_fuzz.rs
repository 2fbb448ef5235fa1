//! Broken shaders end in an error with a place, never in a panic, of ours or of naga's.

use lucerna::shader::{Features, Library};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::shader::{features, library};

/// Pieces of shaders, whole and broken.
const PIECES: &[&str] = &[
    "@if(a)",
    "@if(!a || b)",
    "@elif(b)",
    "@else",
    "@if(",
    "import package::t::a::{one, two};",
    "import package::gen::",
    "import",
    "fn f() {",
    "}",
    "{",
    "(",
    ")",
    "[",
    "]",
    "struct S { x: u32, ",
    "y: array<u32, 4>, ",
    "fn g(x: u32) -> u32 {",
    "return 1u;",
    "return x",
    ";",
    ",",
    "<",
    ">",
    "let a = b;",
    "var<private> v: f32;",
    "/*",
    "*/",
    "//",
    "\n",
    "é",
    "\u{0}",
    "if x { } else { }",
    "switch 1u { default: {} }",
    "for (var i = 0; i < 4; i++) {",
    "loop { break; }",
    "@compute",
    "@workgroup_size(1)",
    "@builtin(",
    "@builtin(workgroup_id) w: vec3<u32>",
    "vec2<u32>(1u, 2u)",
    "1.5f + 2u",
    "enable f16;",
    "diagnostic(off, derivative_uniformity);",
    "@group(0) @binding(0) var<storage, read_write> o: array<LinkItem>;",
    "::",
    "&",
    "&&",
    "||",
    "!",
    "*",
    "0x",
    "1e400f",
    "-",
    "1 << 40",
    "4294967295u",
    "const c = c;",
    "alias A = A;",
    ".x",
    "o[0].range",
];

/// Links a root module, and if that fails looks at where.
fn survive(library: &Library, root: &str, features: &Features) {
    if let Err(error) = library.link(root, features) {
        let (line, column) = error.line_column().expect("an error in a module has a place");
        assert!(line >= 1 && column >= 1);
        assert!(error.report().len() >= error.message.len());
    }
}

/// 20,000 cases of each took a minute once and found nothing; these take a second and are always the same.
fn config() -> ProptestConfig {
    ProptestConfig { cases: 256, failure_persistence: None, rng_seed: RngSeed::Fixed(7), ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn pieces_in_any_order(pieces in prop::collection::vec(prop::sample::select(PIECES), 0..24)) {
        let library = library(&[("t/p", &pieces.join(" ")), ("t/a", "fn one() {}\nfn two() {}\n")]);
        survive(&library, "t/p", &features(&["a"]));
    }

    #[test]
    fn a_shipped_shader_with_a_hole_or_a_graft(
        at in any::<prop::sample::Index>(),
        from in any::<prop::sample::Index>(),
        cut in 0usize..40,
        graft in 0usize..40,
    ) {
        let shipped = Library::embedded();
        let module = "passes/trace/path";
        let chars: Vec<char> = shipped.text(module).unwrap().chars().collect();
        let (at, from) = (at.index(chars.len()), from.index(chars.len()));
        let grafted = &chars[from..chars.len().min(from + graft)];
        let text: String = chars[..at].iter().chain(grafted).chain(&chars[chars.len().min(at + cut)..]).collect();
        survive(&shipped.with(module, &text), module, &features(&[]));
    }
}
