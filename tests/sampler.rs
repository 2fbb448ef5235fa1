//! The samplers: on the GPU as on the CPU, and there as stratified, independent and unbiased as they claim.

use glam::{DVec2, DVec4, UVec4, Vec4};
use lucerna::cpu::rng::{Source, sample_key};
use lucerna::gpu::Runtime;
use lucerna::gpu_struct;
use lucerna::layout::trace::SampleKey;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::shader::Library;

use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;

const BOTH: [Source; 2] = [Source::Pcg, Source::Sobol];

gpu_struct! {
    /// How many keys the probe below draws for.
    pub struct SamplerProbe {
        pub count: u32,
    }
}

const PROBE: &str = "
import package::gen::{SampleKey, SamplerProbe};
import package::lib::rng::{sample_1d, sample_2d, sample_4d};

@group(0) @binding(0) var<storage, read> params: SamplerProbe;
@group(0) @binding(1) var<storage, read> keys: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> drawn: array<vec4<f32>>;

@compute @workgroup_size(64)
fn draw_keys(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let key = SampleKey(keys[2u * i].x, keys[2u * i].y, keys[2u * i].z, keys[2u * i].w);
    let dimension = keys[2u * i + 1u].x;
    drawn[2u * i] = sample_4d(key, dimension & ~3u);
    drawn[2u * i + 1u] = vec4<f32>(sample_2d(key, dimension & ~1u), sample_1d(key, dimension), 0.0);
}
";

static DRAW_KEYS: Pass = Pass {
    name: "draw_keys",
    module: "tests/sampler",
    entry: "draw_keys",
    features: &[],
    bindings: &[
        Binding::params("SamplerProbe"),
        Binding::read("keys", "array<vec4<u32>>"),
        Binding::write("drawn", "array<vec4<f32>>"),
    ],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// A word of a test's own numbers: Steele, Lea and Flood's SplitMix64 (2014) at a place.
fn word(i: u64) -> u32 {
    let mut x = i.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x >> 32) as u32
}

/// Keys of every size with their dimensions, extremes among them.
fn keys() -> Vec<(SampleKey, u32)> {
    let sized = |i: u64, k: u64| word(5 * i + k) >> (word(7 * i + k) % 32);
    let mut keys: Vec<_> = (0..100_000)
        .map(|i| {
            let key = SampleKey { pixel: sized(i, 0), index: sized(i, 1), half: word(i) & 1, seed: sized(i, 2) };
            (key, sized(i, 3) >> 8)
        })
        .collect();
    for all in [0, u32::MAX] {
        keys.extend((0..16).map(|d| (SampleKey { pixel: all, index: all, half: d & 1, seed: all }, d)));
    }
    keys
}

/// Of each key, what a library's sampler gives the GPU: four dimensions; and two with one.
fn drawn_by(library: Library, features: &[&str], keys: &[(SampleKey, u32)]) -> Vec<[DVec4; 2]> {
    let library = library.with_layouts(&[&SamplerProbe::LAYOUT], &[]).with("tests/sampler", PROBE);
    let mut rig = Runtime::new(support::gpu(), library);
    let rows: Vec<UVec4> =
        keys.iter().flat_map(|(k, d)| [UVec4::new(k.pixel, k.index, k.half, k.seed), UVec4::splat(*d)]).collect();
    rig.upload("keys", &rows).unwrap();
    rig.reserve("drawn", rows.len() as u64 * 16).unwrap();
    rig.set_features(features);
    let mut recording = Recording::default();
    let params = SamplerProbe { count: keys.len() as u32 };
    recording.run(&DRAW_KEYS, Size::Items(keys.len() as u64)).params(&params);
    rig.play(&recording).unwrap();
    let got: Vec<Vec4> = rig.read_some("drawn", rows.len()).unwrap();
    got.chunks_exact(2).map(|pair| [pair[0].as_dvec4(), pair[1].as_dvec4()]).collect()
}

#[test]
fn gpu_draws_what_the_twin_draws() {
    let keys = keys();
    for source in BOTH {
        let features: &[&str] = if source == Source::Sobol { &["sobol"] } else { &[] };
        let got = drawn_by(Library::shipped(), features, &keys);
        for (&(key, d), drawn) in keys.iter().zip(got) {
            let two = source.sample_2d(key, d & !1);
            let right = [source.sample_4d(key, d & !3), DVec4::new(two.x, two.y, source.sample_1d(key, d), 0.0)];
            assert_eq!(drawn, right, "{source:?}, {key:?}, dimension {d}");
            let all = [right[0], right[1]].into_iter().flat_map(|v| v.to_array());
            assert!(all.into_iter().all(|u| (0.0..1.0).contains(&u) && (u * f64::from(1 << 24)).fract() == 0.0));
        }
    }
}

