//! Metrics and block statistics of two pictures, against values worked out by hand and against planted differences.

use glam::UVec2;
use lucerna::cpu::pcg4d::pcg4d;
use lucerna::stats::blocks::{Blocks, Grid, LEAST_PIXELS, limit};
use lucerna::stats::metrics::{Census, Difference, peak_signal_to_noise};

const SIZE: UVec2 = UVec2::new(96, 80);

/// Uniform numbers of [0, 1), a pure function of what they belong to.
fn uniform(seed: u32, pixel: u32) -> [f64; 4] {
    pcg4d(glam::UVec4::new(seed, pixel, 0, 7)).to_array().map(|word| f64::from(word) / 2f64.powi(32))
}

/// A smooth picture with noise: `spread` is its standard deviation over the mean; `rare` brings one sample in twenty of all
/// light, which is how a small lamp looks.
fn noisy(seed: u32, spread: f64, rare: bool, factor: f64) -> Vec<[f32; 3]> {
    let pixels = 0..SIZE.x * SIZE.y;
    let pixel = |pixel: u32| {
        let u = uniform(seed, pixel);
        let base = 0.2 + f64::from(pixel % SIZE.x) / f64::from(SIZE.x);
        let noise = match rare {
            false => 1.0 + spread * 3f64.sqrt() * (2.0 * u[0] - 1.0),
            // Eight draws a pixel: 0 or 20.
            true => (0..8).map(|i| f64::from(uniform(seed ^ (i << 20), pixel)[0] < 0.05) * 20.0 / 8.0).sum(),
        };
        [1.0, 0.7, 0.4].map(|tint| (tint * base * noise * factor) as f32)
    };
    pixels.map(pixel).collect()
}

fn blocks(a: &[[f32; 3]], b: &[[f32; 3]]) -> Blocks {
    Blocks::of(a, b, Grid::new(SIZE, 16))
}

fn differ(a: &[[f32; 3]], b: &[[f32; 3]]) -> bool {
    let blocks = blocks(a, b);
    blocks.largest_z().unwrap() > blocks.limit.unwrap()
}

#[test]
fn metrics_are_those_worked_out_by_hand() {
    let a = [[1.0f32, 0.0, 0.5], [2.0, 1.0, 0.0]];
    let b = [[0.5f64, 0.0, 1.0], [2.0, 3.0, 0.0]];
    let found = Difference::of(&a, &b).unwrap();
    assert_eq!(found.pixels, 2);
    assert_eq!((found.mean_a, found.mean_b), ([1.5, 0.5, 0.25], [1.25, 1.5, 0.5]));
    assert_eq!(found.mse, (0.25 + 0.25 + 4.0) / 6.0);
    assert_eq!(found.mae, (0.5 + 0.5 + 2.0) / 6.0);
    let relative = (0.25 / 0.26 + 0.25 / 1.01 + 4.0 / 9.01) / 6.0;
    assert!((found.relative_mse - relative).abs() < 1e-15, "{}", found.relative_mse);
    let psnr = peak_signal_to_noise(&[[255, 0, 0]], &[[0, 0, 0]], 1).unwrap();
    assert!((psnr - 10.0 * 3f64.log10()).abs() < 1e-12, "{psnr}");
    assert_eq!(peak_signal_to_noise(&[[1, 2, 3]], &[[1, 2, 3]], 1), None);
}

#[test]
fn bad_pixels_are_counted_and_left_out() {
    let (nan, infinity) = (f32::NAN, f32::INFINITY);
    let a = [[1.0f32; 3], [nan, -1.0, infinity], [1.0, infinity, -1.0], [1.0, -1e-9, 1.0], [0.5, -0.0, 0.5]];
    let b = [[nan, 0.0, 0.0], [1.0; 3], [1.0; 3], [1.0; 3], [0.5f32, 0.0, 0.25]];
    let census = Census { not_a_number: 1, infinite: 1, negative: 1, first: Some(1) };
    assert_eq!(Census::of(&a), census);
    let found = Difference::of(&a, &b).unwrap();
    assert_eq!((found.pixels, found.mae), (1, 0.25 / 3.0));
    assert_eq!(Difference::of(&a[..1], &b[..1]), None);
}

#[test]
fn blocks_cover_every_pixel_once() {
    for (size, side) in [((1, 1), 8), ((7, 3), 8), ((100, 37), 8), ((129, 64), 16), ((16384, 1), 1024)] {
        let size = UVec2::from(size);
        let grid = Grid::new(size, side);
        let picture = vec![[0.0f32; 3]; (size.x * size.y) as usize];
        let blocks = Blocks::of(&picture, &picture, grid);
        assert_eq!(blocks.list.iter().map(|block| block.pixels).sum::<u32>(), size.x * size.y);
        for y in 0..size.y {
            for x in 0..size.x {
                let at = UVec2::new(x, y);
                let block = blocks.block_of(at);
                assert!(block.min.cmple(at).all() && at.cmplt(block.max).all(), "{at} is not in {block:?}");
            }
        }
    }
}

