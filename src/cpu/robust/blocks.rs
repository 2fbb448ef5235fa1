//! The twin of the pass `blocks`.

use glam::UVec2;

use crate::cpu::film::{add, is_full, place_of};
use crate::layout::film::{AccumulateParams, FilmHalf, ROBUST_BLOCKS, RobustPixel};
use crate::layout::trace::{RadianceSample, SAMPLE_BAD, luminance};

/// Adds a batch of samples to the blocks of their pixels.
pub fn add_blocks(blocks: &mut [RobustPixel], radiance: &[RadianceSample], params: &AccumulateParams) {
    for pixel in 0..params.window_width * params.window_height {
        let place = place_of(pixel, params);
        let own = &mut blocks[(params.first_pixel + place.y * params.row + place.x) as usize];
        if params.replaces != 0 {
            *own = RobustPixel::default();
        }
        let at = UVec2::new(pixel % params.window_width, pixel / params.window_width);
        for layer in 0..params.layers {
            let from = layer * params.radiance_layer + params.radiance_first + at.y * params.radiance_row + at.x;
            let from = &radiance[from as usize];
            let sample = params.first_sample + layer;
            let number = (sample % ROBUST_BLOCKS) as usize;
            let mut block = block_of(own, number);
            if from.info & SAMPLE_BAD != 0 || is_full(&block) || add(&mut block, from, params.exponent).is_some() {
                continue;
            }
            set_block(own, number, &block);
            let bright = luminance(from.rgb);
            if bright > own.brightest {
                (own.brightest, own.sample) = (bright, sample);
            }
        }
    }
}

/// A block of a pixel, by its number.
pub fn block_of(pixel: &RobustPixel, number: usize) -> FilmHalf {
    let sum = [0, 1, 2].map(|channel| pixel.sums[3 * number + channel]);
    FilmHalf { sum, count: pixel.counts[number], bad: 0 }
}

/// Makes a block of a pixel another one.
pub fn set_block(pixel: &mut RobustPixel, number: usize, block: &FilmHalf) {
    pixel.sums[3 * number..3 * number + 3].copy_from_slice(&block.sum);
    pixel.counts[number] = block.count;
}
