//! Linker, source map, validation and reflection of WGSL. Does not know wgpu.
