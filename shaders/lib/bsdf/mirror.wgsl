// Smooth mirror: all light in one direction, so f is a Dirac delta.

// `wo` reflected about the unit normal `n`.
fn reflected(wo: vec3<f32>, n: vec3<f32>) -> vec3<f32> {
    return normalize(2.0 * dot(wo, n) * n - wo);
}
