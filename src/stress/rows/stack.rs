//! A stack that has too little room.

use crate::layout::ray::{Hit, NO_HIT};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::rays::hard_rays;
use crate::stress::scenes::solids::hard_scenes;
use crate::stress::tools::tracer::{Tracer, others};
use crate::stress::tools::trees::{Cut, build};

pub static ROW: Row = Row {
    name: "stack",
    holds: "a stack of 1, 2 or 4 entries that overflows starts over, and loses no hit",
    quantity: "hits that differ",
    most: 0.0,
    unit: "rays",
    sizes: [4_000 * 42, 20_000 * 42, 500_000 * 42],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let mut tracers = [1, 2, 4].map(|entries| (entries, Tracer::with_stack(lab, entries)));
    let scenes = hard_scenes();
    let mut all = Measured::new(0.0, 0);
    for (k, (name, triangles)) in scenes.iter().enumerate() {
        let rays = hard_rays(triangles, size as usize / (scenes.len() * 6));
        for cut in [Cut::Median, Cut::Random(5)] {
            let tree = build(triangles, cut);
            let mut right: Option<Vec<Hit>> = None;
            for (entries, small) in &mut tracers {
                small.load(&tree)?;
                if right.is_none() {
                    right = Some(small.brute(&rays)?);
                }
                let right = right.as_deref().unwrap_or_default();
                let occluded = small.occluded(&rays)?;
                let other =
                    occluded.iter().zip(right).filter(|(o, hit)| (**o == 1) != (hit.triangle != NO_HIT)).count();
                let differ = others(&small.extend(&rays)?, right) + other as u64;
                let note = format!("{entries} entries, {name}, {cut:?}");
                all = all.plus(Measured::new(differ as f64, rays.len() as u64).noted(note));
            }
        }
        lab.tell(k as u64 + 1, scenes.len() as u64);
    }
    Ok(all)
}
