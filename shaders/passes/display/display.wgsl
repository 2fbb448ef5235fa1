// The film as a picture: the mean of both halves, exposed, sRGB, 8 bits.

import package::gen::{DisplayParams, FilmPixel};
import package::lib::colour::{srgb8};

@group(0) @binding(0) var<storage, read> params: DisplayParams;
@group(0) @binding(1) var<storage, read> film: array<FilmPixel>;
@group(0) @binding(2) var<storage, read_write> picture: array<u32>;

fn as_float(words: vec2<u32>) -> f32 {
    return f32(words.y) * 0x1p32 + f32(words.x);
}

@compute @workgroup_size(256)
fn display(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = (group.x + group.y * groups.x) * 256u + local;
    if (pixel >= params.pixels) {
        return;
    }
    let even = film[pixel].halves[0];
    let odd = film[pixel].halves[1];
    // No sample yet: black.
    let scale = params.scale / f32(max(even.count + odd.count, 1u));
    var linear: vec3<f32>;
    for (var c = 0u; c < 3u; c++) {
        linear[c] = (as_float(even.sum[c]) + as_float(odd.sum[c])) * scale;
    }
    picture[pixel] = srgb8(linear);
}
