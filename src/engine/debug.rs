//! What shaders showed of themselves in view "debug", in numbers: a picture holds 0 to 1 of them, in steps.

use bevy_ecs::prelude::*;
use glam::{Vec3, Vec4};

use super::film::progress;
use crate::layout::view::ViewMode;
use crate::systems::EngineError;
use crate::systems::resources::{Device, Shot};

/// The colours of a view "debug".
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DebugRange {
    /// Pixels of the window.
    pub pixels: u32,
    /// Those whose code called `debug`.
    pub shown: u32,
    /// Those of them whose colour is no number in some channel: they are in neither bound.
    pub broken: u32,
    /// The least of each channel; above `most` where no pixel has a colour.
    pub least: Vec3,
    pub most: Vec3,
}

impl DebugRange {
    /// Of colours, with 1 where there is one.
    pub fn of(colours: &[Vec4]) -> Self {
        let mut range = Self { pixels: colours.len() as u32, least: Vec3::MAX, most: Vec3::MIN, ..Self::default() };
        for colour in colours.iter().filter(|colour| colour.w != 0.0) {
            range.shown += 1;
            let rgb = colour.truncate();
            if rgb.is_finite() {
                (range.least, range.most) = (range.least.min(rgb), range.most.max(rgb));
            } else {
                range.broken += 1;
            }
        }
        range
    }
}

/// Reads the colours of the view that is shown; none where that is another.
pub fn read_debug(world: &World) -> Result<Option<Vec<Vec4>>, EngineError> {
    if progress(world).shown != Some(ViewMode::Debug) {
        return Ok(None);
    }
    let size = world.resource::<Shot>().size();
    Ok(Some(world.resource::<Device>().0.read_some("debug_colours", (size.x * size.y) as usize)?))
}
