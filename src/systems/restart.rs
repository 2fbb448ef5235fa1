//! What is to be made anew, whatever change detection finds.

use bevy_ecs::prelude::*;

use super::resources::{Everything, FilmProgress, Tree};
use super::upload::send_tables_again;

/// Has everything extracted, sent and traced anew: what was extracted may not have been sent, nor what was recorded have run.
pub fn start_again(world: &mut World) {
    world.resource_mut::<Everything>().0 = true;
    send_tables_again(world);
    world.resource_mut::<Tree>().built = false;
    restart_film(world);
}

/// Has the film start anew.
pub fn restart_film(world: &mut World) {
    let mut films = world.query::<&mut FilmProgress>();
    films.iter_mut(world).for_each(|mut progress| progress.restart());
}
