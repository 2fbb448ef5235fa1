//! What is to be made anew, whatever change detection finds.

use bevy_ecs::prelude::*;

use super::resources::{Device, Everything, FilmProgress, Tree};
use super::upload::send_tables_again;
use crate::passes::{film, trace};

/// Has everything extracted, sent and traced anew: what was extracted may not have been sent, nor what was recorded have run.
pub fn start_again(world: &mut World) {
    world.resource_mut::<Everything>().0 = true;
    send_tables_again(world);
    world.resource_mut::<Tree>().built = false;
    restart_film(world);
}

/// Drops the film, and what a batch of it takes: a device that ran out of memory has that for a smaller one.
pub fn release_film(world: &mut World) {
    let arrays = [film::buffers(1), trace::buffers(1, 1), trace::reuse_buffers(1, 1, true)];
    let device = &mut world.resource_mut::<Device>().0;
    arrays.into_iter().flatten().for_each(|(name, _)| device.release(name));
}

/// Has the film start anew.
pub fn restart_film(world: &mut World) {
    let mut films = world.query::<&mut FilmProgress>();
    films.iter_mut(world).for_each(|mut progress| progress.restart());
}
