//! An edit of the shaders judged beside the window: by two engines of a thread of their own, on the window's device.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use glam::UVec2;
use winit::event_loop::EventLoopProxy;

use crate::app::edits::{State, Verdict};
use crate::app::judge::{self, Analysis, Control, Judge, JudgeError, Plan, UNCHANGED, WITHIN, marked, standing};
use crate::app::shared::failure::rendered;
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// What is said before there are films.
const COMPILING: &str = "judging: compiling both";

/// What is said before there are films enough.
const UNTOLD: &str = "nothing can be told yet";

/// Between two messages of how far it is: each has the window drawn.
const REPORT: Duration = Duration::from_millis(500);

/// Where judging is done.
pub struct Place {
    pub gpu: Arc<Gpu>,
    pub scene: SceneDescription,
    /// Tracing between two looks at whether it is to step aside.
    pub batch: Duration,
    /// Seconds at most, without those of rest.
    pub seconds: f64,
    /// Called whenever there is something to take.
    pub wake: EventLoopProxy<()>,
}

/// What the thread sends.
enum Message {
    /// How far it is, and the films of each so far.
    Standing(String, usize),
    /// An analysis, and the mean radiance of the films so far, the old shaders' first.
    Analysis(Box<Analysis>, [Vec<[f32; 3]>; 2]),
    Unchanged,
    Failed(JudgeError),
}

/// Judging that is under way, or over.
pub struct Judging {
    messages: Receiver<Message>,
    control: Control,
    thread: Option<JoinHandle<()>>,
    /// By which radiance is multiplied to be shown.
    scale: f64,
    /// Nothing more will come.
    over: bool,
    /// What the last analysis has found, and the same in few words.
    found: Option<(String, String)>,
    /// How far it is, and what was found so far.
    pub line: String,
    /// The same as a row has it.
    pub verdict: Verdict,
    /// The size of one picture, and both: by the old shaders, then by the new ones; the differing blocks are marked.
    pub split: Option<(UVec2, Vec<[u8; 4]>)>,
}

impl Judging {
    /// Starts to judge new shaders by the old ones, which are the first of `sides`.
    pub fn start(sides: [Library; 2], place: Place) -> Self {
        let control = Control::default();
        let (sender, messages) = channel();
        let (exposure, told) = (place.scene.film.exposure, control.clone());
        let thread = std::thread::spawn(move || {
            if let Err(error) = judge(&sides, &place, told, &sender) {
                let _ = sender.send(Message::Failed(error));
            }
            let _ = place.wake.send_event(());
        });
        Self {
            messages,
            control,
            thread: Some(thread),
            scale: f64::from(exposure).exp2(),
            over: false,
            found: None,
            line: COMPILING.to_owned(),
            verdict: Verdict::new(State::Judging, COMPILING),
            split: None,
        }
    }

    /// Whether more is to come.
    pub fn is_under_way(&self) -> bool {
        !self.over
    }

    /// Receives what the thread has sent. Whether there was anything.
    pub fn receive(&mut self) -> bool {
        let messages: Vec<Message> = self.messages.try_iter().collect();
        for message in &messages {
            match message {
                Message::Standing(standing, films) => {
                    let (found, short) = self.found.clone().unwrap_or((UNTOLD.to_owned(), UNTOLD.to_owned()));
                    self.line = format!("judging: {standing}; {found}");
                    self.verdict = progress(*films, &short, &self.line);
                }
                Message::Analysis(analysis, pictures) => {
                    self.over = analysis.ended.is_some();
                    let state = if self.over { "judged" } else { "judging" };
                    let (found, size) = (analysis.line(), analysis.size);
                    self.line = format!(
                        "{state}: {found} ({} films of {} spp each at {}x{})",
                        analysis.films, analysis.spp, size.x, size.y
                    );
                    self.verdict = match self.over {
                        true => Verdict { state: state_of(analysis), short: analysis.short(), line: self.line.clone() },
                        false => progress(analysis.films, &analysis.so_far(), &self.line),
                    };
                    self.found = Some((found, analysis.so_far()));
                    self.split = Some((size, self.split_picture(analysis, pictures)));
                }
                Message::Unchanged => {
                    (self.over, self.line) = (true, format!("judged: {UNCHANGED}"));
                    let short = "changes nothing of what the scene runs".to_owned();
                    self.verdict = Verdict { state: State::Unchanged, short, line: self.line.clone() };
                }
                Message::Failed(error) => {
                    (self.over, self.line) = (true, rendered(error, false));
                    let short = format!("judging failed: {error}").lines().next().unwrap_or_default().to_owned();
                    self.verdict = Verdict { state: State::Failed, short, line: self.line.clone() };
                }
            }
        }
        !messages.is_empty()
    }

