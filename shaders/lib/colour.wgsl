// Linear Rec.709: luminance, and sRGB of it.

fn luminance(rgb: vec3<f32>) -> f32 {
    return dot(rgb, vec3<f32>(0.2126, 0.7152, 0.0722));
}

// One channel, linear to encoded; both 0 to 1 (IEC 61966-2-1).
fn srgb_encode(linear: f32) -> f32 {
    if (linear <= 0.0031308) {
        return 12.92 * linear;
    }
    return 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

// Three channels, encoded to linear; all 0 to 1.
fn srgb_decode(encoded: vec3<f32>) -> vec3<f32> {
    let curve = pow((encoded + 0.055) / 1.055, vec3<f32>(2.4));
    return select(curve, encoded / 12.92, encoded <= vec3<f32>(0.04045));
}

// Clamped to 0..1, encoded and rounded to 8 bits; r in the lowest byte, a = 255 in the highest.
fn srgb8(linear: vec3<f32>) -> u32 {
    let c = clamp(linear, vec3<f32>(0.0), vec3<f32>(1.0));
    let encoded = vec3<f32>(srgb_encode(c.x), srgb_encode(c.y), srgb_encode(c.z));
    let b = vec3<u32>(encoded * 255.0 + 0.5);
    return b.x | b.y << 8u | b.z << 16u | 0xff000000u;
}
