// The film as a picture: the mean of both halves, exposed, by a tone curve, sRGB, 8 bits. Where only some pixels have a sample yet, each is spread over its
// block.

import package::gen::{DisplayParams, FilmPixel, TONE_NONE};
import package::lib::colour::{srgb8};
import package::lib::tone::{toned};

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
    let index = (group.x + group.y * groups.x) * 256u + local;
    let size = vec2<u32>(params.row, params.pixels / params.row);
    let shift = vec2<u32>(params.column_shift, params.row_shift);
    let columns = (size.x + (1u << shift.x) - 1u) >> shift.x;
    let corner = vec2<u32>(index % columns, index / columns) << shift;
    if (corner.y >= size.y) {
        return;
    }
    let source = corner.y * params.row + corner.x;
    let even = film[source].halves[0];
    let odd = film[source].halves[1];
    // No sample yet: black.
    var linear: vec3<f32>;
    @if(adaptive) {
        // Each half counts alike, however many samples it has: the values of each have settled the number of the other.
        let share = select(params.scale, 0.5 * params.scale, even.count > 0u && odd.count > 0u);
        let scales = share / vec2<f32>(max(vec2<u32>(even.count, odd.count), vec2<u32>(1u)));
        for (var c = 0u; c < 3u; c++) {
            linear[c] = as_float(even.sum[c]) * scales.x + as_float(odd.sum[c]) * scales.y;
        }
    } @else {
        let scale = params.scale / f32(max(even.count + odd.count, 1u));
        for (var c = 0u; c < 3u; c++) {
            linear[c] = (as_float(even.sum[c]) + as_float(odd.sum[c])) * scale;
        }
    }
    if (params.tone != TONE_NONE) {
        linear = toned(linear, params.tone);
    }
    let word = srgb8(linear);
    let end = min(corner + (vec2<u32>(1u) << shift), size);
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            let pixel = y * size.x + x;
            picture[pixel] = word;
        }
    }
}