/// Chi-square in 16^2 cells of the points that two dimensions of a group make, squeezed by a power.
fn uniformity_of(points: &[[DVec4; 2]], [a, b]: [usize; 2], power: f64) -> f64 {
    let mut observed = [0u64; 256];
    for [four, _] in points {
        let cell = |d: usize| (four[d].powf(power) * 16.0) as usize;
        observed[cell(a) * 16 + cell(b)] += 1;
    }
    chi_square_z(&observed, &[points.len() as f64 / 256.0; 256])
}

/// The shaders of a shipped family: a lattice in the place of Sobol's points.
#[test]
fn the_lattice_is_uniform_over_pixels_and_spread_within_one() {
    let text = include_str!("../assets/variants/shaders/lattice/lib/rng_sobol.wgsl");
    let lattice =
        |keys: &[(SampleKey, u32)]| drawn_by(Library::shipped().with("lib/rng_sobol", text), &["sobol"], keys);
    for (index, half, dimension) in [(0, 0, 0), (3, 1, 8), (1000, 0, 12)] {
        let keys: Vec<_> = (0..1 << 18).map(|pixel| (SampleKey { pixel, index, half, seed: 1 }, dimension)).collect();
        let points = lattice(&keys);
        for pair in [[0, 1], [2, 3], [0, 3]] {
            let z = uniformity_of(&points, pair, 1.0);
            assert!(z < CHI_SQUARE_LIMIT, "sample {index}, dimension {dimension}, {pair:?}: {z}");
        }
        let skewed = uniformity_of(&points, [0, 1], 1.04);
        assert!(skewed > CHI_SQUARE_LIMIT, "a skew went unnoticed, {skewed}");
        // A pair and a single number are those of the group.
        assert!(points.iter().all(|[four, two]| [four.x, four.y, four.x] == [two.x, two.y, two.z]));
    }
    // Within a pixel its samples are spread: a mean of 256 has less than half the variance of that of independent ones.
    let keys = |pixel| (0..256).map(move |index| (SampleKey { pixel, index, half: 0, seed: 1 }, 4));
    let keys: Vec<_> = (0..64).flat_map(keys).collect();
    let variance = |points: Vec<[f64; 4]>| {
        let means = points.chunks_exact(256).map(|of| of.iter().map(|u| smooth(u, 1.0)).sum::<f64>() / 256.0);
        means.map(|mean| (mean - 1.0) * (mean - 1.0)).sum::<f64>() / 64.0
    };
    let spread = variance(lattice(&keys).into_iter().map(|[four, _]| four.to_array()).collect());
    let independent = variance(keys.iter().map(|(key, d)| Source::Pcg.sample_4d(*key, *d).to_array()).collect());
    assert!(spread < independent / 2.0, "{spread} against {independent}");
}

/// Samples `first..first + count` of half 0, in the four dimensions of a group.
fn group_of(source: Source, pixel: u32, first: u32, count: u32) -> Vec<[f64; 4]> {
    let draw = |i| source.sample_4d(SampleKey { pixel, index: first + i, half: 0, seed: 5 }, 8).to_array();
    (0..count).map(draw).collect()
}

/// Whether each box that is cut in 2^bits[d] along dimension d holds equally many points.
fn is_even(points: &[[f64; 4]], bits: [u32; 4]) -> bool {
    let mut counts = vec![0; 1 << bits.iter().sum::<u32>()];
    for point in points {
        let cell = (0..4).fold(0, |cell, d| (cell << bits[d]) + (point[d] * f64::from(1 << bits[d])) as usize);
        counts[cell] += 1;
    }
    counts.iter().all(|&n| n * counts.len() == points.len())
}

/// Every way to split m bits over the dimensions in steps.
fn splits(m: u32, step: u32) -> Vec<[u32; 4]> {
    let upto = |left: u32| (0..=left).step_by(step as usize);
    upto(m)
        .flat_map(|a| upto(m - a).flat_map(move |b| upto(m - a - b).map(move |c| [a, b, c, m - a - b - c])))
        .collect()
}

