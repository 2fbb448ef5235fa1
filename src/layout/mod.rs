//! Structs shared with WGSL, declared once. Does not know wgpu.
