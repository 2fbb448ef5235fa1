//! How far a row is, on stderr: a bar on a terminal, elsewhere a line now and then where a row takes long.

use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::app::shared::output;
use crate::app::shared::progress::{bar_line, clock};

/// Between two lines where stderr is no terminal.
const LINE: Duration = Duration::from_secs(10);

/// Shows how far a row is.
pub struct Progress {
    bar: ProgressBar,
    /// Lines are shown, for there is no terminal for the bar.
    lines: bool,
}

impl Progress {
    pub fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let target = if terminal && !quiet { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(None, target);
        bar.set_style(ProgressStyle::with_template("{msg}").expect("invariant: the template is a constant"));
        Self { bar, lines: !terminal && !quiet }
    }

    /// What a row of this name, which begins now, tells how far it is.
    pub fn of(&self, name: &str) -> impl Fn(f64) + Send + Sync + use<> {
        let (bar, lines, name, begin) = (self.bar.clone(), self.lines, name.to_owned(), Instant::now());
        let told = Mutex::new(begin);
        bar.set_message(bar_line(&name, 0.0, ""));
        move |done| {
            let left = left(begin.elapsed(), done);
            bar.set_message(bar_line(&name, done, &left));
            let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
            if lines && told.elapsed() >= LINE {
                *told = Instant::now();
                output::note(&format!(
                    "{name}: {:.0} %{}{left}",
                    done * 100.0,
                    if left.is_empty() { "" } else { ", " }
                ));
            }
        }
    }

    /// Leaves the line to the table.
    pub fn clear(&self) {
        self.bar.set_message("");
        self.bar.suspend(|| ());
    }
}

/// How long the rest takes, if it goes on as it went; nothing before there is something to tell it by.
fn left(spent: Duration, done: f64) -> String {
    match done > 0.02 && done < 1.0 {
        true => format!("{} left", clock(spent.as_secs_f64() * (1.0 - done) / done)),
        false => String::new(),
    }
}
