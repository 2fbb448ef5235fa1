// Directions from uniform numbers in [0, 1).

import package::lib::math::{expm1_negative, frame_around, log1p_negative, sin_cos_turns};

// Cosine-weighted about unit n: pdf cos / pi. Unit length; the cosine is at least 2^-12.
fn sample_cosine(n: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let frame = frame_around(n);
    let round = sin_cos_turns(u.y) * sqrt(u.x);
    return normalize(frame.t * round.y + frame.b * round.x + n * sqrt(1.0 - u.x));
}

// Phong lobe about unit r: cos(alpha) = (1 - u)^(1 / (n + 1)), pdf (n + 1) cos^n(alpha) / (2 pi). Near the axis 1 - cos
// and sin are formed without cos, so that n = 1e5 keeps its shape.
fn sample_phong(r: vec3<f32>, n: f32, u: vec2<f32>) -> vec3<f32> {
    let one_minus_cos = -expm1_negative(log1p_negative(-u.x) / (n + 1.0));
    let sin_alpha = sqrt(max(0.0, one_minus_cos * (2.0 - one_minus_cos)));
    let frame = frame_around(r);
    let round = sin_cos_turns(u.y) * sin_alpha;
    return normalize(r - r * one_minus_cos + frame.t * round.y + frame.b * round.x);
}
