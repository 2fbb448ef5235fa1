//! Scenes whose pixels are not equally noisy.

use glam::{DAffine3, DVec3, UVec2, Vec3};

use super::described::{add, ball, empty, matte, quad};
use crate::components::{Camera, Environment, Lobe, Material};
use crate::scene::SceneDescription;
use crate::scene::generate::{Corners, SplitMix, to_mesh};

/// Pixels a side of [`speckled`].
const SIDE: u32 = 16;

/// Radiance of a speck, over that of what is around.
const SPECK: f32 = 20.0;

/// The side of a speck in pixels.
const SPECK_SIDE: f32 = 0.25;

/// Four tiles under a sky of 1, each with a speck that is bright and much smaller than a pixel: one sample in 16 of one pixel in 64 meets it. Paths
/// end where they begin.
pub fn speckled() -> SceneDescription {
    let half = f64::from(SIDE / 2);
    let position = DVec3::new(0.0, 0.0, half);
    // A pixel is one unit wide at the origin's distance.
    let mut scene = empty(UVec2::splat(SIDE), Camera { position, fov_y: 90.0, ..Camera::default() });
    scene.environment = Some(Environment::Constant(Vec3::ONE));
    scene.render.max_depth = 1;
    let glow = Material { emission: Vec3::splat(1.0 + SPECK), ..matte(Vec3::ZERO) };
    for (k, middle) in [(-4.5, 2.5), (3.5, 4.5), (-2.5, -5.5), (5.5, -1.5)].into_iter().enumerate() {
        let corner = Vec3::new(middle.0, middle.1, 0.0) - 0.5 * SPECK_SIDE * (Vec3::X + Vec3::Y);
        let speck = quad(corner, SPECK_SIDE * Vec3::X, SPECK_SIDE * Vec3::Y);
        add(&mut scene, &format!("speck {k}"), speck, DAffine3::IDENTITY, glow);
    }
    scene
}

/// The mean over all pixels of [`speckled`].
pub fn mean_of_speckled() -> f64 {
    1.0 + 4.0 * f64::from(SPECK * SPECK_SIDE * SPECK_SIDE) / f64::from(SIDE * SIDE)
}

/// A wedge that points at the viewer, under an even sky. Its left side and the balls in it are white and matte. Its right side is rough metal
/// before a hundred small lamps, which the left does not see.
pub fn half_hard(size: UVec2) -> SceneDescription {
    let camera = Camera { position: DVec3::new(0.0, 0.0, 4.0), fov_y: 42.0, ..Camera::default() };
    let mut scene = empty(size, camera);
    scene.environment = Some(Environment::Constant(Vec3::new(0.4, 0.45, 0.5)));
    let edge = Vec3::new(0.0, -2.5, 0.0);
    let (left, right) = (Vec3::new(-3.0, 0.0, -3.0), Vec3::new(3.0, 0.0, -3.0));
    let place = DAffine3::IDENTITY;
    add(&mut scene, "left", quad(edge + left, -left, 5.0 * Vec3::Y), place, matte(Vec3::splat(0.8)));
    let metal =
        Material { diffuse: Vec3::new(0.9, 0.7, 0.4), metallic: 1.0, lobe: Lobe::Ggx(0.3), ..Material::default() };
    add(&mut scene, "right", quad(edge, right, 5.0 * Vec3::Y), place, metal);
    for k in 0..6 {
        let (along, up) = (0.6 + 0.6 * f64::from(k / 3), 0.8 * f64::from(k % 3) - 0.8);
        let middle = DVec3::new(-along, up, -along - 0.15);
        add(&mut scene, &format!("ball {k}"), ball(middle, 0.3), place, matte(Vec3::splat(0.8)));
    }
    let mut random = SplitMix(3);
    let mut lamp = || {
        let at =
            Vec3::new(random.range(1.9, 2.6) as f32, random.range(-1.5, 1.5) as f32, random.range(0.0, 0.8) as f32);
        [at, at + 0.03 * Vec3::Y, at + 0.03 * (Vec3::X + Vec3::Z)]
    };
    let lamps: Vec<Corners> = (0..100).map(|_| lamp()).collect();
    let glow = Material { emission: Vec3::splat(150.0), ..matte(Vec3::ZERO) };
    add(&mut scene, "lamps", to_mesh(&lamps), place, glow);
    scene
}
