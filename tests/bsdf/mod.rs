//! Random numbers, elementary functions, sampling and BSDFs on the GPU, against f64.

mod cells;
mod coat;
mod draws;
mod elementary;
mod furnace;
mod pack;
mod pane;
mod specular;
mod tilted;

use glam::{DVec3, Vec3, Vec4};
use lucerna::components::{Energy, Lobe, Material};
use lucerna::cpu::bsdf::{ShadingFrame, Specular};
use lucerna::gpu::Runtime;
use lucerna::gpu_struct;
use lucerna::layout::GpuConst;
use lucerna::layout::trace::MaterialRecord;
use lucerna::passes::trace::Needs;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::prepare::material;
use lucerna::shader::Library;

use crate::support;

gpu_struct! {
    /// What the probes below are asked.
    pub struct BsdfProbe {
        pub material: MaterialRecord,
        pub wo: Vec3,
        pub seed: u32,
        pub normal: Vec3,
        pub count: u32,
        /// What chooses the lobe in `albedo`.
        pub pick: f32,
        pub back_face: u32,
        pub pad1: u32,
        pub pad2: u32,
        /// The surface's own normal; `normal` is the shading normal.
        pub geometric: Vec3,
        pub pad3: u32,
    }
}

const NO_CONSTS: &[GpuConst] = &[];

const PROBE: &str = "
import package::gen::{BsdfProbe, SampleKey};
import package::lib::bsdf::frame::{BsdfSample, ShadingFrame};
import package::lib::bsdf::mixture::{mixture_evaluate, mixture_sample};
@if(dielectric) import package::lib::bsdf::dielectric::{fresnel, interface_of};
import package::lib::math::{expm1_negative, log1p_negative, sin_cos_turns};
import package::lib::rng::{sample_1d, sample_2d};

@group(0) @binding(0) var<storage, read> params: BsdfProbe;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

fn frame() -> ShadingFrame {
    return ShadingFrame(params.wo, params.normal, params.geometric, params.back_face);
}

@compute @workgroup_size(64)
fn draw(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    let key = SampleKey(i, 0u, 0u, params.seed);
    let drawn = mixture_sample(params.material, frame(), sample_1d(key, 0u), sample_2d(key, 1u));
    let at = mixture_evaluate(params.material, frame(), drawn.direction);
    probed[3u * i] = vec4<f32>(drawn.direction, drawn.pdf);
    probed[3u * i + 1u] = vec4<f32>(drawn.weight, at.pdf);
    probed[3u * i + 2u] = vec4<f32>(at.value, 0.0);
}

