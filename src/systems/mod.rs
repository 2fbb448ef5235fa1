//! One file or folder a phase of the schedule.
//!
//! `Reload -> Room -> Extract -> Upload -> Build -> Trace -> Accumulate -> Present -> Submit`. Each system runs only where it has something to
//! do: extraction by change detection, which compares values too, so that an edit that changes nothing resets nothing; each
//! later phase by what is not there yet, of tree, film, batch or picture ([`resources`]).

mod accumulate;
mod build;
mod code;
mod error;
mod extract;
mod phase;
pub mod present;
mod reload;
pub mod resources;
mod restart;
mod room;
mod run;
mod submit;
mod trace;
mod upload;

use bevy_ecs::prelude::*;

pub use code::run_code;
pub use error::{EngineError, Fault};
pub use reload::{Reload, go_back};
pub use restart::{release_film, restart_film, start_again};
pub use run::Entered;
pub use upload::table_bytes;

use crate::components::Film;
use phase::Phase;
use resources::{
    Batch, CompileListener, Displayed, DoneBefore, Endless, Everything, FilmProgress, Frame, General, Governor,
    LightDensity, Live, Policy, ProbeChosen, Relief, Robust, SceneGeometry, Shot, Sky, Spent, Target, Textures, Tiles,
    Tree, Viewed,
};

/// The one schedule.
pub fn schedule() -> Schedule {
    let mut schedule = Schedule::default();
    schedule.configure_sets(
        (
            Phase::Reload,
            Phase::Room,
            Phase::Extract,
            Phase::Upload,
            Phase::Build,
            Phase::Trace,
            Phase::Accumulate,
            Phase::Present,
            Phase::Submit,
        )
            .chain(),
    );
    // What a phase failed at, none behind it tries.
    let behind_reload = [
        Phase::Room,
        Phase::Extract,
        Phase::Upload,
        Phase::Build,
        Phase::Trace,
        Phase::Accumulate,
        Phase::Present,
        Phase::Submit,
    ];
    for phase in behind_reload {
        schedule.configure_sets(phase.run_if(error::no_fault));
    }
    reload::add_systems(&mut schedule);
    room::add_systems(&mut schedule);
    extract::add_systems(&mut schedule);
    upload::add_systems(&mut schedule);
    build::add_systems(&mut schedule);
    trace::add_systems(&mut schedule);
    accumulate::add_systems(&mut schedule);
    present::add_systems(&mut schedule);
    submit::add_systems(&mut schedule);
    schedule
}

/// Adds all that the phases hand to each other, but for the device and how it is used.
pub fn insert_resources(world: &mut World) {
    world.register_required_components::<Film, FilmProgress>();
    upload::insert_tables(world);
    world.init_resource::<CompileListener>();
    world.init_resource::<Fault>();
    world.init_resource::<Entered>();
    world.init_resource::<Everything>();
    world.init_resource::<Policy>();
    world.init_resource::<Relief>();
    world.init_resource::<Textures>();
    world.init_resource::<SceneGeometry>();
    world.init_resource::<LightDensity>();
    world.init_resource::<Sky>();
    world.init_resource::<Shot>();
    world.init_resource::<Displayed>();
    world.init_resource::<Endless>();
    world.init_resource::<General>();
    world.init_resource::<Target>();
    world.init_resource::<Tree>();
    world.init_resource::<Batch>();
    world.init_resource::<Tiles>();
    world.init_resource::<Frame>();
    world.init_resource::<Spent>();
    world.init_resource::<DoneBefore>();
    world.init_resource::<Live>();
    world.init_resource::<Viewed>();
    world.init_resource::<Robust>();
    world.init_resource::<ProbeChosen>();
    world.init_resource::<Governor>();
}
