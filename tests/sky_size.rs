//! Pictures of the environment that a device has no room for: halved, and no light lost.

use std::f64::consts::PI;
use std::sync::Arc;
use std::time::Duration;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Environment, EnvironmentMap, Film, Render};
use lucerna::engine::Engine;
use lucerna::prepare::sky_size::{halve_sky, halvings_of_sky};
use lucerna::scene::generate::SplitMix;
use lucerna::shader::Library;

use crate::support;

/// Integral over the sphere.
fn power(size: UVec2, pixels: &[Vec3]) -> DVec3 {
    let height = |row: u32| (PI * f64::from(row) / f64::from(size.y)).cos();
    let row = |y: u32| {
        let line = &pixels[(y * size.x) as usize..((y + 1) * size.x) as usize];
        (height(y) - height(y + 1)) * line.iter().map(|pixel| pixel.as_dvec3()).sum::<DVec3>()
    };
    2.0 * PI / f64::from(size.x) * (0..size.y).map(row).sum::<DVec3>()
}

#[test]
fn no_light_is_lost() {
    let mut random = SplitMix(7);
    for size in [[1, 1], [2, 1], [2, 2], [3, 2], [8, 4], [9, 5], [31, 17], [64, 32], [1, 40], [50, 1]] {
        let size = UVec2::from(size);
        let mut unit = || random.unit() as f32;
        let pixels: Vec<Vec3> = (0..size.element_product()).map(|_| Vec3::new(unit(), unit(), 9.0 * unit())).collect();
        for halvings in 0..7 {
            let (small, means) = halve_sky(size, &pixels, halvings);
            assert_eq!(small, UVec2::new((size.x >> halvings).max(1), (size.y >> halvings).max(1)));
            assert_eq!(means.len(), small.element_product() as usize);
            let (before, after) = (power(size, &pixels), power(small, &means));
            assert!((after / before - 1.0).abs().max_element() < 1e-6, "{size}, {halvings}: {before}, {after}");
        }
    }
    let (_, one) = halve_sky(UVec2::new(4, 2), &[Vec3::ONE; 8], 1);
    assert_eq!(one, [Vec3::ONE; 2]);
}

#[test]
fn a_picture_is_halved_until_it_fits() {
    // 16 bytes a pixel, and 8 a column.
    assert_eq!(halvings_of_sky(UVec2::new(64, 32), 64 * 32 * 16), 0);
    assert_eq!(halvings_of_sky(UVec2::new(64, 32), 64 * 32 * 16 - 1), 1);
    assert_eq!(halvings_of_sky(UVec2::new(64, 32), 32 * 16 * 16 - 1), 2);
    assert_eq!(halvings_of_sky(UVec2::new(1, 4096), 100), 10);
    assert_eq!(halvings_of_sky(UVec2::ONE, 1), 0, "nothing is smaller");
}

#[test]
fn a_sky_that_is_too_large_is_rendered_and_told() {
    let most = support::gpu().most_bytes();
    let height = ((most / 16 / 2).isqrt() as u32 + 2).next_multiple_of(2);
    if height > 6000 {
        // 2 GiB and more: this device has room for what a test can hold.
        return;
    }
    let size = UVec2::new(2 * height, height);
    let image = EnvironmentMap { size, pixels: vec![Vec3::new(0.25, 0.5, 1.0); size.element_product() as usize] };
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/teapot.ron");
    let mut description = lucerna::scene::load(&path, &[]).unwrap().description;
    description.meshes.clear();
    description.film = Film { size: UVec2::new(8, 6), ..description.film };
    description.render = Render { spp: 1, ..description.render };
    description.environment =
        Some(Environment::Map { image: Arc::new(image), strength: 1.0, tint: Vec3::ONE, turn: glam::DMat3::IDENTITY });
    let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
    while !engine.step(Duration::from_millis(100)).unwrap().finished {}
    assert!(engine.film().unwrap().rgb.iter().all(|rgb| *rgb == [0.25, 0.5, 1.0]));
    assert_eq!(engine.halved_sky(), Some((size, 1)));
}
