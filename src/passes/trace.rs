//! Paths: one sample a pixel and layer, from the camera to where they end, as radiance for the film; and what they lend each other.

use glam::{UVec2, Vec3};

use super::textures::{TEXTURED, texture_bindings};
use super::twin::twin;
use super::{Binding, Makes, Pass, Recording, Size};
use crate::layout::texture::MaterialMaps;
use crate::layout::trace::{
    GatherPoint, LentPoint, MATERIAL_DIELECTRIC, MATERIAL_GGX, MATERIAL_MIRROR, MATERIAL_THIN, MaterialRecord,
    RadianceSample, TILE_BLOCK, TraceParams,
};
use crate::layout::tree::FEW_TRIANGLES;

/// What tracing a path reads, whatever becomes of it.
pub const TRACED: [Binding; 21] = Binding::list::<21>(&[
    &[
        Binding::read("nodes", "array<vec4<u32>>"),
        Binding::read("leaves", "array<vec4<u32>>"),
        Binding::params("TraceParams"),
        Binding::read("materials", "array<vec4<u32>>"),
        Binding::read("shading", "array<Shading>").when(&["normals"]),
        Binding::read("lights", "array<vec4<u32>>").when(&["lights"]),
        Binding::read("sky", "array<vec4<f32>>").when(&["sky", "sky_light"]),
        Binding::read("sky_cdf", "array<CdfEntry>").when(&["sky_light"]),
    ],
    &texture_bindings(TEXTURED),
    &[
        Binding::read("tangents", "array<vec4<u32>>").when(&["relief"]),
        Binding::read("mean_emission", "array<f32>").when(&["emission_map"]).and(&["lights"]),
        Binding::read("triangles", "array<vec4<u32>>").when(&["emission_map"]).and(&["lights"]),
    ],
    &[
        Binding::write("gather_points", "array<GatherPoint>").when(&["reuse"]),
        Binding::write("lent_points", "array<LentPoint>").when(&["reuse"]),
        Binding::write("gather_materials", "array<MaterialRecord>").when(&["textures"]).and(&["reuse"]),
        Binding::write("turns", "array<PathTurn>").when(&["record"]),
        Binding::write("brought", "array<Contribution>").when(&["sources"]),
        Binding::write("probed", "array<Probed>").when(&["record"]),
    ],
]);

/// What a batch of tiles traces.
const TILE_SAMPLES: Binding = Binding::read("tile_samples", "array<TileSample>").when(&["adaptive"]);

/// Integrators `Path` and `Bsdf`: with and without light sampling, but for point lights.
pub static PATH: Pass = Pass {
    name: "path",
    module: "passes/trace/path",
    entry: "path",
    features: &[],
    bindings: &Binding::list::<23>(&[&TRACED, &[Binding::write("radiance", "array<RadianceSample>"), TILE_SAMPLES]]),
    makes: &[Makes::Film],
    twin: twin!(path::PathScene::sample),
};

/// Adds to the pixels' radiance what the paths of their tiles lend.
pub static GATHER: Pass = Pass {
    name: "gather",
    module: "passes/trace/gather",
    entry: "gather",
    features: &[],
    bindings: &Binding::list::<12>(&[
        &[
            Binding::read("nodes", "array<vec4<u32>>"),
            Binding::read("leaves", "array<vec4<u32>>"),
            Binding::params("TraceParams"),
            Binding::read("materials", "array<vec4<u32>>"),
            Binding::write("radiance", "array<RadianceSample>"),
            Binding::read("gather_points", "array<vec4<u32>>"),
            Binding::read("lent_points", "array<vec4<u32>>"),
            TILE_SAMPLES,
        ],
        &texture_bindings(&["cutout"]),
    ]),
    makes: &[Makes::Film],
    twin: twin!(path::PathScene::sample_block),
};

/// Buffers of the trace kernel for a window of so many pixels and so many samples a batch.
pub fn buffers(pixels: u64, layers: u32) -> Vec<(&'static str, u64)> {
    vec![("radiance", (pixels * u64::from(layers)).max(1) * size_of::<RadianceSample>() as u64)]
}

/// Buffers of what so many pixels gather and lend, for so many samples of each at once; `textured`: materials differ from point to point.
pub fn reuse_buffers(pixels: u64, layers: u32, textured: bool) -> Vec<(&'static str, u64)> {
    let places = (pixels * u64::from(layers)).max(1);
    let mut buffers = vec![
        ("gather_points", places * size_of::<GatherPoint>() as u64),
        ("lent_points", places * size_of::<LentPoint>() as u64),
    ];
    if textured {
        buffers.push(("gather_materials", places * size_of::<MaterialRecord>() as u64));
    }
    buffers
}

/// The whole blocks of the film that a window touches: paths lend to each other in those, so a pixel needs all of its block.
pub fn whole_blocks(params: &TraceParams) -> TraceParams {
    let least = UVec2::new(params.window_x, params.window_y) / TILE_BLOCK * TILE_BLOCK;
    let most = UVec2::new(params.window_x + params.window_width, params.window_y + params.window_height);
    let film = UVec2::new(params.film_width, params.film_height);
    let size = (most.map(|end| end.next_multiple_of(TILE_BLOCK))).min(film) - least;
    TraceParams { window_x: least.x, window_y: least.y, window_width: size.x, window_height: size.y, ..*params }
}

/// Records the same as [`record`] where paths are reused, and what comes of that: `at_once` layers by themselves, so that what is lent fits.
/// `params` are of whole blocks; `textured` as in [`reuse_buffers`].
pub fn record_reused(recording: &mut Recording, params: &TraceParams, at_once: u32, textured: bool) {
    let mut first_layer = 0;
    while first_layer < params.layers {
        let layers = at_once.max(1).min(params.layers - first_layer);
        let part = TraceParams { first_layer, layers, first_sample: params.first_sample + first_layer, ..*params };
        record(recording, &part);
        record_gather(recording, &part, textured);
        first_layer += layers;
    }
}

/// Records what pixels gather of what was lent in the batch of `params`, which is of whole blocks.
pub fn record_gather(recording: &mut Recording, params: &TraceParams, textured: bool) {
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: params.layers };
    let call = recording.run(&GATHER, size).params(params);
    if textured {
        call.bind("materials", "gather_materials");
    }
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
    /// Tiles get as many samples as they need.
    pub adaptive: bool,
    /// Paths are reused within tiles.
    pub reuse: bool,
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
            ("adaptive", self.adaptive),
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
            ("reuse", self.reuse),
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
