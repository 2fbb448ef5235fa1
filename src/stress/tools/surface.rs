//! A surface asked by itself on the device: draws, densities, albedo.

use glam::{DVec3, Vec3, Vec4};

use crate::components::{Energy, Lobe, Material};
use crate::cpu::bsdf::{ShadingFrame, Specular};
use crate::gpu::{GpuError, Runtime};
use crate::layout::trace::MaterialRecord;
use crate::passes::trace::Needs;
use crate::passes::{Binding, Pass, Recording, Size, Twin};
use crate::prepare::material;
use crate::shader::Library;

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

/// The shaders with the probes beside them.
pub fn with_probes(library: Library) -> Library {
    library.with_layouts(&[&BsdfProbe::LAYOUT], &[]).with("stress/surface", include_str!("surface.wgsl"))
}

macro_rules! probe {
    ($(#[$meta:meta])* $name:ident, $entry:literal) => {
        $(#[$meta])*
        pub static $name: Pass = Pass {
            name: $entry,
            module: "stress/surface",
            entry: $entry,
            features: &[],
            bindings: &[Binding::params("BsdfProbe"), Binding::write("probed", "array<vec4<f32>>")],
            makes: &[],
            twin: Twin::None("of a stress"),
        };
    };
}
probe!(
    /// Draws, each three words: direction and pdf, weight and the pdf of evaluation, value.
    DRAW,
    "draw"
);
probe!(
    /// Mean weights of one lobe's draws, by rows of the unit square.
    ALBEDO,
    "albedo"
);
probe!(
    /// Elementary functions of words.
    ELEMENTARY,
    "elementary"
);
probe!(
    /// What a smooth dielectric reflects, by cosines.
    SPLIT,
    "split"
);

/// Runs a probe on a device that has them, compiled for its material alone.
pub fn run(rig: &mut Runtime, pass: &'static Pass, params: &BsdfProbe, words: usize) -> Result<Vec<Vec4>, GpuError> {
    let normals = params.normal != params.geometric;
    rig.set_features(&Needs { materials: &[params.material], normals, ..Needs::default() }.features());
    rig.reserve("probed", (words * 16) as u64)?;
    let mut recording = Recording::default();
    recording.run(pass, Size::Items(u64::from(params.count))).params(params);
    rig.play(&recording)?;
    rig.read_some("probed", words)
}

/// A surface seen at an angle from a normal that is along no axis.
pub fn look(values: &Material, degrees: f64) -> BsdfProbe {
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
pub fn probe(kd: f32, ks: f32, lobe: Specular, degrees: f64) -> BsdfProbe {
    let mut values = Material { diffuse: Vec3::splat(kd), specular: Vec3::new(ks, 0.5 * ks, ks), ..Material::BLACK };
    values.lobe = match lobe {
        Specular::Phong(ns) => Lobe::Phong(ns as f32),
        Specular::Ggx(alpha) => Lobe::Ggx(alpha.sqrt() as f32),
        Specular::Mirror => Lobe::Mirror,
    };
    look(&values, degrees)
}

/// A probe's view in f64, of unit vectors.
pub fn frame(probe: &BsdfProbe) -> ShadingFrame {
    let [wo, shading, geometric] = [probe.wo, probe.normal, probe.geometric].map(|v| v.as_dvec3().normalize());
    ShadingFrame { wo, shading, geometric, back_face: probe.back_face != 0 }
}
