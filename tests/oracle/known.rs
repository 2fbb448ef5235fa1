//! Scenes whose answer is known by other means.

use std::f64::consts::TAU;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Environment, Material, Passage};
use lucerna::oracle::Oracle;

use crate::statistics::{BATCHES, Pairs, agree};
use crate::support::stage::{Stage, glowing, matte, quad, sky_map};

use super::{SMALL, batch, glass, veil};

/// A closed box of one grey, seen from inside.
fn furnace(albedo: f32, max_depth: u32) -> Oracle {
    let mut stage = Stage::new(UVec2::splat(6), max_depth, DVec3::new(0.2, -0.3, 0.1), DVec3::new(1.0, 0.5, 0.3));
    let wall = Material { emission: Vec3::splat(3.0), ..matte(Vec3::splat(albedo)) };
    stage.walls([(); 6].map(|_| Some(wall)));
    stage.oracle()
}

#[test]
fn closed_furnace_is_a_geometric_series() {
    for (albedo, depth) in [(0.5, 1), (0.5, 2), (0.75, 8), (1.0, 24), (0.9, 200)] {
        let mut oracle = furnace(albedo, depth);
        let right: f64 = (0..depth).map(|i| 3.0 * f64::from(albedo).powi(i as i32)).sum();
        oracle.ask_lights = false;
        for pixel in batch(&oracle, 0, 2, 1).mean {
            assert!((pixel / right - 1.0).abs().max_element() < 1e-9, "albedo {albedo}, depth {depth}: {pixel}");
        }
        oracle.ask_lights = true;
        let means: Vec<f64> = (0..BATCHES).map(|i| batch(&oracle, i, 8, 1).mean.iter().map(|p| p.x).sum()).collect();
        let differences = std::array::from_fn(|i| means[i] / 36.0 - right);
        agree(&Pairs { differences, mean: right })
            .unwrap_or_else(|why| panic!("albedo {albedo}, depth {depth}: {why}"));
    }
}

#[test]
fn a_shell_of_index_one_and_a_clear_veil_are_invisible() {
    for material in [
        Material { passage: Passage::Glass(1.0), filter: Vec3::ONE, ..glass() },
        Material { passage: Passage::SeeThrough(0.0), filter: Vec3::ONE, ..veil() },
    ] {
        let picture = |ball: bool| {
            let mut stage = Stage::new(SMALL, 4, DVec3::Z * 3.0, DVec3::ZERO);
            stage.sky(sky_map());
            if ball {
                stage.ball(DVec3::ZERO, 0.9, material);
            }
            stage.oracle().render(0..4, 1, 1, &|_, _| ())
        };
        let (with, without) = (picture(true), picture(false));
        let off = with.mean.iter().zip(&without.mean).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
    }
}

#[test]
fn glass_gives_back_the_sky_around_it() {
    // In a sky of 1 a clear solid is as bright as the sky: what refraction takes on the way in it gives on the way out.
    let mut stage = Stage::new(SMALL, 200, DVec3::Z * 3.0, DVec3::ZERO);
    // A cube: a ball of facets can catch a little light for longer than 200 segments.
    for (axis, outward) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
        let (e, f) = (Vec3::AXES[(axis + 1) % 3] * outward, Vec3::AXES[(axis + 2) % 3]);
        let corner = Vec3::AXES[axis] * outward - e - f;
        stage.part(&quad(0.6 * corner, 1.2 * e, 1.2 * f), Material { filter: Vec3::ONE, ..glass() });
    }
    stage.sky(Environment::Constant(Vec3::ONE));
    for pixel in stage.oracle().render(0..16, 1, 2, &|_, _| ()).mean {
        assert!((pixel - 1.0).abs().max_element() < 1e-9, "{pixel}");
    }
}

#[test]
fn a_small_light_gives_its_form_factor() {
    for side in [0.2f32, 2e-6] {
        // A square light above a parallel floor, and a camera that sees only the point below its middle.
        let mut stage = Stage::new(UVec2::splat(2), 2, DVec3::new(0.0, 0.5, 1.0), DVec3::ZERO);
        stage.fov_y(1e-3);
        stage.part(&quad(Vec3::new(-9.0, 0.0, 9.0), Vec3::X * 18.0, Vec3::Z * -18.0), matte(Vec3::splat(0.5)));
        let corner = Vec3::new(-0.5 * side, 1.0, -0.5 * side);
        stage.part(&quad(corner, Vec3::X * side, Vec3::Z * side), glowing(Vec3::splat(7.0)));
        let mean = stage.oracle().render(0..60_000, 1, 2, &|_, _| ()).mean.iter().sum::<DVec3>().x / 4.0;
        // From a point to a parallel square straight above (Siegel and Howell, configuration 11 of appendix C), four corners.
        let x = 0.5 * f64::from(side);
        let factor = 4.0 / TAU * 2.0 * x / (1.0 + x * x).sqrt() * (x / (1.0 + x * x).sqrt()).atan();
        let right = 0.5 * 7.0 * factor;
        assert!((mean / right - 1.0).abs() < 1e-3, "a side of {side}: {mean}, not {right}");
    }
}
