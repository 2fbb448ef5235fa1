//! The last edit of the shaders judged in the window: by two engines of a thread of their own, on the window's device.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use glam::UVec2;
use winit::event_loop::EventLoopProxy;

use crate::app::judge::{Analysis, Judge, JudgeError, Plan, SECONDS, UNCHANGED, WITHIN, marked, standing};
use crate::app::shared::failure::rendered;
use crate::gpu::Gpu;
use crate::scene::SceneDescription;
use crate::shader::Library;

/// Between two messages of how far it is: each has the window drawn.
const REPORT: Duration = Duration::from_millis(500);

/// What the thread sends.
enum Message {
    /// How far it is.
    Standing(String),
    /// An analysis, and the mean radiance of the films so far, the old shaders' first.
    Analysis(Box<Analysis>, [Vec<[f32; 3]>; 2]),
    Unchanged,
    Failed(JudgeError),
}

/// Judging that is under way, or over.
pub struct Judging {
    messages: Receiver<Message>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    /// By which radiance is multiplied to be shown.
    scale: f64,
    /// Nothing more will come.
    over: bool,
    /// What the last analysis has found.
    found: Option<String>,
    /// How far it is, and what was found so far.
    pub line: String,
    /// The size of one picture, and both: by the old shaders, then by the new ones; the differing blocks are marked.
    pub split: Option<(UVec2, Vec<[u8; 4]>)>,
}

impl Judging {
    /// Starts to judge. `wake` is called whenever there is something to take.
    pub fn start(gpu: Arc<Gpu>, sides: [Library; 2], scene: SceneDescription, wake: EventLoopProxy<()>) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let (sender, messages) = channel();
        let (exposure, told) = (scene.film.exposure, stop.clone());
        let thread = std::thread::spawn(move || {
            if let Err(error) = judge(&gpu, &sides, &scene, &told, &sender, &wake) {
                let _ = sender.send(Message::Failed(error));
            }
            let _ = wake.send_event(());
        });
        Self {
            messages,
            stop,
            thread: Some(thread),
            scale: f64::from(exposure).exp2(),
            over: false,
            found: None,
            line: "judging: compiling both".to_owned(),
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
                Message::Standing(standing) => {
                    let found = self.found.as_deref().unwrap_or("nothing can be told yet");
                    self.line = format!("judging: {standing}; {found}");
                }
                Message::Analysis(analysis, pictures) => {
                    self.over = analysis.ended.is_some();
                    let state = if self.over { "judged" } else { "judging" };
                    let (found, size) = (analysis.line(), analysis.size);
                    self.line = format!(
                        "{state}: {found} ({} films of {} spp each at {}x{})",
                        analysis.films, analysis.spp, size.x, size.y
                    );
                    self.found = Some(found);
                    self.split = Some((size, self.split_picture(analysis, pictures)));
                }
                Message::Unchanged => (self.over, self.line) = (true, format!("judged: {UNCHANGED}")),
                Message::Failed(error) => (self.over, self.line) = (true, rendered(error, false)),
            }
        }
        !messages.is_empty()
    }

    fn split_picture(&self, analysis: &Analysis, [old, new]: &[Vec<[f32; 3]>; 2]) -> Vec<[u8; 4]> {
        let [old, new] = [old, new].map(|picture| marked(picture, analysis.size, self.scale, &analysis.means));
        [old, new].concat()
    }
}

impl Judging {
    /// Ends it, without waiting for the thread: that may compile for a while yet.
    pub fn end(mut self) -> Option<JoinHandle<()>> {
        self.thread.take()
    }
}

impl Drop for Judging {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
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

fn judge(
    gpu: &Arc<Gpu>,
    [old, new]: &[Library; 2],
    scene: &SceneDescription,
    stop: &Arc<AtomicBool>,
    messages: &Sender<Message>,
    wake: &EventLoopProxy<()>,
) -> Result<(), JudgeError> {
    let plan = Plan {
        spp: None,
        whole: false,
        begin: Instant::now(),
        seconds: Some(SECONDS),
        films: None,
        alpha: 1e-3,
        within: WITHIN,
        seed: scene.render.seed,
    };
    let mut judge = Judge::open(gpu, [old, new], scene, plan, stop.clone())?;
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
            None if told.elapsed() >= REPORT => Message::Standing(standing(&judge)),
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
