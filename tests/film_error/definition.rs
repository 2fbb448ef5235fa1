//! The film's error and its bound by their definition, pixel by pixel and pair by pair.

use glam::UVec2;
use lucerna::cpu::film::half_mean;
use lucerna::cpu::film_error::{FilmError, Place, film_error};
use lucerna::layout::film::{FilmHalf, FilmPixel};
use lucerna::scene::generate::SplitMix;
use lucerna::stats::summary::upper_quantile;

use super::model::{EXPONENT, pixel_of};

/// A film, looked at one pixel at a time.
struct Plain<'f> {
    film: &'f [FilmPixel],
    place: Place,
}

/// Of a pixel that has both halves: their means, and the variance of the mean of both, by channel.
type Seen = ([[f64; 3]; 2], [f64; 3]);

impl Plain<'_> {
    fn size(&self) -> (i64, i64) {
        (self.place.width as i64, (self.film.len() / self.place.width) as i64)
    }

    fn seen(&self, x: i64, y: i64) -> Option<Seen> {
        let (width, height) = self.size();
        if !((0..width).contains(&x) && (0..height).contains(&y)) {
            return None;
        }
        let halves = &self.film[(y * width + x) as usize].halves;
        let [(a, n), (b, m)] = halves.each_ref().map(|half| half_mean(half, EXPONENT));
        let (n, m) = (f64::from(n), f64::from(m));
        (n > 0.0 && m > 0.0).then(|| ([a, b], [0, 1, 2].map(|c| (a[c] - b[c]).powi(2) * n * m / (n + m).powi(2))))
    }

    fn square(&self, x: i64, y: i64, reach: i64, own: bool) -> Vec<Seen> {
        let all = (y - reach..=y + reach).flat_map(|y| (x - reach..=x + reach).map(move |x| (x, y)));
        all.filter(|at| own || *at != (x, y)).filter_map(|(x, y)| self.seen(x, y)).collect()
    }

    /// How much more than those around it a channel of a pixel has, by both halves.
    fn product(&self, x: i64, y: i64, c: usize) -> Option<f64> {
        let (means, _) = self.seen(x, y)?;
        let around = self.square(x, y, 2, false);
        let mean = |half: usize| around.iter().map(|seen| seen.0[half][c]).sum::<f64>() / around.len() as f64;
        (!around.is_empty()).then(|| (means[0][c] - mean(0)) * (means[1][c] - mean(1)))
    }

    /// What a channel has along the edge that a pixel is at, or 0: the lesser half's mean over the line that is least spread, if another is a
    /// hundred times as much.
    fn along_edge(&self, x: i64, y: i64, c: usize) -> f64 {
        let line = |(across, down): (i64, i64)| -> Option<Vec<[f64; 2]>> {
            let pixel = |far: i64| Some(self.seen(x + far * across, y + far * down)?.0.map(|mean| mean[c]));
            [-2, -1, 1, 2].into_iter().map(pixel).collect()
        };
        let spread = |line: &[[f64; 2]]| {
            let means: Vec<f64> = line.iter().map(|[a, b]| 0.5 * (a + b)).collect();
            let mean = means.iter().sum::<f64>() / 4.0;
            means.iter().map(|m| m * m).sum::<f64>() / 4.0 - mean * mean
        };
        let mut lines: Vec<_> = [(1, 0), (0, 1), (1, 1), (1, -1)].into_iter().filter_map(line).collect();
        lines.sort_by(|a, b| spread(a).total_cmp(&spread(b)));
        match (lines.first(), lines.last()) {
            (Some(least), Some(most)) if 100.0 * spread(least).max(0.0) < spread(most) => {
                let sum = |half: usize| least.iter().map(|means| means[half]).sum::<f64>();
                sum(0).min(sum(1)) / 4.0
            }
            _ => 0.0,
        }
    }

    /// Relative errors of the channels, and what their squares might add up to.
    fn share(&self, x: i64, y: i64) -> Option<([f64; 3], f64)> {
        let (means, noise) = self.seen(x, y)?;
        let (mut errors, mut most) = ([0.0; 3], 0.0);
        for c in 0..3 {
            let (a, b, noise) = (means[0][c], means[1][c], noise[c]);
            let own_of = |least: f64| {
                let dark = (a.min(b).max(least).powi(2) + 0.01).sqrt();
                let rare = 1.0 + noise / ((0.5 * (a + b)).powi(2) + 0.01);
                rare / (dark * (dark + (a - b).abs()))
            };
            let (own, likely) = (own_of(0.0), own_of(self.along_edge(x, y, c).min(0.5 * (a + b))));
            let (near, wide) = (self.square(x, y, 2, false), self.square(x, y, 4, false));
            let (weight, greater) = if near.is_empty() {
                (own, own)
            } else {
                let mean = |of: &dyn Fn(&Seen) -> f64, all: &[Seen]| all.iter().map(of).sum::<f64>() / all.len() as f64;
                let radiance = mean(&|seen| 0.5 * (seen.0[0][c] + seen.0[1][c]), &near);
                let variance = mean(&|seen| seen.1[c], &near).max(0.5 * mean(&|seen| seen.1[c], &wide));
                let others = 1.0 / (radiance.powi(2) + 0.01 + 3.0 * variance / near.len() as f64);
                let inner = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
                let products: Vec<f64> = inner.filter_map(|(x, y)| self.product(x, y, c)).collect();
                let structure = (products.iter().sum::<f64>() / products.len().max(1) as f64).max(0.0);
                let trust = if structure > 0.0 { structure / (structure + noise) } else { 0.0 };
                (trust * likely + (1.0 - trust) * others, own.max(others))
            };
            errors[c] = (weight * noise).sqrt() * (a - b).signum();
            most += noise * greater;
        }
        Some((errors, most))
    }

    /// Variance of the sum of relative errors over a block, whose first pixel is at an absolute place.
    fn variance(&self, block: (i64, i64)) -> f64 {
        let min = (i64::from(self.place.min.x), i64::from(self.place.min.y));
        let at = |x: i64, y: i64| self.share(x - min.0, y - min.1);
        let (mut whole, mut pixels, mut doubt) = (Vec::new(), 0.0, 0.0);
        for (x, y) in (0..4).flat_map(|y| (0..4).map(move |x| (block.0 + 2 * x, block.1 + 2 * y))) {
            let quad: Vec<_> = [(0, 0), (1, 0), (0, 1), (1, 1)].iter().filter_map(|(i, j)| at(x + i, y + j)).collect();
            pixels += quad.len() as f64;
            doubt += quad.iter().map(|(_, most)| most * most).sum::<f64>();
            if quad.len() == 4 {
                whole.push(quad.iter().map(|(errors, _)| *errors).collect::<Vec<_>>());
            }
        }
        let dot = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|c| a[c] * b[c]).sum::<f64>();
        let pairs = || (0..4).flat_map(|a| (0..4).map(move |b| (a, b))).filter(|(a, b)| a != b);
        let (mut own, mut tiles) = (0.0, 0.0);
        for (i, one) in whole.iter().enumerate() {
            own += pairs().map(|(a, b)| dot(&one[a], &one[b]).powi(2)).sum::<f64>();
            for (j, other) in whole.iter().enumerate() {
                for ((a, b), (c, d)) in pairs().flat_map(|one| pairs().map(move |other| (one, other))) {
                    if i != j {
                        tiles += dot(&one[a], &one[b]) * dot(&other[c], &other[d]);
                    }
                }
            }
        }
        // A half's error is twice what is told of it, hence 4. Of 12 ordered pairs of a quad's pixels, 4 pixels count; of 24 matches of two
        // tiles in two quads, 4.
        let variance = 4.0 * (own * 4.0 / 12.0 + tiles * 4.0 / 24.0);
        let missing = if whole.is_empty() { 0.0 } else { pixels / (4.0 * whole.len() as f64) };
        missing * variance.max(0.0) + 0.4 * doubt
    }

    fn error(&self) -> FilmError {
        let (width, height) = self.size();
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let shares: Vec<_> = all.filter_map(|(x, y)| self.share(x, y)).collect();
        let terms = (3 * shares.len()).max(1) as f64;
        let sum: f64 = shares.iter().flat_map(|(errors, _)| errors.map(|error| error * error)).sum();
        let first = |min: u32| i64::from(min) / 8 * 8;
        let (left, top) = (first(self.place.min.x), first(self.place.min.y));
        let (right, bottom) = (i64::from(self.place.min.x) + width, i64::from(self.place.min.y) + height);
        let rows = (top..bottom).step_by(8);
        let variances: Vec<f64> =
            rows.flat_map(|y| (left..right).step_by(8).map(move |x| (x, y))).map(|at| self.variance(at)).collect();
        let (variance, squares) = variances.iter().fold((0.0, 0.0), |(sum, squares), v| (sum + v, squares + v * v));
        let blocks = if squares > 0.0 { (variance * variance / squares).max(1.0) } else { 1.0 };
        FilmError { relmse: sum / terms, bound: (sum + variance.sqrt() * upper_quantile(0.05, blocks)) / terms }
    }
}

