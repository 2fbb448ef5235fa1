//! The pass table and the recording of dispatches. Does not know wgpu.
