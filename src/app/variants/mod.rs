//! Renders the members of a family of scenes, each as its scene alone would be, and answers with pictures, tables and a page.
//!
//! | file | what it does |
//! |---|---|
//! | `survey`, `keys`, `code` | loads all members without a device: what is wrong, what they share, in which order |
//! | `jobs`, `stage`, `trace` | renders them on one engine an adapter, which exchanges what differs |
//! | `shelf` | keeps what is done, and finds it again |
//! | `board`, `against`, `record` | what is known of all members, also against the reference |
//! | `answers` | tables, sheet and page |
//! | `race` | lets them compete instead |
//! | `list` | says what would be done |

mod against;
pub mod answers;
mod arguments;
mod blank;
mod board;
mod code;
pub mod find;
mod jobs;
mod keys;
mod list;
mod race;
pub mod record;
mod shelf;
mod stage;
mod survey;
mod trace;
mod watcher;

pub use arguments::VariantsArguments;

use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::progress::Goal as Extent;
use crate::app::{Exit, Failure};
use crate::gpu::adapters;
use crate::scene::variants::{self, Family, Goal};
use crate::scene::{Assets, Diagnostic};
use answers::numbers::state;
use board::Answers;
use jobs::{Board, Plan};
use record::State;
use shelf::Shelf;
use survey::{Survey, order, survey};
use watcher::Watcher;

/// Loads all members, renders those that are not done, and answers.
pub fn run(arguments: &VariantsArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let path = find::find(&arguments.family)?;
    let assets = Assets::new();
    let family = variants::plan(&path, &arguments.defines(), &assets)?;
    arguments.check(&family)?;
    let mut survey = survey(&family, &assets, arguments)?;
    // From here on, scenes alone hold what they need.
    drop(assets);
    if !arguments.quiet {
        family.warnings.iter().chain(&survey.warnings).for_each(|warning: &Diagnostic| show(warning));
    }
    let mut folder = arguments.out.join(&family.name);
    if arguments.race {
        // What a race keeps is not what is rendered.
        folder.push("race");
    }
    if arguments.list {
        return list::print(&family, &survey, &folder, arguments);
    }
    let shelf = Shelf::open(&folder).map_err(Failure::of)?;
    let answers = Answers::new(&family, &survey.found, folder);
    if arguments.race {
        if survey.codes.len() > 1 {
            survey.codes.limit();
        }
        return compete(&family, &survey, &shelf, &answers, arguments, interrupt);
    }
    let order = wanted(&family, &survey, &shelf, &answers, arguments);
    render(&family, &survey, order, &shelf, &answers, arguments, interrupt)
}

/// The films to be made, in their order. Those on the shelf are taken up.
fn wanted(
    family: &Family,
    survey: &Survey,
    shelf: &Shelf,
    answers: &Answers,
    arguments: &VariantsArguments,
) -> Vec<usize> {
    let mut order = order(&survey.found);
    order.retain(|index| {
        let Ok(subject) = &survey.found[*index] else { return false };
        match shelf.find(subject) {
            Some(record) => {
                // The order of members, and what they are called on the axes, may be others now.
                let held = blank::missing(&subject.member);
                answers.set(*index, record::Record { at: held.at, settings: held.settings, ..record });
                false
            }
            None => *index >= family.members.len() || arguments.wants(&subject.member.name),
        }
    });
    order
}

fn render(
    family: &Family,
    survey: &Survey,
    order: Vec<usize>,
    shelf: &Shelf,
    answers: &Answers,
    arguments: &VariantsArguments,
    interrupt: Interrupt,
) -> Result<Exit, Failure> {
    let adapters = numbers(arguments.jobs)?;
    let (extent, counted) = extent(survey, &order, arguments.jobs);
    let watcher = Watcher::new(&family.name, extent, counted, interrupt, arguments.quiet);
    let rendered = order.len();
    let ended = jobs::run(&Plan { family, survey, order, shelf, watcher: &watcher }, &adapters, answers);
    watcher.finish();
    watcher.interrupt.hold();
    let interrupted = watcher.interrupt.requested();
    answers.with(|answer, own| {
        answer.interrupted = interrupted;
        if let Some(name) = answer.reference.clone() {
            let remark = against::compare(&shelf.folder, &survey.found, &mut answer.records, &name, own.as_ref());
            answer.remarks.extend(remark);
        }
    });
    answers.write();
    tell(answers, shelf, rendered, arguments)?;
    ended?;
    Ok(exit(answers, arguments, interrupted))
}