    /// Lets it rest from the next batch on, or go on.
    pub fn rest(&self, on: bool) {
        self.control.pause.set(on);
    }

    /// Ends it, without waiting for the thread: that may compile for a while yet.
    pub fn end(mut self) -> Option<JoinHandle<()>> {
        self.thread.take()
    }

    fn split_picture(&self, analysis: &Analysis, [old, new]: &[Vec<[f32; 3]>; 2]) -> Vec<[u8; 4]> {
        let [old, new] = [old, new].map(|picture| marked(picture, analysis.size, self.scale, &analysis.means));
        [old, new].concat()
    }
}

impl Drop for Judging {
    fn drop(&mut self) {
        self.control.stop.store(true, Ordering::Relaxed);
        self.control.pause.set(false);
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has said so.
            let _ = thread.join();
        }
    }
}

/// Threads that were stopped, and are waited for before the device goes.
#[derive(Default)]
pub struct Ending(Vec<JoinHandle<()>>);

impl Ending {
    /// Keeps a thread that was stopped, and forgets those that have ended.
    pub fn wait_for(&mut self, thread: Option<JoinHandle<()>>) {
        self.0.retain(|thread| !thread.is_finished());
        self.0.extend(thread);
    }
}

impl Drop for Ending {
    fn drop(&mut self) {
        for thread in self.0.drain(..) {
            // A thread that panicked has said so.
            let _ = thread.join();
        }
    }
}

/// How far it is in few words.
fn progress(films: usize, found: &str, line: &str) -> Verdict {
    Verdict { state: State::Judging, short: format!("judging: {films} films; {found}"), line: line.to_owned() }
}

fn state_of(analysis: &Analysis) -> State {
    match analysis.verdict {
        judge::Verdict::Differ => State::Differ,
        judge::Verdict::Agree(_) => State::Agree,
        judge::Verdict::CannotTell(_) => State::CannotTell,
    }
}

fn judge(
    [old, new]: &[Library; 2],
    place: &Place,
    control: Control,
    messages: &Sender<Message>,
) -> Result<(), JudgeError> {
    let Place { gpu, scene, batch, seconds, wake } = place;
    let plan = Plan {
        spp: None,
        whole: false,
        begin: Instant::now(),
        seconds: Some(*seconds),
        films: None,
        alpha: 1e-3,
        within: WITHIN,
        seed: scene.render.seed,
        batch: *batch,
    };
    let mut judge = Judge::open(gpu, [old, new], scene, plan, control)?;
    if !judge.changed() {
        let _ = messages.send(Message::Unchanged);
        return Ok(());
    }
    let mut told = Instant::now();
    loop {
        let analysis = judge.advance()?;
        let ended = analysis.as_ref().is_some_and(|analysis| analysis.ended.is_some());
        let message = match analysis {
            Some(analysis) => Message::Analysis(Box::new(analysis), judge.pictures()),
            None if told.elapsed() >= REPORT => Message::Standing(standing(&judge), judge.films()),
            None => continue,
        };
        told = Instant::now();
        // A window that has gone takes nothing.
        let received = messages.send(message).is_ok();
        if ended || !received {
            return Ok(());
        }
        let _ = wake.send_event(());
    }
}
