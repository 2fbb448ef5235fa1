//! What scenes may need of the trace kernels: a feature is compiled where a scene needs it, and nowhere else.

/// A part of the trace kernels by the name that `@if` knows it by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Feature {
    pub name: &'static str,
    /// What a scene has that needs it.
    pub what: &'static str,
    /// It reads no array that a scene without it lacks, and excludes no other: it can be compiled in where it is of no use.
    pub can_be_idle: bool,
}

/// All of them, in the order of their names.
pub const FEATURES: [Feature; 25] = [
    of("adaptive", "adaptive sampling"),
    idle("alpha", "see-through materials"),
    idle("coat", "clear coats"),
    of("cutout", "holes cut by textures"),
    idle("dielectric", "glass"),
    of("emission_map", "textured lights"),
    of("emitters", "materials that emit"),
    idle("environment", "constant light from around"),
    of("few_triangles", "32 triangles or fewer"),
    idle("ggx", "rough metal (GGX)"),
    idle("lens", "a lens"),
    of("lights", "sampled lights"),
    idle("mirror", "mirrors"),
    of("normals", "smooth normals"),
    idle("phong", "Phong lobes"),
    of("point_lights", "point lights"),
    of("relief", "bump or normal maps"),
    of("reuse", "reuse of paths"),
    of("roulette", "roulette"),
    of("sky", "a sky that is not sampled"),
    of("sky_light", "a sampled sky"),
    of("sobol", "stratified numbers"),
    of("sun", "a sun"),
    of("textures", "textures"),
    idle("thin", "panes"),
];

const fn of(name: &'static str, what: &'static str) -> Feature {
    Feature { name, what, can_be_idle: false }
}

const fn idle(name: &'static str, what: &'static str) -> Feature {
    Feature { name, what, can_be_idle: true }
}
