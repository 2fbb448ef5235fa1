//! The record of all that is saved while the window is open, kept in memory and on the disk, and judged while nothing else needs the device.
//!
//! | file | what it holds |
//! |---|---|
//! | `record` | pure: rows, the one that runs, and which row a verdict is of |
//! | `attention` | pure: when the device is free for judging |
//! | `keeper` | the thread that writes the record to the disk |
//! | `following` | the session: saves become rows, and going back |
//! | `judging_by_itself` | the session: judging that begins by itself, steps aside, and goes on |

mod attention;
mod following;
mod judging_by_itself;
mod keeper;
pub mod record;

use std::path::PathBuf;
use std::time::{Duration, Instant};

pub use attention::{Attention, REST};

use crate::app::edits::{Edit, Kind, Lint, State, Verdict, now};
use crate::shader::Library;
use keeper::{Keeper, Said};
use record::{Record, RowId};

/// What the end of the window waits for, at most, so that the last edit is on the disk.
const FLUSH: Duration = Duration::from_secs(1);

/// The record, and what is done with it.
pub struct Edits {
    pub record: Record,
    keeper: Keeper,
    /// The opening is on its way to the disk: with the first edit, so that a window without edits leaves nothing.
    kept: bool,
    pub attention: Attention,
    /// Edits are judged without being asked for it.
    pub automatic: bool,
    /// The row that a user did not want to be judged any more.
    declined: Option<RowId>,
}

impl Edits {
    /// Nothing is edited yet. `scene` is the scene's name; `wake` wakes the window.
    pub fn new(
        scene: &str,
        shaders: Library,
        folder: PathBuf,
        automatic: bool,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let opened = Edit {
            kind: Kind::Opened,
            scene: scene.to_owned(),
            files: Vec::new(),
            saved: now(),
            pixels: None,
            lint: Lint::NotLinted,
            verdict: Verdict::new(State::None, ""),
        };
        Self {
            record: Record::new(opened, shaders),
            keeper: Keeper::new(folder, wake),
            kept: false,
            attention: Attention::new(Instant::now()),
            automatic,
            declined: None,
        }
    }

    /// Has a row kept that is new.
    fn keep(&mut self, id: RowId) {
        if !std::mem::replace(&mut self.kept, true) {
            self.keep_row(0);
        }
        self.keep_row(id);
    }

    fn keep_row(&self, id: RowId) {
        if let Some(row) = self.record.row(id) {
            let before = row.before.as_ref().map(|(before, _)| *before);
            self.keeper.keep(id, &row.edit, before, row.shaders.clone());
        }
    }

    /// Has kept what is known of a row by now.
    fn update(&self, id: RowId) {
        if let Some(row) = self.record.row(id) {
            self.keeper.update(id, &row.edit);
        }
    }

    /// Hears which numbers rows are kept by. What went wrong, if anything did; whether there was anything to hear.
    fn hear(&mut self) -> (Option<String>, bool) {
        let (mut wrong, mut heard) = (None, false);
        for said in self.keeper.said() {
            heard = true;
            match said {
                Said::Number(id, number) => self.record.number(id, number),
                Said::Failed(error) => wrong = Some(format!("edits are not kept on the disk: {error}")),
            }
        }
        (wrong, heard)
    }

    /// Has all that is known written before the process ends.
    pub fn flush(&self) {
        if self.kept {
            self.keeper.flush(FLUSH);
        }
    }
}
