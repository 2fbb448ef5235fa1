//! The session's saves become rows of the record, and a row that was clicked runs again.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::record::RowId;
use crate::app::edits::{Edit, Kind, Lint, State, Verdict, now};
use crate::app::shared::output;
use crate::app::window::session::Session;
use crate::watch::{Problem, Restarts};

impl Session {
    /// Something that was saved runs now. Returns what to say of it where a row was gone back to, or left.
    pub(in crate::app::window) fn record_taken(
        &mut self,
        files: &[PathBuf],
        restarts: Restarts,
        since_save: Duration,
        chosen: bool,
    ) -> Option<String> {
        let shaders = self.engine.library();
        let ran = self.edits.record.running();
        let (ran, other) = (ran.id, !ran.shaders.as_ref().is_some_and(|running| running.is_same(&shaders)));
        if chosen && !other {
            // Another member of the family: nothing was saved.
            return None;
        }
        let last_that_ran = self.edits.record.rows().find(|row| row.shaders.is_some()).map(|row| row.id);
        let wanted = self.edits.record.wanted();
        let kind = if other || files.iter().any(|file| is_shader(file)) { Kind::Shaders } else { Kind::Scene };
        let verdict = if other { verdict(restarts) } else { untouched(kind) };
        let edit = self.new_edit(kind, files, since_save, verdict);
        let newest = self.edits.record.newest();
        let id = self.edits.record.take(edit, &shaders, other && restarts.film);
        if self.edits.record.running().id != ran {
            self.end_judging();
            self.leave_verdict(ran);
        }
        let is_new = id > newest;
        if is_new {
            self.edits.keep(id);
        }
        match (is_new, wanted) {
            (false, Some(wanted)) if wanted == id => Some(format!(
                "{} runs again; the files are as they were, and the next save goes on from them",
                self.called(id)
            )),
            (true, _) if other && last_that_ran != Some(ran) => {
                Some(format!("from the files as they are; before it ran {}", self.called(ran)))
            }
            _ => None,
        }
    }

    /// Something that was saved can't be used.
    pub(in crate::app::window) fn record_failed(
        &mut self,
        files: &[PathBuf],
        problems: &[Problem],
        since_save: Duration,
    ) {
        let all: Vec<String> = problems.iter().map(told).collect();
        let first = all.first().map_or("", String::as_str);
        // The name says enough where there is little room; folders before it stand in the long line.
        let (place, message) = first.split_once(": ").unwrap_or(("", first));
        let place = place.rsplit(['/', '\\']).next().filter(|place| !place.is_empty());
        let short = place.map_or(format!("failed: {message}"), |place| format!("failed: {place}: {message}"));
        let verdict = Verdict { state: State::Failed, short, line: all.join("\n") };
        let kind = if files.iter().any(|file| is_shader(file)) { Kind::Shaders } else { Kind::Scene };
        let edit = self.new_edit(kind, files, since_save, verdict);
        let shaders = self.engine.library();
        let known = self.edits.record.running().id;
        let id = self.edits.record.fail(edit, &shaders);
        if self.edits.record.running().id != known {
            self.end_judging();
        }
        if id == known {
            self.edits.update(id);
        } else {
            self.edits.keep(id);
        }
    }

    /// The first pixels that came of a save are there.
    pub(in crate::app::window) fn record_pixels(&mut self, since_save: Duration) {
        if let Some(id) = self.edits.record.show(since_save.as_secs_f64()) {
            self.edits.update(id);
        }
    }

    /// The code of surfaces was linted.
    pub(in crate::app::window) fn record_lint(&mut self, warnings: &[Problem]) {
        let lint = match warnings {
            [] => Lint::Clean,
            warnings => Lint::Warned(warnings.iter().map(|warning| warning.diagnostic.to_string()).collect()),
        };
        let id = self.edits.record.lint(lint);
        self.edits.update(id);
    }

    /// Has the shaders of a row run again.
    pub(in crate::app::window) fn go_back_to(&mut self, id: RowId) {
        let Some(shaders) = self.edits.record.go_back(id) else { return };
        self.engine.run_again(shaders);
        let called = self.called(id);
        self.notify(format!("going back to {called}"));
        self.resume();
    }

    /// Hears what the disk says.
    pub(in crate::app::window) fn hear_keeper(&mut self) {
        let (wrong, heard) = self.edits.hear();
        if let Some(wrong) = wrong {
            output::note(&wrong);
            self.notify(wrong);
        }
        if heard && self.panel.open {
            self.draw_again();
        }
    }

    /// How a row is called in messages.
    pub(super) fn called(&self, id: RowId) -> String {
        let Some(row) = self.edits.record.row(id) else { return "an edit that is gone".to_owned() };
        match (row.edit.kind, row.number) {
            (Kind::Opened, _) => "what the window opened with".to_owned(),
            (_, Some(number)) => format!("edit {number} ({})", row.edit.what()),
            (_, None) => format!("the edit of {}", row.edit.what()),
        }
    }

    fn new_edit(&self, kind: Kind, files: &[PathBuf], since_save: Duration, verdict: Verdict) -> Edit {
        Edit {
            kind,
            scene: self.name().to_owned(),
            files: files.iter().map(|file| told_path(file)).collect(),
            saved: now().saturating_sub(since_save.as_secs()),
            pixels: None,
            lint: Lint::NotLinted,
            verdict,
        }
    }
}

/// What is to become of a save that was taken up, before anything is judged.
fn verdict(restarts: Restarts) -> Verdict {
    match restarts {
        Restarts { film: true, .. } => Verdict::new(State::Waiting, "to be judged"),
        Restarts { picture: true, .. } => Verdict::new(State::Unchanged, "changes only how the picture is shown"),
        _ => Verdict::new(State::Unchanged, "changes nothing of what the scene runs"),
    }
}

/// The same of a save behind which the same shaders run as before.
fn untouched(kind: Kind) -> Verdict {
    match kind {
        Kind::Shaders => Verdict::new(State::Unchanged, "the files are again what runs"),
        Kind::Opened | Kind::Scene => Verdict::new(State::None, "scene: not judged"),
    }
}

fn is_shader(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending == "wgsl")
}

/// A problem in a line, with its place.
fn told(problem: &Problem) -> String {
    let message = problem.message.lines().next().unwrap_or_default();
    match (&problem.file, problem.line) {
        (Some(file), 0) => format!("{file}: {message}"),
        (Some(file), line) => format!("{file}:{line}:{}: {message}", problem.column),
        (None, _) => message.to_owned(),
    }
}

/// A path as it is told, the same on every system.
fn told_path(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}
