// Smooth dielectric: light is reflected or refracted, by Fresnel's equations for unpolarised light.

// A crossing from index `a` on the side of the viewer to index `b` beyond.
struct Interface {
    a: f32,
    b: f32,
    // b^2 - a^2, from the index itself: near 1 a difference of squares would have lost it.
    gap: f32,
}

struct Fresnel {
    // Part of the light that is reflected, 0 to 1.
    reflectance: f32,
    // Of the refracted direction and the normal on its side; 0 under total reflection.
    cos_transmitted: f32,
}

// `ni` is the index behind the surface, 1 that before it.
fn interface_of(ni: f32, back_face: bool) -> Interface {
    let gap = (ni - 1.0) * (ni + 1.0);
    return Interface(select(1.0, ni, back_face), select(ni, 1.0, back_face), select(gap, -gap, back_face));
}

// What radiance is multiplied by on its way through, the square of the relative index of refraction: it is squeezed into another cone
// (Veach 1997, 5.2).
fn eta_squared(at: Interface) -> f32 {
    return (at.a / at.b) * (at.a / at.b);
}

// With x = a cos_i and y = b cos_t, y^2 - x^2 is the gap. Both amplitudes are written over their sums squared, so that no
// difference of nearly equal numbers is left but at Brewster's angle, where the other amplitude rules.
fn fresnel(at: Interface, cos_incident: f32) -> Fresnel {
    let x = at.a * cos_incident;
    let y2 = at.gap + x * x;
    if (y2 <= 0.0) {
        return Fresnel(1.0, 0.0);
    }
    let y = sqrt(y2);
    let cos_transmitted = min(1.0, y / at.b);
    let across = x + y;
    let along = at.b * cos_incident + at.a * cos_transmitted;
    let s = at.gap / (across * across);
    let p = at.gap * (cos_incident * cos_incident + cos_transmitted * cos_transmitted - 1.0) / (along * along);
    return Fresnel(min(1.0, 0.5 * (s * s + p * p)), cos_transmitted);
}

// The direction beyond the surface of unit normal `n`, which is on the side of `wo`. Equal indices do not bend it at all.
fn refracted(at: Interface, wo: vec3<f32>, n: vec3<f32>, cos_transmitted: f32) -> vec3<f32> {
    let ratio = at.a / at.b;
    let bent = normalize((ratio * dot(wo, n) - cos_transmitted) * n - ratio * wo);
    return select(bent, -wo, at.gap == 0.0);
}
