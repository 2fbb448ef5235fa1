//! Random numbers, elementary functions, sampling and BSDFs on the GPU, against f64.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec3, Vec4};
use lucerna::cpu::bsdf::{Reflection, mirror};
use lucerna::cpu::rng::{sample_1d, sample_2d, sample_key};
use lucerna::gpu::Runtime;
use lucerna::gpu_struct;
use lucerna::layout::GpuConst;
use lucerna::layout::trace::{EnergyRule, MaterialRecord, Reflector};
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::shader::Library;

use crate::statistics::{CHI_SQUARE_LIMIT, chi_square_z};
use crate::support;

gpu_struct! {
    /// What the probes below are asked.
    pub struct BsdfProbe {
        pub material: MaterialRecord,
        pub wo: Vec3,
        pub seed: u32,
        pub normal: Vec3,
        pub count: u32,
        /// The lobe of `albedo`: below `material.glossy` or not.
        pub pick: f32,
        pub pad0: u32,
        pub pad1: u32,
        pub pad2: u32,
    }
}

const NO_CONSTS: &[GpuConst] = &[];

const PROBE: &str = "
import package::gen::{BsdfProbe, SampleKey};
import package::lib::bsdf::mixture::{Facing, mixture_evaluate, mixture_sample};
import package::lib::math::{expm1_negative, log1p_negative, sin_cos_turns};
import package::lib::rng::{sample_1d, sample_2d};

@group(0) @binding(0) var<storage, read> params: BsdfProbe;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

@compute @workgroup_size(64)
fn draw(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let key = SampleKey(i, 0u, 0u, params.seed);
    let facing = Facing(params.wo, params.normal, params.normal, 0u);
    let drawn = mixture_sample(params.material, facing, sample_1d(key, 0u), sample_2d(key, 1u));
    let at = mixture_evaluate(params.material, facing, drawn.direction);
    probed[2u * i] = vec4<f32>(drawn.direction, drawn.weight.x);
    probed[2u * i + 1u] = vec4<f32>(at.value.xy, at.pdf, drawn.weight.y);
}

// Mean weight of one lobe's draws over a row of the unit square.
@compute @workgroup_size(64)
fn albedo(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let facing = Facing(params.wo, params.normal, params.normal, 0u);
    var sum = vec3<f32>(0.0);
    for (var j = 0u; j < params.count; j++) {
        let u = (vec2<f32>(vec2<u32>(i, j)) + 0.5) / f32(params.count);
        sum += mixture_sample(params.material, facing, params.pick, u).weight;
    }
    probed[i] = vec4<f32>(sum / f32(params.count), 0.0);
}

@compute @workgroup_size(64)
fn elementary(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let x = probed[i].x;
    probed[i] = vec4<f32>(log1p_negative(-x), expm1_negative(-x * 20.0), sin_cos_turns(x));
}
";

macro_rules! probe {
    ($name:ident, $entry:literal) => {
        static $name: Pass = Pass {
            name: $entry,
            module: "tests/bsdf",
            entry: $entry,
            bindings: &[Binding::params("BsdfProbe"), Binding::write("probed", "array<vec4<f32>>")],
        };
    };
}
probe!(DRAW, "draw");
probe!(ALBEDO, "albedo");
probe!(ELEMENTARY, "elementary");

fn rig() -> Runtime {
    let library = Library::shipped().with_layouts(&[&BsdfProbe::LAYOUT], NO_CONSTS).with("tests/bsdf", PROBE);
    let mut rig = Runtime::new(support::gpu(), library);
    rig.set_features(&["glossy"]);
    rig
}

fn run(rig: &mut Runtime, pass: &'static Pass, params: &BsdfProbe, words: usize) -> Vec<Vec4> {
    rig.reserve("probed", (words * 16) as u64).unwrap();
    let mut recording = Recording::default();
    recording.run(pass, Size::Items(u64::from(params.count))).params(params);
    rig.play(&recording).unwrap();
    rig.read_some("probed", words).unwrap()
}

