//! The bindings of `passes/trace/textures`, in every pass that looks textures up.

use super::Binding;

/// Features under which textures are looked up: `cutout` in the walk itself.
pub const TEXTURED: &[&str] = &["textures", "relief", "emission_map", "cutout"];

/// What a lookup reads, there where any of some features is on.
pub const fn texture_bindings(features: &'static [&'static str]) -> [Binding; 4] {
    [
        Binding::read("uvs", "array<vec4<u32>>").when(features),
        Binding::read("textures", "array<vec4<u32>>").when(features),
        Binding::read("texels", "array<u32>").when(features),
        Binding::read("material_maps", "array<vec4<u32>>").when(features),
    ]
}
