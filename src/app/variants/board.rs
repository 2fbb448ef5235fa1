//! What is known of all members by now, and its files: written now and then, and at the end.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::answers;
use super::blank::{blank, missing};
use super::jobs::Board;
use super::record::{Answer, AxisRecord, Record, State};
use super::survey::{Broken, Found};
use crate::app::shared::failure::show;
use crate::app::shared::output::{FOLDER_FLAG, Unplaced};
use crate::image::{SaveError, file};
use crate::scene::variants::{Axis, Family};

/// Of the format of `answer.json`.
const VERSION: u32 = 1;

/// Between two times that all files are written, at least.
const PAUSE: Duration = Duration::from_secs(5);

/// Writing may cost one part in so many of the time.
const SHARE: u32 = 20;

/// The answer as it grows.
pub struct Answers {
    state: Mutex<Growing>,
    folder: PathBuf,
    /// Held by whoever writes the files of all members.
    writing: Mutex<()>,
    /// A file of a member could not be written.
    unwritten: AtomicBool,
    /// The last time that the files of all members were written, one could not be.
    torn: AtomicBool,
}

struct Growing {
    answer: Answer,
    /// Of the reference's own film.
    reference: Option<Record>,
    written: Instant,
    /// Until they are written again.
    pause: Duration,
}

impl Answers {
    /// Of members of which nothing is known but what is wrong with them.
    pub fn new(family: &Family, found: &[Found], folder: PathBuf) -> Self {
        let axis = |axis: &Axis| AxisRecord { name: axis.name.clone(), labels: axis.labels.clone() };
        let answer = Answer {
            version: VERSION,
            name: family.name.clone(),
            file: family.path.display().to_string(),
            axes: family.axes.iter().map(axis).collect(),
            records: found.iter().take(family.members.len()).map(first).collect(),
            reference: family.reference.as_ref().map(|reference| reference.member.clone()),
            interrupted: false,
            remarks: Vec::new(),
        };
        let state = Growing { answer, reference: None, written: Instant::now(), pause: PAUSE };
        Self {
            state: Mutex::new(state),
            folder,
            writing: Mutex::new(()),
            unwritten: AtomicBool::new(false),
            torn: AtomicBool::new(false),
        }
    }

    /// Looks at, or changes, what there is.
    pub fn with<R>(&self, change: impl FnOnce(&mut Answer, &mut Option<Record>) -> R) -> R {
        let mut state = self.lock();
        let Growing { answer, reference, .. } = &mut *state;
        change(answer, reference)
    }

    /// Takes up a record, of a member or of the reference's own film.
    pub fn set(&self, index: usize, record: Record) {
        self.with(|answer, reference| match answer.records.get_mut(index) {
            Some(held) => *held = record,
            None => *reference = Some(record),
        });
    }

    /// Writes all files.
    pub fn write(&self) {
        self.write_by(&self.writing.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// The same, by whoever may. Members may be taken up meanwhile.
    fn write_by(&self, _writing: &MutexGuard<()>) {
        let begin = Instant::now();
        let answer = self.lock().answer.clone();
        let written = write(&answer, &self.folder);
        self.torn.store(written.is_err(), Ordering::Relaxed);
        if let Err(error) = written {
            show(&Unplaced::by(FOLDER_FLAG)(error));
        }
        let mut state = self.lock();
        state.written = Instant::now();
        state.pause = PAUSE.max(SHARE * begin.elapsed());
    }

    /// Whether all that was to be written was.
    pub fn is_whole(&self) -> bool {
        !self.unwritten.load(Ordering::Relaxed) && !self.torn.load(Ordering::Relaxed)
    }

    fn lock(&self) -> MutexGuard<'_, Growing> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Board for Answers {
    fn put(&self, index: usize, record: Record) {
        self.set(index, record);
        let due = || {
            let state = self.lock();
            state.written.elapsed() >= state.pause
        };
        if let Ok(writing) = self.writing.try_lock()
            && due()
        {
            self.write_by(&writing);
        }
    }

    fn unwritten(&self, error: SaveError) {
        show(&Unplaced::by(FOLDER_FLAG)(error));
        self.unwritten.store(true, Ordering::Relaxed);
    }
}

fn write(answer: &Answer, folder: &Path) -> Result<(), SaveError> {
    let path = folder.join("answer.json");
    let text = serde_json::to_string_pretty(answer)
        .map_err(|error| SaveError::Write { path: path.clone(), source: error.into() })?;
    file::write_text(&path, &(text + "\n"))?;
    answers::write(answer, folder).map(|_| ())
}

/// Of a member that nothing was done about yet.
fn first(found: &Found) -> Record {
    match found {
        Ok(subject) => blank(subject),
        Err(broken) => {
            let Broken { member, error } = &**broken;
            let state = State::Failed {
                message: error.message.clone(),
                file: Some(error.file.display().to_string()),
                line: error.line,
                column: error.column,
            };
            Record { state, ..missing(member) }
        }
    }
}
