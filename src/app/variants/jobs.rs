//! Renders what is wanted, on one adapter or on several at once.

use std::collections::VecDeque;
use std::panic::resume_unwind;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

use super::blank::blank;
use super::record::{Record, State};
use super::shelf::Shelf;
use super::stage::Stage;
use super::survey::{Subject, Survey};
use super::trace::{Traced, retake, trace};
use super::watcher::Watcher;
use crate::app::shared::describe::{Described, quoted};
use crate::components::Render;
use crate::engine::{EngineError, FilmImage};
use crate::gpu::{Gpu, GpuError};
use crate::image::SaveError;
use crate::scene::variants::Family;

/// Threads that write films, at most.
const WRITERS: usize = 4;

/// Pixels of a film of which several are held at once.
const MEDIUM: u64 = 1 << 22;

/// Where results go.
pub trait Board: Sync {
    /// A film is done, or failed. Its files are on the shelf.
    fn put(&self, index: usize, record: Record);
    /// Its files can't be written.
    fn unwritten(&self, error: SaveError);
}

/// What there is to do.
pub struct Plan<'p> {
    pub family: &'p Family,
    pub survey: &'p Survey,
    /// Films that are wanted and not on the shelf, in the order that shares the most.
    pub order: Vec<usize>,
    pub shelf: &'p Shelf,
    pub watcher: &'p Watcher,
}

/// Parts of the order, for threads to take: members of one tree, but for more threads than there are such.
struct Queue {
    parts: Mutex<VecDeque<Vec<usize>>>,
    of: usize,
}

impl Queue {
    fn new(plan: &Plan, threads: usize) -> Self {
        let tree = |index: &usize| plan.survey.found[*index].as_ref().map(|subject| subject.keys.geometry).ok();
        let mut parts: Vec<Vec<usize>> =
            plan.order.chunk_by(|a, b| threads == 1 || tree(a) == tree(b)).map(<[usize]>::to_vec).collect();
        while parts.len() < threads {
            let Some(longest) = (0..parts.len()).max_by_key(|part| parts[*part].len()) else { break };
            let half = parts[longest].len() / 2;
            if half == 0 {
                break;
            }
            let at = parts[longest].len() - half;
            let rest = parts[longest].split_off(at);
            parts.insert(longest + 1, rest);
        }
        Self { parts: Mutex::new(parts.into()), of: plan.order.len() }
    }

    /// The next part.
    fn take(&self) -> Option<Vec<usize>> {
        self.parts.lock().unwrap_or_else(PoisonError::into_inner).pop_front()
    }
}

/// Renders all that is wanted on some adapters, by their numbers; on the one that is chosen by default where there are none. An error is one
/// of a device that can't be opened: all else is a member's.
pub fn run(plan: &Plan, adapters: &[usize], board: &dyn Board) -> Result<(), GpuError> {
    if plan.order.is_empty() {
        return Ok(());
    }
    let queue = Queue::new(plan, adapters.len().max(1));
    let begun = Mutex::new(0);
    if adapters.is_empty() {
        return work(plan, &queue, &begun, &Gpu::open, board);
    }
    std::thread::scope(|scope| {
        let (queue, begun) = (&queue, &begun);
        let threads: Vec<_> = adapters
            .iter()
            .map(|number| scope.spawn(move || work(plan, queue, begun, &|| Gpu::open_number(*number), board)))
            .collect();
        // All are waited for; the first error is told.
        let end = |panic| resume_unwind(panic);
        let ends: Vec<_> = threads.into_iter().map(|thread| thread.join().unwrap_or_else(end)).collect();
        ends.into_iter().collect()
    })
}

/// Takes parts until there are none. What is made is written by threads of their own, so that the adapter needn't wait for it.
fn work(
    plan: &Plan,
    queue: &Queue,
    begun: &Mutex<usize>,
    open: &dyn Fn() -> Result<Arc<Gpu>, GpuError>,
    board: &dyn Board,
) -> Result<(), GpuError> {
    std::thread::scope(|scope| {
        let (made, films) = sync_channel(0);
        let films = Arc::new(Mutex::new(films));
        for _ in 0..writers(plan) {
            let films = films.clone();
            scope.spawn(move || {
                let next = || films.lock().unwrap_or_else(PoisonError::into_inner).recv();
                while let Ok(film) = next() {
                    keep(plan, board, film);
                }
            });
        }
        // What can't be handed over any more isn't waited for.
        drop(films);
        trace_all(plan, queue, begun, open, &made, board)
    })
}

/// Threads that write films: one where films are large, since each holds one.
fn writers(plan: &Plan) -> usize {
    let subjects = plan.order.iter().filter_map(|index| plan.survey.found[*index].as_ref().ok());
    let pixels = subjects.map(|subject| subject.description.film.window().size().as_u64vec2().element_product()).max();
    match pixels {
        Some(..=MEDIUM) => std::thread::available_parallelism().map_or(1, usize::from).min(WRITERS),
        _ => 1,
    }
}

/// A film that is done, and is to be written.
type Film<'p> = (usize, &'p Subject, Made);

fn keep(plan: &Plan, board: &dyn Board, (index, subject, (record, traced, metadata)): Film) {
    match plan.shelf.keep(subject, &record, &traced, &metadata) {
        Ok(()) => {
            plan.watcher.interrupt.hold();
            board.put(index, record);
        }
        Err(error) => board.unwritten(error),
    }
}

