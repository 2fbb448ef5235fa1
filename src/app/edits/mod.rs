//! `lucerna edits`: what was saved while windows were open, and what came of it; and the shaders of an edit, in a folder.

mod edit;
mod folder;
mod list;
mod write;

use std::path::PathBuf;

use clap::Args;

pub use edit::{Edit, Kind, Lint, State, Verdict, age, now};
pub use folder::{EditsFolder, Kept, Listed, MOST, PLACE};

use crate::app::shared::output;
use crate::app::shared::values::MORE;
use crate::app::{Exit, Failure};
use crate::scene::printable;

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct EditsArguments {
    /// One edit, by its number [default: list them, the newest first]
    pub number: Option<u32>,
    /// Write the shaders of that edit to a folder
    #[arg(short, long, value_name = "DIR", requires = "number")]
    pub output: Option<PathBuf>,
    /// Write over a folder that is there
    #[arg(long, requires = "output")]
    pub force: bool,
    /// The folder that a window has kept them in
    #[arg(long, value_name = "DIR", default_value = PLACE)]
    pub from: PathBuf,
    /// Print all that is known to stdout as JSON, and nothing else there
    #[arg(long)]
    pub json: bool,
}

/// A folder of edits that can't be read.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{}: can't be read: {source}", folder.display())]
#[diagnostic(help("name the folder that a window keeps edits in: --from DIR"))]
struct Unreadable {
    folder: PathBuf,
    source: std::io::Error,
}

/// Lists, or tells of one, or writes it.
pub fn run(arguments: &EditsArguments) -> Result<Exit, Failure> {
    let folder = EditsFolder::new(&arguments.from);
    let unreadable = |source| Failure::of(Unreadable { folder: arguments.from.clone(), source });
    let listed = folder.list().map_err(unreadable)?;
    listed.unread.iter().for_each(|unread| output::note(&printable(&format!("warning: {unread}: left out"))));
    let Some(number) = arguments.number else {
        output::print(&list::all(&listed.edits, &arguments.from, arguments.json))?;
        return Ok(Exit::Done);
    };
    let Some(kept) = listed.edits.iter().find(|kept| kept.number == number) else {
        let there = match (listed.edits.first(), listed.edits.last()) {
            (Some(first), Some(last)) => {
                format!("there are {} to {}: `lucerna edits` lists them", first.number, last.number)
            }
            _ => format!("{} holds none", arguments.from.display()),
        };
        return Err(Failure::usage(format!("there is no edit {number}"), there));
    };
    if let Some(to) = &arguments.output {
        let others = write::write(&folder, kept, to, arguments.force)?;
        if !others.is_empty() {
            let others = others.join(", ");
            output::note(&format!("warning: {} holds shaders that the edit did not have: {others}", to.display()));
        }
    }
    output::print(&list::one(kept, arguments.output.as_deref(), arguments.json))?;
    Ok(Exit::Done)
}
