//! Films of whole scenes as estimates: a seed a batch.

use bevy_ecs::prelude::*;
use glam::{DVec3, UVec2};

use super::paths::{Estimator, Sums, block_sums};
use crate::components::Render;
use crate::engine::{Engine, FilmImage};
use crate::layout::trace::TraceParams;
use crate::scene::SceneDescription;
use crate::stress::lab::{Lab, finish};
use crate::stress::measured::StressError;

/// A scene's film by the seeds from `first` on, as sums over blocks.
pub fn estimates(lab: &Lab, description: &SceneDescription, first: u32) -> Result<impl Estimator + use<>, StressError> {
    let mut engine = lab.engine(description)?;
    Ok(move |i| Ok(film_sums(&film_of_seed(&mut engine, first + i as u32)?)))
}

/// The whole film of another seed.
pub fn film_of_seed(engine: &mut Engine, seed: u32) -> Result<FilmImage, StressError> {
    engine.edit(|world: &mut World| {
        world.query::<&mut Render>().iter_mut(world).for_each(|mut render| render.seed = seed);
    });
    finish(engine)
}

/// Of means, block by block.
pub fn film_sums(film: &FilmImage) -> Sums {
    let size = film.window.size();
    let params = TraceParams { window_width: size.x, window_height: size.y, layers: 1, ..TraceParams::default() };
    let at = |p: UVec2| DVec3::from(film.rgb[(p.y * size.x + p.x) as usize].map(f64::from));
    block_sums(&params, |_, p| (at(p), 0))
}
