//! What the rays of a path bring its pixel, and by which way.

use glam::Vec3;

gpu_struct! {
    /// Light that one ray brought to a pixel.
    pub struct Contribution {
        /// What the pixel got, linear Rec.709.
        pub rgb: Vec3,
        /// What sent it: a triangle in scene order, [`LIGHT_POINT`] and a row of the table of lights, [`LIGHT_SUN`] or [`LIGHT_SKY`].
        pub light: u32,
        /// Index of the material where the last direction was chosen by a density: a light sampled, or the BSDF drawn from. `NO_MATERIAL` where
        /// that was the camera.
        pub surface: u32,
        /// Of the mirror or glass that had no choice, between there and the light: the last before the light. `NO_MATERIAL` without one.
        pub through: u32,
        /// Surfaces that sent the light on, without those that it went straight through.
        pub bounce: u32,
        /// A `WAY_` number.
        pub way: u32,
    }
}

gpu_consts! {
    /// From the camera on nothing was chosen: the light is seen, straight or by mirrors and glass.
    pub const WAY_SEEN: u32 = 0;
    /// A surface has sampled the light.
    pub const WAY_SAMPLED: u32 = 1;
    /// A direction that a BSDF drew has met the light.
    pub const WAY_FOUND: u32 = 2;
    /// With the row of a point light added, that light.
    pub const LIGHT_POINT: u32 = 0x8000_0000;
    /// The sun, with the sky before it.
    pub const LIGHT_SUN: u32 = 0xffff_fffe;
    /// The environment.
    pub const LIGHT_SKY: u32 = 0xffff_ffff;
    /// Contributions of a path that are kept.
    pub const MOST_BROUGHT: u32 = 64;
}
