//! `lucerna stress`: what must hold of the numbers, measured here and now.

mod arguments;
mod progress;
mod report;

pub use arguments::StressArguments;

use std::time::Instant;

use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::{Exit, Failure};
use crate::gpu::Gpu;
use crate::image::file;
use crate::shader::Library;
use crate::stress::planted::{FAULTS, Fault, caught};
use crate::stress::rows::ALL;
use crate::stress::{Lab, Outcome, Row, Scale, Verdict, judge};
use progress::Progress;
use report::{Head, Planted};

/// Measures the rows that are wanted, and shows each as soon as it is measured.
pub fn run(arguments: &StressArguments) -> Result<Exit, Failure> {
    if arguments.list {
        output::print(&report::list(ALL))?;
        return Ok(Exit::Done);
    }
    let rows = wanted(&arguments.only)?;
    Interrupt::listen(Exit::Interrupted);
    let library = match &arguments.shaders {
        Some(folder) => Library::open(folder)?,
        None => Library::shipped(),
    };
    let gpu = Gpu::open()?;
    let scale = match (arguments.planted, arguments.full) {
        (true, _) => Scale::Test,
        (false, true) => Scale::Full,
        (false, false) => Scale::Quick,
    };
    let progress = Progress::new(arguments.quiet);
    let open = |library: Library, name: &str| {
        let lab = Lab::new(gpu.clone(), scale).with_library(library).with_progress(progress.of(name));
        lab.with_edits(arguments.seed, arguments.time)
    };
    let head = Head { adapter: gpu.name(), scale, begin: Instant::now() };
    if arguments.planted {
        let faults: Vec<&Fault> = FAULTS.iter().filter(|fault| is_wanted(fault, &rows)).collect();
        return plant(arguments, &head, &faults, |library| open(library, "planted"), &library, &progress);
    }
    let mut outcomes = Vec::new();
    if !arguments.json {
        output::print(&report::head(&head))?;
    }
    for row in rows {
        let outcome = judge(row, &open(library.clone(), row.name));
        progress.clear();
        if !arguments.json {
            output::print(&report::line(&outcome))?;
        }
        outcomes.push(outcome);
        // Rows take minutes: what is known is kept, whatever ends the process.
        save(arguments, &report::json(&head, &outcomes))?;
    }
    let json = report::json(&head, &outcomes);
    finish(arguments, &json, &report::end(&head, &outcomes))?;
    Ok(exit(&outcomes))
}

/// Whether any of the rows is to see a mistake.
fn is_wanted(fault: &Fault, rows: &[&'static Row]) -> bool {
    rows.iter().any(|row| fault.seen_by.contains(&row.name))
}

/// Plants each mistake, and shows which rows see it.
fn plant(
    arguments: &StressArguments,
    head: &Head,
    faults: &[&Fault],
    open: impl Fn(Library) -> Lab,
    library: &Library,
    progress: &Progress,
) -> Result<Exit, Failure> {
    let mut planted = Vec::new();
    for fault in faults {
        let outcomes = fault.looked_for(library.clone(), &open);
        progress.clear();
        let found = Planted { name: fault.name, wrong: fault.wrong, outcomes };
        if !arguments.json {
            output::print(&report::planted_line(&found))?;
        }
        planted.push(found);
    }
    finish(arguments, &report::planted_json(head, &planted), &report::planted_end(&planted))?;
    let unseen = planted.iter().any(|fault| !fault.seen());
    Ok(if unseen { Exit::Unstable } else { Exit::Done })
}

/// Prints what comes last, and writes the whole file.
fn finish(arguments: &StressArguments, json: &serde_json::Value, text: &str) -> Result<(), Failure> {
    match arguments.json {
        true => output::print(&format!("{json:#}\n"))?,
        false => output::print(text)?,
    }
    save(arguments, json)
}

/// Writes the file, if one is wanted.
fn save(arguments: &StressArguments, json: &serde_json::Value) -> Result<(), Failure> {
    match &arguments.output {
        Some(path) => file::write_text(path, &format!("{json:#}\n")).map_err(Failure::from),
        None => Ok(()),
    }
}

/// The rows that names or their beginnings mean; without any, all.
fn wanted(names: &[String]) -> Result<Vec<&'static Row>, Failure> {
    for name in names {
        if !ALL.iter().any(|row| row.name.starts_with(name.as_str())) {
            let known: Vec<&str> = ALL.iter().map(|row| row.name).collect();
            let help = format!("rows: {}", known.join(", "));
            return Err(Failure::usage(format!("no row's name begins with `{name}`"), help));
        }
    }
    let is_named = |row: &&Row| names.is_empty() || names.iter().any(|name| row.name.starts_with(name.as_str()));
    Ok(ALL.iter().copied().filter(is_named).collect())
}

fn exit(outcomes: &[Outcome]) -> Exit {
    let mut verdicts = outcomes.iter().map(Outcome::verdict);
    if verdicts.clone().any(|verdict| matches!(verdict, Verdict::Fails(_))) {
        Exit::Unstable
    } else if verdicts.any(|verdict| matches!(verdict, Verdict::CannotTell(_))) {
        Exit::CannotTell
    } else {
        Exit::Done
    }
}

impl Planted<'_> {
    /// Whether any row saw it.
    fn seen(&self) -> bool {
        self.outcomes.as_ref().is_ok_and(|outcomes| outcomes.iter().any(caught))
    }
}
