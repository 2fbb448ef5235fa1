//! `lucerna replay`: one sample of one pixel, vertex by vertex, by the kernel, its twin and the oracle.

mod arguments;
mod bundle;
mod json;
mod names;
mod numbers;
mod text;
mod third;
mod told;

pub use arguments::ReplayArguments;

use std::time::Duration;

use crate::app::shared::describe::Described;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::opening::Opening;
use crate::app::shared::output;
use crate::app::shared::scene::Opened;
use crate::app::{Exit, Failure};
use crate::components::Crop;
use crate::engine::Engine;
use crate::oracle::Oracle;
use told::Told;

/// Replays and tells.
pub fn run(arguments: &ReplayArguments) -> Result<Exit, Failure> {
    let _interrupt = Interrupt::listen(Exit::Interrupted);
    let opening = Opening::begin();
    let opened = arguments.flags.open(&arguments.scene, arguments.quiet)?;
    let library = arguments.flags.library(&opened)?;
    let (pixel, size) = (arguments.pixel, opened.description.film.size);
    if pixel.cmpge(size).any() {
        let message = format!("--pixel {},{} is outside of the picture of {}x{}", pixel.x, pixel.y, size.x, size.y);
        return Err(Failure::usage(
            message,
            "count pixels from 0, from the left and the top; --size says how many there are",
        ));
    }
    if let Some(folder) = &arguments.bundle {
        bundle::refuse_used(folder)?;
    }
    let (gpu, _) = opening.finish()?;
    // The tree needs all of the scene, and the film no more than the pixel.
    let mut description = opened.description.clone();
    description.film.crop = Some(Crop { min: pixel, max: pixel + 1 });
    description.render.spp = 1;
    let adapter = gpu.name();
    let mut engine = Engine::open(gpu, library.clone(), &description).map_err(Failure::engine)?;
    while !engine.step(Duration::from_millis(100)).map_err(Failure::engine)?.finished {}
    let replay = engine.replay(pixel, arguments.sample).map_err(Failure::engine)?;
    let Some(replay) = replay else {
        return Err(Failure::usage("the scene has no triangle, so that no path has a vertex", "choose another scene"));
    };
    let third = match engine.edit(Oracle::new) {
        Ok(oracle) => third::of_path(&oracle, &replay),
        Err(_) => vec![None; replay.gpu.len()],
    };
    let described = described(arguments, &opened, &adapter);
    let repeat = described.replay(pixel, arguments.sample);
    let told =
        Told { replay: &replay, third: &third, description: &opened.description, adapter: &adapter, repeat: &repeat };
    let mut written = None;
    if let Some(folder) = &arguments.bundle {
        written = Some(bundle::write(folder, &opened, &library, (&described, pixel, arguments.sample))?);
    }
    match arguments.json {
        true => output::print(&format!("{}\n", json::json(&told, written.as_deref())))?,
        false => output::print(&text::text(&told, written.as_deref()))?,
    }
    Ok(Exit::Done)
}

/// What the replay follows from.
fn described<'a>(arguments: &'a ReplayArguments, opened: &'a Opened, adapter: &'a str) -> Described<'a> {
    Described {
        path: &opened.path,
        description: &opened.description,
        defines: &arguments.flags.define,
        shaders: arguments.flags.shaders.as_deref(),
        window: opened.description.film.window(),
        spp: 1,
        adapter,
    }
}
