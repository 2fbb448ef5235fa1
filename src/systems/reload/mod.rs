//! The phase Reload: what was saved is put in place, told, and taken back if it fails.
//!
//! | file | what it holds |
//! |---|---|
//! | `state` | what is watched, what of it runs, and what is on trial |
//! | `take_up` | puts in place what the worker made |
//! | `tell` | what that makes anew, and its first pixels |
//! | `trial` | the end of a trial, and the way back |
//! | `aside` | where the film waits meanwhile |

mod aside;
mod state;
mod take_up;
mod tell;
mod trial;

use bevy_ecs::prelude::*;

pub use state::Reload;
pub use trial::go_back;

use super::error::no_fault;
use super::phase::Phase;
use take_up::take_up_saves;
use tell::{tell_first_pixels, tell_what_restarts};
use trial::end_trial;

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            take_up_saves.in_set(Phase::Reload),
            tell_what_restarts.after(Phase::Extract).before(Phase::Upload).run_if(no_fault),
            (tell_first_pixels, end_trial).chain().after(Phase::Submit).run_if(no_fault),
        )
            .run_if(resource_exists::<Reload>),
    );
}
