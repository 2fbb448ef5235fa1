//! Bounds and Morton codes against their CPU twins, which give the same bits; and the scenes that the tree is tested on.

use glam::{UVec3, Vec3};
use lucerna::cpu::bounds::Bounds;
use lucerna::cpu::morton::{self, SceneBounds};
use lucerna::gpu::Runtime;
use lucerna::layout::tree::{BOUNDS_WORDS, Triangle};
use lucerna::passes::Recording;
use lucerna::passes::tree::lbvh;
use lucerna::scene::generate::SplitMix;

use crate::support;

pub use lucerna::stress::scenes::clouds::{cloud, clustered, point, scenes, triangle};

/// Numbers of triangles around every tile: none, the workgroup of 256, the pyramid's 512, the bounds pass's 2,048, the
/// sort's 4,096, and the pyramid's second dispatch at 131,072.
pub const SIZES: [u32; 24] = [
    0, 1, 2, 3, 4, 5, 7, 8, 9, 255, 256, 257, 511, 512, 513, 1025, 2047, 2048, 2049, 4095, 4096, 4097, 131_071, 131_073,
];

/// A runtime with buffers for that many triangles.
pub fn rig_for(n: u32) -> Runtime {
    let mut rig = support::rig();
    for (name, bytes) in lbvh::buffers(n) {
        rig.reserve(name, bytes).unwrap();
    }
    rig
}

fn check(rig: &mut Runtime, what: &str, triangles: &[Triangle]) {
    let n = triangles.len() as u32;
    rig.upload("triangles", triangles).unwrap();
    let mut recording = Recording::default();
    lbvh::record_codes(&mut recording, n, morton::core_of(triangles));
    rig.play(&recording).unwrap();

    if n > 0 {
        let words: Vec<u32> = rig.read_some("centroid_bounds", BOUNDS_WORDS as usize).unwrap();
        let found = SceneBounds::from_words(words.as_slice().try_into().unwrap());
        assert_eq!(found, morton::bounds(triangles), "bounds of {n} triangles, {what}");
    }
    let keys: Vec<u64> = rig.read_some("keys", n as usize).unwrap();
    let expected = morton::codes(triangles, morton::bounds(triangles).centroids, morton::core_of(triangles));
    let wrong = keys.iter().zip(&expected).position(|(a, b)| a != b);
    assert_eq!(wrong, None, "first triangle with another code, of {n}, {what}");
    let payload: Vec<u32> = rig.read_some("payload", n as usize).unwrap();
    assert!(payload.iter().copied().eq(0..n), "payload of {n} triangles, {what}");
}

#[test]
fn bounds_and_codes_equal_the_cpu() {
    let mut rig = rig_for(131_073);
    for n in SIZES {
        check(&mut rig, "random", &cloud(n, 0.02, |_, random| point(random) * 3.0 - 1.0));
    }
    for n in [2, 700, 2500] {
        for (what, triangles) in scenes(n) {
            check(&mut rig, what, &triangles);
        }
    }
}

#[test]
fn bounds_and_codes_of_a_million_equal_the_cpu() {
    let n = (1 << 20) + 1;
    check(&mut rig_for(n), "random", &cloud(n, 0.001, |_, random| point(random)));
}

/// The code by its definition, from a cell.
fn interleaved(cell: UVec3) -> u64 {
    (0..21).map(|bit| (0..3).map(|axis| u64::from(cell[axis] >> bit & 1) << (3 * bit + 2 - axis)).sum::<u64>()).sum()
}

#[test]
fn codes_are_those_of_the_cells() {
    // An extent just above a power of two: 2^21 cells of 2^-20 metres would be too many, and the scale is rounded down.
    let far = Vec3::splat(2.0 - 1.0 / 1048576.0);
    let mut random = SplitMix(7);
    let mut points = vec![Vec3::ZERO, far];
    points.extend((0..1000).map(|_| point(&mut random) * far));
    let triangles: Vec<Triangle> = points.iter().zip(0..).map(|(&p, i)| triangle(i, p, p, p)).collect();
    let centroids = morton::bounds(&triangles).centroids;
    assert_eq!(centroids, Bounds { low: Vec3::ZERO, high: far });
    let scale = morton::cells_per_metre(far.x);
    for (point, code) in points.iter().zip(morton::codes(&triangles, centroids, 1e30)) {
        assert_eq!(code, interleaved((point * scale).as_uvec3()), "{point}");
    }
}

#[test]
fn the_scale_is_just_below_the_quotient() {
    let mut random = SplitMix(3);
    for _ in 0..100_000 {
        let extent = (1.0 + random.unit() as f32) * 2f32.powi((random.next_u64() % 220) as i32 - 100);
        let exact = f64::from(1 << 21) / f64::from(extent);
        let ratio = f64::from(morton::cells_per_metre(extent)) / exact;
        // One unit lost of the 2^15 to 2^16 of the significand's upper half, one of the 2^16 to 2^17 of the quotient.
        assert!((1.0 - 2f64.powi(-14)..=1.0).contains(&ratio), "{extent}: {ratio}");
    }
    for extent in [0.0, 1e-38, 2f32.powi(-104), f32::INFINITY] {
        assert_eq!(morton::cells_per_metre(extent), 0.0);
    }
}

#[test]
fn ordered_bits_keep_the_order_and_come_back() {
    let numbers = [f32::MIN, -1e30, -1.5, -1.0, -1e-30, -0.0, 0.0, 1e-30, 1.0, 1.5, 1e30, f32::MAX];
    for pair in numbers.windows(2) {
        assert!(morton::ordered_bits(pair[0]) < morton::ordered_bits(pair[1]), "{pair:?}");
    }
    for x in numbers {
        assert_eq!(morton::from_ordered_bits(morton::ordered_bits(x)).to_bits(), x.to_bits());
        assert!(morton::ordered_bits(x) > 0 && !morton::ordered_bits(x) > 0, "a cleared word is below all: {x}");
    }
}
