//! All that is done about a family: its members loaded, those that are wanted rendered, and answers.

use std::path::PathBuf;

use super::answers::numbers::state;
use super::board::Answers;
use super::flags::FamilyFlags;
use super::jobs::{self, Plan};
use super::record::{Record, State};
use super::shelf::Shelf;
use super::survey::{Survey, order, survey};
use super::wanted::Wanted;
use super::watcher::Watcher;
use super::{against, blank, list, movie};
use crate::app::shared::failure::show;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::progress::Goal as Extent;
use crate::app::{Exit, Failure};
use crate::gpu::adapters;
use crate::scene::variants::{Family, Goal};
use crate::scene::{Assets, Diagnostic};

/// What is asked of a family.
pub struct Request<'r> {
    pub family: &'r Family,
    pub flags: &'r FamilyFlags,
    pub wanted: Wanted,
    /// Gets everything.
    pub folder: PathBuf,
}

impl Request<'_> {
    /// Loads all members. Scenes alone hold what they need of the assets from there on.
    pub fn survey(&self, assets: Assets) -> Result<Survey, Failure> {
        let survey = survey(self.family, &assets, self.flags)?;
        if !self.flags.quiet {
            self.family.warnings.iter().chain(&survey.warnings).for_each(|warning: &Diagnostic| show(warning));
        }
        Ok(survey)
    }
}

/// Loads all members, renders those that are not done, and answers.
pub fn produce(request: &Request, assets: Assets, interrupt: Interrupt) -> Result<Exit, Failure> {
    let Request { family, flags, wanted, folder } = request;
    let survey = request.survey(assets)?;
    if flags.list {
        return list::print(family, &survey, folder, wanted);
    }
    let shelf = Shelf::open(folder).map_err(Failure::of)?;
    let answers = Answers::new(family, &survey.found, folder.clone());
    let order = missing(request, &survey, &shelf, &answers);
    render(request, &survey, order, &shelf, &answers, interrupt)
}

/// The films to be made, in their order. Those on the shelf are taken up.
fn missing(request: &Request, survey: &Survey, shelf: &Shelf, answers: &Answers) -> Vec<usize> {
    let mut order = order(&survey.found);
    order.retain(|index| {
        let Ok(subject) = &survey.found[*index] else { return false };
        match shelf.find(subject) {
            Some(record) => {
                // The order of members, and what they are called on the axes, may be others now.
                let held = blank::missing(&subject.member);
                answers.set(*index, Record { at: held.at, settings: held.settings, ..record });
                false
            }
            None => subject.is_reference || request.wanted.has(*index, &subject.member.name),
        }
    });
    order
}

fn render(
    request: &Request,
    survey: &Survey,
    order: Vec<usize>,
    shelf: &Shelf,
    answers: &Answers,
    interrupt: Interrupt,
) -> Result<Exit, Failure> {
    let Request { family, flags, .. } = *request;
    let adapters = numbers(flags.jobs)?;
    let (extent, counted) = extent(survey, &order, flags.jobs);
    let watcher = Watcher::new(&family.name, extent, counted, interrupt, flags.quiet);
    let rendered = order.len();
    let ended = jobs::run(&Plan { family, survey, order, shelf, watcher: &watcher }, &adapters, answers);
    watcher.finish();
    watcher.interrupt.hold();
    let interrupt = &watcher.interrupt;
    answers.with(|answer, own| {
        if let Some(name) = answer.reference.clone() {
            let remark = against::compare(&shelf.folder, &survey.found, &mut answer.records, &name, own.as_ref());
            answer.remarks.extend(remark);
        }
        if let Some(fps) = family.fps.filter(|_| !interrupt.requested()) {
            answer.remarks.push(movie::make(&shelf.folder, answer, &request.wanted, fps, interrupt));
        }
        answer.interrupted = interrupt.requested();
    });
    answers.write();
    tell(request, answers, rendered)?;
    ended?;
    Ok(exit(request, answers, interrupt.requested()))
}

/// How it ended.
pub fn exit(request: &Request, answers: &Answers, interrupted: bool) -> Exit {
    let failed = answers.with(|answer, reference| {
        let is_failed = |record: &Record| matches!(record.state, State::Failed { .. });
        let mut records = answer.records.iter().enumerate();
        records.any(|(place, record)| is_failed(record) && request.wanted.has(place, &record.name))
            || reference.as_ref().is_some_and(is_failed)
    });
    match (failed || !answers.is_whole(), interrupted) {
        (_, true) => Exit::Interrupted,
        (true, false) => Exit::Failed,
        (false, false) => Exit::Done,
    }
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
            (Extent { samples: None, seconds: Some(seconds / f64::from(jobs)), error: None }, false)
        }
        Some(Goal::Error(_)) => (Extent { samples: Some(order.len() as u64), seconds: None, error: None }, true),
        Some(Goal::Samples(_)) | None => {
            let samples = subjects().map(jobs::samples).fold(0, u64::saturating_add);
            (Extent { samples: Some(samples), seconds: None, error: None }, false)
        }
    }
}

/// Says what came of it.
pub fn tell(request: &Request, answers: &Answers, rendered: usize) -> Result<(), Failure> {
    answers.with(|answer, reference| {
        if request.flags.json {
            let text = serde_json::to_string_pretty(answer).unwrap_or_default();
            return output::print(&(text + "\n"));
        }
        let count = |is: fn(&State) -> bool| answer.records.iter().filter(|record| is(&record.state)).count();
        let done = count(|state| matches!(state, State::Done));
        let mut text = format!("{}: {done} of {} {}", answer.name, answer.records.len(), request.family.word());
        text += &match rendered {
            0 => ", nothing had to be rendered\n".to_owned(),
            _ => "\n".to_owned(),
        };
        answer.remarks.iter().for_each(|remark| text += &format!("  {remark}\n"));
        let failed = |record: &&Record| matches!(record.state, State::Failed { .. });
        for record in answer.records.iter().filter(failed) {
            text += &format!("  {} failed: {}\n", record.name, state(record).1);
        }
        for record in reference.iter().filter(failed) {
            text += &format!("  the reference's own film failed: {}\n", state(record).1);
        }
        text += &format!("  {}\n", request.folder.display());
        output::print(&text)
    })
}
