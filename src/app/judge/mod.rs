//! `lucerna judge`: whether an edit of the shaders made the estimator better, worse or wrong.

mod arguments;
mod core;
mod look;
mod mark;
mod report;

pub use self::core::{Judge, JudgeError, Plan, SECONDS};
pub use arguments::JudgeArguments;
pub use look::{End, Estimator, Look};
pub use mark::marked;

use std::path::{Path, PathBuf};

use super::failure::show;
use super::interrupt::Interrupt;
use super::progress::{Goal, Meter};
use super::scene::choose_camera;
use super::{Exit, Failure, output};
use crate::gpu::Gpu;
use crate::scene::{self, SceneDescription};
use crate::shader::Library;
use crate::systems::save::Picture;
use report::Account;

/// What is said of code that is the same.
pub const UNCHANGED: &str = "nothing changed in what this scene runs";

/// Judges until all is clear or the time is over, and tells.
pub fn run(arguments: &JudgeArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let (path, description) = describe(arguments)?;
    for output in &arguments.output {
        output.prepare()?;
    }
    let old = arguments.old.as_deref().map_or_else(|| Ok(Library::embedded()), Library::open)?;
    let new = Library::open(&arguments.new)?;
    let gpu = Gpu::open()?;
    let mut judge = Judge::open(&gpu, [&old, &new], &description, arguments.plan())?;
    if !judge.changed() && !arguments.force {
        output::print(&report::unchanged(UNCHANGED, arguments.json))?;
        return Ok(Exit::Done);
    }
    judge.stop_by(interrupt.flag());
    match judge.warm_up() {
        Err(JudgeError::Stopped) => return Ok(Exit::Interrupted),
        warm => warm?,
    }
    let look = watch(&mut judge, arguments, &interrupt)?;
    let interrupted = look.ended.is_none();
    let changed = judge.changed();
    let adapter = gpu.name();
    let account = Account { arguments, path: &path, description: &description, adapter, changed, look: &look };
    tell(&account, &judge.pictures()[1])?;
    Ok(match (look.means.differ(), interrupted, look.tells()) {
        (true, ..) => Exit::MeansDiffer,
        (_, true, _) => Exit::Interrupted,
        (.., false) => Exit::Failed,
        (.., true) => Exit::Done,
    })
}

/// The scene as it is to be judged.
fn describe(arguments: &JudgeArguments) -> Result<(PathBuf, SceneDescription), Failure> {
    let path = scene::find(&arguments.scene)?;
    let loaded = scene::load(&path, &arguments.define)?;
    if !arguments.quiet {
        loaded.warnings.iter().for_each(|warning| show(warning));
    }
    let mut description = loaded.description;
    if let Some(name) = &arguments.camera {
        choose_camera(&mut description, name)?;
    }
    if let Some(size) = arguments.size {
        description.film.size = size;
        // A crop in pixels is one of the scene's own size.
        description.film.crop = None;
    }
    Ok((path, description))
}

/// Traces until a look ends it, or a signal does.
fn watch(judge: &mut Judge, arguments: &JudgeArguments, interrupt: &Interrupt) -> Result<Look, Failure> {
    let samples = arguments.films.map(|films| judge.samples().saturating_mul(u64::from(films)));
    let seconds = arguments.time.or(samples.is_none().then_some(SECONDS));
    let goal = Goal { samples, seconds };
    let mut meter = Meter::new("judge", goal, arguments.quiet);
    let mut spp = 0u32;
    loop {
        let look = match judge.advance() {
            Err(JudgeError::Stopped) => None,
            look => look?,
        };
        // From the first films on there is something to tell.
        interrupt.hold();
        spp = spp.saturating_add(judge.spp().saturating_mul(2));
        meter.advance(2 * judge.samples(), spp);
        match (look, interrupt.asked()) {
            (Some(look), _) if look.ended.is_some() => {
                meter.finish();
                return Ok(look);
            }
            (_, true) => {
                meter.finish();
                return Ok(judge.look());
            }
            _ => {}
        }
    }
}

/// Writes the files, then says what was found.
fn tell(account: &Account, radiance: &[[f32; 3]]) -> Result<(), Failure> {
    let arguments = account.arguments;
    let film = &account.description.film;
    let window = film.window();
    let names: Vec<String> = arguments.output.iter().map(|output| output.path.display().to_string()).collect();
    let json = account.json(&names);
    let display = marked(radiance, window.size(), f64::from(film.exposure).exp2(), &account.look.means);
    let metadata = account.metadata();
    let picture =
        Picture { size: film.size, window, linear: radiance, display: &display, metadata: &metadata, report: &json };
    for output in &arguments.output {
        output.write(&picture)?;
    }
    if !arguments.quiet {
        account.warnings().iter().for_each(|line| output::note(line));
    }
    match arguments.json {
        true => output::print(&format!("{json}\n")),
        false => output::print(&account.text(&names)),
    }
}

impl From<JudgeError> for Failure {
    fn from(error: JudgeError) -> Self {
        match error {
            JudgeError::Shader(error) => error.into(),
            JudgeError::Engine(error) => Self::engine(error),
            stopped @ JudgeError::Stopped => Self::of(stopped),
        }
    }
}

/// A folder's name as it is told.
fn folder(path: Option<&Path>) -> String {
    path.map_or("built in".to_owned(), |path| path.display().to_string())
}
