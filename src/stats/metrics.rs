//! How far two pictures are apart, pixel by pixel. Sums are f64; what is no radiance is left out. Knows no files.

/// A pixel: linear radiance of red, green and blue, in f32 or f64.
pub trait Sample: Copy + Into<f64> {}
impl<T: Copy + Into<f64>> Sample for T {}

/// Keeps the error of black pixels finite (Rousselle, Knaus, Zwicker 2012).
pub const DARK: f64 = 0.01;

/// What a pixel is, by the worst of its channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// Finite, and at least 0.
    Good,
    Negative,
    Infinite,
    NotANumber,
}

/// Sorts a pixel.
pub fn quality<T: Sample>(pixel: [T; 3]) -> Quality {
    let of = |value: f64| match value {
        v if v.is_nan() => Quality::NotANumber,
        v if v.is_infinite() => Quality::Infinite,
        v if v < 0.0 => Quality::Negative,
        _ => Quality::Good,
    };
    let [r, g, b] = pixel.map(|channel| of(channel.into()));
    r.max(g).max(b)
}

/// The pixels of one picture that can't be compared, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    pub not_a_number: u64,
    pub infinite: u64,
    pub negative: u64,
    /// Index of the first of them.
    pub first: Option<usize>,
}

impl Census {
    /// Counts the bad pixels of a picture.
    pub fn of<T: Sample>(picture: &[[T; 3]]) -> Self {
        let mut census = Self::default();
        for (index, pixel) in picture.iter().enumerate() {
            match quality(*pixel) {
                Quality::Good => continue,
                Quality::Negative => census.negative += 1,
                Quality::Infinite => census.infinite += 1,
                Quality::NotANumber => census.not_a_number += 1,
            }
            census.first = census.first.or(Some(index));
        }
        census
    }

    /// All bad pixels.
    pub fn bad(&self) -> u64 {
        self.not_a_number + self.infinite + self.negative
    }
}

/// Metrics of a picture A against a reference B, over the pixels that are good in both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Pixels compared, at least 1.
    pub pixels: u64,
    /// Mean of each channel of A.
    pub mean_a: [f64; 3],
    /// Mean of each channel of B.
    pub mean_b: [f64; 3],
    /// Mean of (A - B)^2 over pixels and channels.
    pub mse: f64,
    /// Mean of |A - B| over pixels and channels.
    pub mae: f64,
    /// Mean of (A - B)^2 / (B^2 + 0.01) over pixels and channels.
    pub relative_mse: f64,
}

impl Difference {
    /// Compares two pictures of equal length; `None` where no pixel is good in both.
    pub fn of<A: Sample, B: Sample>(a: &[[A; 3]], b: &[[B; 3]]) -> Option<Self> {
        assert_eq!(a.len(), b.len(), "invariant: pictures of one size");
        let (mut pixels, mut sum_a, mut sum_b) = (0u64, [0.0; 3], [0.0; 3]);
        let (mut squares, mut distances, mut relative) = (0.0, 0.0, 0.0);
        for (a, b) in a.iter().zip(b).filter(|(a, b)| comparable(**a, **b)) {
            pixels += 1;
            for c in 0..3 {
                let (a, b): (f64, f64) = (a[c].into(), b[c].into());
                let distance = a - b;
                sum_a[c] += a;
                sum_b[c] += b;
                squares += distance * distance;
                distances += distance.abs();
                relative += relative_error(a, b);
            }
        }
        let channels = 3.0 * pixels as f64;
        (pixels > 0).then(|| Self {
            pixels,
            mean_a: sum_a.map(|sum| sum / pixels as f64),
            mean_b: sum_b.map(|sum| sum / pixels as f64),
            mse: squares / channels,
            mae: distances / channels,
            relative_mse: relative / channels,
        })
    }
}

/// relMSE of a picture against a reference, over the pixels that are good in both; 0 where none is.
pub fn relative_mse<A: Sample, B: Sample>(image: &[[A; 3]], reference: &[[B; 3]]) -> f64 {
    Difference::of(image, reference).map_or(0.0, |difference| difference.relative_mse)
}

/// Whether a pixel of A and its place in B are both good.
pub fn comparable<A: Sample, B: Sample>(a: [A; 3], b: [B; 3]) -> bool {
    quality(a) == Quality::Good && quality(b) == Quality::Good
}

/// (a - b)^2 / (b^2 + 0.01) of one channel: the term whose mean is relMSE.
pub fn relative_error(a: f64, b: f64) -> f64 {
    (a - b) * (a - b) / (b * b + DARK)
}

/// Peak signal-to-noise ratio of two 8-bit pictures, decibels, the peak being 255; `None` for equal ones. `pixels` is by how
/// many to divide: those that are bad are equal in both, and don't count.
pub fn peak_signal_to_noise(a: &[[u8; 3]], b: &[[u8; 3]], pixels: u64) -> Option<f64> {
    let square = |(a, b): (&u8, &u8)| u64::from(a.abs_diff(*b)).pow(2);
    let squares: u64 = a.as_flattened().iter().zip(b.as_flattened()).map(square).sum();
    (squares > 0).then(|| 10.0 * (255.0f64.powi(2) * 3.0 * pixels as f64 / squares as f64).log10())
}
