//! Puts in place what the worker made, tells what that restarts, and brings back what was there if it fails.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::Instant;

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use super::code::{restart_for_code, restarts_of};
use super::error::{EngineError, no_fault};
use super::phase::Phase;
use super::resources::{Batch, Device, Displayed, FilmProgress, Governor, MaterialSlot, Target, Tree};
use super::restart::start_again;
use crate::components::{Film, Name, ShaderValues};
use crate::gpu::{Code, Compiler, GpuError, GpuTable};
use crate::layout::trace::MaterialRecord;
use crate::scene::{self, Diagnostic, Loaded, SceneDescription, SceneText, Severity};
use crate::shader::{ErrorKind, Library};
use crate::watch::{Linter, News, Outcome, Problem, ReloadEvent, Restarts, Sources, Wake, Watch, WatchError, values};

/// What is watched, what of it runs, and what is on trial.
#[derive(Resource)]
pub struct Reload {
    watch: Watch,
    /// The scene as its files were last taken up.
    pub description: Option<SceneDescription>,
    /// The text of its own file, as it was then.
    pub text: SceneText,
    /// What is wrong with shaders and scene as they are on the disk; the engine runs older ones.
    pub problems: Standing,
    /// Not yet fetched.
    pub events: Vec<ReloadEvent>,
    /// What was taken up in this run of the schedule.
    taken: Vec<Taken>,
    /// What could not be taken up in it: told after what was.
    refused: Vec<ReloadEvent>,
    /// The scene, or the code, had to give way to an older one, and is tried again when the other changes.
    retry_scene: bool,
    retry_code: bool,
    /// Shaders and scene that were of each other were taken back: nothing else is taken up until they come together again.
    undone: bool,
    /// When the save happened whose first pixels are not there yet.
    awaited: Option<Instant>,
    /// What other code makes anew, from when it is put in place until the changes of the scene are known.
    code_restarts: Restarts,
    trial: Trial,
    linter: Linter,
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
struct Taken {
    saved: Instant,
    files: Vec<PathBuf>,
    warnings: Vec<Problem>,
}

/// What to go back to.
#[derive(Default)]
struct Trial {
    code: Option<Code>,
    /// The code that runs now has shown a whole sample.
    passed: bool,
    /// Code and scene are of each other: both go, or neither.
    tied: bool,
    /// What the code on trial makes anew.
    restarts: Restarts,
    scene: Option<(SceneDescription, SceneText)>,
    /// How far the film was that was put aside.
    film: Option<FilmProgress>,
    /// The files that are on trial.
    files: Vec<PathBuf>,
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

/// Where the film and its counters are put aside while other code is on trial.
const ASIDE: [(&str, &str); 2] = [("film", "film_aside"), ("counters", "counters_aside")];

pub fn add_systems(schedule: &mut Schedule) {
    schedule.add_systems(
        (
            take_up_saves.in_set(Phase::Reload),
            tell_what_restarts.after(Phase::Extract).before(Phase::Upload).run_if(no_fault),
            end_trial.after(Phase::Submit).run_if(no_fault),
        )
            .run_if(resource_exists::<Reload>),
    );
}

/// Takes up all that the worker has sent, unless that is held.
fn take_up_saves(world: &mut World) {
    world.resource_scope(|world, mut reload: Mut<Reload>| {
        let linted = reload.linter.take();
        reload.events.extend(linted);
        let news = if reload.held { Vec::new() } else { reload.watch.news() };
        for news in news {
            match news {
                News::Ready(outcome) => take_up(world, &mut reload, *outcome),
                News::Compiling { files, since, given_up, warnings } => {
                    reload.events.push(ReloadEvent::Compiling { files, since, given_up, warnings });
                }
            }
        }
    });
}

fn take_up(world: &mut World, reload: &mut Reload, outcome: Outcome) {
    let Outcome { saved, mut code, mut scene, warnings: slow, tied, again } = refuse_unfit(world, outcome);
    if reload.undone && !tied && (matches!(code, Some((_, Ok(_)))) || matches!(scene, Some((_, Ok(_))))) {
        // It was read before the worker knew.
        code = code.filter(|(_, code)| code.is_err());
        scene = scene.filter(|(_, scene)| scene.is_err());
        reload.watch.choose();
    }
    if tied && matches!((&code, &scene), (Some((_, Ok(_))), Some((_, Ok(_))))) {
        (reload.undone, reload.trial.tied) = (false, true);
    }
    let (mut good, mut bad) = (Vec::new(), Vec::new());
    let (mut any_good, mut problems, mut warnings) = (false, Vec::new(), Vec::new());
    match code {
        Some((files, Ok(code))) => {
            (any_good, good, warnings) = (true, files, slow);
            // What the files hold may be as wrong as before.
            if !again {
                reload.problems.code.clear();
            }
            let unfit = put_code_and_tell_unfit(world, reload, code);
            warnings.extend(unfit.into_iter().filter(|_| scene.is_none()));
            // A scene that had to give way may do so no longer.
            if std::mem::take(&mut reload.retry_scene) {
                reload.force();
            }
        }
        Some((files, Err(found))) => {
            bad = files;
            problems.extend(found.iter().cloned());
            if !again {
                reload.problems.code = found;
            }
        }
        None => {}
    }
    match scene {
        Some((files, Ok(loaded))) => {
            any_good = true;
            good.extend(files);
            reload.problems.scene.clear();
            warnings.extend(put_scene(world, reload, *loaded));
            if std::mem::take(&mut reload.retry_code) {
                reload.force();
            }
        }
        Some((files, Err(found))) => {
            bad.extend(files);
            problems.extend(found.iter().cloned());
            reload.problems.scene = found;
        }
        None => {}
    }
    if any_good {
        reload.trial.files.clone_from(&good);
        reload.taken.push(Taken { saved, files: good, warnings });
    }
    if !problems.is_empty() {
        reload.refused.push(ReloadEvent::Failed { files: bad, problems, since_save: saved.elapsed() });
    }
}

/// Refuses a scene that sets what its shaders have not, or can't be set to; code that is tied to it goes with it.
fn refuse_unfit(world: &World, mut outcome: Outcome) -> Outcome {
    let parameters = match &outcome.code {
        Some((_, Ok(code))) => code.parameters(),
        _ => world.resource::<Device>().0.parameters().clone(),
    };
    let fit = |scene: Box<Loaded>| {
        let unfit = values::unfit(&scene.description.shader, &scene.shader_places, &parameters);
        if unfit.is_empty() { Ok(scene) } else { Err(unfit.into_iter().map(Problem::from).collect()) }
    };
    outcome.scene = outcome.scene.map(|(files, scene)| (files, scene.and_then(fit)));
    if outcome.tied && matches!(outcome.scene, Some((_, Err(_)))) {
        outcome.code = outcome.code.filter(|(_, code)| code.is_err());
    }
    outcome
}

/// Values of parameters that the shaders which run have no use for: edits of shaders may leave such behind.
fn unfit_now(world: &mut World) -> Vec<Diagnostic> {
    let set = world.query::<&ShaderValues>().iter(world).next().cloned().unwrap_or_default();
    values::unfit(&set, &BTreeMap::new(), world.resource::<Device>().0.parameters())
}

/// Puts other code in place. Returns warnings of values that had a use until now, and have none by this code.
fn put_code_and_tell_unfit(world: &mut World, reload: &mut Reload, code: Code) -> Vec<Problem> {
    let before = unfit_now(world);
    put_code(world, reload, code);
    let is_new = |unfit: &Diagnostic| !before.iter().any(|known| known.message == unfit.message);
    let warning = |unfit: Diagnostic| {
        let message = format!("{}; the default counts, if there is one", unfit.message);
        Diagnostic { severity: Severity::Warning, message, ..unfit }.into()
    };
    unfit_now(world).into_iter().filter(is_new).map(warning).collect()
}

/// Runs other code from now on, and puts the film aside that the old code made.
fn put_code(world: &mut World, reload: &mut Reload, code: Code) {
    let (old, changed) = world.resource_mut::<Device>().0.replace(code);
    reload.linter.forget();
    reload.code_restarts = reload.code_restarts.with(restarts_of(&changed));
    if reload.trial.code.is_some() && !reload.trial.passed {
        // What is gone back to is still the last that worked, and the film has samples of both since.
        reload.trial.restarts = reload.trial.restarts.with(reload.code_restarts);
        return;
    }
    reload.trial.code = Some(old);
    // What runs is the same: only what a scene may ask for later is other code.
    reload.trial.passed = reload.code_restarts == Restarts::default() && !reload.trial.tied;
    reload.trial.restarts = reload.code_restarts;
    if reload.code_restarts.film {
        let device = &mut world.resource_mut::<Device>().0;
        let kept = ASIDE.iter().all(|(from, to)| device.copy(from, to).is_ok());
        let progress = world.query::<&FilmProgress>().iter(world).next().copied();
        reload.trial.film = progress.filter(|_| kept);
    }
}

/// Makes the world hold another scene, but for what was edited beside the files and is the same in both. Returns what was
/// not taken as written.
fn put_scene(world: &mut World, reload: &mut Reload, loaded: Loaded) -> Vec<Problem> {
    scene::apply_changes(world, reload.description.as_ref(), &loaded.description);
    let old = reload.description.replace(loaded.description);
    let old_text = std::mem::replace(&mut reload.text, loaded.text);
    if reload.trial.scene.is_none() {
        reload.trial.scene = old.map(|old| (old, old_text));
    }
    loaded.warnings.into_iter().map(Problem::from).collect()
}

/// What a reload may make start anew.
#[derive(SystemParam)]
struct Made<'w, 's> {
    tree: ResMut<'w, Tree>,
    progress: Single<'w, 's, &'static mut FilmProgress, With<Film>>,
    displayed: Res<'w, Displayed>,
    governor: ResMut<'w, Governor>,
}

/// Has made anew what other code makes, beside what extraction found, and tells both.
fn tell_what_restarts(mut reload: ResMut<Reload>, mut made: Made) {
    if !made.progress.begun {
        // The film that is aside is one of another scene, or seen from elsewhere.
        reload.trial.film = None;
    }
    let code = std::mem::take(&mut reload.code_restarts);
    restart_for_code(code, &mut made.tree, &mut made.progress, &mut made.governor);
    let restarts = Restarts {
        tree: !made.tree.built,
        film: !made.progress.begun,
        picture: code.picture || made.displayed.is_changed() && !made.displayed.is_added(),
    };
    for Taken { saved, files, warnings } in std::mem::take(&mut reload.taken) {
        if restarts != Restarts::default() {
            reload.awaited.get_or_insert(saved);
        }
        reload.events.push(ReloadEvent::Reloaded { files, restarts, warnings, since_save: saved.elapsed() });
    }
    let refused = std::mem::take(&mut reload.refused);
    reload.events.extend(refused);
}

/// Tells the first pixels, and ends the trial once every pixel has a sample.
fn end_trial(
    mut reload: ResMut<Reload>,
    batch: Res<Batch>,
    progress: Single<&FilmProgress, With<Film>>,
    device: Res<Device>,
    records: Res<GpuTable<MaterialRecord>>,
    materials: Query<(&Name, &MaterialSlot)>,
) {
    if (!batch.is_empty() || progress.shown.is_some())
        && let Some(saved) = reload.awaited.take()
    {
        reload.events.push(ReloadEvent::FirstPixels { since_save: saved.elapsed() });
        let mut named: Vec<(u32, &Name)> = materials.iter().map(|(name, slot)| (slot.0, name)).collect();
        named.sort_by_key(|(slot, _)| *slot);
        let record = |(slot, name): (u32, &Name)| Some((name.to_string(), *records.rows().get(slot as usize)?));
        let materials = named.into_iter().filter_map(record).collect();
        reload.linter.start(&device.0, materials);
    }
    if progress.samples > 0 {
        reload.trial.scene = None;
        reload.trial.film = None;
        reload.trial.passed = true;
        // What was there before is gone: its scene is, too.
        if std::mem::take(&mut reload.trial.tied) {
            reload.trial.code = None;
        }
    }
}

/// Brings back what was there before what is on trial, if an error may come from that; else gives the error back.
///
/// A loop that does not end shows late where few pixels come to it: code can be taken back for that even after its trial.
pub fn go_back(world: &mut World, error: EngineError) -> Result<(), EngineError> {
    let Some(mut reload) = world.remove_resource::<Reload>() else { return Err(error) };
    let endless = is_endless(&error);
    let lost = matches!(error, EngineError::Gpu(GpuError::Lost { .. }));
    let code = reload.trial.code.take_if(|_| !reload.trial.passed || endless);
    let tied = reload.trial.tied && code.is_some();
    let scene = reload.trial.scene.take_if(|_| tied || !endless || code.is_none());
    if lost || code.is_none() && scene.is_none() {
        world.insert_resource(reload);
        return Err(error);
    }
    let problem = Problem::from(error);
    let (had_code, had_scene) = (code.is_some(), scene.is_some());
    if let Some(code) = code {
        world.resource_mut::<Device>().0.replace(code);
        reload.linter.forget();
        reload.problems.code = vec![problem.clone()];
    }
    if let Some((scene, text)) = scene {
        scene::apply_changes(world, reload.description.as_ref(), &scene);
        (reload.description, reload.text) = (Some(scene), text);
        if !tied {
            reload.problems.scene = vec![problem.clone()];
        }
    }
    // A batch is counted when it is recorded: where the tree failed, it was not traced.
    let untraced = !world.resource::<Tree>().built && !world.resource::<Batch>().is_empty();
    if had_code {
        world.resource_mut::<Tree>().built &= !reload.trial.restarts.tree;
    }
    let target = world.resource::<Target>().0;
    let is_wanted = |film: &FilmProgress| film.most_samples() <= target;
    match reload.trial.film.take().filter(|film| endless && is_wanted(film)) {
        Some(film) => {
            let device = &mut world.resource_mut::<Device>().0;
            let restored = ASIDE.iter().all(|(from, to)| device.copy(to, from).is_ok());
            let film = if restored { FilmProgress { shown: None, ..film } } else { FilmProgress::default() };
            set_progress(world, |progress| *progress = film);
        }
        // Code of the tree or of the picture: the film is what it was.
        None if endless && had_code && !reload.trial.restarts.film => {
            set_progress(world, |progress| match untraced {
                true => progress.restart(),
                false => progress.shown = None,
            });
        }
        None => start_again(world),
    }
    if tied {
        (reload.undone, reload.trial.tied) = (true, false);
        reload.watch.undone();
    } else {
        reload.retry_code |= had_code && !endless;
        reload.retry_scene |= had_scene;
    }
    world.resource_mut::<Governor>().forget();
    let saved = reload.awaited.take().or(reload.taken.first().map(|taken| taken.saved));
    let since_save = saved.map(|saved| saved.elapsed()).unwrap_or_default();
    reload.taken.clear();
    let refused = std::mem::take(&mut reload.refused);
    reload.events.extend(refused);
    let files = reload.trial.files.clone();
    reload.events.push(ReloadEvent::Failed { files, problems: vec![problem], since_save });
    world.insert_resource(reload);
    Ok(())
}

fn set_progress(world: &mut World, change: impl Fn(&mut FilmProgress)) {
    world.query::<&mut FilmProgress>().iter_mut(world).for_each(|mut progress| change(&mut progress));
}

fn is_endless(error: &EngineError) -> bool {
    matches!(error, EngineError::Gpu(GpuError::Shader(error)) if error.kind == ErrorKind::Loop)
}

impl From<EngineError> for Problem {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Gpu(error) => error.into(),
            other => Problem::of(other),
        }
    }
}