/// A material of grey lobes, seen at an angle from a normal that is along no axis.
fn probe(kd: f32, ks: f32, ns: f32, degrees: f64) -> BsdfProbe {
    let values = Reflector { kd: Vec3::splat(kd), ks: Vec3::new(ks, 0.5 * ks, ks), ns, ..Reflector::default() };
    let normal = DVec3::new(0.36, -0.48, 0.8).normalize();
    let side = DVec3::new(0.8, 0.6, 0.0);
    let wo = normal * degrees.to_radians().cos() + side * degrees.to_radians().sin();
    BsdfProbe {
        material: MaterialRecord::pack(&values, EnergyRule::Preserve),
        wo: wo.normalize().as_vec3(),
        normal: normal.as_vec3(),
        count: 1 << 20,
        seed: (ns as u32).wrapping_mul(31) ^ degrees as u32,
        ..BsdfProbe::default()
    }
}

/// Both directions of a probe in f64, unit length.
fn directions(probe: &BsdfProbe) -> (DVec3, DVec3) {
    (probe.normal.as_dvec3().normalize(), probe.wo.as_dvec3().normalize())
}

#[test]
fn elementary_functions_keep_their_digits() {
    let mut rig = rig();
    // Numbers of all magnitudes below 1, and the ones next to 1.
    let mut inputs: Vec<f32> = (1..40_000).map(|i| 2f32.powf(-24.0 * (i as f32) / 40_000.0)).collect();
    inputs.extend((1..1000).map(|i| 1.0 - i as f32 / (1 << 24) as f32));
    let rows: Vec<Vec4> = inputs.iter().map(|&x| Vec4::splat(x)).collect();
    rig.upload("probed", &rows).unwrap();
    let params = BsdfProbe { count: rows.len() as u32, ..BsdfProbe::default() };
    let got = run(&mut rig, &ELEMENTARY, &params, rows.len());
    for (&x, got) in inputs.iter().zip(got) {
        let x = f64::from(x);
        let relative = |got: f32, right: f64| (f64::from(got) / right - 1.0).abs();
        // 4 ulp; of the exponential, WGSL allows 3 + 2 |x| ulp, on a result near -1.
        assert!(relative(got.x, (-x).ln_1p()) < 4.0 * f64::from(f32::EPSILON), "log1p(-{x}) = {}", got.x);
        assert!(relative(got.y, (-x * 20.0).exp_m1()) < 8e-7, "expm1(-20 * {x}) = {}", got.y);
        let (sin, cos) = (x * TAU).sin_cos();
        assert!((f64::from(got.z) - sin).abs() < 2e-7 && (f64::from(got.w) - cos).abs() < 2e-7, "turn {x}: {got}");
    }
}

#[test]
fn draws_equal_the_f64_twin() {
    let mut rig = rig();
    for (kd, ks, ns, degrees) in
        [(0.7, 0.0, 0.0, 20.0), (0.4, 0.5, 33.0, 50.0), (0.0, 1.0, 1000.0, 75.0), (0.2, 0.6, 1e5, 30.0)]
    {
        let probe = BsdfProbe { count: 1 << 14, ..probe(kd, ks, ns, degrees) };
        let (n, wo) = directions(&probe);
        let reflection = Reflection::from(&probe.material);
        let got = run(&mut rig, &DRAW, &probe, 2 << 14);
        let mut worst = [0.0f64; 3];
        for (i, got) in got.chunks_exact(2).enumerate() {
            let key = sample_key(i as u32, 0, probe.seed);
            let wi = reflection.sample(n, wo, sample_1d(key, 0), sample_2d(key, 1));
            let at = reflection.evaluate(n, wo, got[0].truncate().as_dvec3().normalize());
            worst[0] = worst[0].max(wi.distance(got[0].truncate().as_dvec3()));
            if n.dot(wi) < 1e-5 {
                continue;
            }
            worst[1] = worst[1].max((f64::from(got[1].z) / at.pdf - 1.0).abs());
            worst[2] = worst[2].max((f64::from(got[0].w) / (at.value.x / at.pdf) - 1.0).abs());
        }
        // A direction's coordinates err by 2^-22. With the exponent that is a relative error of 2 n sqrt(17 / n) 2^-23 in
        // the lobe, 17 being -log of its tail's end; the weight, a ratio, is far less moved.
        let lobe = 2.0 * f64::from(ns).max(1.0).sqrt() * 17f64.sqrt() * 2f64.powi(-22);
        assert!(worst[0] < 1e-6, "Ns {ns}: a direction is off by {}", worst[0]);
        assert!(worst[1] < 1e-5 + lobe, "Ns {ns}: a pdf is off by {}", worst[1]);
        assert!(worst[2] < 2e-5 + lobe, "Ns {ns}: a weight is off by {}", worst[2]);
    }
}

