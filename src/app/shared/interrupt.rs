//! Ctrl-C, and requests to end. The first ends the process within a second, whatever the process is at; or, where there is something to
//! be saved, once it is. The second ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::failure::Exit;
use super::output;
use crate::image::file;

/// What a command has to come to its own end. Reading, compiling and drivers may not come to one in any time.
const GRACE: Duration = Duration::from_millis(500);

/// Between two lines that say what is waited for.
const REMINDER: Duration = Duration::from_secs(5);

/// What a line to stderr may take, which nobody may be reading.
const LINE: Duration = Duration::from_millis(50);

/// Set by the first signal.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    asked: Arc<AtomicBool>,
    /// There is something to be saved: the command ends by itself.
    held: Arc<Mutex<bool>>,
}

impl Interrupt {
    /// Takes over the process's signals. `exit` is what the first ends it with, until [`Interrupt::hold`]. Where that fails, Ctrl-C just
    /// ends the process.
    pub fn listen(exit: Exit) -> Self {
        let interrupt = Self::default();
        let heard = interrupt.clone();
        let _ = ctrlc::set_handler(move || {
            if heard.asked.swap(true, Ordering::SeqCst) {
                end(Exit::Interrupted);
            }
            // A thread, since a second signal has to be heard meanwhile.
            let waiting = heard.clone();
            std::thread::spawn(move || waiting.see_to_the_end(exit));
        });
        interrupt
    }

    /// From now on there is something to be saved. Does not return if the process is ending already.
    pub fn hold(&self) {
        *self.held.lock().unwrap_or_else(PoisonError::into_inner) = true;
    }

    /// What the first signal sets.
    pub fn flag(&self) -> Arc<AtomicBool> {
        self.asked.clone()
    }

    /// Whether a signal has come.
    pub fn requested(&self) -> bool {
        self.asked.load(Ordering::SeqCst)
    }

    /// Ends the process if nothing is to be saved; else says what is waited for.
    fn see_to_the_end(&self, exit: Exit) {
        let begin = Instant::now();
        std::thread::sleep(GRACE);
        let held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        if !*held {
            if exit == Exit::Interrupted {
                std::thread::spawn(|| output::note("interrupted before there was anything to write"));
                std::thread::sleep(LINE);
            }
            // The lock is kept: what would be saved from now on is not begun.
            end(exit);
        }
        drop(held);
        std::thread::sleep(GRACE);
        loop {
            let seconds = begin.elapsed().as_secs();
            output::note(&format!(
                "interrupted {seconds} s ago: what is there is written once the device is done; Ctrl-C again ends at once"
            ));
            std::thread::sleep(REMINDER);
        }
    }
}

/// Something is left running: the process is to end without waiting for it.
static LEFT: AtomicBool = AtomicBool::new(false);

/// Says whether something is left running, which the process's end is not to wait for.
pub fn leave_running(left: bool) {
    LEFT.store(left, Ordering::SeqCst);
}

/// The end of `main`: at once where something is left running, else in order.
pub fn end_of_main(exit: Exit) -> std::process::ExitCode {
    if LEFT.load(Ordering::SeqCst) {
        let _ = std::io::Write::flush(&mut std::io::stdout());
        end(exit);
    }
    exit.into()
}

/// Ends the process from any thread, whatever the others do.
pub fn end(exit: Exit) -> ! {
    file::remove_unfinished();
    let code = i32::from(exit.code());
    // SAFETY: this call has no conditions. It runs no exit handlers: those of drivers don't expect that their threads go on.
    #[cfg(unix)]
    unsafe {
        libc::_exit(code)
    }
    #[cfg(not(unix))]
    std::process::exit(code)
}
