//! A stack for work that recurses as deep as a shader nests: naga's front end, its backends, and the drivers' compilers.
//!
//! Measured with naga 30: a level takes at most 2 KiB of stack in a build that is optimised, and about 6 times that in one
//! that is not. [`depth`](super::depth) lets through trees of some 1,000 levels and chains of 20,000 declarations (13 MiB).

use std::cell::Cell;
use std::thread;

/// Bytes, of addresses only: pages that are not touched cost nothing.
const BYTES: usize = 128 << 20;

thread_local! {
    static LARGE: Cell<bool> = const { Cell::new(false) };
}

/// Does some work on a thread with a large stack, and waits for it. A panic in it goes on here.
pub fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    if LARGE.get() {
        return work();
    }
    let mut work = Some(work);
    let slot = &mut work;
    let done = thread::scope(|scope| {
        let run = move || {
            LARGE.set(true);
            slot.take().map(|work| work())
        };
        let thread =
            thread::Builder::new().name("shaders".to_owned()).stack_size(BYTES).spawn_scoped(scope, run).ok()?;
        thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    // Where no such thread can be had, the main thread's own stack carries what usual shaders take.
    done.or_else(|| work.take().map(|work| work())).expect("invariant: the work was done by one of the two")
}
