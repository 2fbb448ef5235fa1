//! The twin of the pass `blocks`.

use glam::UVec2;

use crate::cpu::film::{add, place_of};
use crate::layout::film::{AccumulateParams, ROBUST_BLOCKS, RobustPixel};
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
            let block = &mut own.blocks[(sample % ROBUST_BLOCKS) as usize];
            if from.info & SAMPLE_BAD != 0 || add(block, from, params.exponent).is_some() {
                continue;
            }
            let bright = luminance(from.rgb);
            if bright > own.brightest {
                (own.brightest, own.sample) = (bright, sample);
            }
        }
    }
}
