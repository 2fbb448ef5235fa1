//! Every way to estimate a picture against every other.

use glam::{DAffine3, UVec2};

use crate::components::{Integrator, Render, Reuse, Sampler};
use crate::scene::SceneDescription;
use crate::stats::agreement::{BATCHES, MOST_ERRORS};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{Inside, room};
use crate::stress::tools::films::{film_of_seed, film_sums};
use crate::stress::tools::paths::{Sums, as_measured, compare};

pub static ROW: Row = Row {
    name: "estimators",
    holds: "bsdf, path, path with reuse, with and without roulette, Pcg and Sobol: each has every other's mean",
    quantity: "standard errors between two",
    most: MOST_ERRORS,
    unit: "paths",
    sizes: [12_000_000, 12_000_000, 2_000_000_000],
    measure,
};

const SIDE: u32 = 8;

/// What is compared, by name.
fn ways(base: Render) -> Vec<(&'static str, Render)> {
    let pcg = Render { sampler: Sampler::Pcg, roulette: false, ..base };
    vec![
        ("bsdf", Render { integrator: Integrator::Bsdf, ..pcg }),
        ("path", Render { integrator: Integrator::Path, ..pcg }),
        ("path, Sobol, roulette", base),
        ("bsdf, Sobol, roulette", Render { integrator: Integrator::Bsdf, ..base }),
        ("path with reuse, Sobol, roulette", Render { reuse: Reuse::Tiles, ..base }),
    ]
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let insides = if lab.scale() == Scale::Full { &[Inside::Rough, Inside::Smooth][..] } else { &[Inside::Rough] };
    let mut all = Measured::new(0.0, 0);
    for inside in insides {
        let description = room(UVec2::splat(SIDE), *inside, DAffine3::IDENTITY);
        let ways = ways(description.render);
        let films = (ways.len() * BATCHES * insides.len()) as u64;
        let spp = size.div_ceil(films * u64::from(SIDE * SIDE)) as u32;
        let mut sums: Vec<Vec<Sums>> = Vec::new();
        for (k, (_, render)) in ways.iter().enumerate() {
            let mut engine =
                lab.engine(&SceneDescription { render: Render { spp, ..*render }, ..description.clone() })?;
            let mut of_way = Vec::new();
            for i in 0..BATCHES {
                // No two have a seed in common.
                of_way.push(film_sums(&film_of_seed(&mut engine, (k * BATCHES + i) as u32)?));
                lab.tell((k * BATCHES + i) as u64, films);
            }
            all.samples += u64::from(spp * SIDE * SIDE) * BATCHES as u64;
            sums.push(of_way);
        }
        for (a, b) in (0..ways.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let agreement = compare(|i| Ok(sums[a][i].clone()), |i| Ok(sums[b][i].clone()))?;
            all = all.worst(as_measured(agreement, 0, &format!("{} and {}", ways[a].0, ways[b].0)));
        }
    }
    Ok(all)
}
