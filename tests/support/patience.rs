//! Waiting for what a program does: for as long as it gets on, however busy the machine is.

use std::time::{Duration, Instant};

/// Processor time that nothing here takes: who used it up goes in circles.
const CIRCLES: Duration = Duration::from_secs(600);

/// A program that does next to nothing for so long waits in vain.
const STILL: Duration = Duration::from_secs(120);

/// In that time, at least, a program that gets on takes more than this.
const NOTHING: Duration = Duration::from_secs(1);

/// Between two looks, at first and at most: looking takes processor time too.
const MOMENT: [Duration; 2] = [Duration::from_millis(2), Duration::from_millis(50)];

/// Lasts while a process gets on.
pub struct Patience {
    process: u32,
    begin: Instant,
    /// What it had taken at the beginning.
    before: Duration,
    /// When it was last seen to have got on, and what it had taken then.
    moved: (Instant, Duration),
    moment: Duration,
}

impl Patience {
    /// With a process, by its id: it is its processor time that counts.
    pub fn with(process: u32) -> Self {
        let (begin, before) = (Instant::now(), processor_time(process).unwrap_or_default());
        Self { process, begin, before, moved: (begin, before), moment: MOMENT[0] }
    }

    /// With the test's own process.
    pub fn here() -> Self {
        Self::with(std::process::id())
    }

    /// How long to wait until the next look. Panics once there is no more hope of `what`.
    #[track_caller]
    pub fn moment(&mut self, what: &str) -> Duration {
        // Where the system does not tell, all time is taken to be the process's.
        let now = processor_time(self.process).unwrap_or_else(|| self.before + self.begin.elapsed());
        if now > self.moved.1 + NOTHING {
            self.moved = (Instant::now(), now);
        }
        let (taken, still) = (now.saturating_sub(self.before), self.moved.0.elapsed());
        let waited = self.begin.elapsed();
        assert!(taken < CIRCLES && still < STILL, "waited {waited:?} in vain for {what}, {taken:?} of work");
        self.moment = (self.moment * 11 / 10).min(MOMENT[1]);
        self.moment
    }

    /// Waits for a moment.
    #[track_caller]
    pub fn wait(&mut self, what: &str) {
        let moment = self.moment(what);
        std::thread::sleep(moment);
    }
}

/// How soon a process ends that was told to: by the clock, or by its own processor time where the machine has too much else to do.
pub fn time_to_end(child: &mut std::process::Child, most: Duration) -> Option<Duration> {
    let (begin, before) = (Instant::now(), processor_time(child.id()));
    loop {
        let now = processor_time(child.id());
        if child.try_wait().unwrap().is_some() {
            return Some(begin.elapsed());
        }
        let worked = now.zip(before).map_or(begin.elapsed(), |(now, before)| now.saturating_sub(before));
        if begin.elapsed() > most && worked > most || begin.elapsed() > STILL {
            return None;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Processor time of a process so far, all threads together, in steps of 10 ms; `None` where the system does not tell.
pub fn processor_time(process: u32) -> Option<Duration> {
    time_in(&format!("/proc/{process}/stat"))
}

/// The same of this thread.
pub fn thread_time() -> Option<Duration> {
    time_in("/proc/thread-self/stat")
}

fn time_in(stat: &str) -> Option<Duration> {
    let stat = std::fs::read_to_string(stat).ok()?;
    // The name, in parentheses, may hold anything.
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<u64>().ok()? + fields.get(12)?.parse::<u64>().ok()?;
    Some(Duration::from_millis(10 * ticks))
}