/// All 1D and 2D intervals that aligned blocks of 2^m points must fill evenly, and those of 4^n points in 4D.
fn nets_of(m: u32) -> Vec<[u32; 4]> {
    let in_a_pair = |s: &[u32; 4]| (s[0] + s[1] == 0) || (s[2] + s[3] == 0);
    let mut all: Vec<_> = splits(m, 1).into_iter().filter(in_a_pair).collect();
    if m.is_multiple_of(2) {
        all.extend(splits(m, 2));
    }
    // t = 2 across pairs: 2^m points fill boxes of 2^(m - 2).
    let dimensions = |s: &[u32; 4]| s.iter().filter(|&&b| b > 0).count();
    all.extend(splits(m.saturating_sub(2), 1).into_iter().filter(|s| dimensions(s) <= 2));
    all
}

#[test]
fn blocks_of_samples_are_nets() {
    for m in 0..=9 {
        for block in [0, 1, 2, 5] {
            for pixel in [0, 1, 77_777] {
                let points = group_of(Source::Sobol, pixel, block << m, 1 << m);
                for bits in nets_of(m) {
                    assert!(is_even(&points, bits), "block {block} of 2^{m}, pixel {pixel}, cut {bits:?}");
                }
            }
        }
    }
    // The test sees what is no net, and one whose first two dimensions are not each other's.
    assert!(!is_even(&group_of(Source::Pcg, 0, 0, 64), [3, 3, 0, 0]));
    let mut mixed = group_of(Source::Sobol, 0, 0, 64);
    for (point, other) in mixed.iter_mut().zip(group_of(Source::Sobol, 1, 0, 64)) {
        point[1] = other[1];
    }
    assert!(!splits(6, 1).into_iter().filter(|s| s[2] + s[3] == 0).all(|bits| is_even(&mixed, bits)));
}

#[test]
fn single_dimensions_are_stratified_in_every_slot() {
    for dimension in 0..24 {
        let mut seen = [false; 256];
        for index in 256..512 {
            let u = Source::Sobol.sample_1d(SampleKey { pixel: 9, index, half: 1, seed: 0 }, dimension);
            seen[(u * 256.0) as usize] = true;
        }
        assert!(seen.into_iter().all(|s| s), "dimension {dimension}");
    }
}

/// The correlation of two streams of independent uniform numbers in the four dimensions of a group.
fn correlation(count: u32, draw: impl Fn(u32) -> [DVec4; 2]) -> DVec4 {
    let half = DVec4::splat(0.5);
    let sum: DVec4 = (0..count).map(draw).map(|[a, b]| (a - half) * (b - half)).sum();
    sum * 12.0 / f64::from(count)
}

#[test]
fn dimensions_are_independent_and_a_leak_is_seen() {
    // The correlation of n pairs has a deviation of n^-1/2; the numbers below stay within 5 of them.
    let count = 1 << 20;
    let most = 5.0 / f64::from(count).sqrt();
    // One sample a pixel: those of one pixel depend on each other.
    let key = |i: u32| SampleKey { pixel: i, index: (i & 1) * (word(i.into()) & 15), half: 0, seed: 7 };
    for source in BOTH {
        let draw = |key, dimension| source.sample_4d(key, dimension);
        let within = correlation(count, |i| {
            let [x, y, z, w] = draw(key(i), 0).to_array();
            [draw(key(i), 0), DVec4::new(y, z, w, x)]
        });
        assert!(within.abs().max_element() < most, "{source:?}: dimensions correlate by {within}");
        // A hundredth of one stream in the other is seen.
        let leak = correlation(count, |i| {
            let a = draw(key(i), 0);
            [a, 0.99 * draw(key(i), 4) + 0.01 * a]
        });
        assert!(leak.max_element() > most, "{source:?}: a leak of 1 % went unnoticed");
    }
}

/// Chi-square in 16^2 cells of one 2D draw each of many pixels, squeezed by a power.
fn uniformity(source: Source, dimension: u32, power: f64) -> f64 {
    const DRAWS: u32 = 1 << 20;
    let mut observed = [0u64; 256];
    for pixel in 0..DRAWS {
        let key = SampleKey { pixel, index: 3, half: 0, seed: 1 };
        let cell = (source.sample_2d(key, dimension).powf(power) * 16.0).as_uvec2();
        observed[(cell.x * 16 + cell.y) as usize] += 1;
    }
    chi_square_z(&observed, &[f64::from(DRAWS) / 256.0; 256])
}

