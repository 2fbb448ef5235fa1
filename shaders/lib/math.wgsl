// Elementary functions where WGSL's own promise too little: its log has an absolute error, its sin and cos 2^-11.

const PI: f32 = 3.14159265358979;
const INV_PI: f32 = 0.318309886183791;

// log(1 + x) for x in [-1 + 2^-24, 0], to about 2 ulp of the result: 1 + x = 2^e (1 + f) with 1 + f in [0.7, 1.42),
// and log(1 + f) = 2 atanh(f / (2 + f)).
fn log1p_negative(x: f32) -> f32 {
    let y = 1.0 + x;
    // 0x3f3504f3 is sqrt(1/2): what lies above it keeps exponent 0.
    let e = (bitcast<i32>(y) - 0x3f3504f3) >> 23u;
    let m = bitcast<f32>(bitcast<i32>(y) - (e << 23u));
    let f = select(m - 1.0, x, e == 0);
    let s = f / (2.0 + f);
    let z = s * s;
    let series = z * (0.33333334 + z * (0.2 + z * (0.14285715 + z * (0.11111111 + z * 0.09090909))));
    return f32(e) * 0.6931472 + 2.0 * (s + s * series);
}

// exp(x) - 1 for x <= 0, to a few ulp of the result.
fn expm1_negative(x: f32) -> f32 {
    if (x < -0.35) {
        return exp(x) - 1.0;
    }
    let tail = 1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x / 5040.0)));
    return x + x * x * (0.5 + x * tail);
}

// (sin, cos) of 2 pi u for u from -1/8 to 1: reduced exactly to an eighth of a turn either side of a quadrant's axis.
fn sin_cos_turns(u: f32) -> vec2<f32> {
    let quadrant = floor(u * 4.0 + 0.5);
    let a = (u * 4.0 - quadrant) * (0.5 * PI);
    let z = a * a;
    let s = a + a * z * (-0.16666667 + z * (0.008333332 + z * (-0.00019841 + z * 2.7557e-6)));
    let c = 1.0 + z * (-0.5 + z * (0.041666668 + z * (-0.0013888889 + z * (2.4801587e-5 - z * 2.7557e-7))));
    let q = u32(quadrant) & 3u;
    let swapped = select(vec2<f32>(s, c), vec2<f32>(c, s), (q & 1u) != 0u);
    // Quadrants 0..3: (s, c), (c, -s), (-s, -c), (-c, s).
    return swapped * vec2<f32>(select(1.0, -1.0, q >= 2u), select(1.0, -1.0, q == 1u || q == 2u));
}

// The angle of (x, y) from the x axis in turns, -1/2 to 1/2, to about 1e-8 of a turn; 0 for (0, 0).
fn turns_of(x: f32, y: f32) -> f32 {
    let a = abs(vec2<f32>(x, y));
    let ratio = min(a.x, a.y) / max(max(a.x, a.y), 1e-37);
    // atan(r) = 1/8 turn + atan((r - 1) / (r + 1)), so that the series is evaluated for |z| below tan(pi / 8) only.
    let reduced = ratio > 0.41421357;
    let z = select(ratio, (ratio - 1.0) / (ratio + 1.0), reduced);
    let s = z * z;
    let series = 1.0 + s * (-1.0 / 3.0 + s * (0.2 + s * (-1.0 / 7.0 + s * (1.0 / 9.0 + s * (-1.0 / 11.0 + s * (1.0 / 13.0 - s / 15.0))))));
    let octant = select(0.0, 0.125, reduced) + z * series * (0.5 * INV_PI);
    let quarter = select(octant, 0.25 - octant, a.y > a.x);
    let half = select(quarter, 0.5 - quarter, x < 0.0);
    return select(half, -half, y < 0.0);
}

// cos(alpha)^n for the angle between unit vectors, 0 from 90 degrees on. For n up to 1e5 the cosine itself has lost
// what matters; the distance of the two points has not.
fn cos_power(a: vec3<f32>, b: vec3<f32>, n: f32) -> f32 {
    let d = a - b;
    let one_minus_cos = 0.5 * dot(d, d);
    if (one_minus_cos >= 1.0) {
        return 0.0;
    }
    return exp(n * log1p_negative(-one_minus_cos));
}

// Two unit vectors that with unit n make a right-handed frame (Duff et al., JCGT 6(1), 2017).
struct Frame {
    t: vec3<f32>,
    b: vec3<f32>,
}

fn frame_around(n: vec3<f32>) -> Frame {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    return Frame(vec3<f32>(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3<f32>(b, s + n.y * n.y * a, -n.y));
}

fn largest_of(v: vec3<f32>) -> f32 {
    return max(v.x, max(v.y, v.z));
}
