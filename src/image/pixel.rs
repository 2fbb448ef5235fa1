//! The colour of a pixel that was read.

/// Linear Rec.709 radiance of a pixel, as the file has it: it may be negative, infinite or NaN.
pub type Pixel = [f32; 3];
