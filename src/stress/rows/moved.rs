//! Scenes far from the origin of their coordinates.

use glam::Vec3;

use crate::layout::ray::Ray;
use crate::scene::generate::Corners;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::rays::random_rays;
use crate::stress::scenes::solids::soup;
use crate::stress::tools::tracer::{AT_ONCE, Tracer, others};
use crate::stress::tools::trees::{Cut, build};

pub static ROW: Row = Row {
    name: "moved",
    holds: "rays through a scene that is moved by 1e4 or 1e6 units hit what they hit before",
    quantity: "part of the rays with another hit",
    most: 1e-5,
    unit: "rays",
    sizes: [2 * 50_000, 2 * 300_000, 2 * 20_000_000],
    measure,
};

/// Coordinates on a grid that the moved scene still has: what differs is the traversal's own rounding.
fn on_grid(v: Vec3) -> Vec3 {
    (v * 16.0).round() / 16.0
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let triangles: Vec<Corners> = soup(300, 3.0, 50).iter().map(|t| t.map(|v| on_grid(v * 20.0))).collect();
    let mut tracer = Tracer::new(lab);
    let [mut differ, mut brute, mut traced] = [0, 0, 0];
    let mut seed = 51;
    while traced < size {
        let count = ((size - traced) / 2).clamp(1, AT_ONCE) as usize;
        let rays: Vec<Ray> =
            random_rays(count, 40.0, seed).iter().map(|r| Ray { origin: on_grid(r.origin), ..*r }).collect();
        tracer.load(&build(&triangles, Cut::Median))?;
        let right = tracer.extend(&rays)?;
        for far in [1e4, 1e6] {
            let shift = Vec3::new(far, -far, far);
            let moved: Vec<Corners> = triangles.iter().map(|t| t.map(|v| v + shift)).collect();
            tracer.load(&build(&moved, Cut::Median))?;
            let rays: Vec<Ray> = rays.iter().map(|r| Ray { origin: r.origin + shift, ..*r }).collect();
            let hits = tracer.extend(&rays)?;
            differ += hits.iter().zip(&right).filter(|(a, b)| a.triangle != b.triangle).count() as u64;
            let some = rays.len().min(20_000);
            brute += others(&hits[..some], &tracer.brute(&rays[..some])?);
            traced += count as u64;
        }
        seed += 1;
        lab.tell(traced, size);
    }
    if brute > 0 {
        return Err(StressError::Broken(format!("moved, the tree has {brute} other hits than its triangles")));
    }
    Ok(Measured::new(differ as f64 / traced as f64, traced).noted(format!("{differ} of {traced}")))
}
