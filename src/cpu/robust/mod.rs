//! A mean that rare bright samples can't take with them, beside the plain one and never in its place: it is not the pixel's radiance in the mean.
//!
//! Where all of a pixel's light comes in one sample of a thousand, that sample is the light, and a robust mean leaves it out. So what it is good for is
//! to tell where a film hangs on single samples.

mod blocks;
mod film;
mod mean;

pub use blocks::{add_blocks, block_of, set_block};
pub use film::{RobustFilm, Worst, robust_film};
pub use mean::{RobustMean, robust_mean};
