//! Renders the members of a family of scenes, each as its scene alone would be, and answers with pictures, tables and a page.
//!
//! | file | what it does |
//! |---|---|
//! | `produce` | all that is done about a family; `flags` and `wanted` say what is asked for |
//! | `survey`, `keys`, `code` | loads all members without a device: what is wrong, what they share, in which order |
//! | `jobs`, `stage`, `trace` | renders them on one engine an adapter, which exchanges what differs |
//! | `shelf` | keeps what is done, and finds it again |
//! | `board`, `against`, `record` | what is known of all members, also against the reference |
//! | `answers` | tables, sheet and page |
//! | `movie` | frames to a film, where members are such |
//! | `race` | lets them compete instead |
//! | `list` | says what would be done |

mod against;
pub mod answers;
mod arguments;
mod blank;
mod board;
pub(crate) mod code;
pub mod find;
pub mod flags;
mod jobs;
mod keys;
mod list;
mod movie;
pub mod produce;
mod race;
pub mod record;
mod shelf;
mod stage;
mod survey;
mod trace;
pub mod wanted;
mod watcher;

pub use arguments::VariantsArguments;

use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::app::shared::progress::Goal;
use crate::app::{Exit, Failure};
use crate::scene::Assets;
use crate::scene::variants;
use board::Answers;
use jobs::Board;
use produce::{Request, exit, produce, tell};
use shelf::Shelf;
use survey::order;
use watcher::Watcher;

/// Renders the members of a variant file, or lets them compete.
pub fn run(arguments: &VariantsArguments) -> Result<Exit, Failure> {
    let interrupt = Interrupt::listen(Exit::Interrupted);
    let path = find::find(&arguments.family)?;
    let assets = Assets::new();
    let family = variants::plan(&path, &arguments.flags.defines(), &assets)?;
    arguments.check(&family)?;
    arguments.flags.check()?;
    let mut folder = arguments.out.join(&family.name);
    if arguments.race {
        // What a race keeps is not what is rendered.
        folder.push("race");
    }
    let request = Request { family: &family, flags: &arguments.flags, wanted: arguments.wanted(), folder };
    match arguments.race {
        true => compete(&request, assets, arguments, interrupt),
        false => produce(&request, assets, interrupt),
    }
}

/// Lets members compete.
fn compete(
    request: &Request,
    assets: Assets,
    arguments: &VariantsArguments,
    interrupt: Interrupt,
) -> Result<Exit, Failure> {
    let Request { family, flags, wanted, folder } = request;
    let mut survey = request.survey(assets)?;
    let shelf = Shelf::open(folder).map_err(Failure::of)?;
    let answers = Answers::new(family, &survey.found, folder.clone());
    if survey.codes.len() > 1 {
        survey.codes.limit();
    }
    let mut order = order(&survey.found);
    order.retain(|index| survey.found[*index].as_ref().is_ok_and(|found| wanted.has(*index, &found.member.name)));
    let extent = Goal { samples: Some(u64::from(arguments.rounds)), seconds: flags.time.last().copied(), error: None };
    let watcher = Watcher::new(&family.name, extent, true, interrupt, flags.quiet);
    let raced = race::run(&survey, &order, arguments, &watcher);
    watcher.finish();
    let raced = raced?;
    watcher.interrupt.hold();
    for (index, record, film) in raced.records(family, &survey) {
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
    if !flags.json {
        output::print(&race::text(&raced))?;
    }
    tell(request, &answers, order.len())?;
    Ok(exit(request, &answers, raced.interrupted))
}