#[test]
fn each_sample_alone_is_uniform_over_pixels() {
    for source in BOTH {
        for dimension in [0, 2, 8, 10] {
            let z = uniformity(source, dimension, 1.0);
            assert!(z < CHI_SQUARE_LIMIT, "{source:?}, dimension {dimension}: {z}");
        }
        let skewed = uniformity(source, 0, 1.02);
        assert!(skewed > CHI_SQUARE_LIMIT, "{source:?}: a skew of 2 % went unnoticed, {skewed}");
    }
}

/// A smooth function of the mean 1, of numbers that are squeezed by a power.
fn smooth(u: &[f64; 4], skew: f64) -> f64 {
    let [a, b, c, d] = u.map(|u| u.powf(skew));
    // The mean of 4 u v is 1; that of 1.5 sqrt(u) too.
    0.5 * 4.0 * a * c + 0.5 * 1.5 * b.sqrt() * (1.0 + (d - 0.5))
}

/// Of the integral of a smooth function of four dimensions by `count` samples: the variance over pixels and the mean of its
/// error in standard errors. The function has the mean 1.
fn integrate(source: Source, count: u32, skew: f64) -> (f64, f64) {
    const PIXELS: u32 = 256;
    let value = |u: &[f64; 4]| smooth(u, skew);
    let means =
        (0..PIXELS).map(|pixel| group_of(source, pixel, 0, count).iter().map(value).sum::<f64>() / f64::from(count));
    let errors: Vec<f64> = means.map(|mean| mean - 1.0).collect();
    let variance = errors.iter().map(|e| e * e).sum::<f64>() / f64::from(PIXELS);
    let mean = errors.iter().sum::<f64>() / f64::from(PIXELS);
    (variance, mean / (variance / f64::from(PIXELS)).sqrt())
}

#[test]
fn variance_falls_as_it_should() {
    for source in BOTH {
        let counts: Vec<u32> = (4..=12).step_by(2).map(|m| 1 << m).collect();
        let runs: Vec<(f64, f64)> = counts.iter().map(|&n| integrate(source, n, 1.0)).collect();
        for (n, (_, z)) in counts.iter().zip(&runs) {
            // Beyond 5 with a probability of 6e-7, of ten such tests.
            assert!(z.abs() < 5.0, "{source:?}, {n} samples: off by {z} standard errors");
        }
        let slope = (runs[4].0 / runs[0].0).log2() / 8.0;
        // The variance over 256 pixels has a relative deviation of sqrt(2 / 256) = 0.09, so a slope one of 0.09 * sqrt 2 / ln 2 / 8
        // = 0.023.
        match source {
            Source::Pcg => assert!((slope + 1.0).abs() < 5.0 * 0.023, "PCG's variance falls as N^{slope}"),
            Source::Sobol => assert!(slope < -1.3, "Sobol's variance falls as N^{slope}"),
        }
    }
    assert!(integrate(Source::Sobol, 1 << 10, 1.01).1.abs() > 5.0, "a skew of 1 % went unnoticed");
}

/// The variance of the mean of both halves, over a quarter of the mean of (h0 - h1)^2, which estimates it.
fn honesty(of_half_1: u32) -> f64 {
    let half = |pixel: u32, half: u32| -> f64 {
        let draw = |i: u32| Source::Sobol.sample_2d(SampleKey { half, ..sample_key(pixel, 2 * i, 3) }, 2);
        (0..8).map(draw).map(|u: DVec2| 4.0 * u.x * u.y - 1.0).sum::<f64>() / 8.0
    };
    let pixels = 1 << 14;
    let (mut right, mut estimated) = (0.0, 0.0);
    for pixel in 0..pixels {
        let (h0, h1) = (half(pixel, 0), half(pixel, of_half_1));
        right += (0.5 * (h0 + h1)).powi(2);
        estimated += 0.25 * (h0 - h1).powi(2);
    }
    right / estimated
}

#[test]
fn the_error_between_halves_is_the_error() {
    // Each sum over 2^14 pixels has a relative deviation of 0.011.
    let ratio = honesty(1);
    assert!((ratio - 1.0).abs() < 5.0 * 0.011 * 2f64.sqrt(), "{ratio}");
    // Halves that share their scrambles differ by nothing.
    assert!(honesty(0) > 1e3, "shared scrambles went unnoticed");
}
