//! A device that is opened while files are read.

use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::failure::Failure;
use super::interrupt::leave_running;
use crate::gpu::{Gpu, GpuError};

/// Opening a device, which takes drivers some tenths of a second. Where the command fails meanwhile, the process ends without it.
pub struct Opening {
    thread: JoinHandle<(Result<Arc<Gpu>, GpuError>, Duration)>,
}

impl Opening {
    /// Begins, in a thread.
    pub fn begin() -> Self {
        leave_running(true);
        let open = || {
            let begin = Instant::now();
            (Gpu::open(), begin.elapsed())
        };
        Self { thread: std::thread::spawn(open) }
    }

    /// The device, and the time that it took to open, whether it was waited for or not.
    pub fn finish(self) -> Result<(Arc<Gpu>, Duration), Failure> {
        let (gpu, took) = self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        leave_running(false);
        Ok((gpu?, took))
    }
}
