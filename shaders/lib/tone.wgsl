// Tone curves: exposed light of any strength to what a display can show, both linear Rec.709. See `cpu/tone.rs`, the twin.

import package::gen::{TONE_AGX};

// Brighter is shown as this is. It keeps the curves' arithmetic finite.
const BRIGHTEST: f32 = 65504.0;

// Of AgX, by columns: Rec.709 to Rec.2020 (ITU-R BT.2407) and its inset there; the outset, and back.
const TO_REC2020 = mat3x3<f32>(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
const TO_REC709 = mat3x3<f32>(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
const AGX_INSET = mat3x3<f32>(
    0.856627153315983, 0.137318972929847, 0.11189821299995,
    0.0951212405381588, 0.761241990602591, 0.0767994186031903,
    0.0482516061458583, 0.101439036467562, 0.811302368396859,
);
const AGX_OUTSET = mat3x3<f32>(
    1.1271005818144368, -0.1413297634984383, -0.14132976349843826,
    -0.11060664309660323, 1.157823702216272, -0.11060664309660294,
    -0.016493938717834573, -0.016493938717834257, 1.2519364065950405,
);

// Stops that the curve of AgX reaches over, binary logarithms of light.
const AGX_DARKEST: f32 = -12.47393;
const AGX_BRIGHTEST: f32 = 4.026069;

// AgX (Sobotka 2022), with the primaries that Blender 4 has it with and the curve as a polynomial (Wrensch 2023).
fn agx(light: vec3<f32>) -> vec3<f32> {
    let inset = max(AGX_INSET * (TO_REC2020 * light), vec3<f32>(1e-10));
    let x = clamp((log2(inset) - AGX_DARKEST) / (AGX_BRIGHTEST - AGX_DARKEST), vec3<f32>(0.0), vec3<f32>(1.0));
    let even = ((15.5 * x - 40.14) * x + 31.96) * x - 6.868;
    let curve = ((even * x + 0.4298) * x + 0.1191) * x - 0.00232;
    return TO_REC709 * pow(max(AGX_OUTSET * curve, vec3<f32>(0.0)), vec3<f32>(2.2));
}

// Khronos PBR Neutral (2024), with its specification's letters: what is below K_s is as it was but for F_90, the reflection that
// dielectrics lay over their colour.
fn neutral(light: vec3<f32>) -> vec3<f32> {
    let f_90 = 0.04;
    let k_s = 0.8 - f_90;
    let k_d = 0.15;
    let x = min(light.x, min(light.y, light.z));
    let c = light - select(f_90, x - x * x / (4.0 * f_90), x <= 2.0 * f_90);
    let p = max(c.x, max(c.y, c.z));
    let p_n = 1.0 - (1.0 - k_s) * (1.0 - k_s) / (max(p, k_s) + 1.0 - 2.0 * k_s);
    let g = 1.0 / (k_d * (p - p_n) + 1.0);
    let compressed = c * (p_n / max(p, k_s)) * g + p_n * (1.0 - g);
    return select(c, compressed, p > k_s);
}

// By a curve other than `TONE_NONE`.
fn toned(light: vec3<f32>, curve: u32) -> vec3<f32> {
    let finite = min(light, vec3<f32>(BRIGHTEST));
    if (curve == TONE_AGX) {
        return agx(finite);
    }
    return neutral(finite);
}
