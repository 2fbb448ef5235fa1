// Directions from uniform numbers in [0, 1). A distribution gives the angle from its axis; the turn about it is uniform.

import package::lib::math::{expm1_negative, frame_around, log1p_negative, sin_cos_turns};

// Cosine and sine of an angle.
struct Angle {
    cos: f32,
    sin: f32,
}

// Cosine-weighted: pdf cos / pi. The cosine is at least 2^-12.
fn cosine_angle(u: f32) -> Angle {
    return Angle(sqrt(1.0 - u), sqrt(u));
}

// Phong lobe: cos(alpha) = (1 - u)^(1 / (n + 1)), pdf (n + 1) cos^n(alpha) / (2 pi). The sine is formed without the cosine,
// so that n = 1e5 keeps its shape near the axis.
fn phong_angle(n: f32, u: f32) -> Angle {
    let one_minus_cos = -expm1_negative(log1p_negative(-u) / (n + 1.0));
    return Angle(1.0 - one_minus_cos, sqrt(max(0.0, one_minus_cos * (2.0 - one_minus_cos))));
}

// A point of the unit disk, evenly: squares about the middle become circles (Shirley and Chiu: A Low Distortion Map Between Disk and Square,
// Journal of Graphics Tools 2(3), 1997).
fn concentric_disk(u: vec2<f32>) -> vec2<f32> {
    let p = 2.0 * u - 1.0;
    let wide = abs(p.x) > abs(p.y);
    let radius = select(p.y, p.x, wide);
    let part = 0.125 * select(p.x, p.y, wide) / select(radius, 1.0, radius == 0.0);
    return radius * sin_cos_turns(select(0.25 - part, part, wide)).yx;
}

// The direction at an angle from a unit axis, `turn` turns about it. Unit length.
fn direction_around(axis: vec3<f32>, angle: Angle, turn: f32) -> vec3<f32> {
    let frame = frame_around(axis);
    let round = sin_cos_turns(turn) * angle.sin;
    return normalize(axis * angle.cos + frame.t * round.y + frame.b * round.x);
}