// Mean weight of one lobe's draws over a row of the unit square. Finer towards u.x = 1, where all lobes have their tails: by
// 1 - s^2, which weighs 2 s.
@compute @workgroup_size(64)
fn albedo(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    var sum = vec3<f32>(0.0);
    for (var j = 0u; j < params.count; j++) {
        let at = (vec2<f32>(vec2<u32>(i, j)) + 0.5) / f32(params.count);
        let u = vec2<f32>(1.0 - at.y * at.y, at.x);
        sum += 2.0 * at.y * mixture_sample(params.material, frame(), params.pick, u).weight;
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

// Cosines in, reflectances and cosines beyond out.
@compute @workgroup_size(64)
fn split(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = group.x * 64u + local;
    if (i >= params.count) { return; }
    @if(dielectric) {
        let at = fresnel(interface_of(params.material.ni, params.back_face != 0u), probed[i].x);
        probed[i] = vec4<f32>(at.reflectance, at.cos_transmitted, 0.0, 0.0);
    }
}
";

macro_rules! probe {
    ($name:ident, $entry:literal) => {
        static $name: Pass = Pass {
            name: $entry,
            module: "tests/bsdf",
            entry: $entry,
            features: &[],
            bindings: &[Binding::params("BsdfProbe"), Binding::write("probed", "array<vec4<f32>>")],
            makes: &[],
            twin: lucerna::passes::Twin::None("of a test"),
        };
    };
}
probe!(DRAW, "draw");
probe!(ALBEDO, "albedo");
probe!(ELEMENTARY, "elementary");
probe!(SPLIT, "split");

fn library() -> Library {
    Library::shipped().with_layouts(&[&BsdfProbe::LAYOUT], NO_CONSTS).with("tests/bsdf", PROBE)
}

fn rig() -> Runtime {
    Runtime::new(support::gpu(), library())
}

/// Runs a probe, compiled for its material alone.
fn run(rig: &mut Runtime, pass: &'static Pass, params: &BsdfProbe, words: usize) -> Vec<Vec4> {
    let normals = params.normal != params.geometric;
    rig.set_features(&Needs { materials: &[params.material], normals, ..Needs::default() }.features());
    rig.reserve("probed", (words * 16) as u64).unwrap();
    let mut recording = Recording::default();
    recording.run(pass, Size::Items(u64::from(params.count))).params(params);
    rig.play(&recording).unwrap();
    rig.read_some("probed", words).unwrap()
}

/// A draw of the kernel, and what it says of that direction.
struct Draw {
    direction: DVec3,
    pdf: f64,
    weight: DVec3,
    /// Of the whole mixture in that direction.
    evaluated: f64,
}

fn draws(rig: &mut Runtime, probe: &BsdfProbe) -> Vec<Draw> {
    let rows = run(rig, &DRAW, probe, 3 * probe.count as usize);
    let draw = |row: &[Vec4]| Draw {
        direction: row[0].truncate().as_dvec3().normalize(),
        pdf: f64::from(row[0].w),
        weight: row[1].truncate().as_dvec3(),
        evaluated: f64::from(row[1].w),
    };
    rows.chunks_exact(3).map(draw).collect()
}

/// A surface seen at an angle from a normal that is along no axis.
fn look(values: &Material, degrees: f64) -> BsdfProbe {
    let exponent = if let Lobe::Phong(exponent) = values.lobe { exponent } else { 0.0 };
    let normal = DVec3::new(0.36, -0.48, 0.8).normalize();
    let side = DVec3::new(0.8, 0.6, 0.0);
    let wo = normal * degrees.to_radians().cos() + side * degrees.to_radians().sin();
    BsdfProbe {
        material: material::pack(values, Energy::Preserve),
        wo: wo.normalize().as_vec3(),
        normal: normal.as_vec3(),
        geometric: normal.as_vec3(),
        count: 1 << 20,
        seed: (exponent as u32).wrapping_mul(31) ^ degrees as u32,
        ..BsdfProbe::default()
    }
}

/// A material of a diffuse and a specular lobe.
fn probe(kd: f32, ks: f32, lobe: Specular, degrees: f64) -> BsdfProbe {
    let mut values = Material { diffuse: Vec3::splat(kd), specular: Vec3::new(ks, 0.5 * ks, ks), ..Material::BLACK };
    values.lobe = match lobe {
        Specular::Phong(ns) => Lobe::Phong(ns as f32),
        Specular::Ggx(alpha) => Lobe::Ggx(alpha.sqrt() as f32),
        Specular::Mirror => Lobe::Mirror,
    };
    look(&values, degrees)
}

/// The same on a facet whose own normal leans off the shading normal by `lean` degrees, `turn` turns from the viewer's side.
fn leaning(probe: BsdfProbe, lean: f64, turn: f64) -> BsdfProbe {
    let ShadingFrame { wo, shading: n, .. } = frame(&probe);
    let side = wo.reject_from_normalized(n).normalize();
    let away = side.rotate_axis(n, turn * std::f64::consts::TAU);
    let geometric = n * lean.to_radians().cos() + away * lean.to_radians().sin();
    assert!(geometric.dot(wo) > 0.0, "the facet is not seen");
    BsdfProbe { geometric: geometric.as_vec3(), ..probe }
}

/// A probe's view in f64, of unit vectors.
fn frame(probe: &BsdfProbe) -> ShadingFrame {
    let [wo, shading, geometric] = [probe.wo, probe.normal, probe.geometric].map(|v| v.as_dvec3().normalize());
    ShadingFrame { wo, shading, geometric, back_face: probe.back_face != 0 }
}
