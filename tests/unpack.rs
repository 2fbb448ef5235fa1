//! Structs read by vectors of four words: the generated WGSL finds every field where Rust puts it.

use std::fmt::Write;

use glam::{IVec2, IVec3, IVec4, UVec2, UVec3, UVec4, Vec2, Vec3, Vec4};
use lucerna::gpu::Runtime;
use lucerna::gpu_struct;
use lucerna::layout::{self, FieldLayout, Vectors};
use lucerna::passes::{Binding, Pass, Recording, Size, Twin};
use lucerna::shader::{Features, Library};

use crate::support;
use crate::support::dice::Dice;

gpu_struct! {
    /// Every type that a field may have, at every place in a vector.
    pub struct Mixed {
        pub a: Vec3,
        pub b: f32,
        pub c: UVec3,
        pub d: u32,
        pub e: IVec3,
        pub f: i32,
        pub g: Vec4,
        pub h: UVec4,
        pub i: IVec4,
        pub j: Vec2,
        pub k: UVec2,
        pub l: IVec2,
        pub m: i32,
        pub n: f32,
        pub o: f32,
        pub p: i32,
        pub q: Vec2,
    }

    /// No multiple of 16 bytes.
    pub struct Short {
        pub area: f32,
        pub index: u32,
    }

    /// Of a field that is no scalar or vector.
    pub struct Listed {
        pub words: [u32; 4],
    }
}

const MIXED: Vectors = Vectors::of(&Mixed::LAYOUT);

/// Structs that each test reads.
const COUNT: usize = 300;

static UNPACK: Pass = Pass {
    name: "unpack",
    module: "tests/unpack",
    entry: "unpack",
    features: &[],
    bindings: &[Binding::read("structs", "array<vec4<u32>>"), Binding::write("fields", "array<u32>")],
    makes: &[],
    twin: Twin::None("of a test"),
};

fn library() -> Library {
    Library::shipped().with_layouts(&[&Mixed::LAYOUT, &Short::LAYOUT], &[]).with_vectors(&[MIXED])
}

/// The words of a field, each as an expression of type u32.
fn words(field: &FieldLayout, value: &str) -> Vec<String> {
    match field.size / 4 {
        1 => vec![format!("bitcast<u32>({value})")],
        n => "xyzw"[..n as usize].chars().map(|c| format!("bitcast<u32>({value}.{c})")).collect(),
    }
}

/// A kernel that writes the words of all fields of each struct, once of the whole struct and once by the fields' own functions.
fn kernel(vectors: &Vectors, snake: &str) -> String {
    let (name, stride, loud) = (vectors.layout.name, vectors.stride(), snake.to_uppercase());
    let fields = vectors.layout.fields;
    let mut imports = format!("{name}, unpack_{snake}, {loud}_STRIDE");
    let mut values = Vec::new();
    for field in fields {
        let (own, place) = (format!("{snake}_{}", field.name), format!("{loud}_{}", field.name.to_uppercase()));
        write!(imports, ", {own}, {place}").unwrap();
        values.extend(words(field, &format!("{own}(structs[at + {place}])")));
    }
    let whole = fields.iter().flat_map(|field| words(field, &format!("whole.{}", field.name)));
    let all: Vec<String> = whole.chain(values).collect();
    let stores: String = all
        .iter()
        .enumerate()
        .map(|(i, word)| format!("    fields[{}u * index + {i}u] = {word};\n", all.len()))
        .collect();
    let arguments: Vec<String> = (0..stride).map(|i| format!("structs[at + {i}u]")).collect();
    format!(
        "import package::gen::{{{imports}}};
@group(0) @binding(0) var<storage, read> structs: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> fields: array<u32>;
@compute @workgroup_size(64)
fn unpack(@builtin(global_invocation_id) id: vec3<u32>) {{
    let index = id.x;
    if (index >= {COUNT}u) {{ return; }}
    let at = {loud}_STRIDE * index;
    let whole: {name} = unpack_{snake}({});
{stores}}}
",
        arguments.join(", ")
    )
}

#[track_caller]
fn check(vectors: &Vectors, snake: &str) {
    let size = vectors.layout.size as usize;
    assert_eq!(vectors.stride() as usize * 16, size, "{snake}");
    let mut dice = Dice(7);
    // Bits of numbers that are finite and not tiny, which no device changes on the way.
    let mut random = || ((dice.unit() * 4294967296.0) as u32 & 0xbfff_ffff) | 0x2000_0000;
    let structs: Vec<u32> = (0..COUNT * size / 4).map(|_| random()).collect();
    let mut rig = Runtime::new(support::gpu(), library().with("tests/unpack", &kernel(vectors, snake)));
    rig.upload("structs", &structs).unwrap();
    let fields = vectors.layout.fields;
    let per_struct: usize = fields.iter().map(|field| field.size as usize / 4).sum();
    rig.reserve("fields", (COUNT * 2 * per_struct * 4) as u64).unwrap();
    let mut recording = Recording::default();
    recording.run(&UNPACK, Size::Items(COUNT as u64));
    rig.play(&recording).unwrap();
    let found: Vec<u32> = rig.read_some("fields", COUNT * 2 * per_struct).unwrap();
    for (written, read) in structs.chunks(size / 4).zip(found.chunks(2 * per_struct)) {
        let of_field = |field: &FieldLayout| &written[field.offset as usize / 4..][..field.size as usize / 4];
        let expected: Vec<u32> = fields.iter().flat_map(of_field).copied().collect();
        assert_eq!(read[..per_struct], expected, "{snake}, whole");
        assert_eq!(read[per_struct..], expected, "{snake}, by field");
    }
}

#[test]
fn every_field_is_read_back() {
    check(&MIXED, "mixed");
    for (name, snake) in [
        ("Triangle", "triangle"),
        ("Node", "node"),
        ("LightRecord", "light_record"),
        ("PointLightRecord", "point_light_record"),
        ("MaterialRecord", "material_record"),
        ("GatherPoint", "gather_point"),
        ("LentPoint", "lent_point"),
        ("TextureRecord", "texture_record"),
        ("MaterialMaps", "material_maps"),
        ("CornerUvs", "corner_uvs"),
        ("Tangents", "tangents"),
    ] {
        check(layout::VECTORS.iter().find(|vectors| vectors.layout.name == name).unwrap(), snake);
    }
    assert_eq!(layout::VECTORS.len(), 11, "a struct is not tested here");
}

#[test]
fn only_what_is_imported_is_generated() {
    let text = "import package::gen::{MIXED_STRIDE};\n@compute @workgroup_size(MIXED_STRIDE)\nfn nothing() {}\n";
    let linked = library().with("tests/unpack", text).link("tests/unpack", &Features::new()).unwrap();
    assert!(linked.text.contains("const MIXED_STRIDE: u32 = 9u;"), "{}", linked.text);
    assert!(!linked.text.contains("unpack_mixed") && !linked.text.contains("struct Mixed"), "{}", linked.text);
}

#[test]
fn what_is_not_made_of_vectors_is_refused() {
    assert!(std::panic::catch_unwind(|| Vectors::of(&Short::LAYOUT)).is_err());
    assert!(std::panic::catch_unwind(|| Vectors::of(&Listed::LAYOUT)).is_err());
    let text = "import package::gen::{unpack_short};\n@compute @workgroup_size(1)\nfn nothing() {}\n";
    assert!(library().with("tests/unpack", text).link("tests/unpack", &Features::new()).is_err());
}