/// Pixels of two or three samples, some of which are far brighter than the others.
fn noise(pixels: usize) -> Vec<FilmPixel> {
    let mut random = SplitMix(pixels as u64);
    let mut sample = || {
        let scale = if random.unit() < 0.03 { 60.0 } else { 1.0 };
        [0.0; 3].map(|_: f64| scale * random.unit())
    };
    (0..pixels).map(|_| pixel_of(&[sample(), sample(), sample()])).collect()
}

#[test]
fn the_error_is_that_of_its_definition_however_many_rows_there_are() {
    let sizes = [(1, 1), (3, 2), (9, 5), (17, 31), (8, 32), (5, 33), (7, 36), (4, 37), (6, 64), (3, 65), (11, 100)];
    let places = [(0, 0), (3, 2), (8, 29), (13, 31), (1000, 33)];
    for (number, (width, height)) in sizes.into_iter().enumerate() {
        let mut film = noise(width * height);
        // A lamp's edge, which covers little of a row.
        let lit = height / 2 * width;
        film[lit..lit + width].fill(pixel_of(&[[50.0; 3]; 2]));
        let mut sliver = |at: usize| {
            film[at] = pixel_of(&[[0.1; 3], [[2.0; 3], [0.2; 3]][at % 2], [[2.1; 3], [0.3; 3]][at / 2 % 2]])
        };
        (lit.saturating_sub(width)..lit).for_each(&mut sliver);
        // Some have no sample in one half.
        film.iter_mut().step_by(17).for_each(|pixel| pixel.halves[1] = FilmHalf::default());
        let place = Place { min: UVec2::from(places[number % places.len()]), width };
        let told = film_error(&film, place, EXPONENT);
        let right = Plain { film: &film, place }.error();
        for (told, right) in [(told.relmse, right.relmse), (told.bound, right.bound)] {
            assert!((told - right).abs() <= 1e-9 * right, "{width}x{height} at {}: {told}, not {right}", place.min);
        }
    }
}

#[test]
fn a_film_without_pixels_or_light_or_of_one_sample_has_no_error() {
    let place = Place { min: UVec2::ZERO, width: 8 };
    let nothing = FilmError::default();
    for min in [UVec2::ZERO, UVec2::splat(5)] {
        assert_eq!(film_error(&[], Place { min, width: 0 }, EXPONENT), nothing);
        assert_eq!(film_error(&[], Place { min, width: 7 }, EXPONENT), nothing);
    }
    assert_eq!(film_error(&[FilmPixel::default(); 64], place, EXPONENT), nothing);
    assert_eq!(film_error(&[pixel_of(&[[1.0; 3]]); 64], place, EXPONENT), nothing);
    assert_eq!(film_error(&[pixel_of(&[[0.0; 3]; 4]); 64], place, EXPONENT), nothing);
}
