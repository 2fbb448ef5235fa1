//! sRGB (IEC 61966-2-1): how linear light is encoded for displays, and back.

/// One channel, linear to encoded; both 0 to 1.
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// One channel, encoded to linear; both 0 to 1.
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// One channel, linear to 8 bits, clamped and rounded.
pub fn srgb_byte(linear: f64) -> u8 {
    (srgb_encode(linear.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8
}
