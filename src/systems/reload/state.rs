//! What is watched, what of it runs, and what is on trial.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

use bevy_ecs::prelude::*;

use crate::gpu::{Code, Compiler};
use crate::scene::{SceneDescription, SceneText};
use crate::shader::Library;
use crate::systems::resources::FilmProgress;
use crate::watch::{Linter, Problem, ReloadEvent, Restarts, Sources, Wake, Watch, WatchError};

/// What is watched, what of it runs, and what is on trial.
#[derive(Resource)]
pub struct Reload {
    pub(super) watch: Watch,
    /// The scene as its files were last taken up.
    pub description: Option<SceneDescription>,
    /// The text of its own file, as it was then.
    pub text: SceneText,
    /// What is wrong with shaders and scene as they are on the disk; the engine runs older ones.
    pub problems: Standing,
    /// Not yet fetched.
    pub events: Vec<ReloadEvent>,
    /// What was taken up in this run of the schedule.
    pub(super) taken: Vec<Taken>,
    /// What could not be taken up in it: told after what was.
    pub(super) refused: Vec<ReloadEvent>,
    /// The scene, or the code, had to give way to an older one, and is tried again when the other changes.
    pub(super) retry_scene: bool,
    pub(super) retry_code: bool,
    /// Shaders and scene that were of each other were taken back: nothing else is taken up until they come together again.
    pub(super) undone: bool,
    /// When the save happened whose first pixels are not there yet.
    pub(super) awaited: Option<Instant>,
    /// What other code makes anew, from when it is put in place until the changes of the scene are known.
    pub(super) code_restarts: Restarts,
    pub(super) trial: Trial,
    pub(super) linter: Linter,
    /// What the worker sends stays where it is.
    pub held: bool,
}

/// Problems by what they are about.
#[derive(Default)]
pub struct Standing {
    pub code: Vec<Problem>,
    pub scene: Vec<Problem>,
}

/// Something good that was put in place.
pub(super) struct Taken {
    pub(super) saved: Instant,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Vec<Problem>,
}

/// What to go back to.
#[derive(Default)]
pub(super) struct Trial {
    pub(super) code: Option<Code>,
    /// The code that runs now has shown a whole sample.
    pub(super) passed: bool,
    /// Code and scene are of each other: both go, or neither.
    pub(super) tied: bool,
    /// What the code on trial makes anew.
    pub(super) restarts: Restarts,
    pub(super) scene: Option<(SceneDescription, SceneText)>,
    /// How far the film was that was put aside.
    pub(super) film: Option<FilmProgress>,
    /// The files that are on trial.
    pub(super) files: Vec<PathBuf>,
}

impl Reload {
    /// Starts to watch. `wake` is called, from another thread, when the next step has something to take up.
    pub fn start(sources: Sources, compiler: Compiler, wake: Wake) -> Result<Reload, WatchError> {
        let judged = sources.shaders.as_ref().map(|(_, library)| library.clone());
        let scene = sources.scene.as_ref();
        let (description, text) = scene.map(|scene| (scene.description.clone(), scene.text.clone())).unzip();
        Ok(Reload {
            linter: Linter::new(judged, wake.clone()),
            watch: Watch::start(sources, compiler, wake)?,
            description,
            text: text.unwrap_or_default(),
            problems: Standing::default(),
            events: Vec::new(),
            taken: Vec::new(),
            refused: Vec::new(),
            retry_scene: false,
            retry_code: false,
            undone: false,
            awaited: None,
            code_restarts: Restarts::default(),
            trial: Trial::default(),
            held: false,
        })
    }

    /// Whether the next step has something to take up.
    pub fn waits(&self) -> bool {
        self.watch.waits()
    }

    /// Whether something that was saved is being compiled.
    pub fn compiles(&self) -> bool {
        self.watch.compiles()
    }

    /// Has shaders that ran before run again, whatever the files hold; `current` are those that run.
    pub fn run_again(&self, library: Library, current: &Library) {
        let modules: BTreeSet<&str> = library.modules().chain(current.modules()).collect();
        let other = modules.into_iter().filter(|module| library.hash(module) != current.hash(module));
        let edited = other.map(str::to_owned).collect();
        self.watch.run_again(library, edited);
    }

    /// Has everything read again, changed or not.
    pub fn force(&self) {
        self.watch.force();
    }

    /// Has the scene read again, at once: another one is wanted.
    pub fn choose(&self) {
        self.watch.choose();
    }
}
