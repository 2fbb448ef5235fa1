//! The linker: imports, conditions, reflection.

use std::collections::BTreeSet;

use glam::UVec2;
use lucerna::gpu_struct;
use lucerna::layout::AtomicWord;
use lucerna::shader::{Features, Library, Linked, ResourceKind};

gpu_struct! {
    pub struct LinkItem {
        pub range: [u32; 2],
        pub words: [AtomicWord; 2],
    }

    pub struct LinkParams {
        pub count: u32,
        pub scale: f32,
        pub cell: UVec2,
    }
}

const NO_CONSTS: &[lucerna::layout::GpuConst] = &[];

/// A library of the embedded modules and some more.
pub fn library(modules: &[(&str, &str)]) -> Library {
    let shared = Library::embedded().with_layouts(&[&LinkItem::LAYOUT, &LinkParams::LAYOUT], NO_CONSTS);
    modules.iter().fold(shared, |library, (name, text)| library.with(name, text))
}

pub fn features(names: &[&str]) -> Features {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn link(modules: &[(&str, &str)], names: &[&str]) -> Linked {
    library(modules).link(modules[0].0, &features(names)).unwrap()
}

const PASS: &str = "import package::t::a::double;
import package::gen::{LinkParams, LinkItem};
@group(0) @binding(1) var<storage, read_write> out: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read_write> items: array<LinkItem>;
@group(0) @binding(3) var<storage, read> unused: array<u32>;
@group(0) @binding(0) var<storage, read> params: LinkParams;
@compute @workgroup_size(64, 2)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    out[id.x] = vec2(double(id.x), params.count);
}
@compute @workgroup_size(1)
fn other() { atomicAdd(&items[0].words[1], unused[0]); }
";

#[test]
fn reflection_lists_what_an_entry_point_uses() {
    let linked = link(&[("t/p", PASS), ("t/a", "fn double(x: u32) -> u32 { return x * 2u; }")], &[]);
    assert_eq!(linked.entries().collect::<Vec<_>>(), ["main", "other"]);
    let main = linked.entry("main").unwrap();
    assert_eq!(main.workgroup_size, [64, 2, 1]);
    let bindings: Vec<_> =
        main.bindings.iter().map(|b| (b.name.as_str(), b.binding, b.kind, b.ty.as_str(), b.size)).collect();
    assert_eq!(
        bindings,
        [
            ("params", 0, ResourceKind::StorageRead, "LinkParams", 16),
            ("out", 1, ResourceKind::StorageReadWrite, "array<vec2<u32>>", 8),
        ]
    );
    let other = linked.entry("other").unwrap();
    let names: Vec<_> = other.bindings.iter().map(|b| (b.name.as_str(), b.kind, b.ty.as_str())).collect();
    assert_eq!(
        names,
        [
            ("items", ResourceKind::StorageReadWrite, "array<LinkItem>"),
            ("unused", ResourceKind::StorageRead, "array<u32>"),
        ]
    );
    assert_eq!(linked.entry("third"), None);
    assert_eq!(linked.imports, BTreeSet::from(["t/a".to_owned(), "t/p".to_owned()]));
}

/// What naga made of the functions, structs and constants of a link, by name, whether used or not.
fn declared(linked: &Linked) -> BTreeSet<String> {
    let module = naga::front::wgsl::parse_str(&linked.text).unwrap();
    let functions = module.functions.iter().filter_map(|(_, function)| function.name.clone());
    let types = module.types.iter().filter_map(|(_, ty)| ty.name.clone());
    let constants = module.constants.iter().filter_map(|(_, constant)| constant.name.clone());
    functions.chain(types).chain(constants).collect()
}

