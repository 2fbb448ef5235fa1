//! Work in pieces, for all processors. How work is cut is said by who has it, never by the number of threads, so results are the same to
//! the bit on every machine.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::ScopedJoinHandle;

/// What pieces 0 to `count` come to, in their order. The last pieces may be begun before the first are done.
pub fn map<R: Send>(count: usize, work: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let run = || {
        let mut made = Vec::new();
        loop {
            let piece = next.fetch_add(1, Ordering::Relaxed);
            if piece >= count {
                return made;
            }
            made.push((piece, work(piece)));
        }
    };
    let mut made: Vec<(usize, R)> = on_threads(count, run).into_iter().flatten().collect();
    made.sort_by_key(|(piece, _)| *piece);
    made.into_iter().map(|(_, result)| result).collect()
}

/// Fills a list in pieces of `size` items, the last perhaps shorter. `work` is given a piece and the index of its first item.
pub fn fill<T: Send>(items: &mut [T], size: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    let size = size.max(1);
    let count = items.len().div_ceil(size);
    let pieces = Mutex::new(items.chunks_mut(size).enumerate());
    let run = || {
        loop {
            let next = pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((number, piece)) = next else { return };
            work(number * size, piece);
        }
    };
    on_threads(count, run);
}

/// Runs the same on as many threads as there are processors, and at most `most`, this one among them. A panic in any goes on here.
pub fn on_threads<R: Send>(most: usize, run: impl Fn() -> R + Sync) -> Vec<R> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(most);
    std::thread::scope(|scope| {
        let run = &run;
        let others: Vec<ScopedJoinHandle<'_, R>> = (1..threads).map(|_| scope.spawn(run)).collect();
        let mut results = vec![run()];
        results.extend(others.into_iter().map(|other| other.join().unwrap_or_else(|p| std::panic::resume_unwind(p))));
        results
    })
}