/// Tests, degrees of freedom, and quantiles of Student's distribution at 1 - 5e-5 / tests, computed by numerical integration of its density.
const QUANTILES: [(usize, u32, f64); 5] =
    [(6, 31, 5.0885), (771, 63, 5.9488), (771, 31, 6.7978), (93, 255, 4.9984), (100000, 1023, 6.1671)];

#[test]
fn the_limit_is_students() {
    for (tests, freedom, quantile) in QUANTILES {
        let found = limit(tests, freedom);
        assert!((found / quantile - 1.0).abs() < 5e-3, "{tests} tests, {freedom}: {found} is not {quantile}");
    }
}

/// 100 pairs, even and rare noise: a false alarm has a probability of 1e-4 each, so any is a defect with 99 %.
#[test]
fn noise_is_not_taken_for_a_difference() {
    for seed in 0..100 {
        let (one, other) = (2 * seed, 2 * seed + 1);
        assert!(!differ(&noisy(one, 0.3, false, 1.0), &noisy(other, 0.3, false, 1.0)), "seed {seed}");
        assert!(!differ(&noisy(one, 0.3, true, 1.0), &noisy(other, 0.3, true, 1.0)), "seed {seed}, rare");
    }
    let picture = noisy(1, 0.3, false, 1.0);
    let same = blocks(&picture, &picture);
    assert_eq!((same.largest_z(), same.beyond()), (Some(0.0), 0));
    assert!(same.list.iter().all(|block| block.relative == 0.0));
}

/// The same picture where the 16 pixels of a tile, every second one of an 8 by 8 block, share most of their noise.
fn tiled(seed: u32, spread: f64, factor: f64) -> Vec<[f32; 3]> {
    let own = noisy(seed, 0.3 * spread, false, factor);
    let tile = |x: u32, y: u32| (y / 8 * 2 + y % 2) * 1000 + x / 8 * 2 + x % 2;
    let shared = |pixel: u32| uniform(seed ^ 0x5555, tile(pixel % SIZE.x, pixel / SIZE.x))[1];
    let noise = |pixel: u32| (1.0 + spread * 3f64.sqrt() * (2.0 * shared(pixel) - 1.0)) as f32;
    own.into_iter().enumerate().map(|(pixel, rgb)| rgb.map(|channel| channel * noise(pixel as u32))).collect()
}

#[test]
fn noise_that_neighbours_share_is_not_taken_for_a_difference() {
    for seed in 0..50 {
        let (one, other) = (tiled(2 * seed, 0.2, 1.0), tiled(2 * seed + 1, 0.2, 1.0));
        assert!(!differ(&one, &other), "seed {seed}");
        let alone = blocks(&noisy(2 * seed, 0.2, false, 1.0), &noisy(2 * seed + 1, 0.2, false, 1.0)).common_noise;
        let shared = blocks(&one, &other).common_noise;
        assert!(alone == [1.0; 3] && shared.iter().all(|factor| (4.0..40.0).contains(factor)), "{alone:?}, {shared:?}");
    }
    // And a difference is still found, of 4 % where the whole picture is sure to 0.4 %.
    assert!(differ(&tiled(1, 0.05, 1.04), &tiled(2, 0.05, 1.0)));
}

/// 1 % more light everywhere: by noise of 5 % the whole picture's standard error is 0.08 %, so z is about 12.
#[test]
fn a_bias_of_one_percent_is_found() {
    for seed in 0..100 {
        let (a, b) = (noisy(2 * seed, 0.05, false, 1.01), noisy(2 * seed + 1, 0.05, false, 1.0));
        assert!(differ(&a, &b) && differ(&b, &a), "seed {seed}");
    }
}

#[test]
fn a_difference_in_one_block_is_found_there() {
    let (mut a, b) = (noisy(1, 0.05, false, 1.0), noisy(2, 0.05, false, 1.0));
    for y in 32..48 {
        for x in 64..80 {
            a[y * SIZE.x as usize + x] = a[y * SIZE.x as usize + x].map(|channel| channel * 0.9);
        }
    }
    let blocks = blocks(&a, &b);
    let (worst, relative) = (blocks.worst().unwrap(), blocks.most_different().unwrap());
    assert_eq!((worst.min, worst.max), (UVec2::new(64, 32), UVec2::new(80, 48)));
    assert_eq!((relative.min, blocks.beyond()), (worst.min, 1));
    assert!((relative.relative + 0.1).abs() < 0.02 && worst.worst().unwrap().0 < -10.0, "{worst:?}");
}

#[test]
fn few_pixels_have_no_z_and_constant_differences_a_finite_one() {
    let few = vec![[1.0f32; 3]; LEAST_PIXELS as usize - 1];
    let blocks = Blocks::of(&few, &few, Grid::new(UVec2::new(LEAST_PIXELS - 1, 1), 8));
    assert_eq!((blocks.largest_z(), blocks.limit), (None, None));
    let (one, more) = (vec![[1.0f32; 3]; 64], vec![[1.001f32; 3]; 64]);
    let of = |a: &[[f32; 3]]| Blocks::of(a, &one, Grid::new(UVec2::splat(8), 8)).largest_z().unwrap();
    assert!(of(&more) > 1e3 && of(&more).is_finite());
    assert_eq!(of(&vec![[1.000_005f32; 3]; 64]), 0.0, "that is rounding");
}
