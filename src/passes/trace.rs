//! Paths: one sample a pixel and layer, from the camera to where they end, as radiance for the film.

use glam::{DVec3, UVec2, Vec3};

use super::{Binding, Pass, Recording, Size};
use crate::layout::film::largest_sample;
use crate::layout::trace::{MaterialRecord, RadianceSample, TraceParams};

/// Integrator `Bsdf`: directions from the BSDF alone, light is found by hitting it.
pub static PATH: Pass = Pass {
    name: "path",
    module: "passes/trace/path",
    entry: "path",
    bindings: &[
        Binding::read("nodes", "array<Node>"),
        Binding::read("leaves", "array<Triangle>"),
        Binding::params("TraceParams"),
        Binding::read("materials", "array<MaterialRecord>"),
        Binding::write("radiance", "array<RadianceSample>"),
        Binding::read("shading", "array<Shading>").when("normals"),
    ],
};

/// Where a camera is and looks. World space, scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    pub position: DVec3,
    pub look_at: DVec3,
    pub up: DVec3,
    /// Vertical field of view, degrees, above 0 and below 180.
    pub fov_y: f64,
}

/// Buffers of the trace kernel for a window of so many pixels and so many samples a batch.
pub fn buffers(pixels: u64, layers: u32) -> Vec<(&'static str, u64)> {
    vec![("radiance", (pixels * u64::from(layers)).max(1) * size_of::<RadianceSample>() as u64)]
}

/// Records `params.layers` samples of every pixel of the window into `radiance`.
pub fn record(recording: &mut Recording, params: &TraceParams) {
    let size = Size::Pixels { width: params.window_width, height: params.window_height, layers: params.layers };
    recording.run(&PATH, size).params(params);
}

/// What a scene and its settings ask of the kernel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs<'a> {
    pub materials: &'a [MaterialRecord],
    /// Radiance from everywhere.
    pub environment: Vec3,
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
        let wanted = [
            ("emitters", any(|m| m.emission.max_element() > 0.0)),
            ("environment", self.environment.max_element() > 0.0),
            ("glossy", any(|m| m.glossy > 0.0)),
            ("normals", self.normals),
            ("roulette", self.roulette),
            ("sobol", self.sobol),
        ];
        wanted.into_iter().filter_map(|(name, on)| on.then_some(name)).collect()
    }
}

/// The largest radiance that any material or the environment sends out; what the film's exponent is chosen from.
pub fn largest_emission(materials: &[MaterialRecord], environment: Vec3) -> f32 {
    materials.iter().map(|m| m.emission.max_element()).fold(environment.max_element(), f32::max)
}

impl TraceParams {
    /// The camera part, for a whole film of `film` pixels and a scene whose coordinates are relative to `origin`. All
    /// in f64 until the last step, so that far from the world's origin nothing is lost.
    pub fn aim(&mut self, view: &View, film: UVec2, origin: DVec3) {
        let forward = (view.look_at - view.position).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(view.up).normalize_or(forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let tan = (view.fov_y.to_radians() * 0.5).tan();
        let aspect = f64::from(film.x) / f64::from(film.y);
        self.position = (view.position - origin).as_vec3();
        self.forward = forward.as_vec3();
        self.right = (right * (tan * aspect)).as_vec3();
        self.up = (up * tan).as_vec3();
        self.cone_spread = (2.0 * tan / f64::from(film.y)) as f32;
        (self.film_width, self.film_height) = (film.x, film.y);
    }

    /// The rendered part of the film: `min` inside, `max` just outside.
    pub fn crop(&mut self, min: UVec2, max: UVec2) {
        (self.window_x, self.window_y) = (min.x, min.y);
        (self.window_width, self.window_height) = (max.x - min.x, max.y - min.y);
    }

    /// What the film of this exponent can hold.
    pub fn fit_film(&mut self, exponent: i32) {
        self.largest = largest_sample(exponent);
    }
}
