//! `lucerna judge`: whether an edit of the shaders made the estimator better, worse or wrong.

mod analysis;
mod arguments;
mod bisect;
mod clock;
mod commits;
mod core;
mod error;
mod mark;
mod pause;
mod report;
mod series;
mod short;
mod side;
pub mod sizing;

pub use self::core::{Judge, Plan, SECONDS, WITHIN};
pub use analysis::{Analysis, End, Unknown, Verdict};
pub use arguments::JudgeArguments;
pub use bisect::{answer as bisect_answer, is_for_bisect};
pub use clock::Control;
pub use commits::Commits;
pub use error::JudgeError;
pub use mark::marked;
pub use pause::Pause;
pub use series::Estimator;

use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::parameters;
use crate::app::shared::pictures::watch_pictures;
use crate::app::shared::progress::{Goal, Meter, clock};
use crate::app::shared::scene::choose_camera;
use crate::app::{Exit, Failure};
use crate::gpu::Gpu;
use crate::image::{Outputs, Picture};
use crate::scene::{self, Loaded, Loading};
use crate::shader::Library;
use commits::CommitError;
use report::JudgeSummary;

/// What is said of code that is the same.
pub const UNCHANGED: &str = "nothing changed in what this scene runs";

/// Judges until all is clear or the time is over, and reports.
pub fn run(arguments: &JudgeArguments) -> Result<Exit, Failure> {
    if arguments.bisect { bisect::answer(|| judge(arguments)) } else { judge(arguments) }
}

fn judge(arguments: &JudgeArguments) -> Result<Exit, Failure> {
    let begin = Instant::now();
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let (path, Loaded { description, files, shader_places, .. }) = describe(arguments)?;
    let ([old, new], names) = sides(arguments)?;
    parameters::check_either(&description.shader, &shader_places, [&old, &new])?;
    let (mut outputs, prepared) = output::prepare(&arguments.output, &files)?;
    let gpu = Gpu::open()?;
    let mut judge = match Judge::open(&gpu, [&old, &new], &description, arguments.plan(begin), interrupt.flag()) {
        Err(JudgeError::Stopped) => return Ok(Exit::Interrupted),
        judge => judge?,
    };
    if !judge.changed() && !arguments.force {
        output::print(&report::unchanged(UNCHANGED, arguments.json))?;
        return Ok(Exit::Done);
    }
    let analysis = watch(&mut judge, arguments, &interrupt)?;
    let summary = JudgeSummary {
        arguments,
        names: &names,
        path: &path,
        scene: &description.name,
        film: judge.film(),
        adapter: gpu.name(),
        changed: judge.changed(),
        analysis: &analysis,
    };
    let saved = tell(&summary, &judge.pictures()[1], &mut outputs)?;
    Ok(match (&analysis.verdict, analysis.ended) {
        (Verdict::Differ, _) => Exit::MeansDiffer,
        _ if !(saved && prepared) => Exit::Failed,
        (_, None) => Exit::Interrupted,
        (Verdict::CannotTell(_), _) => Exit::CannotTell,
        (Verdict::Agree(_), _) => Exit::Done,
    })
}

/// The shaders to judge by, and those to be judged; and what they are called.
fn sides(arguments: &JudgeArguments) -> Result<([Library; 2], [String; 2]), Failure> {
    let folder = |path: &Path| Ok::<_, Failure>((Library::open(path)?, path.display().to_string()));
    let commit = |name: &str| commits::read(&arguments.new, name);
    let (old, new) = match &arguments.git {
        // That there is nothing to judge by is no fault of what is judged.
        Some(Commits { old, new: Some(new) }) => (commit(old).map_err(Failure::of)?, commit(new)?),
        Some(Commits { old, new: None }) => (commit(old).map_err(Failure::of)?, folder(&arguments.new)?),
        None => {
            let built_in = || Ok((Library::embedded(), "built in".to_owned()));
            (arguments.old.as_deref().map_or_else(built_in, folder)?, folder(&arguments.new)?)
        }
    };
    Ok(([old.0, new.0], [old.1, new.1]))
}

