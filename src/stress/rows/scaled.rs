//! Scenes a million times as small and as large, by powers of two.

use crate::layout::ray::{Hit, Ray};
use crate::scene::generate::Corners;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::rays::hard_rays;
use crate::stress::scenes::solids::hard_scenes;
use crate::stress::tools::tracer::{Tracer, others};
use crate::stress::tools::trees::{Cut, build};

pub static ROW: Row = Row {
    name: "scaled",
    holds: "a scene scaled by 2^-20 or 2^20 is hit in the same bits",
    quantity: "hits that differ",
    most: 0.0,
    unit: "rays",
    sizes: [4_000 * 14, 100_000 * 14, 1_000_000 * 14],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut tracer = Tracer::new(lab);
    let scenes = hard_scenes();
    let mut all = Measured::new(0.0, 0);
    for (k, (name, triangles)) in scenes.iter().enumerate() {
        let rays = hard_rays(triangles, size as usize / (2 * scenes.len()));
        tracer.load(&build(triangles, Cut::Median))?;
        let right = tracer.extend(&rays)?;
        for scale in [2f32.powi(-20), 2f32.powi(20)] {
            let ends = |t: f32| if t < 1e38 { t * scale } else { t };
            let scaled: Vec<Corners> = triangles.iter().map(|corners| corners.map(|v| v * scale)).collect();
            tracer.load(&build(&scaled, Cut::Median))?;
            let rays: Vec<Ray> =
                rays.iter().map(|r| Ray { origin: r.origin * scale, t_max: ends(r.t_max), ..*r }).collect();
            let right: Vec<Hit> = right.iter().map(|hit| Hit { t: ends(hit.t), ..*hit }).collect();
            let differ = others(&tracer.extend(&rays)?, &right);
            all = all.plus(Measured::new(differ as f64, rays.len() as u64).noted(format!("{name} by {scale:e}")));
        }
        lab.tell(k as u64 + 1, scenes.len() as u64);
    }
    Ok(all)
}