fn trace_all<'p>(
    plan: &'p Plan,
    queue: &Queue,
    begun: &Mutex<usize>,
    open: &dyn Fn() -> Result<Arc<Gpu>, GpuError>,
    films: &SyncSender<Film<'p>>,
    board: &dyn Board,
) -> Result<(), GpuError> {
    let mut gpu = open()?;
    let mut stage: Option<Stage> = None;
    while let Some(part) = queue.take() {
        let mut previous: Option<(&Subject, Record)> = None;
        for index in part {
            let Ok(subject) = &plan.survey.found[index] else { continue };
            if plan.watcher.interrupt.requested() {
                return Ok(());
            }
            let number = {
                let mut begun = begun.lock().unwrap_or_else(PoisonError::into_inner);
                *begun += 1;
                *begun
            };
            plan.watcher.begin(&subject.member.name, number, queue.of);
            let before = previous.take();
            let mut made = member(plan, &gpu, &mut stage, subject, before.as_ref());
            if let Err(EngineError::Gpu(GpuError::Lost { .. })) = made {
                // On a device of its own, once more.
                stage = None;
                gpu = open()?;
                made = member(plan, &gpu, &mut stage, subject, None);
            }
            match made {
                Ok(None) => return Ok(()),
                Ok(Some(made)) => {
                    previous = Some((subject, made.0.clone()));
                    // It is taken as long as this end is there.
                    let _ = films.send((index, subject, made));
                }
                Err(error) => board.put(index, failed(plan.family, subject, &error)),
            }
            plan.watcher.end();
        }
    }
    Ok(())
}

type Made = (Record, FilmImage, Vec<(&'static str, String)>);

/// Renders a member after another one; none after a signal.
fn member(
    plan: &Plan,
    gpu: &Arc<Gpu>,
    stage: &mut Option<Stage>,
    subject: &Subject,
    before: Option<&(&Subject, Record)>,
) -> Result<Option<Made>, EngineError> {
    let codes = &plan.survey.codes;
    if stage.is_none() {
        let mut opened = Stage::open(gpu.clone(), codes, subject)?;
        opened.engine.on_compiling(plan.watcher.compiling());
        *stage = Some(opened);
    }
    let Some(stage) = stage else { return Ok(None) };
    let tally = stage.tally();
    let render = subject.description.render;
    let alike = before.filter(|(other, _)| other.keys.shares_film(&subject.keys));
    let same = alike.filter(|(other, _)| other.goal == subject.goal);
    let mut taken = None;
    if let Some((other, record)) = same
        && let Some(last) = record.snapshots.last()
    {
        stage.put(codes, subject, Render { spp: last.spp, ..render })?;
        let name = record.film_of.clone().unwrap_or_else(|| other.member.name.clone());
        taken = retake(stage, &tally)?
            .map(|(film, bad_samples)| (Traced { film, snapshots: record.snapshots.clone(), bad_samples }, Some(name)));
    }
    let (traced, film_of) = match taken {
        Some(taken) => taken,
        None => {
            stage.put(codes, subject, render)?;
            let Some(traced) = trace(stage, &tally, render, &subject.goal, plan.watcher)? else { return Ok(None) };
            let went_on = alike.filter(|_| !stage.began(&tally));
            (traced, went_on.map(|(other, _)| other.member.name.clone()))
        }
    };
    let described = Described {
        path: plan.family.scene_of(&subject.member),
        description: &subject.description,
        defines: &subject.member.defines,
        shaders: plan.survey.shaders.as_deref(),
        window: traced.film.window,
        spp: traced.film.spp,
        adapter: &stage.adapter,
    };
    let record = Record {
        state: State::Done,
        snapshots: traced.snapshots,
        mean: traced.film.mean,
        bad_samples: traced.bad_samples,
        adapter: stage.adapter.clone(),
        film_of,
        work: stage.work(&tally, subject.read),
        repeat: repeat(plan.family, plan.survey, subject, &described),
        ..blank(subject)
    };
    Ok(Some((record, traced.film, described.metadata())))
}

/// The command that renders a member alone. `render` takes folders of shaders that are whole.
pub fn repeat(family: &Family, survey: &Survey, subject: &Subject, described: &Described) -> String {
    if subject.member.shaders.is_none() {
        return described.repeat();
    }
    let [file, name] = [&family.path.display().to_string(), &subject.member.name].map(|word| quoted(word));
    let command = match family.fps {
        Some(fps) => format!("lucerna animate {file} --frames {name} --fps {fps}"),
        None => format!("lucerna variants {file} --only {name}"),
    };
    command + &survey.flags
}

/// A member that broke while it was rendered.
fn failed(family: &Family, subject: &Subject, error: &EngineError) -> Record {
    let place = &subject.member.place;
    let state = State::Failed {
        message: error.to_string(),
        file: Some(family.path.display().to_string()),
        line: place.line,
        column: place.column,
    };
    Record { state, ..blank(subject) }
}

/// Samples of all pixels that a film is expected to have.
pub fn samples(subject: &Subject) -> u64 {
    let size = subject.description.film.window().size();
    u64::from(size.x) * u64::from(size.y) * u64::from(subject.description.render.spp)
}
