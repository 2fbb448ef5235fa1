//! Tone curves: exposed light of any strength to what a display can show, both linear Rec.709. The twin of `lib/tone`.
//!
//! AgX is Sobotka's (2022), with the primaries that Blender 4 has it with (`AgX_Base_sRGB`) and its curve as the polynomial of Wrensch, "Minimal
//! AgX implementation" (2023). Neutral is the Khronos PBR Neutral tone mapper (2024), by its specification.

use glam::{DMat3, DVec3};

use crate::layout::film::{TONE_AGX, TONE_NEUTRAL};

/// Brighter is shown as this is.
const BRIGHTEST: f64 = 65504.0;

/// Rec.709 to Rec.2020 (ITU-R BT.2407), and back.
const TO_REC2020: [f64; 9] = [0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956];
const TO_REC709: [f64; 9] = [1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187];

/// By columns, as those before.
const AGX_INSET: [f64; 9] = [
    0.856627153315983,
    0.137318972929847,
    0.11189821299995,
    0.0951212405381588,
    0.761241990602591,
    0.0767994186031903,
    0.0482516061458583,
    0.101439036467562,
    0.811302368396859,
];
const AGX_OUTSET: [f64; 9] = [
    1.1271005818144368,
    -0.1413297634984383,
    -0.14132976349843826,
    -0.11060664309660323,
    1.157823702216272,
    -0.11060664309660294,
    -0.016493938717834573,
    -0.016493938717834257,
    1.2519364065950405,
];

/// Stops that the curve of AgX reaches over, binary logarithms of light.
const AGX_STOPS: [f64; 2] = [-12.47393, 4.026069];

/// The curve of AgX, from the highest power down.
const AGX_CURVE: [f64; 7] = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];

/// By a `TONE_` curve. `light` at least 0.
pub fn toned(light: [f64; 3], curve: u32) -> [f64; 3] {
    let finite = DVec3::from_array(light).min(DVec3::splat(BRIGHTEST));
    match curve {
        TONE_AGX => agx(finite).to_array(),
        TONE_NEUTRAL => neutral(finite).to_array(),
        _ => light,
    }
}

fn agx(light: DVec3) -> DVec3 {
    let [to_rec2020, to_rec709, inset, outset] =
        [TO_REC2020, TO_REC709, AGX_INSET, AGX_OUTSET].map(|columns| DMat3::from_cols_array(&columns));
    let [darkest, brightest] = AGX_STOPS;
    let stops = (inset * (to_rec2020 * light)).max(DVec3::splat(1e-10)).map(f64::log2);
    let x = ((stops - darkest) / (brightest - darkest)).clamp(DVec3::ZERO, DVec3::ONE);
    let curve = AGX_CURVE.into_iter().fold(DVec3::ZERO, |sum, factor| sum * x + factor);
    to_rec709 * (outset * curve).max(DVec3::ZERO).powf(2.2)
}

fn neutral(light: DVec3) -> DVec3 {
    const F_90: f64 = 0.04;
    const K_S: f64 = 0.8 - F_90;
    const K_D: f64 = 0.15;
    let x = light.min_element();
    let c = light - if x <= 2.0 * F_90 { x - x * x / (4.0 * F_90) } else { F_90 };
    let p = c.max_element();
    if p <= K_S {
        return c;
    }
    let p_n = 1.0 - (1.0 - K_S).powi(2) / (p + 1.0 - 2.0 * K_S);
    let g = 1.0 / (K_D * (p - p_n) + 1.0);
    c * (p_n / p) * g + p_n * (1.0 - g)
}
