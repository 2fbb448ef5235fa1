//! Shared structs and constants: offsets, the WGSL text, and what the registry must hold.

use glam::{IVec3, UVec2, Vec2, Vec3, Vec4};
use lucerna::layout::{self, AtomicWord};
use lucerna::{gpu_consts, gpu_struct};

gpu_struct! {
    /// Every kind of padding rule in one struct.
    pub struct Inner {
        pub position: Vec3,
        pub radius: f32,
        pub cell: IVec3,
        pub flags: u32,
        pub uv: Vec2,
        pub range: UVec2,
    }

    /// Nested structs, arrays, arrays of structs and of arrays.
    pub struct Outer {
        pub axes: [Vec4; 3],
        pub inner: Inner,
        pub many: [Inner; 2],
        pub counts: [AtomicWord; 6],
        pub table: [[u32; 2]; 3],
        pub tail: [u32; 4],
    }
}

gpu_consts! {
    pub const HIGH_BIT: u32 = 1 << 31;
    pub const LEAST: i32 = i32::MIN;
    pub const BELOW: i32 = -3;
    pub const TINY: f32 = 1e-5;
    pub const WHOLE: f32 = 2.0;
}

#[test]
fn offsets_are_those_of_wgsl() {
    let offsets = |layout: &layout::StructLayout| layout.fields.iter().map(|f| f.offset).collect::<Vec<_>>();
    assert_eq!(offsets(&Inner::LAYOUT), [0, 12, 16, 28, 32, 40]);
    assert_eq!((Inner::LAYOUT.size, Inner::LAYOUT.align), (48, 16));
    assert_eq!(offsets(&Outer::LAYOUT), [0, 48, 96, 192, 216, 240]);
    assert_eq!((Outer::LAYOUT.size, Outer::LAYOUT.align), (256, 16));
}

#[test]
fn declarations_are_wgsl() {
    assert_eq!(
        Outer::LAYOUT.wgsl(),
        "struct Outer {\n    axes: array<vec4<f32>, 3>,\n    inner: Inner,\n    many: array<Inner, 2>,\n    \
         counts: array<atomic<u32>, 6>,\n    table: array<array<u32, 2>, 3>,\n    tail: array<u32, 4>,\n}\n"
    );
    let text: Vec<String> = CONSTS.iter().map(layout::GpuConst::wgsl).collect();
    assert_eq!(
        text,
        [
            "const HIGH_BIT: u32 = 2147483648u;\n",
            "const LEAST: i32 = -2147483647i - 1i;\n",
            "const BELOW: i32 = -3i;\n",
            "const TINY: f32 = 1e-5f;\n",
            "const WHOLE: f32 = 2.0f;\n",
        ]
    );
}

#[test]
fn the_registry_names_each_thing_once() {
    let structs = layout::ALL.iter().map(|layout| layout.name);
    let consts = layout::CONSTS.iter().flat_map(|list| list.iter()).map(|constant| constant.name);
    let mut names: Vec<&str> = structs.chain(consts).collect();
    names.sort_unstable();
    let count = names.len();
    names.dedup();
    assert_eq!(names.len(), count, "a struct or constant is listed twice");
}

#[test]
fn the_registry_holds_what_its_structs_are_made_of() {
    for layout in layout::ALL {
        for part in layout.depends_on() {
            assert!(layout::ALL.iter().any(|known| known.name == part.name), "{} is not in layout::ALL", part.name);
        }
    }
}

#[test]
fn default_is_all_zero() {
    assert!(bytemuck::bytes_of(&Outer::default()).iter().all(|&byte| byte == 0));
}
