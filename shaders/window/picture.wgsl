// The picture on a window: nearest pixels, black around it. Drawn, not dispatched, so there is no row in the pass table.
// It holds sRGB bytes, r in the lowest, which go to the window as they are.

import package::gen::{WindowParams};

@group(0) @binding(0) var<storage, read> params: WindowParams;
@group(0) @binding(1) var<storage, read> picture: array<u32>;

// One triangle over the whole window.
@vertex
fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let x = f32(index & 1u) * 4.0 - 1.0;
    let y = f32(index >> 1u) * 4.0 - 1.0;
    return vec4<f32>(x, y, 0.0, 1.0);
}

@fragment
fn colour(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let place = (at.xy - params.origin) / params.extent;
    if (any(place < vec2<f32>(0.0)) || any(place >= vec2<f32>(1.0)) || params.size.x == 0u) {
        return vec4<f32>(0.0, 0.0, 0.0, 1.0);
    }
    let pixel = min(vec2<u32>(place * vec2<f32>(params.size)), params.size - 1u);
    return unpack4x8unorm(picture[pixel.y * params.size.x + pixel.x]);
}
