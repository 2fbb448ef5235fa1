//! A clock for what may take long: it ticks each second, and not at all where the work is over sooner.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// What is over sooner is not worth a word.
const SECOND: Duration = Duration::from_secs(1);

/// What is to be called when some work begins, and when it is over: `show` is called from another thread with the seconds that it has
/// taken, each second from the first on, and no more once it is over.
pub fn each_second(show: impl Fn(u64) + Clone + Send + Sync + 'static) -> impl Fn(bool) + Send + Sync + 'static {
    let clock: Mutex<Option<(Sender<()>, JoinHandle<()>)>> = Mutex::default();
    move |begins| {
        let mut clock = clock.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((over, thread)) = clock.take() {
            drop(over);
            let _ = thread.join();
        }
        if begins {
            let (over, waits) = channel();
            let show = show.clone();
            let tick = move || {
                for seconds in 1.. {
                    if waits.recv_timeout(SECOND) != Err(RecvTimeoutError::Timeout) {
                        return;
                    }
                    show(seconds);
                }
            };
            *clock = Some((over, std::thread::spawn(tick)));
        }
    }
}

/// Whether a line is due where nothing can be written over: at 1, 10, 20, .. seconds.
pub fn is_due(seconds: u64) -> bool {
    seconds == 1 || seconds.is_multiple_of(10)
}
