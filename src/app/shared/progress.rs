//! How far a render is, on stderr: a bar on a terminal, a line now and then elsewhere, nothing if it is to be quiet.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::compiling::{is_due, line};
use super::output;
use crate::engine::FilmError;

/// Letters of a line: one less than the narrowest terminal that there still is.
const COLUMNS: usize = 79;

/// Letters of the bar, and of the name before it.
const BAR: usize = 16;
const NAME: usize = 16;

/// Between two lines where stderr is no terminal.
const LINE: Duration = Duration::from_secs(10);

/// Between two readings of the film's error, at least.
const LOOK: Duration = Duration::from_secs(2);

/// A reading may cost one part in so many of the time.
const LOOK_SHARE: u32 = 50;

/// What ends the render.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Samples of all pixels; none if only time counts.
    pub samples: Option<u64>,
    /// Seconds of tracing.
    pub seconds: Option<f64>,
    /// The relMSE that the film is at most to have.
    pub error: Option<f64>,
}

/// Shows how far a render is.
#[derive(Debug)]
pub struct Meter {
    bar: ProgressBar,
    /// What goes on.
    name: String,
    /// It changes, and is said on every line.
    renamed: bool,
    shown: Shown,
    goal: Goal,
    /// Of all there is to do: what was done before the part that is under way, and what that part is.
    part: (f64, f64),
    begin: Instant,
    samples: u64,
    spp: u32,
    error: Option<FilmError>,
    looked: Instant,
    look_cost: Duration,
    line: Instant,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    Nothing,
    Lines,
    Bar,
}

impl Meter {
    /// Begins now.
    pub fn new(name: &str, goal: Goal, quiet: bool) -> Self {
        let shown = match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Shown::Nothing,
            (false, false) => Shown::Lines,
            (false, true) => Shown::Bar,
        };
        let target = if shown == Shown::Bar { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(ProgressStyle::with_template("{msg}").expect("invariant: the template is a constant"));
        let now = Instant::now();
        Self {
            bar,
            name: name.to_owned(),
            renamed: false,
            shown,
            goal,
            part: (0.0, 1.0),
            begin: now,
            samples: 0,
            spp: 0,
            error: None,
            looked: now,
            look_cost: Duration::ZERO,
            line: now,
        }
    }

    /// Says what goes on from now on, on the bar and before every line.
    pub fn rename(&mut self, name: &str) {
        name.clone_into(&mut self.name);
        self.renamed = true;
    }

    /// Says that a part of what there is to do begins: what share was done before it, and what share it is. It has an error of its own.
    pub fn begin_part(&mut self, name: &str, before: f64, share: f64) {
        self.rename(name);
        (self.part, self.error, self.spp) = ((before, share), None, 0);
    }

    /// Shows how many seconds shaders have been compiled for.
    pub fn show_compiling(&self) -> impl Fn(u64) + Clone + Send + Sync + use<> {
        let (bar, shown, name) = (self.bar.clone(), self.shown, self.name.clone());
        move |seconds| match shown {
            Shown::Bar => bar.set_message(fitted(&format!("{}: {}", cut(&name, NAME), line(seconds)))),
            Shown::Lines if is_due(seconds) => output::note(&line(seconds)),
            Shown::Lines | Shown::Nothing => {}
        }
    }

    /// Seconds that are left, where they are limited.
    pub fn seconds_left(&self) -> Option<f64> {
        self.goal.seconds.map(|goal| (goal - self.elapsed().as_secs_f64()).max(0.0))
    }

    /// Since the beginning.
    pub fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }

    /// Adds the samples of a step, and shows them.
    pub fn advance(&mut self, samples: u64, spp: u32) {
        self.samples += samples;
        self.spp = spp;
        let message = self.message();
        self.draw(&message);
    }

    /// Shows that so much of the goal is done, in whatever it counts, with words of its own.
    pub fn show(&mut self, samples: u64, message: &str) {
        self.samples = samples;
        self.draw(message);
    }

    fn draw(&mut self, message: &str) {
        match self.shown {
            Shown::Nothing => {}
            Shown::Bar => self.bar.set_message(bar_line(&self.name, self.done(), message)),
            Shown::Lines if self.line.elapsed() >= LINE => {
                self.line = Instant::now();
                let name = if self.renamed { format!("{}: ", self.name) } else { String::new() };
                output::note(&fitted(&format!("{:3.0} %  {name}{message}", self.done() * 100.0)));
            }
            Shown::Lines => {}
        }
    }

    /// Whether it is time to read the film's error: not too often, since reading the film back takes time.
    pub fn wants_error(&self) -> bool {
        let due = LOOK.max(self.look_cost * LOOK_SHARE);
        self.shown != Shown::Nothing && self.spp >= 2 && self.looked.elapsed() >= due
    }

    /// Takes note of what the film tells of its relMSE, and of what it cost to learn it.
    pub fn set_error(&mut self, error: FilmError, cost: Duration) {
        (self.error, self.look_cost, self.looked) = (Some(error), cost, Instant::now());
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Part of the goal that is reached, 0 to 1.
    fn done(&self) -> f64 {
        let by_samples = self.goal.samples.map_or(0.0, |goal| self.samples as f64 / goal.max(1) as f64);
        let by_time = self.goal.seconds.map_or(0.0, |goal| self.elapsed().as_secs_f64() / goal);
        // The error falls with the samples.
        let (before, share) = self.part;
        let of_part = self.goal.error.zip(self.error).map_or(0.0, |(goal, error)| (goal / error.bound).clamp(0.0, 1.0));
        let by_error = before + share * of_part;
        let done = by_samples.max(by_time).max(by_error);
        if done.is_nan() { 0.0 } else { done.clamp(0.0, 1.0) }
    }

    fn message(&self) -> String {
        let seconds = self.elapsed().as_secs_f64();
        let done = self.done();
        let mut text = format!("{} spp", self.spp);
        if let Some(error) = self.error {
            text += &format!(", error {:.1e}", error.relmse);
        }
        if done > 0.0 && done < 1.0 {
            text += &format!(", {} left", clock(seconds * (1.0 - done) / done));
        }
        text
    }
}

/// A line with a bar, of which `done`, 0 to 1, is filled.
pub fn bar_line(name: &str, done: f64, message: &str) -> String {
    let filled = (done.clamp(0.0, 1.0) * BAR as f64) as usize;
    let bar = "=".repeat(filled) + if filled < BAR { ">" } else { "" };
    fitted(&format!("{} [{bar:BAR$}] {:>3.0} %  {message}", cut(name, NAME), done * 100.0))
}

/// A line without what a narrow terminal has no room for.
pub fn fitted(line: &str) -> String {
    cut(line, COLUMNS)
}

/// As many letters of a text, the last of them an ellipsis if there are more.
fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}

/// Seconds as users read them: `12 s`, `3:07`, `2:03:07`.
pub fn clock(seconds: f64) -> String {
    let whole = seconds.clamp(0.0, 1e9).ceil() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m}:{s:02}"),
        (h, m, s) => format!("{h}:{m:02}:{s:02}"),
    }
}
