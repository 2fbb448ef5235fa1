//! Numbers that shaders show of themselves by `probe("name", value)`: of a name that is chosen, over the picture and at a pixel.
//!
//! Plain functions, no system: they ask the device. What a pixel has is traced for that alone, into buffers of its own.

use bevy_ecs::prelude::*;
use glam::{UVec2, Vec4};

use super::film::progress;
use super::replay::one_sample;
use crate::components::Film;
use crate::layout::view::ViewMode;
use crate::passes::Recording;
use crate::passes::probe::{self, ProbeLook};
use crate::systems::EngineError;
use crate::systems::resources::{Device, FilmProgress, ProbeChosen, Probing, Shot, Tree};

/// Bounces that a pixel is asked for, at most.
const MOST_BOUNCES: u32 = 64;

/// Chooses a name and how it is looked at, or none.
pub fn choose(world: &mut World, probing: Option<Probing>) {
    let mut chosen = world.resource_mut::<ProbeChosen>();
    if chosen.0 == probing {
        return;
    }
    chosen.0 = probing;
    let mut films = world.query_filtered::<&mut FilmProgress, With<Film>>();
    films.iter_mut(world).for_each(|mut progress| progress.outdate_probe());
}

/// Reads the numbers of the view that is shown; none where that is another.
pub fn read_values(world: &World) -> Result<Option<Vec<Vec4>>, EngineError> {
    if progress(world).shown != Some(ViewMode::Probe) {
        return Ok(None);
    }
    let size = world.resource::<Shot>().size();
    Ok(Some(world.resource::<Device>().0.read_some("probe_values", (size.x * size.y) as usize)?))
}

/// What the chosen name shows of the first sample of a pixel of the picture, by bounce, as in [`read_values`]; none where no name is chosen, or there is
/// no such pixel, or no tree yet.
pub fn of_pixel(world: &mut World, pixel: UVec2) -> Result<Option<Vec<Vec4>>, EngineError> {
    let shot = world.resource::<Shot>();
    let (size, params) = (shot.size(), shot.params);
    let name = world.resource::<ProbeChosen>().number(&world.resource::<Device>().0);
    let Some(name) = name else { return Ok(None) };
    if pixel.cmpge(size).any() || !world.resource::<Tree>().built {
        return Ok(None);
    }
    let bounces = params.max_depth.clamp(1, MOST_BOUNCES);
    let asked = ProbeLook { bounce: Some(0), ..ProbeLook::default() }.choice(name);
    let at = pixel + UVec2::new(params.window_x, params.window_y);
    let mut recording = Recording::default();
    probe::record_pixel(&mut recording, &one_sample(&params, at, 0), bounces);
    let device = &mut world.resource_mut::<Device>().0;
    for (name, bytes) in probe::pixel_buffers(bounces) {
        device.reserve(name, bytes)?;
    }
    device.upload("probe_asked", &[asked])?;
    device.play(&recording)?;
    device.check_loops()?;
    Ok(Some(device.read_some("probe_pixel", bounces as usize)?))
}