/// How it ended.
fn exit(answers: &Answers, arguments: &VariantsArguments, interrupted: bool) -> Exit {
    let failed = answers.with(|answer, reference| {
        let is_failed = |record: &record::Record| matches!(record.state, State::Failed { .. });
        answer.records.iter().any(|record| is_failed(record) && arguments.wants(&record.name))
            || reference.as_ref().is_some_and(is_failed)
    });
    match (failed || !answers.is_whole(), interrupted) {
        (_, true) => Exit::Interrupted,
        (true, false) => Exit::Failed,
        (false, false) => Exit::Done,
    }
}

/// Lets members compete.
fn compete(
    family: &Family,
    survey: &Survey,
    shelf: &Shelf,
    answers: &Answers,
    arguments: &VariantsArguments,
    interrupt: Interrupt,
) -> Result<Exit, Failure> {
    let mut order = order(&survey.found);
    let wants = |index: &usize| survey.found[*index].as_ref().is_ok_and(|found| arguments.wants(&found.member.name));
    order.retain(wants);
    let extent = Extent { samples: Some(u64::from(arguments.rounds)), seconds: arguments.time.last().copied() };
    let watcher = Watcher::new(&family.name, extent, true, interrupt, arguments.quiet);
    let raced = race::run(survey, &order, arguments, &watcher);
    watcher.finish();
    let raced = raced?;
    watcher.interrupt.hold();
    for (index, record, film) in raced.records(family, survey) {
        if let (Some((film, metadata)), Ok(subject)) = (film, &survey.found[index])
            && let Err(error) = shelf.keep(subject, &record, &film, &metadata)
        {
            answers.unwritten(error);
        }
        answers.set(index, record);
    }
    answers.with(|answer, _| {
        answer.interrupted = raced.interrupted;
        // Members are compared with each other.
        answer.reference = None;
    });
    answers.write();
    if !arguments.json {
        output::print(&race::text(&raced))?;
    }
    tell(answers, shelf, order.len(), arguments)?;
    Ok(exit(answers, arguments, raced.interrupted))
}

/// The adapters to render on; none for the one that is chosen by default.
fn numbers(jobs: u32) -> Result<Vec<usize>, Failure> {
    let jobs = jobs as usize;
    if jobs == 1 {
        return Ok(Vec::new());
    }
    let known = adapters().len();
    if jobs > known {
        let help = "`lucerna doctor` lists them";
        return Err(Failure::usage(format!("--jobs {jobs}: there are only {known} adapters"), help));
    }
    Ok((0..jobs).collect())
}

/// What all films are expected to take; and whether it is members that are counted, where nothing else is known before.
fn extent(survey: &Survey, order: &[usize], jobs: u32) -> (Extent, bool) {
    let subjects = || order.iter().filter_map(|index| survey.found[*index].as_ref().ok());
    match subjects().next().map(|subject| &subject.goal) {
        Some(Goal::Seconds(_)) => {
            let last = |goal: &Goal| match goal {
                Goal::Seconds(seconds) => seconds.last().copied().unwrap_or(0.0),
                Goal::Samples(_) | Goal::Error(_) => 0.0,
            };
            let seconds: f64 = subjects().map(|subject| last(&subject.goal)).sum();
            (Extent { samples: None, seconds: Some(seconds / f64::from(jobs)) }, false)
        }
        Some(Goal::Error(_)) => (Extent { samples: Some(order.len() as u64), seconds: None }, true),
        Some(Goal::Samples(_)) | None => {
            let samples = subjects().map(jobs::samples).fold(0, u64::saturating_add);
            (Extent { samples: Some(samples), seconds: None }, false)
        }
    }
}

/// Says what came of it.
fn tell(answers: &Answers, shelf: &Shelf, rendered: usize, arguments: &VariantsArguments) -> Result<(), Failure> {
    answers.with(|answer, reference| {
        if arguments.json {
            let text = serde_json::to_string_pretty(answer).unwrap_or_default();
            return output::print(&(text + "\n"));
        }
        let count = |is: fn(&State) -> bool| answer.records.iter().filter(|record| is(&record.state)).count();
        let done = count(|state| matches!(state, State::Done));
        let mut text = format!("{}: {done} of {} members", answer.name, answer.records.len());
        text += &match rendered {
            0 => ", nothing had to be rendered\n".to_owned(),
            _ => "\n".to_owned(),
        };
        answer.remarks.iter().for_each(|remark| text += &format!("  {remark}\n"));
        let failed = |record: &&record::Record| matches!(record.state, State::Failed { .. });
        for record in answer.records.iter().filter(failed) {
            text += &format!("  {} failed: {}\n", record.name, state(record).1);
        }
        for record in reference.iter().filter(failed) {
            text += &format!("  the reference's own film failed: {}\n", state(record).1);
        }
        text += &format!("  {}\n", shelf.folder.display());
        output::print(&text)
    })
}