/// Cells about an axis: rows of the angle from it with bounds `rows`, of equal turns.
struct Cells {
    axis: DVec3,
    rows: Vec<f64>,
    turns: usize,
}

impl Cells {
    fn frame(&self) -> (DVec3, DVec3) {
        self.axis.any_orthonormal_pair()
    }

    fn count(&self, draws: impl Iterator<Item = DVec3>) -> Vec<u64> {
        let (t, b) = self.frame();
        let mut counts = vec![0; (self.rows.len() - 1) * self.turns];
        for d in draws {
            let angle = 2.0 * (0.5 * d.distance(self.axis)).min(1.0).asin();
            let turn = (d.dot(b).atan2(d.dot(t)) / TAU).rem_euclid(1.0);
            let row = self.rows.partition_point(|&bound| bound <= angle).clamp(1, self.rows.len() - 1) - 1;
            counts[row * self.turns + ((turn * self.turns as f64) as usize).min(self.turns - 1)] += 1;
        }
        counts
    }

    /// The integral of a pdf over each cell, by Gauss's rule of 3 points along both, on parts of each cell.
    fn integrate(&self, pdf: impl Fn(DVec3) -> f64) -> Vec<f64> {
        const PARTS: usize = 6;
        const NODES: [(f64, f64); 3] =
            [(0.112701665379258, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887298334620742, 5.0 / 18.0)];
        let (t, b) = self.frame();
        let mut integrals = Vec::new();
        for row in self.rows.windows(2) {
            for turn in 0..self.turns {
                let mut sum = 0.0;
                for part in 0..PARTS * PARTS {
                    for node in 0..9 {
                        let ((x, wx), (y, wy)) = (NODES[node / 3], NODES[node % 3]);
                        let along = ((part / PARTS) as f64 + x) / PARTS as f64;
                        let across = ((part % PARTS) as f64 + y) / PARTS as f64;
                        let angle = row[0] + (row[1] - row[0]) * along;
                        let phi = TAU * (turn as f64 + across) / self.turns as f64;
                        let d = self.axis * angle.cos() + (t * phi.cos() + b * phi.sin()) * angle.sin();
                        sum += wx * wy * pdf(d) * angle.sin();
                    }
                }
                let area = (row[1] - row[0]) * TAU / self.turns as f64 / (PARTS * PARTS) as f64;
                integrals.push(sum * area);
            }
        }
        integrals
    }
}

/// Cells about the mirror direction that grow with the angle as the lobe of exponent `ns` does, to the far pole.
fn cells(probe: &BsdfProbe) -> Cells {
    let (n, wo) = directions(probe);
    let ns = f64::from(probe.material.ns);
    let rows = 16;
    // Equal parts of a lobe for most rows, then equal ratios of angles; the lobe's own edge is a bound.
    let mut bounds: Vec<f64> =
        (0..rows).map(|i| (1.0 - i as f64 / rows as f64).powf(1.0 / (ns + 1.0)).acos()).collect();
    let last = bounds[rows - 1];
    bounds.extend((1..=rows).map(|i| last * (PI / last).powf(i as f64 / rows as f64)));
    bounds.push(0.5 * PI);
    bounds.sort_by(f64::total_cmp);
    Cells { axis: mirror(n, wo), rows: bounds, turns: 12 }
}

const MIXTURES: [(f32, f32, f32, f64); 8] = [
    (0.7, 0.0, 0.0, 40.0),
    (0.0, 1.0, 0.0, 10.0),
    (0.0, 1.0, 1.0, 60.0),
    (0.0, 1.0, 25.0, 0.0),
    (0.0, 1.0, 1000.0, 80.0),
    (0.0, 1.0, 1e5, 45.0),
    (0.5, 0.4, 20.0, 35.0),
    (0.3, 0.6, 300.0, 70.0),
];

