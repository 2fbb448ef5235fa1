//! Pictures of the environment that are too large for a device, made smaller.

use std::f64::consts::PI;

use glam::{DVec3, UVec2, Vec3};

use crate::layout::cdf::CdfEntry;

/// How often the sides of a picture of so many pixels are halved until its pixels, and the entries of the table that directions are drawn by, take at most
/// `room` bytes each.
pub fn halvings_of_sky(size: UVec2, room: u64) -> u32 {
    let fits = |halvings: &u32| {
        let size = halved(size, *halvings).as_u64vec2();
        let bytes = [16 * size.element_product(), size_of::<CdfEntry>() as u64 * (size.x + 1) * size.y];
        bytes.into_iter().all(|bytes| bytes <= room)
    };
    (0..32).find(fits).unwrap_or(0)
}

/// The sides, halved so many times.
fn halved(size: UVec2, halvings: u32) -> UVec2 {
    UVec2::new(size.x >> halvings, size.y >> halvings).max(UVec2::ONE)
}

/// A picture of the sphere by longitude and latitude with its sides halved: each pixel is the mean of what it covers, by solid angle, so that
/// no light is lost. `pixels` has `size.x * size.y` of them.
pub fn halve_sky(size: UVec2, pixels: &[Vec3], halvings: u32) -> (UVec2, Vec<Vec3>) {
    let small = halved(size, halvings);
    let columns = covered(size.x, small.x, |at| at);
    // By the height above the equator's plane: of a slice of the sphere, that is its area.
    let rows = covered(size.y, small.y, |at| -(PI * at / f64::from(size.y)).cos());
    let mut result = Vec::with_capacity(small.x as usize * small.y as usize);
    for row in &rows {
        for column in &columns {
            let mut sum = DVec3::ZERO;
            for (y, height) in row {
                let line = &pixels[*y * size.x as usize..];
                sum += *height * column.iter().map(|(x, width)| *width * line[*x].as_dvec3()).sum::<DVec3>();
            }
            result.push(sum.as_vec3());
        }
    }
    (small, result)
}

/// Of each of `to` equal parts, which of `from` pixels it covers, and their weights by the differences of `measure`; these sum to 1.
fn covered(from: u32, to: u32, measure: impl Fn(f64) -> f64) -> Vec<Vec<(usize, f64)>> {
    let edge = |part: u32| f64::from(from) * f64::from(part) / f64::from(to);
    let part = |part: u32| {
        let (begin, end) = (edge(part), edge(part + 1));
        let whole = measure(end) - measure(begin);
        let pixels = begin as usize..(end.ceil() as usize).min(from as usize);
        let weight = |x: usize| (measure(end.min(x as f64 + 1.0)) - measure(begin.max(x as f64))) / whole;
        pixels.map(|x| (x, weight(x))).collect()
    };
    (0..to).map(part).collect()
}
