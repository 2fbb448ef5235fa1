//! The film as WGSL and Rust see it: 64-bit fixed-point sums, two halves a pixel, and the counters beside them.

use glam::UVec2;

use super::types::AtomicWord;

gpu_struct! {
    /// Half of a pixel: the samples of one scramble.
    pub struct FilmHalf {
        /// Per channel: the sum of radiance times 2^exponent, low word and high word.
        pub sum: [UVec2; 3],
        /// Samples in the sums.
        pub count: u32,
        /// Samples that were NaN, infinite, negative or too large, and are in neither.
        pub bad: u32,
    }

    /// One pixel of the film.
    pub struct FilmPixel {
        /// Even and odd film samples.
        pub halves: [FilmHalf; 2],
    }

    /// A pixel's samples in blocks, beside the film: what a robust mean is made of.
    pub struct RobustPixel {
        /// Of each block, the film samples whose number leaves that remainder, per channel: as in [`FilmHalf`].
        pub sums: [UVec2; 3 * ROBUST_BLOCKS as usize],
        /// Samples in each block.
        pub counts: [u32; ROBUST_BLOCKS as usize],
        /// Luminance of the brightest sample; 0 where none has any.
        pub brightest: f32,
        /// The first film sample that is as bright.
        pub sample: u32,
    }

    /// Where a sample went wrong.
    pub struct BadSample {
        /// Row times the whole film's width plus column.
        pub pixel: u32,
        /// Film sample.
        pub sample: u32,
        /// Path segments before the ray at whose end it went wrong, or [`UNKNOWN_BOUNCE`].
        pub bounce: u32,
        /// Index of the material, or `NO_MATERIAL`.
        pub material: u32,
        /// A `BAD_` kind.
        pub kind: u32,
    }

    /// What the film counts, over all dispatches since it was cleared.
    pub struct FilmCounters {
        /// Rays traced, low word.
        pub rays_lo: AtomicWord,
        /// Rays traced, high word.
        pub rays_hi: AtomicWord,
        /// Bad samples; the first [`BAD_LOG`] of them are in `log`, in no order.
        pub bad: AtomicWord,
        /// Halves of pixels that have become full: they take no more samples.
        pub full: AtomicWord,
        /// Where the bad samples went wrong.
        pub log: [BadSample; BAD_LOG as usize],
    }

    /// Parameters of the accumulate pass.
    pub struct AccumulateParams {
        /// Whole film's width, for the log.
        pub film_width: u32,
        /// The batch's first pixel, in the whole film.
        pub window_x: u32,
        pub window_y: u32,
        /// Columns and rows of the batch.
        pub window_width: u32,
        pub window_height: u32,
        /// Film sample of layer 0.
        pub first_sample: u32,
        /// Samples of this batch.
        pub layers: u32,
        /// Radiance is scaled by 2^exponent.
        pub exponent: i32,
        /// Where the batch's first pixel is in `film`.
        pub first_pixel: u32,
        /// Pixels of a row of `film`.
        pub row: u32,
        /// Binary logarithm of the distance between two columns of the batch.
        pub column_shift: u32,
        /// The same of rows.
        pub row_shift: u32,
        /// Where the batch's first pixel is in a layer of `radiance`: more may be traced than is kept.
        pub radiance_first: u32,
        /// Pixels of a row there.
        pub radiance_row: u32,
        /// Pixels of a layer there.
        pub radiance_layer: u32,
        /// 1: what pixels had so far is dropped.
        pub replaces: u32,
        /// Tiles that `tile_runs` says the samples of; 0: the batch is layers of a rectangle. Of adaptive films alone.
        pub runs: u32,
    }

    /// Parameters of the display pass.
    pub struct DisplayParams {
        /// Pixels of the window.
        pub pixels: u32,
        /// Pixels of a row of it.
        pub row: u32,
        /// Binary logarithm of the width of a block, all of which shows the pixel at its top left.
        pub column_shift: u32,
        /// The same of its height.
        pub row_shift: u32,
        /// 2^(exposure - the film's exponent), finite and above 0.
        pub scale: f32,
        /// A `TONE_` curve.
        pub tone: u32,
        /// 1: each half of a pixel counts alike, however many samples it has. So it is in adaptive films alone.
        pub by_halves: u32,
    }
}

gpu_consts! {
    /// Blocks of a pixel's samples; even, so that each is of one half.
    pub const ROBUST_BLOCKS: u32 = 16;
    /// Entries of [`FilmCounters::log`].
    pub const BAD_LOG: u32 = 1024;
    /// A bad sample whose bounce is not known: it went bad in the film.
    pub const UNKNOWN_BOUNCE: u32 = 0x00ff_ffff;
    /// Scaled radiance of one sample is below 2^this, 2^16 times the largest emission.
    pub const SAMPLE_BITS: u32 = 56;
    /// The high word of a sum from which on its half of a pixel takes no more samples: the next one of [`SAMPLE_BITS`] might not fit.
    pub const FULL_SUM: u32 = 0xff00_0000;
    /// Tone curve: none. What is too bright is white.
    pub const TONE_NONE: u32 = 0;
    /// Tone curve: AgX.
    pub const TONE_AGX: u32 = 1;
    /// Tone curve: Khronos PBR Neutral.
    pub const TONE_NEUTRAL: u32 = 2;
    /// Samples a pixel that a film holds for certain, where none is brighter than the largest emission.
    pub const MOST_SAMPLES: u32 = 255 << 16;
}

/// The power of two by which radiance is scaled, so that the largest emission lands in [2^40, 2^41).
///
/// One sample may reach 2^56, which is 65,536 times the largest emission; a half of a pixel holds 2^64, which is 2^23
/// samples of the largest emission. The step is 2^-40 of the largest emission. A half whose sum has come to within a sample of 2^64
/// ([`FULL_SUM`]) takes no more: refusing what does not fit would leave out the bright samples alone, and the mean would be too dark.
pub fn film_exponent(largest_emission: f32) -> i32 {
    if !(largest_emission > 0.0 && largest_emission.is_finite()) {
        return 40;
    }
    let floor_log2 = f64::from(largest_emission).log2().floor() as i32;
    // Bounded so that 2^-exponent and 2^(56 - exponent) stay within f32.
    (40 - floor_log2).clamp(-70, 110)
}

/// The first radiance that does not fit a film of this exponent.
pub fn largest_sample(exponent: i32) -> f32 {
    2f32.powi(SAMPLE_BITS as i32 - exponent)
}
