//! The tree loses and adds nothing: rays along axes, with zeros of both signs, from and to corners, in flat boxes.

use crate::layout::ray::{Hit, NO_HIT};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::rays::hard_rays;
use crate::stress::scenes::solids::hard_scenes;
use crate::stress::tools::tracer::{Tracer, others};
use crate::stress::tools::trees::{Cut, build};

pub static ROW: Row = Row {
    name: "hard-rays",
    holds: "rays along axes, with -0.0, at corners, in flat boxes: every tree finds what testing every triangle finds",
    quantity: "hits that differ",
    most: 0.0,
    unit: "rays",
    sizes: [20_000 * 21, 100_000 * 21, 1_000_000 * 21],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut tracer = Tracer::new(lab);
    let scenes = hard_scenes();
    let cuts = [Cut::Median, Cut::Random(3), Cut::Chain];
    let mut all = Measured::new(0.0, 0);
    for (k, (name, triangles)) in scenes.iter().enumerate() {
        let rays = hard_rays(triangles, (size as usize) / (scenes.len() * cuts.len()));
        let mut right: Option<Vec<Hit>> = None;
        for cut in cuts {
            tracer.load(&build(triangles, cut))?;
            let hits = tracer.extend(&rays)?;
            if right.is_none() {
                right = Some(tracer.brute(&rays)?);
            }
            let right = right.as_deref().unwrap_or_default();
            // Any hit is the same question.
            let occluded = tracer.occluded(&rays)?;
            let other =
                occluded.iter().zip(right).filter(|(any, hit)| (**any == 1) != (hit.triangle != NO_HIT)).count();
            let differ = others(&hits, right) + other as u64;
            all = all.plus(Measured::new(differ as f64, rays.len() as u64).noted(format!("{name}, {cut:?}")));
        }
        let hit = right.iter().flatten().filter(|hit| hit.triangle != NO_HIT).count();
        if hit * 50 <= rays.len() {
            return Err(StressError::Broken(format!("{name}: only {hit} of {} rays hit anything", rays.len())));
        }
        lab.tell(k as u64 + 1, scenes.len() as u64);
    }
    Ok(all)
}
