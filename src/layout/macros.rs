//! The macros that declare what Rust and WGSL share.

/// Declares structs once for Rust and WGSL.
///
/// Each struct becomes a `#[repr(C)]` Pod type whose `Default` is all zero, with a
/// [`StructLayout`](crate::layout::StructLayout) in `Self::LAYOUT`, from which the shader library writes the WGSL
/// declaration. It compiles only if Rust lays every field where WGSL does: a `Vec3` needs an offset divisible by 16, so
/// an f32 or u32 goes behind each; a `Vec2` one divisible by 8; a struct's size is a multiple of its alignment; arrays
/// of `Vec3` do not exist.
///
/// Fields are f32, u32, i32, glam's `Vec`, `UVec` and `IVec` of 2, 3, 4, [`AtomicWord`](crate::layout::AtomicWord),
/// other such structs, and arrays of those. A new struct also gets its line in [`layout::ALL`](crate::layout::ALL).
#[macro_export]
macro_rules! gpu_struct {
    ($(
        $(#[$meta:meta])*
        pub struct $name:ident {
            $( $(#[$field_meta:meta])* pub $field:ident : $ty:ty ),+ $(,)?
        }
    )+) => { $(
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, ::bytemuck::Pod, ::bytemuck::Zeroable)]
        pub struct $name {
            $( $(#[$field_meta])* pub $field: $ty, )+
        }

        impl $name {
            /// The layout that WGSL must give this struct.
            pub const LAYOUT: $crate::layout::StructLayout = $crate::layout::StructLayout {
                name: stringify!($name),
                size: ::core::mem::size_of::<Self>() as u32,
                align: $crate::layout::largest(&[$(<$ty as $crate::layout::GpuField>::ALIGN),+]),
                fields: &[$(
                    $crate::layout::FieldLayout {
                        name: stringify!($field),
                        ty: <$ty as $crate::layout::GpuField>::TYPE,
                        offset: ::core::mem::offset_of!(Self, $field) as u32,
                        size: ::core::mem::size_of::<$ty>() as u32,
                    },
                )+],
            };
        }

        impl Default for $name {
            fn default() -> Self {
                ::bytemuck::Zeroable::zeroed()
            }
        }

        impl $crate::layout::GpuField for $name {
            const ALIGN: u32 = Self::LAYOUT.align;
            const SIZE: u32 = Self::LAYOUT.size;
            const TYPE: $crate::layout::FieldType = $crate::layout::FieldType::Struct(&Self::LAYOUT);
        }

        const _: () = {
            let mut end = 0;
            $(
                end = $crate::layout::round_up(end, <$ty as $crate::layout::GpuField>::ALIGN);
                assert!(
                    end == ::core::mem::offset_of!($name, $field) as u32,
                    concat!(
                        "WGSL aligns ", stringify!($name), "::", stringify!($field), ": ", stringify!($ty),
                        " to an offset that Rust does not: reorder the fields or fill the gap",
                    ),
                );
                end += <$ty as $crate::layout::GpuField>::SIZE;
            )+
            assert!(
                $crate::layout::round_up(end, $name::LAYOUT.align) == $name::LAYOUT.size,
                concat!("WGSL rounds the size of ", stringify!($name), " up to its alignment: fill its end"),
            );
        };
    )+ };
}

/// Declares u32, i32 and f32 constants once for Rust and WGSL: at most once a module, since it also makes that
/// module's `CONSTS`, which goes into [`layout::CONSTS`](crate::layout::CONSTS).
#[macro_export]
macro_rules! gpu_consts {
    ($(
        $(#[$meta:meta])*
        pub const $name:ident : $ty:ident = $value:expr;
    )+) => {
        $(
            $(#[$meta])*
            pub const $name: $ty = $value;
        )+

        /// What this module shares with WGSL.
        pub const CONSTS: &[$crate::layout::GpuConst] = &[$(
            $crate::layout::GpuConst {
                name: stringify!($name),
                value: $crate::gpu_consts!(@value $ty, $name),
            },
        )+];
    };
    (@value u32, $name:ident) => { $crate::layout::ConstValue::U32($name) };
    (@value i32, $name:ident) => { $crate::layout::ConstValue::I32($name) };
    (@value f32, $name:ident) => {{
        assert!($name.is_finite(), concat!("WGSL has no literal for a non-finite ", stringify!($name)));
        $crate::layout::ConstValue::F32($name)
    }};
}
