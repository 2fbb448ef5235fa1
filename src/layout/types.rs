//! What is known of a shared struct or constant, and its declaration in WGSL.

use bytemuck::{Pod, Zeroable};
use glam::{IVec2, IVec3, IVec4, UVec2, UVec3, UVec4, Vec2, Vec3, Vec4};

/// A struct as both Rust and WGSL lay it out.
#[derive(Debug)]
pub struct StructLayout {
    pub name: &'static str,
    /// Bytes, a multiple of `align`; also the stride in an array.
    pub size: u32,
    /// Bytes, by WGSL's rules.
    pub align: u32,
    pub fields: &'static [FieldLayout],
}

/// A field of a [`StructLayout`].
#[derive(Debug)]
pub struct FieldLayout {
    pub name: &'static str,
    pub ty: FieldType,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// Bytes.
    pub size: u32,
}

/// The type of a field.
#[derive(Debug)]
pub enum FieldType {
    /// A scalar, vector or atomic, as WGSL writes it.
    Plain(&'static str),
    /// So many of a type.
    Array(&'static FieldType, u32),
    /// Another shared struct.
    Struct(&'static StructLayout),
}

/// A constant of `package::gen`.
#[derive(Debug)]
pub struct GpuConst {
    pub name: &'static str,
    pub value: ConstValue,
}

/// A constant's type and value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstValue {
    U32(u32),
    I32(i32),
    /// Finite.
    F32(f32),
}

/// A type that a field of a [`gpu_struct!`](crate::gpu_struct) may have.
pub trait GpuField: Pod {
    /// WGSL's alignment in bytes.
    const ALIGN: u32;
    /// WGSL's size in bytes.
    const SIZE: u32;
    const TYPE: FieldType;
}

/// A u32 that WGSL changes atomically; the CPU sees a plain word.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct AtomicWord(pub u32);

macro_rules! plain_fields {
    ($($ty:ty, $wgsl:literal, $align:literal, $size:literal;)+) => { $(
        impl GpuField for $ty {
            const ALIGN: u32 = $align;
            const SIZE: u32 = $size;
            const TYPE: FieldType = FieldType::Plain($wgsl);
        }
        const _: () = assert!(size_of::<$ty>() == $size);
    )+ };
}

// https://www.w3.org/TR/WGSL/#alignment-and-size
plain_fields! {
    f32, "f32", 4, 4;
    u32, "u32", 4, 4;
    i32, "i32", 4, 4;
    AtomicWord, "atomic<u32>", 4, 4;
    Vec2, "vec2<f32>", 8, 8;
    Vec3, "vec3<f32>", 16, 12;
    Vec4, "vec4<f32>", 16, 16;
    UVec2, "vec2<u32>", 8, 8;
    UVec3, "vec3<u32>", 16, 12;
    UVec4, "vec4<u32>", 16, 16;
    IVec2, "vec2<i32>", 8, 8;
    IVec3, "vec3<i32>", 16, 12;
    IVec4, "vec4<i32>", 16, 16;
}

impl<T: GpuField, const N: usize> GpuField for [T; N] {
    const ALIGN: u32 = T::ALIGN;
    const SIZE: u32 = {
        let stride = round_up(T::SIZE, T::ALIGN);
        assert!(stride == size_of::<T>() as u32, "WGSL pads the elements of this array, Rust does not: use a Vec4");
        stride * N as u32
    };
    const TYPE: FieldType = FieldType::Array(&T::TYPE, N as u32);
}

/// The least multiple of `align` that is at least `offset`.
pub const fn round_up(offset: u32, align: u32) -> u32 {
    offset.div_ceil(align) * align
}

/// The largest of some alignments, 1 if there are none.
pub const fn largest(aligns: &[u32]) -> u32 {
    let mut result = 1;
    let mut i = 0;
    while i < aligns.len() {
        if aligns[i] > result {
            result = aligns[i];
        }
        i += 1;
    }
    result
}

impl FieldType {
    /// The type as WGSL writes it, canonically: `array<vec2<u32>, 4>`.
    pub fn wgsl(&self) -> String {
        match self {
            FieldType::Plain(name) => (*name).to_owned(),
            FieldType::Array(element, count) => format!("array<{}, {count}>", element.wgsl()),
            FieldType::Struct(layout) => layout.name.to_owned(),
        }
    }

    /// The struct that this type is made of, if any.
    pub fn structure(&self) -> Option<&'static StructLayout> {
        match self {
            FieldType::Plain(_) => None,
            FieldType::Array(element, _) => element.structure(),
            FieldType::Struct(layout) => Some(layout),
        }
    }
}

impl StructLayout {
    /// The declaration in WGSL, a line a field.
    pub fn wgsl(&self) -> String {
        let fields: String =
            self.fields.iter().map(|field| format!("    {}: {},\n", field.name, field.ty.wgsl())).collect();
        format!("struct {} {{\n{fields}}}\n", self.name)
    }

    /// The structs that its declaration names.
    pub fn depends_on(&self) -> impl Iterator<Item = &'static StructLayout> {
        self.fields.iter().filter_map(|field| field.ty.structure())
    }
}

impl GpuConst {
    /// The declaration in WGSL.
    pub fn wgsl(&self) -> String {
        let name = self.name;
        match self.value {
            ConstValue::U32(value) => format!("const {name}: u32 = {value}u;\n"),
            // An i32 literal can't be the least i32: WGSL negates after it has checked the range.
            ConstValue::I32(i32::MIN) => format!("const {name}: i32 = -2147483647i - 1i;\n"),
            ConstValue::I32(value) => format!("const {name}: i32 = {value}i;\n"),
            ConstValue::F32(value) => format!("const {name}: f32 = {value:?}f;\n"),
        }
    }
}
