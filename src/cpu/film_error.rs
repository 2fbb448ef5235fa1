//! The error of a film, estimated from its two halves.

use super::film::half_mean;
use crate::layout::film::FilmPixel;
use crate::parallel;
use crate::stats::metrics::DARK;

/// Pixels on every side whose radiance stands for that of the one in their middle, where an error is made relative.
const REACH: usize = 4;

/// Rows that a thread looks at together.
const ROWS: usize = 32;

/// The relMSE that the film's mean is estimated to have: the mean over pixels and channels of var / (radiance^2 + 0.01). `width` is
/// that of the window whose pixels these are, row by row.
///
/// The halves are independent, so (h0 - h1)^2 has the mean s^2 (1 / c0 + 1 / c1) where the mean of both has variance s^2 /
/// (c0 + c1): a quarter of it for equal counts. The radiance is the mean of a square of pixels: by its own pixel's mean a rare
/// bright sample would be in what it is measured by, and hide itself. 0 where no pixel has samples in both halves.
pub fn relative_error(film: &[FilmPixel], width: usize, exponent: i32) -> f64 {
    let width = width.max(1);
    let height = film.len() / width;
    let piece = |number: usize| {
        let (first, end) = (number * ROWS, ((number + 1) * ROWS).min(height));
        let (low, high) = (first.saturating_sub(REACH), (end + REACH).min(height));
        Piece { film: &film[low * width..high * width], width, first: first - low, end: end - low, exponent }.error()
    };
    let pieces = parallel::map(height.div_ceil(ROWS), piece);
    let (sum, terms) = pieces.into_iter().fold((0.0, 0), |(sum, terms), (more, others)| (sum + more, terms + others));
    sum / terms.max(1) as f64
}

/// Some rows of a film, and those within reach of them.
struct Piece<'f> {
    film: &'f [FilmPixel],
    width: usize,
    /// The rows that count, from `first` up to but not `end`, among those of `film`.
    first: usize,
    end: usize,
    exponent: i32,
}

/// Three channels and a weight.
type Weighted = [f64; 4];

impl Piece<'_> {
    /// The sum of the rows' relative errors, and how many they are.
    fn error(&self) -> (f64, u64) {
        let mut means: Vec<Weighted> = Vec::with_capacity(self.film.len());
        let mut variances: Vec<[f64; 3]> = Vec::with_capacity(self.film.len());
        for pixel in self.film {
            let [(h0, c0), (h1, c1)] = pixel.halves.each_ref().map(|half| half_mean(half, self.exponent));
            if c0 == 0 || c1 == 0 {
                means.push([0.0; 4]);
                variances.push([0.0; 3]);
                continue;
            }
            let [r, g, b] = [0, 1, 2].map(|c| 0.5 * (h0[c] + h1[c]));
            means.push([r, g, b, 1.0]);
            let (c0, c1) = (f64::from(c0), f64::from(c1));
            let share = c0 * c1 / ((c0 + c1) * (c0 + c1));
            variances.push([0, 1, 2].map(|c| (h0[c] - h1[c]).powi(2) * share));
        }
        let (mut sum, mut terms) = (0.0, 0);
        let mut columns = vec![[0.0; 4]; self.width];
        for y in self.first..self.end {
            self.sum_columns(&means, y, &mut columns);
            let row = y * self.width..(y + 1) * self.width;
            for (x, (mean, variance)) in means[row.clone()].iter().zip(&variances[row]).enumerate() {
                if mean[3] == 0.0 {
                    continue;
                }
                let [r, g, b, count] = columns[near(x, self.width)].iter().fold([0.0; 4], add);
                let around = [r, g, b].map(|sum| sum / count);
                sum += [0, 1, 2].iter().map(|c| variance[*c] / (around[*c] * around[*c] + DARK)).sum::<f64>();
                terms += 3;
            }
        }
        (sum, terms)
    }

    /// Sums the means of each column over the rows within reach of one.
    fn sum_columns(&self, means: &[Weighted], y: usize, columns: &mut [Weighted]) {
        columns.fill([0.0; 4]);
        for row in near(y, means.len() / self.width) {
            let row = &means[row * self.width..(row + 1) * self.width];
            columns.iter_mut().zip(row).for_each(|(sum, value)| *sum = add(*sum, value));
        }
    }
}

fn add(sum: Weighted, value: &Weighted) -> Weighted {
    [0, 1, 2, 3].map(|c| sum[c] + value[c])
}

/// What is within reach of an index of a list.
fn near(at: usize, count: usize) -> std::ops::Range<usize> {
    at.saturating_sub(REACH)..(at + REACH + 1).min(count)
}
