//! Says how far the pictures of textures are, where loading them takes long enough to wonder.

use std::io::IsTerminal;
use std::sync::{Arc, Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output;
use super::seconds::{each_second, is_due};

/// What a loader is to call with how many pictures are decoded, of how many: first with none. Shown on stderr from the first second
/// on: in place on a terminal, a line now and then elsewhere, and not at all if it is to be quiet.
pub fn watch_pictures(quiet: bool) -> impl Fn(usize, usize) + Sync {
    let counts = Arc::new(Mutex::new((0, 0)));
    let terminal = std::io::stderr().is_terminal();
    let target = if terminal && !quiet { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(None, target);
    bar.set_style(ProgressStyle::with_template("{msg}").expect("invariant: the template is a constant"));
    let (seen, shown) = (counts.clone(), bar.clone());
    let clock = each_second(move |seconds| {
        let (done, all) = *seen.lock().unwrap_or_else(PoisonError::into_inner);
        let text = format!("loading textures {done}/{all}");
        match terminal {
            _ if quiet => {}
            true => shown.set_message(text),
            false if is_due(seconds) => output::note(&text),
            false => {}
        }
    });
    move |done, all| {
        *counts.lock().unwrap_or_else(PoisonError::into_inner) = (done, all);
        if done == 0 {
            clock(true);
        } else if done == all {
            clock(false);
            bar.finish_and_clear();
        }
    }
}
