//! Other code for the passes, put in place between two steps.

use bevy_ecs::prelude::*;

use super::resources::{Device, FilmProgress, Governor, Tree};
use crate::components::Film;
use crate::gpu::Code;
use crate::passes::{Makes, Pass};
use crate::watch::Restarts;

/// What starts anew where passes run other code.
pub fn restarts_of(changed: &[&'static Pass]) -> Restarts {
    let makes = |what: Makes| changed.iter().any(|pass| pass.makes.contains(&what));
    Restarts { tree: makes(Makes::Tree), film: makes(Makes::Film), picture: makes(Makes::Picture) }
}

/// Has made anew what other code makes.
pub fn restart_for_code(code: Restarts, tree: &mut Tree, progress: &mut FilmProgress, governor: &mut Governor) {
    if code.tree || code.film {
        governor.forget();
    }
    if code.tree {
        tree.built = false;
        progress.outdate_views();
    }
    if code.film {
        progress.restart();
    }
    if code.picture {
        progress.outdate_all();
    }
}

/// Runs other code from now on. Returns the code that was run until now, with all that was compiled of it.
pub fn run_code(world: &mut World, code: Code) -> Code {
    let (old, changed) = world.resource_mut::<Device>().0.replace(code);
    let restarts = restarts_of(&changed);
    world.resource_scope(|world, mut tree: Mut<Tree>| {
        world.resource_scope(|world, mut governor: Mut<Governor>| {
            let mut films = world.query_filtered::<&mut FilmProgress, With<Film>>();
            for mut progress in films.iter_mut(world) {
                restart_for_code(restarts, &mut tree, &mut progress, &mut governor);
            }
        });
    });
    old
}