/// The scene as it is to be judged, with its path and all that was read for it.
fn describe(arguments: &JudgeArguments) -> Result<(PathBuf, Loaded), Failure> {
    let path = scene::find(&arguments.scene)?;
    let tell = watch_pictures(arguments.quiet);
    let mut loaded = scene::load_with(&path, &arguments.define, &Loading { tell: &tell, ..Loading::default() })?;
    if !arguments.quiet {
        loaded.warnings.iter().for_each(|warning| show(warning));
    }
    let description = &mut loaded.description;
    if let Some(name) = &arguments.camera {
        choose_camera(description, name)?;
    }
    if let Some(size) = arguments.size {
        description.film.size = size;
        // A crop in pixels is one of the scene's own size.
        description.film.crop = None;
    }
    Ok((path, loaded))
}

/// Traces until an analysis ends it, or a signal does.
fn watch(judge: &mut Judge, arguments: &JudgeArguments, interrupt: &Interrupt) -> Result<Analysis, Failure> {
    let goal = Goal { samples: arguments.films.map(u64::from), seconds: judge.seconds_left(), error: None };
    let mut meter = Meter::new("judge", goal, arguments.quiet);
    let analysis = loop {
        match judge.advance() {
            Err(JudgeError::Stopped) => break judge.analyse(),
            Ok(Some(analysis)) if analysis.ended.is_some() => break analysis,
            step => step?,
        };
        // From the first films on there is something to report.
        interrupt.hold();
        meter.show(judge.films() as u64, &standing(judge));
    };
    // Also of an analysis that ended it before the first films were through: what is written is written whole.
    interrupt.hold();
    meter.finish();
    Ok(analysis)
}

/// What goes on, for a user who waits.
pub fn standing(judge: &Judge) -> String {
    let (films, size, spp) = (judge.films(), judge.film().window().size(), judge.spp());
    let left = judge.seconds_left().map_or(String::new(), |left| format!(", {} left", clock(left)));
    format!("{films} films of {spp} spp each at {}x{}{left}", size.x, size.y)
}

/// Writes the files, then says what was found; whether all files were written.
fn tell(summary: &JudgeSummary, radiance: &[[f32; 3]], outputs: &mut Outputs) -> Result<bool, Failure> {
    let arguments = summary.arguments;
    let film = &summary.film;
    let window = film.window();
    let display = marked(radiance, window.size(), f64::from(film.exposure).exp2(), &summary.analysis.means);
    let metadata = summary.metadata();
    let report = &serde_json::Value::Null;
    let picture = Picture { size: film.size, window, linear: radiance, display: &display, metadata: &metadata, report };
    let whole = output::all_written(outputs.write(&picture, |written| summary.json(&written.names())));
    let names = outputs.names();
    if !arguments.quiet {
        summary.warnings().iter().for_each(|line| output::note(line));
    }
    match arguments.json {
        true => output::print(&format!("{}\n", summary.json(&names)))?,
        false => output::print(&summary.text(&names))?,
    }
    Ok(whole)
}

impl From<CommitError> for Failure {
    fn from(error: CommitError) -> Self {
        // That a commit has none is its own fault; all else is not.
        let exit = if matches!(error, CommitError::NoFolder { .. }) { Exit::BrokenShaders } else { Exit::Failed };
        Self { exit, ..Self::of(error) }
    }
}

impl Failure {
    /// Of the shaders to judge by: where they are broken, nothing can be judged.
    fn of_old(failure: Failure) -> Self {
        let exit = if failure.exit == Exit::BrokenShaders { Exit::Failed } else { failure.exit };
        Self { exit, ..failure }
    }
}

impl From<JudgeError> for Failure {
    fn from(error: JudgeError) -> Self {
        match error {
            JudgeError::Shader(error) => error.into(),
            JudgeError::Engine(error) => Self::engine(error),
            JudgeError::OldShader(error) => Self::of_old(error.into()),
            JudgeError::OldEngine(error) => Self::of_old(Self::engine(error)),
            stopped @ JudgeError::Stopped => Self::of(stopped),
        }
    }
}
