// Adds a batch of samples to sums over blocks of each pixel's samples: what a robust mean is made of. Beside the film, which has nothing of it.

import package::gen::{FilmHalf, RobustPixel, ROBUST_BLOCKS, SAMPLE_BAD};
import package::lib::colour::{luminance};
import package::passes::film::accumulate::{add_sample, is_full, params, place_of, radiance};

@group(0) @binding(4) var<storage, read_write> blocks: array<RobustPixel>;

// The samples of one pixel, layer by layer.
fn add_to_blocks(pixel: u32) {
    let first = params.radiance_first + pixel / params.window_width * params.radiance_row + pixel % params.window_width;
    let place = place_of(pixel);
    let index = params.first_pixel + place.y * params.row + place.x;
    if (params.replaces != 0u) {
        blocks[index] = RobustPixel();
    }
    for (var layer = 0u; layer < params.layers; layer++) {
        let arrived = radiance[layer * params.radiance_layer + first];
        if ((arrived.info & SAMPLE_BAD) != 0u) {
            continue;
        }
        let sample = params.first_sample + layer;
        let block = sample % ROBUST_BLOCKS;
        var sums: FilmHalf;
        for (var c = 0u; c < 3u; c++) {
            sums.sum[c] = blocks[index].sums[3u * block + c];
        }
        sums.count = blocks[index].counts[block];
        if (is_full(&sums) || add_sample(&sums, arrived.rgb) != 0u) {
            continue;
        }
        for (var c = 0u; c < 3u; c++) {
            blocks[index].sums[3u * block + c] = sums.sum[c];
        }
        blocks[index].counts[block] = sums.count;
        let bright = luminance(arrived.rgb);
        if (bright > blocks[index].brightest) {
            blocks[index].brightest = bright;
            blocks[index].sample = sample;
        }
    }
}

@compute @workgroup_size(64)
fn add_blocks(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = (group.x + group.y * groups.x) * 64u + local;
    if (pixel < params.window_width * params.window_height) {
        add_to_blocks(pixel);
    }
}
