//! The error that a film tells of itself.

use glam::{DAffine3, UVec2};

use crate::components::{Render, Reuse, Sampler};
use crate::scene::{self, SceneDescription};
use crate::stats::metrics::relative_mse;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{Inside, room};
use crate::stress::tools::films::film_of_seed;

pub static ROW: Row = Row {
    name: "claimed-error",
    holds: "the relMSE that a render reports is 0.7 to 1.4 of the true one, by each sampler, in every scene",
    quantity: "factor by which it is off, of what it may be",
    most: 1.0,
    unit: "samples",
    sizes: [1_200_000, 6_000_000, 3_000_000_000],
    measure,
};

/// Samples a pixel of what is judged, and how many films.
const SPP: u32 = 16;
const FILMS: u32 = 4;

/// Rooms, and where there are files of them, scenes that are shipped.
fn scenes(lab: &Lab) -> Vec<(String, SceneDescription)> {
    let side = UVec2::splat(if lab.scale() == Scale::Full { 128 } else { 32 });
    let mut scenes = vec![
        ("a room".to_owned(), room(side, Inside::Rough, DAffine3::IDENTITY)),
        ("glass and mirror".to_owned(), room(side, Inside::Smooth, DAffine3::IDENTITY)),
    ];
    if lab.scale() == Scale::Full {
        for name in ["cornell-box", "teapot", "glass"] {
            let loaded = scene::find(name).ok().and_then(|path| scene::load(&path, &[]).ok());
            if let Some(loaded) = loaded {
                let mut description = loaded.description;
                description.film.size = side;
                scenes.push((name.to_owned(), description));
            }
        }
    }
    scenes
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let scenes = scenes(lab);
    let ways = [(Sampler::Sobol, Reuse::Off), (Sampler::Pcg, Reuse::Off), (Sampler::Sobol, Reuse::Tiles)];
    let mut all = Measured::new(0.0, 0);
    for (k, (name, description)) in scenes.iter().enumerate() {
        let pixels = u64::from(description.film.size.element_product());
        let spp = size.div_ceil(pixels * scenes.len() as u64).max(64 * u64::from(SPP)) as u32;
        let with = |render: Render| SceneDescription { render, ..description.clone() };
        let reference = with(Render { spp, reuse: Reuse::Off, sampler: Sampler::Sobol, ..description.render });
        let right = film_of_seed(&mut lab.engine(&reference)?, 1000)?;
        all.samples += u64::from(spp) * pixels;
        for (sampler, reuse) in ways {
            let mut engine = lab.engine(&with(Render { spp: SPP, sampler, reuse, ..description.render }))?;
            for seed in 0..FILMS {
                let film = film_of_seed(&mut engine, seed)?;
                let ratio = film.error.relmse / relative_mse(&film.rgb, &right.rgb);
                let note = format!("{name}, {sampler:?}, reuse {reuse:?}, {SPP} spp: {ratio:.2} of the true one");
                all = all.worst(Measured::new((ratio / 1.4).max(0.7 / ratio), u64::from(SPP) * pixels).noted(note));
            }
        }
        lab.tell(k as u64 + 1, scenes.len() as u64);
    }
    Ok(all)
}
