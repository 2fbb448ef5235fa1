//! What is seen first through every pixel, shown by itself instead of the film.

use super::trace::TraceParams;

gpu_consts! {
    /// The material's `kd + ks`.
    pub const VIEW_ALBEDO: u32 = 1;
    /// The normal, turned to the viewer: 0.5 n + 0.5.
    pub const VIEW_NORMAL: u32 = 2;
    /// 1 at the camera, 1/2 at the scene's size away from it.
    pub const VIEW_DEPTH: u32 = 3;
    /// A colour for every material.
    pub const VIEW_MATERIAL: u32 = 4;
    /// Steps of the walk through the tree, from black by red and yellow to white.
    pub const VIEW_COST: u32 = 5;
    /// Texture coordinates, as they repeat: u red, v green.
    pub const VIEW_UV: u32 = 6;
    /// The texel there of the first map that the material has, of the whole picture.
    pub const VIEW_TEXEL: u32 = 7;
    /// The level of it that the camera's footprint asks for, from black (the whole picture) by red and yellow to white.
    pub const VIEW_LEVEL: u32 = 8;
    /// Levels that are white, and more.
    pub const VIEW_MOST_LEVELS: u32 = 12;
    /// Steps that are white, and more.
    pub const VIEW_MOST_STEPS: u32 = 64;
}

gpu_struct! {
    /// Parameters of the pass `view`.
    pub struct ViewParams {
        /// Camera, window and root; the rest is not used.
        pub trace_params: TraceParams,
        /// A `VIEW_` number.
        pub mode: u32,
        /// Depth that is shown as 1/2, scene units; above 0.
        pub reach: f32,
        pub pad0: u32,
        pub pad1: u32,
    }
}

/// What the picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum ViewMode {
    /// The film.
    #[default]
    Beauty = 0,
    Albedo = VIEW_ALBEDO,
    Normal = VIEW_NORMAL,
    Depth = VIEW_DEPTH,
    Material = VIEW_MATERIAL,
    Cost = VIEW_COST,
    Uv = VIEW_UV,
    Texel = VIEW_TEXEL,
    Level = VIEW_LEVEL,
    /// What shaders show of themselves: a pass of its own.
    Debug = VIEW_LEVEL + 1,
    /// A number that shaders show, by its size: passes of its own.
    Probe = VIEW_LEVEL + 2,
}

impl ViewMode {
    /// All of them, with the names that people read.
    pub const ALL: [(ViewMode, &str); 11] = [
        (ViewMode::Beauty, "beauty"),
        (ViewMode::Albedo, "albedo"),
        (ViewMode::Normal, "normals"),
        (ViewMode::Depth, "depth"),
        (ViewMode::Material, "material ids"),
        (ViewMode::Cost, "BVH cost"),
        (ViewMode::Uv, "texture coordinates"),
        (ViewMode::Texel, "texels"),
        (ViewMode::Level, "mip levels"),
        (ViewMode::Debug, "debug"),
        (ViewMode::Probe, "probe"),
    ];
}