#[test]
fn draws_follow_the_pdf() {
    let mut rig = rig();
    for (kd, ks, ns, degrees) in MIXTURES {
        let probe = probe(kd, ks, ns, degrees);
        let (n, wo) = directions(&probe);
        let reflection = Reflection::from(&probe.material);
        let cells = cells(&probe);
        let got = run(&mut rig, &DRAW, &probe, 2 * probe.count as usize);
        let observed = cells.count(got.chunks_exact(2).map(|g| g[0].truncate().as_dvec3().normalize()));
        let parts = cells.integrate(|d| reflection.evaluate(n, wo, d).pdf);
        // The cells that the horizon or the lobe's own edge cuts are integrated to 1e-3, once over the sphere.
        let total = parts.iter().sum::<f64>();
        assert!((total - 1.0).abs() < 1e-3, "Ns {ns} at {degrees}: the pdf integrates to {total}");
        let expected: Vec<f64> = parts.iter().map(|p| p * f64::from(probe.count)).collect();
        let z = chi_square_z(&observed, &expected);
        assert!(z < CHI_SQUARE_LIMIT, "Ns {ns} at {degrees} degrees: chi-square is {z} deviations out");
        // A pdf that is 2 % too high on one side and too low on the other must not pass.
        let tilted = |i: usize| if i % cells.turns < cells.turns / 2 { 1.02 } else { 0.98 };
        let wrong: Vec<f64> = expected.iter().enumerate().map(|(i, e)| e * tilted(i)).collect();
        assert!(chi_square_z(&observed, &wrong) > 2.0 * CHI_SQUARE_LIMIT, "Ns {ns}: a pdf wrong by 2 % passes");
    }
}

/// Albedo of the Phong lobe for ks = 1 by quadrature over the angle from the mirror direction; around it, the cosine above
/// the horizon integrates in closed form.
fn phong_albedo(ns: f64, cos_view: f64) -> f64 {
    let sin_view = (1.0 - cos_view * cos_view).sqrt();
    const STEPS: usize = 200_000;
    // Steps in s with alpha = pi / 2 * s^4: fine where the lobe of a large exponent is.
    let term = |i: usize| {
        let s = (i as f64 + 0.5) / STEPS as f64;
        let alpha = 0.5 * PI * s.powi(4);
        let (a, b) = (alpha.cos() * cos_view, alpha.sin() * sin_view);
        let ring = match a {
            _ if a >= b => TAU * a,
            _ => {
                let edge = (-a / b).acos();
                2.0 * (a * edge + b * edge.sin())
            }
        };
        alpha.cos().powf(ns) * ring * alpha.sin() * 2.0 * PI * s.powi(3)
    };
    (0..STEPS).map(term).sum::<f64>() / STEPS as f64 * (ns + 2.0) / TAU
}

#[test]
fn white_furnace_albedo_is_the_integral() {
    let mut rig = rig();
    let mut mean = |probe: &BsdfProbe| {
        let rows = run(&mut rig, &ALBEDO, probe, probe.count as usize);
        rows.iter().map(|v| v.truncate().as_dvec3()).sum::<DVec3>() / f64::from(probe.count)
    };
    for ns in [0.0, 1.0, 7.0, 100.0, 3e3, 1e5] {
        for degrees in [0.0, 30.0, 60.0, 80.0, 89.0] {
            let both = BsdfProbe { count: 640, ..probe(0.5, 0.5, ns, degrees) };
            let p = f64::from(both.material.glossy);
            let lobe = mean(&BsdfProbe { pick: 0.0, ..both });
            let cosine = mean(&BsdfProbe { pick: 0.999_999, ..both });
            let got = p * lobe + (1.0 - p) * cosine;
            let (n, wo) = directions(&both);
            let right =
                both.material.kd.as_dvec3() + both.material.ks.as_dvec3() * phong_albedo(f64::from(ns), n.dot(wo));
            assert!((got - right).abs().max_element() < 1e-4, "Ns {ns}, {degrees} degrees: {got}, not {right}");
        }
    }
}

#[test]
fn equal_keys_draw_equal_numbers_and_others_do_not() {
    let key = sample_key(77, 5, 9);
    assert_eq!((key.index, key.half), (2, 1));
    assert_eq!(sample_2d(key, 4), sample_2d(key, 4));
    let others = [sample_key(78, 5, 9), sample_key(77, 4, 9), sample_key(77, 7, 9), sample_key(77, 5, 8)];
    assert!(others.iter().all(|&other| sample_2d(other, 4) != sample_2d(key, 4)));
    assert_ne!(sample_2d(key, 5), sample_2d(key, 4));
    // Neighbouring pixels: the correlation of 2^20 pairs has a deviation of 2^-10; five of them.
    let draw = |pixel: u32| sample_2d(sample_key(pixel, 0, 3), 0) - DVec2::splat(0.5);
    let sum: DVec2 = (0..1 << 20).map(|pixel| draw(pixel) * draw(pixel + 1)).sum();
    let correlation = sum / f64::from(1 << 20) * 12.0;
    assert!(correlation.abs().max_element() < 5.0 / 1024.0, "{correlation}");
}
