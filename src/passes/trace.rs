//! Paths: one sample a pixel and layer, from the camera to where they end, as radiance for the film.

use glam::Vec3;

use super::textures::{TEXTURED, texture_bindings};
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::texture::MaterialMaps;
use crate::layout::trace::{
    MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MATERIAL_THIN, MaterialRecord, RadianceSample, TraceParams,
};
use crate::layout::tree::FEW_TRIANGLES;

/// What tracing a path reads, whatever becomes of it.
pub const TRACED: [Binding; 15] = Binding::list::<15>(&[
    &[
        Binding::read("nodes", "array<vec4<u32>>"),
        Binding::read("leaves", "array<vec4<u32>>"),
        Binding::params("TraceParams"),
        Binding::read("materials", "array<vec4<u32>>"),
        Binding::read("shading", "array<Shading>").when(&["normals"]),
        Binding::read("lights", "array<vec4<u32>>").when(&["lights"]),
        Binding::read("sky", "array<vec4<f32>>").when(&["sky", "sky_light"]),
        Binding::read("sky_columns", "array<AliasColumn>").when(&["sky_light"]),
    ],
    &texture_bindings(TEXTURED),
    &[
        Binding::read("tangents", "array<vec4<u32>>").when(&["relief"]),
        Binding::read("mean_emission", "array<f32>").when(&["emission_map"]).and(&["lights"]),
        Binding::read("triangles", "array<vec4<u32>>").when(&["emission_map"]).and(&["lights"]),
    ],
]);

/// Integrators `Path` and `Bsdf`: with and without light sampling, but for point lights.
pub static PATH: Pass = Pass {
    name: "path",
    module: "passes/trace/path",
    entry: "path",
    features: &[],
    bindings: &Binding::list::<16>(&[&TRACED, &[Binding::write("radiance", "array<RadianceSample>")]]),
    makes: &[Makes::Film],
    twin: twin!(path::PathScene::sample),
};

/// Buffers of the trace kernel for a window of so many pixels and so many samples a batch.
pub fn buffers(pixels: u64, layers: u32) -> Vec<(&'static str, u64)> {
    vec![("radiance", (pixels * u64::from(layers)).max(1) * size_of::<RadianceSample>() as u64)]
}

/// Records `params.layers` samples of every pixel of the window into `radiance`.
pub fn record(recording: &mut Recording, params: &TraceParams) {
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: params.layers };
    recording.run(&PATH, size).params(params);
}

/// What a scene and its settings need of the kernel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs<'a> {
    pub materials: &'a [MaterialRecord],
    /// Of those materials; empty where none has a texture.
    pub maps: &'a [MaterialMaps],
    /// Number of triangles.
    pub triangles: u32,
    /// Radiance from everywhere.
    pub environment: Vec3,
    /// The environment is a picture.
    pub sky: bool,
    /// It is sampled.
    pub sky_light: bool,
    /// Beside the picture there is a sun; sampled if that is.
    pub sun: bool,
    /// There are lights to sample in a table: emitting triangles, or points.
    pub lights: bool,
    /// Some of those are points.
    pub point_lights: bool,
    /// The camera has a lens.
    pub lens: bool,
    /// Some mesh has normals of its own.
    pub normals: bool,
    /// Russian roulette.
    pub roulette: bool,
    /// Stratified random numbers instead of independent ones.
    pub sobol: bool,
}

impl Needs<'_> {
    /// The features to compile, sorted; what a scene lacks is not compiled.
    pub fn features(&self) -> Vec<&'static str> {
        let any = |test: fn(&MaterialRecord) -> bool| self.materials.iter().any(test);
        let mapped = |test: fn(&MaterialMaps) -> bool| self.maps.iter().any(test);
        let flagged = |flag: u32| self.materials.iter().any(|m| m.flags & flag != 0);
        let wanted = [
            ("alpha", any(|m| m.transparency > 0.0)),
            ("coat", any(|m| m.coat > 0.0)),
            ("cutout", mapped(|m| m.opacity != 0)),
            ("dielectric", flagged(MATERIAL_DIELECTRIC)),
            ("emission_map", mapped(|m| m.emission != 0)),
            ("emitters", any(|m| m.emission.max_element() > 0.0)),
            ("environment", self.environment.max_element() > 0.0),
            ("few_triangles", (2..=FEW_TRIANGLES).contains(&self.triangles)),
            ("ggx", flagged(MATERIAL_GGX)),
            ("lens", self.lens),
            ("lights", self.lights),
            ("mirror", flagged(MATERIAL_MIRROR)),
            ("normals", self.normals),
            ("phong", any(MaterialRecord::has_phong)),
            ("relief", mapped(|m| m.relief != 0)),
            ("point_lights", self.point_lights),
            ("roulette", self.roulette),
            // The two exclude each other.
            ("sky", self.sky && !self.sky_light),
            ("sky_light", self.sky_light),
            ("sobol", self.sobol),
            ("sun", self.sun),
            ("textures", mapped(MaterialMaps::changes_lobes)),
            ("thin", flagged(MATERIAL_THIN)),
        ];
        wanted.into_iter().filter_map(|(name, on)| on.then_some(name)).collect()
    }
}

/// The largest radiance that any material or the environment sends out; what the film's exponent is chosen from. `most` is what a texture
/// of a number multiplies it by at most.
pub fn largest_emission(materials: &[MaterialRecord], maps: &[MaterialMaps], most: &[f32], environment: Vec3) -> f32 {
    let part = |index: usize| match maps.get(index).map_or(0, |maps| maps.emission) {
        0 => 1.0,
        map => most.get(map as usize - 1).copied().unwrap_or(1.0),
    };
    let sent = materials.iter().enumerate().map(|(index, m)| m.emission.max_element() * part(index));
    sent.fold(environment.max_element(), f32::max)
}