fn names(list: &[&str]) -> BTreeSet<String> {
    list.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn a_diamond_includes_each_module_once_and_whole() {
    let modules = [
        ("t/p", "import package::t::{left::l, right::r};\nfn f() -> u32 { return l() + r(); }\n"),
        ("t/left", "import package::t::base::{b};\nfn l() -> u32 { return b(); }\n"),
        ("t/right", "import package::t::base::b;\nfn r() -> u32 { return b(); }\n"),
        ("t/base", "fn b() -> u32 { return 1u; }\nfn other() {}\n"),
        ("t/apart", "fn apart() {}\n"),
    ];
    let linked = link(&modules, &[]);
    assert_eq!(declared(&linked), names(&["f", "l", "r", "b", "other"]));
    assert_eq!(linked.imports, names(&["t/p", "t/left", "t/right", "t/base"]));
    assert_eq!(linked.text.matches("fn b()").count(), 1);
}

#[test]
fn what_no_entry_point_uses_is_gone_from_the_module() {
    let text = "@group(0) @binding(0) var<storage, read_write> out: array<u32>;\n\
                @group(0) @binding(1) var<storage, read_write> lost: array<u32>;\n\
                fn used() -> u32 { return 1u; }\nfn unused() -> u32 { return lost[0]; }\n\
                @compute @workgroup_size(1) fn main() { out[0] = used(); }\n\
                @compute @workgroup_size(1) fn second() { out[0] = 2u; }\n";
    let linked = link(&[("t/p", text)], &[]);
    let functions: Vec<_> = linked.module.functions.iter().filter_map(|(_, f)| f.name.as_deref()).collect();
    assert_eq!(functions, ["used"]);
    assert_eq!(linked.module.global_variables.len(), 1);
    assert_eq!(linked.entries().collect::<Vec<_>>(), ["main", "second"]);
}

#[test]
fn comments_hold_no_code() {
    let text = "// import package::t::none::x; @if(a) {\n/* import package::t::none::x; /* } */ ( */\n\
                fn f() /* @else */ -> u32 { return 1u; } // ]\n";
    assert_eq!(declared(&link(&[("t/p", text)], &[])), names(&["f"]));
}

#[test]
fn names_inside_functions_are_their_own() {
    let text = "@compute @workgroup_size(1)\nfn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(num_workgroups) n: vec3<u32>) {\n\
                for (var i = 0u; i < 2u; i++) { let one = i; }\nfor (var i = 0u; i < n.x; i++) { let one = id.x; }\n}\n\
                fn g(one: u32) -> u32 { return one; }\n";
    let modules = [("t/p", text), ("t/a", "fn one() {}\nfn i() {}\n")];
    link(&modules, &[]);
    let importing = format!("import package::t::a::i;\n{text}");
    link(&[("t/p", &importing), modules[1]], &[]);
}

/// Declarations that only some features have.
const DECLARATIONS: &str = "@if(a) fn only_a() {}
@if(!a) fn not_a() {}
@if(a && b) const both = 1u;
@if(a || b) const either = 1u;
@if(!(a || b) && c) struct OnlyC { x: array<vec2<u32>, 2>, @if(d) y: u32 }
@if(a) fn x() -> u32 { if (true) { return 1u; } else { return 2u; } }
@elif(b) fn x_of_b() -> u32 { return 3u; }
@else fn x_else() -> u32 { return 4u; }
fn last() {}
";

#[test]
fn conditions_on_declarations() {
    for (enabled, expected) in [
        (&[][..], &["not_a", "x_else", "last"][..]),
        (&["a"], &["only_a", "either", "x", "last"]),
        (&["b"], &["not_a", "either", "x_of_b", "last"]),
        (&["a", "b"], &["only_a", "both", "either", "x", "last"]),
        (&["c"], &["not_a", "OnlyC", "x_else", "last"]),
        (&["c", "a"], &["only_a", "either", "x", "last"]),
    ] {
        assert_eq!(declared(&link(&[("t/p", DECLARATIONS)], enabled)), names(expected), "{enabled:?}");
    }
}

/// Conditions inside functions, structs and parameter lists; each function returns a sum that tells what is left.
const INSIDE: &str = "struct S { first: u32, @if(a) second: array<vec2<u32>, 2>, @else second: u32, @if(b) third: u32 }
fn p(@if(a) x: vec2<u32>, @else x: u32, @if(b) y: u32) -> u32 {
    var sum = 0u;
    @if(a) sum += 1u;
    @if(!a) { sum += 2u; }
    @if(a) if sum > 0u { sum += 4u; @if(b) { sum += 8u; } @else sum += 16u; } else { sum += 32u; }
    @else for (var i = 0u; i < 2u; i++) { sum += 64u; }
    @if(b)
    switch sum { case 0u: { sum += 128u; } default: { sum += 256u; } }
    return sum;
}
";

#[test]
fn conditions_inside_declarations() {
    let left = |enabled: &[&str]| {
        let linked = link(&[("t/p", INSIDE)], enabled);
        assert_eq!(linked.text.len(), INSIDE.len() + 2, "bytes keep their places");
        assert_eq!(linked.text.matches('\n').count(), INSIDE.matches('\n').count() + 2, "lines keep their places");
        let words: Vec<&str> = linked.text.split_whitespace().collect();
        words.join(" ")
    };
    assert_eq!(
        left(&[]),
        "struct S { first: u32, second: u32, } fn p( x: u32, ) -> u32 { var sum = 0u; { sum += 2u; } \
         for (var i = 0u; i < 2u; i++) { sum += 64u; } return sum; }"
    );
    assert_eq!(
        left(&["a", "b"]),
        "struct S { first: u32, second: array<vec2<u32>, 2>, third: u32 } fn p( x: vec2<u32>, y: u32) -> u32 { \
         var sum = 0u; sum += 1u; if sum > 0u { sum += 4u; { sum += 8u; } } else { sum += 32u; } \
         switch sum { case 0u: { sum += 128u; } default: { sum += 256u; } } return sum; }"
    );
    assert_eq!(
        left(&["a"]),
        "struct S { first: u32, second: array<vec2<u32>, 2>, } fn p( x: vec2<u32>, ) -> u32 { \
         var sum = 0u; sum += 1u; if sum > 0u { sum += 4u; sum += 16u; } else { sum += 32u; } return sum; }"
    );
}

#[test]
fn conditions_on_imports() {
    let modules = [
        ("t/p", "@if(a) import package::t::{a::one};\nfn f() {}\n@if(a) const two = one;\n"),
        ("t/a", "const one = 1u;\n"),
    ];
    assert_eq!(link(&modules, &["a"]).imports, names(&["t/p", "t/a"]));
    assert_eq!(link(&modules, &[]).imports, names(&["t/p"]));
}

#[test]
fn features_are_those_that_the_closure_names_and_that_are_enabled() {
    let modules = [
        ("t/p", "import package::t::a::one;\n@if(x) fn f() { @if(inside_dead) { } }\n"),
        ("t/a", "const one = 1u;\n@if(!y || z) const two = 2u;\n"),
        ("t/b", "@if(apart) const three = 3u;\n"),
    ];
    let key = |enabled: &[&str]| link(&modules, enabled).features;
    assert_eq!(key(&["apart", "unknown"]), features(&[]));
    assert_eq!(key(&["y", "apart"]), features(&["y"]));
    assert_eq!(key(&["inside_dead"]), features(&["inside_dead"]));
    assert_eq!(key(&["x", "y", "z", "apart"]), features(&["x", "y", "z"]));
}

#[test]
fn a_module_has_a_hash_of_its_text() {
    let (one, two) = (library(&[("t/p", "fn f() {}")]), library(&[("t/p", "fn f() { }")]));
    assert_eq!(one.hash("t/p"), library(&[("t/p", "fn f() {}")]).hash("t/p"));
    assert_ne!(one.hash("t/p"), two.hash("t/p"));
    assert_eq!(one.hash("t/q"), None);
}

#[test]
fn the_embedded_shaders_are_those_of_the_folder() {
    let folder = Library::open(std::path::Path::new("shaders")).unwrap();
    let embedded = Library::embedded();
    assert_eq!(embedded.modules().collect::<Vec<_>>(), folder.modules().collect::<Vec<_>>());
    for module in folder.modules() {
        assert_eq!(embedded.hash(module), folder.hash(module), "{module}");
    }
}

/// Every registered struct and constant, used or not, against naga's layout.
#[test]
fn every_shared_struct_has_the_layout_of_wgsl() {
    let structs = lucerna::layout::ALL.iter().map(|layout| layout.name);
    let consts = lucerna::layout::CONSTS.iter().flat_map(|list| list.iter()).map(|constant| constant.name);
    let all: Vec<&str> = structs.chain(consts).collect();
    let text = format!("import package::gen::{{{}}};\n", all.join(", "));
    let linked = link(&[("t/all", &text)], &[]);
    assert!(declared(&linked).is_superset(&names(&all)));
}

#[test]
fn all_loops_can_be_limited_as_those_of_edited_modules_are() {
    let shipped = Library::embedded();
    let linked = |library: &Library| {
        let linked = library.link("passes/film/accumulate", &Features::new()).unwrap();
        (linked.edited, linked.limited)
    };
    assert_eq!(linked(&shipped), (false, false));
    assert_eq!(linked(&shipped.clone().with_limited_loops()), (false, true));
    let edited = shipped.with("lib/fixed", &format!("{}\n", include_str!("../shaders/lib/fixed.wgsl")));
    assert_eq!(linked(&edited), (true, true));
}
