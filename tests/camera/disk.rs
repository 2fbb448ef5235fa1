//! Points of the lens: equal to the twin's, and spread evenly.

use std::f64::consts::TAU;

use glam::{DVec2, Vec4};
use lucerna::cpu::camera::concentric_disk;
use lucerna::cpu::rng::{Source, sample_key};
use lucerna::gpu::Runtime;
use lucerna::gpu_struct;
use lucerna::layout::GpuConst;
use lucerna::layout::trace::LENS_DIMENSIONS;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::shader::Library;

use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;

gpu_struct! {
    /// What the probe is asked.
    pub struct DiskProbe {
        pub count: u32,
        pub seed: u32,
        pub pad0: u32,
        pub pad1: u32,
    }
}

const NO_CONSTS: &[GpuConst] = &[];

const PROBE: &str = "
import package::gen::{DiskProbe, SampleKey, LENS_DIMENSIONS};
import package::lib::rng::{sample_2d};
import package::lib::sampling::{concentric_disk};

@group(0) @binding(0) var<storage, read> params: DiskProbe;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

@compute @workgroup_size(64)
fn disk(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
        @builtin(local_invocation_index) local: u32) {
    let i = (group.x + group.y * groups.x) * 64u + local;
    if (i >= params.count) { return; }
    let u = sample_2d(SampleKey(i & 255u, i >> 9u, (i >> 8u) & 1u, params.seed), LENS_DIMENSIONS);
    // Corners, edges and the middle of the square too.
    let corner = vec2<f32>(vec2<u32>(i % 3u, i / 3u)) * vec2<f32>(0.5);
    probed[i] = vec4<f32>(concentric_disk(u), concentric_disk(select(u, corner, i < 9u)));
}
";

static DISK: Pass = Pass {
    name: "disk",
    module: "tests/disk",
    entry: "disk",
    features: &[],
    bindings: &[Binding::params("DiskProbe"), Binding::write("probed", "array<vec4<f32>>")],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

const COUNT: u32 = 1 << 20;

fn draws(source: Source) -> Vec<Vec4> {
    let library = Library::shipped().with_layouts(&[&DiskProbe::LAYOUT], NO_CONSTS).with("tests/disk", PROBE);
    let mut rig = Runtime::new(support::gpu(), library);
    rig.set_features(if source == Source::Sobol { &["sobol"] } else { &[] });
    rig.reserve("probed", u64::from(COUNT) * 16).unwrap();
    let mut recording = Recording::default();
    let params = DiskProbe { count: COUNT, seed: 3, pad0: 0, pad1: 0 };
    recording.run(&DISK, Size::Items(u64::from(COUNT))).params(&params);
    rig.play(&recording).unwrap();
    rig.read_some("probed", COUNT as usize).unwrap()
}

/// Which of 8 rings of one area, and of 16 sectors, a point is in.
fn cell(p: DVec2) -> usize {
    let ring = (8.0 * p.length_squared()).min(7.0) as usize;
    let sector = ((p.to_angle() / TAU).rem_euclid(1.0) * 16.0).min(15.0) as usize;
    16 * ring + sector
}

#[test]
fn points_of_the_lens_equal_the_twins() {
    for source in [Source::Pcg, Source::Sobol] {
        for (i, got) in draws(source).into_iter().enumerate() {
            let i = i as u32;
            let key = sample_key(i & 255, i >> 8, 3);
            let right = concentric_disk(source.sample_2d(key, LENS_DIMENSIONS));
            let got_disk = DVec2::new(got.x.into(), got.y.into());
            assert!(got_disk.distance(right) < 1e-6, "{source:?}, {i}: {got_disk}, the twin {right}");
            if i < 9 {
                let right = concentric_disk(DVec2::new(f64::from(i % 3), f64::from(i / 3)) * 0.5);
                let corner = DVec2::new(got.z.into(), got.w.into());
                assert!(corner.distance(right) < 1e-6 && corner.length() < 1.0 + 1e-6, "corner {i}: {corner}, {right}");
            }
        }
    }
}

#[test]
fn points_of_the_lens_are_spread_evenly() {
    let mut observed = vec![0u64; 128];
    draws(Source::Pcg).iter().for_each(|p| observed[cell(DVec2::new(p.x.into(), p.y.into()))] += 1);
    let even = vec![f64::from(COUNT) / 128.0; 128];
    let z = chi_square_z(&observed, &even);
    assert!(z < CHI_SQUARE_LIMIT, "chi-square is {z} deviations out");
    // A lens that is 2 % brighter on one side must not pass.
    let tilted: Vec<f64> = even.iter().enumerate().map(|(i, e)| e * if i % 16 < 8 { 1.02 } else { 0.98 }).collect();
    assert!(chi_square_z(&observed, &tilted) > 2.0 * CHI_SQUARE_LIMIT, "a lens wrong by 2 % passes");
    // By Sobol's, any 4^4 samples of a pixel's half have one in each of 256 cells of the square: 64 cells of the disk have four each.
    let mut counts = vec![0u32; 64];
    let key = |sample: u32| sample_key(7, sample, 3);
    for sample in (0..512).step_by(2) {
        let u = Source::Sobol.sample_2d(key(sample), LENS_DIMENSIONS);
        counts[(u.x * 8.0) as usize * 8 + (u.y * 8.0) as usize] += 1;
    }
    assert!(counts.iter().all(|count| *count == 4), "{counts:?}");
}
