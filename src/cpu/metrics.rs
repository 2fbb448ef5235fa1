//! How far a picture is from a reference. Sums are f64. Knows no files.

/// Keeps the error of black pixels finite (Rousselle, Knaus, Zwicker 2012).
const DARK: f64 = 0.01;

/// relMSE: the mean over pixels and channels of (I - R)^2 / (R^2 + 0.01), linear radiance. 0 for empty pictures; of
/// pictures of unequal length, only what both have counts.
pub fn relative_mse(image: &[[f32; 3]], reference: &[[f32; 3]]) -> f64 {
    let channels = || image.as_flattened().iter().zip(reference.as_flattened());
    let term = |(&i, &r): (&f32, &f32)| {
        let (i, r) = (f64::from(i), f64::from(r));
        (i - r) * (i - r) / (r * r + DARK)
    };
    channels().map(term).sum::<f64>() / channels().count().max(1) as f64
}
