//! Pictures decoded by several threads, within a bound of memory.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use super::picture::{Facts, Header, Picture, Reduction};
use crate::image::{ReadError, TextureFile, halve};

/// Threads, at most.
const MOST_THREADS: usize = 8;

/// Bytes of pictures that may be decoded at once, unless it is one alone.
const MOST_AT_ONCE: u64 = 4 << 30;

/// A picture that is to be decoded.
pub struct Job {
    pub file: TextureFile,
    pub reduction: Reduction,
}

/// Decodes pictures; what came of each, in their order. `tell` is called from any thread with how many are done.
pub fn decode(jobs: Vec<Job>, tell: &(dyn Fn(usize, usize) + Sync)) -> Vec<Result<Picture, ReadError>> {
    let all = jobs.len();
    let threads = std::thread::available_parallelism().map_or(1, |threads| threads.get());
    let threads = threads.min(MOST_THREADS).min(all);
    // The largest first, so that no thread has one left when the others are done.
    let mut jobs: Vec<(usize, Job)> = jobs.into_iter().enumerate().collect();
    jobs.sort_by_key(|(_, job)| job.file.bytes);
    let jobs = Mutex::new(jobs);
    let room = Room { free: Mutex::new(MOST_AT_ONCE), freed: Condvar::new() };
    let done = AtomicUsize::new(0);
    if all > 0 {
        tell(0, all);
    }
    let work = || {
        let mut pictures = Vec::new();
        loop {
            let next = jobs.lock().unwrap_or_else(PoisonError::into_inner).pop();
            let Some((index, job)) = next else { return pictures };
            let bytes = room.take(job.file.bytes);
            pictures.push((index, read(job)));
            room.give_back(bytes);
            tell(done.fetch_add(1, Ordering::Relaxed) + 1, all);
        }
    };
    let mut pictures: Vec<(usize, Result<Picture, ReadError>)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let join = |thread: std::thread::ScopedJoinHandle<'_, _>| match thread.join() {
            Ok(pictures) => pictures,
            Err(panic) => std::panic::resume_unwind(panic),
        };
        threads.into_iter().flat_map(join).collect()
    });
    pictures.sort_by_key(|(index, _)| *index);
    pictures.into_iter().map(|(_, picture)| picture).collect()
}

fn read(job: Job) -> Result<Picture, ReadError> {
    let Job { file, reduction } = job;
    let header = Header { size: file.size, bytes: file.bytes };
    let read = file.read()?;
    let image = match reduction.halvings {
        0 => read.image,
        times => halve(&read.image, times, reduction.codes),
    };
    let facts = Facts {
        header,
        reduction,
        alpha: read.alpha,
        mended: read.mended,
        warnings: read.warnings,
        colours: read.colours,
    };
    Ok(Picture { image: Arc::new(image), facts })
}

/// Memory that threads share.
struct Room {
    free: Mutex<u64>,
    freed: Condvar,
}

impl Room {
    /// Waits for so many bytes, or for all there are. Returns how many were taken.
    fn take(&self, bytes: u64) -> u64 {
        let bytes = bytes.min(MOST_AT_ONCE);
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let mut free = self.freed.wait_while(free, |free| *free < bytes).unwrap_or_else(PoisonError::into_inner);
        *free -= bytes;
        bytes
    }

    fn give_back(&self, bytes: u64) {
        *self.free.lock().unwrap_or_else(PoisonError::into_inner) += bytes;
        self.freed.notify_all();
    }
}
