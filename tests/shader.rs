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
@group(0) @binding(0) var<uniform> params: LinkParams;
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
            ("params", 0, ResourceKind::Uniform, "LinkParams", 16),
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
