//! The record of all that was saved since the window opened, as plain data: rows come, verdicts find their rows, and one row's shaders run.

use std::collections::VecDeque;

use crate::app::edits::{Edit, Kind, Lint, State, Verdict};
use crate::shader::Library;

/// Rows that are kept: beyond that the oldest go, text and all, but never the first, nor the one that runs.
pub const MOST: usize = 100;

/// Names a row as long as the window is open; that of a later row is larger.
pub type RowId = u64;

/// One entry of the record.
#[derive(Clone)]
pub struct Row {
    pub id: RowId,
    /// The number that it is kept by on the disk, once it is.
    pub number: Option<u32>,
    pub edit: Edit,
    /// What there is to go back to: shaders that ran.
    pub shaders: Option<Library>,
    /// The row that ran before, and its shaders, which this one is judged by.
    pub before: Option<(RowId, Library)>,
    /// What is traced was other code.
    pub traces: bool,
}

impl Row {
    /// Whether its edit is to be judged, or further judged.
    pub fn is_to_be_judged(&self) -> bool {
        self.traces && self.before.is_some() && self.edit.verdict.state.is_open()
    }
}

/// All rows, and which of them runs.
pub struct Record {
    /// The oldest first. Never empty: the first is the opening.
    rows: VecDeque<Row>,
    runs: RowId,
    /// The row whose shaders are to run next.
    wanted: Option<RowId>,
    /// The row whose first pixels are not there yet.
    awaited: Option<RowId>,
    /// Rows that were dropped.
    dropped: usize,
    next: RowId,
}

impl Record {
    /// Nothing was saved yet. `opened` is the entry of the opening, and `shaders` are those that run.
    pub fn new(opened: Edit, shaders: Library) -> Self {
        let first = Row { id: 0, number: None, edit: opened, shaders: Some(shaders), before: None, traces: false };
        Self { rows: [first].into(), runs: 0, wanted: None, awaited: None, dropped: 0, next: 1 }
    }

