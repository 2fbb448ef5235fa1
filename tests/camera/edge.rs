//! The blurred edge of a glowing plane, whose brightness is known: that part of the disk of confusion that lies on it.

use std::f64::consts::PI;
use std::time::Duration;

use glam::{DVec3, UVec2, Vec3};
use lucerna::Engine;
use lucerna::components::{Focus, Lens, Render};
use lucerna::scene::describe;
use lucerna::shader::Library;

use crate::statistics::{BATCHES, Pairs, agree};
use crate::support;
use crate::support::stage::{Stage, glowing, quad};

const SIDE: u32 = 16;

/// A glowing plane left of x = 0, 4 away. Sharp is what is 2 or 8 away.
fn stage(aperture: f64, focus: Focus) -> Stage {
    let mut stage = Stage::new(UVec2::splat(SIDE), 2, 4.0 * DVec3::Z, DVec3::ZERO);
    stage.part(&quad(Vec3::new(-9.0, -9.0, 0.0), 9.0 * Vec3::X, 18.0 * Vec3::Y), glowing(Vec3::ONE));
    stage.lens(Lens { aperture, focus, ..Lens::default() });
    stage
}

/// The part of a disk of a radius about `x` that is left of 0.
fn part(x: f64, radius: f64) -> f64 {
    let c = (-x / radius).clamp(-1.0, 1.0);
    0.5 + (c * (1.0 - c * c).sqrt() + c.asin()) / PI
}

/// The mean of that over a column of pixels.
fn right(column: u32, radius: f64) -> f64 {
    let half = 4.0 * 21f64.to_radians().tan();
    let at = |i: u32| (2.0 * (f64::from(column) + (f64::from(i) + 0.5) / 1000.0) / f64::from(SIDE) - 1.0) * half;
    (0..1000).map(|i| part(at(i), radius)).sum::<f64>() / 1000.0
}

/// The means of columns.
fn columns(pixels: &[f64]) -> Vec<f64> {
    let mean = |x: u32| (0..SIDE).map(|y| pixels[(y * SIDE + x) as usize]).sum::<f64>() / f64::from(SIDE);
    (0..SIDE).map(mean).collect()
}

fn judge(means: &[Vec<f64>], radius: f64) -> Result<(), String> {
    // Columns that are all on it, or all off it, have nothing to tell.
    let columns = (0..SIDE).map(|x| (x, right(x, radius))).filter(|(_, mean)| (0.02..0.98).contains(mean));
    for (x, right) in columns {
        let differences = std::array::from_fn(|i| means[i][x as usize] - right);
        // By the brightness of the plane itself.
        agree(&Pairs { differences, mean: 1.0 }).map_err(|why| format!("column {x}: {why}"))?;
    }
    Ok(())
}

#[test]
fn a_blurred_edge_is_that_of_a_disk() {
    let spp = 128;
    let focused = [(Focus::Distance(2.0), 1.0), (Focus::At(DVec3::new(0.7, 0.1, -4.0)), 0.5)];
    for (focus, blur) in focused {
        let (aperture, radius) = (0.6, 0.6 * blur);
        let mut stage = stage(aperture, focus);
        let oracle = stage.oracle();
        let means: Vec<_> = (0..BATCHES as u32)
            .map(|i| oracle.render(i * spp..(i + 1) * spp, 1, 2, &|_, _| ()))
            .map(|picture| columns(&picture.mean.iter().map(|p| p.x).collect::<Vec<_>>()))
            .collect();
        judge(&means, radius).unwrap_or_else(|why| panic!("the oracle, {focus:?}: {why}"));
        assert!(judge(&means, 1.1 * radius).is_err(), "{focus:?}: a lens of another radius went unnoticed");

        let mut description = describe(stage.world(), "edge");
        description.render = Render { spp, ..description.render };
        let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
        let means: Vec<_> = (0..BATCHES as u32)
            .map(|seed| {
                engine.edit(|world| world.query::<&mut Render>().iter_mut(world).for_each(|mut r| r.seed = seed));
                while !engine.step(Duration::from_millis(100)).unwrap().finished {}
                columns(&engine.film().unwrap().rgb.iter().map(|p| p[0].into()).collect::<Vec<_>>())
            })
            .collect();
        judge(&means, radius).unwrap_or_else(|why| panic!("the engine, {focus:?}: {why}"));
        assert!(judge(&means, 1.1 * radius).is_err(), "{focus:?}: a lens of another radius went unnoticed");
    }
}