    /// The newest first.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &Row> + DoubleEndedIterator {
        self.rows.iter().rev()
    }

    /// The row that came last, whichever runs.
    pub fn newest(&self) -> RowId {
        self.next - 1
    }

    pub fn row(&self, id: RowId) -> Option<&Row> {
        self.rows.iter().find(|row| row.id == id)
    }

    fn row_mut(&mut self, id: RowId) -> Option<&mut Row> {
        self.rows.iter_mut().find(|row| row.id == id)
    }

    /// The row whose shaders run.
    pub fn running(&self) -> &Row {
        self.row(self.runs).unwrap_or(&self.rows[0])
    }

    /// The row whose shaders are being compiled to run again.
    pub fn wanted(&self) -> Option<RowId> {
        self.wanted
    }

    /// How many rows are gone.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// Something good was saved; `shaders` run now, and `traces` is whether that changed code of what is traced. Returns its row, or that
    /// which was gone back to.
    pub fn take(&mut self, edit: Edit, shaders: &Library, traces: bool) -> RowId {
        let wanted = self.wanted.take();
        if let Some(id) = wanted.filter(|id| self.has_shaders(*id, shaders)) {
            (self.runs, self.awaited) = (id, None);
            return id;
        }
        let changed = !self.running().shaders.as_ref().is_some_and(|running| running.is_same(shaders));
        let known = self.rows.iter().rev().find(|row| self.has_shaders(row.id, shaders)).map(|row| row.id);
        if let Some(id) = known.filter(|_| edit.files.is_empty()) {
            // Read again, and nothing new.
            self.runs = if changed { id } else { self.runs };
            return self.runs;
        }
        let before = self.running().shaders.clone().map(|library| (self.runs, library)).filter(|_| changed);
        let id =
            self.push(Row { id: 0, number: None, edit, shaders: changed.then(|| shaders.clone()), before, traces });
        self.awaited = Some(id);
        if changed {
            self.runs = id;
        }
        id
    }

    /// Something was saved that can't be used; `shaders` run now. A row whose shaders were taken up, and then taken back, is the one that
    /// failed: its row, or the new one.
    pub fn fail(&mut self, edit: Edit, shaders: &Library) -> RowId {
        self.wanted = None;
        let newest = self.rows.back().map(|row| row.id).filter(|id| *id == self.runs && *id > 0);
        let Some(id) = newest.filter(|id| !self.has_shaders(*id, shaders)) else {
            // A row that was gone back to can fail too: what ran before it runs.
            let known = self.rows.iter().rev().find(|row| self.has_shaders(row.id, shaders)).map(|row| row.id);
            self.runs = known.filter(|_| !self.has_shaders(self.runs, shaders)).unwrap_or(self.runs);
            return self.push(Row { id: 0, number: None, edit, shaders: None, before: None, traces: false });
        };
        let before = self.row(id).and_then(|row| row.before.as_ref()).map_or(0, |(before, _)| *before);
        if let Some(row) = self.row_mut(id) {
            (row.edit.verdict, row.shaders, row.traces) = (edit.verdict, None, false);
        }
        (self.runs, self.awaited) = (before, None);
        id
    }

    /// The first pixels that came of what was saved last are there, so many seconds after. The row, unless it has them already.
    pub fn show(&mut self, seconds: f64) -> Option<RowId> {
        let id = self.awaited.take()?;
        self.row_mut(id)?.edit.pixels = Some(seconds);
        Some(id)
    }

    /// The shaders that run were linted.
    pub fn lint(&mut self, lint: Lint) -> RowId {
        let id = self.runs;
        if let Some(row) = self.row_mut(id) {
            row.edit.lint = lint;
        }
        id
    }

    /// What judging found of a row, whichever runs by now. False where there is no such row any more, or it was taken back.
    pub fn judge(&mut self, id: RowId, verdict: Verdict) -> bool {
        let open = |row: &&mut Row| row.edit.verdict.state != State::Failed || row.shaders.is_some();
        match self.row_mut(id).filter(open) {
            Some(row) => {
                row.edit.verdict = verdict;
                true
            }
            None => false,
        }
    }

    /// Another edit came before all was known of a row: what was known of it stays.
    pub fn leave(&mut self, id: RowId) {
        if let Some(row) = self.row_mut(id).filter(|row| row.edit.verdict.state.is_open()) {
            let verdict = &mut row.edit.verdict;
            let known = verdict.short.split_once("; ").map(|(_, known)| known.to_owned());
            let words = match known.filter(|_| verdict.state == State::Judging) {
                Some(known) => format!("left before all was known: {known}"),
                None => "left before it was judged".to_owned(),
            };
            *verdict = Verdict::new(State::Left, &words);
        }
    }

    /// Wants the shaders of a row to run again. Returns them, if they are there and don't run already.
    pub fn go_back(&mut self, id: RowId) -> Option<Library> {
        let shaders = self.row(id)?.shaders.clone().filter(|_| self.runs != id || self.wanted.is_some())?;
        self.wanted = Some(id);
        Some(shaders)
    }

    /// What is to be judged by itself: the row that runs, if its edit is not judged yet. The shaders before, and its own.
    pub fn to_judge(&self) -> Option<(RowId, [Library; 2])> {
        let row = self.running();
        let (_, before) = row.before.as_ref().filter(|_| row.is_to_be_judged())?;
        Some((row.id, [before.clone(), row.shaders.clone()?]))
    }

    /// What is judged where a user asks for it: the last edit of what is traced, on the way from the row that runs to those that ran before.
    pub fn last_traced(&self) -> Option<(RowId, [Library; 2])> {
        let now = self.running().shaders.clone()?;
        let mut row = self.running();
        while !row.traces {
            row = self.row(row.before.as_ref()?.0)?;
        }
        let (_, before) = row.before.as_ref()?;
        Some((row.id, [before.clone(), now]))
    }

    /// Warnings of lint that stand: of the code before a row, where nothing since was linted and found to be mended.
    pub fn inherited<'a>(&'a self, row: &'a Row) -> &'a [String] {
        let mut at = row;
        loop {
            match &at.edit.lint {
                Lint::Warned(warnings) if at.id != row.id => return warnings,
                Lint::NotLinted => {}
                _ => return &[],
            }
            match at.before.as_ref().and_then(|(before, _)| self.row(*before)) {
                Some(before) => at = before,
                None => return &[],
            }
        }
    }

    /// The row is on the disk.
    pub fn number(&mut self, id: RowId, number: u32) {
        if let Some(row) = self.row_mut(id) {
            row.number = Some(number);
        }
    }

    fn has_shaders(&self, id: RowId, shaders: &Library) -> bool {
        self.row(id).and_then(|row| row.shaders.as_ref()).is_some_and(|own| own.is_same(shaders))
    }

    fn push(&mut self, row: Row) -> RowId {
        let id = self.next;
        self.next += 1;
        self.rows.push_back(Row { id, ..row });
        if self.rows.len() > MOST {
            let oldest = self.rows.iter().position(|row| row.edit.kind != Kind::Opened && row.id != self.runs);
            if oldest.and_then(|at| self.rows.remove(at)).is_some() {
                self.dropped += 1;
            }
        }
        id
    }
}
