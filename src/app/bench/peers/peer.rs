//! Mitsuba, running beside: told what to render by lines, and gone when this is dropped.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use glam::UVec2;
use serde::Deserialize;

use super::error::PeerError;
use super::python::Python;
use crate::app::bench::BenchError;
use crate::app::shared::interrupt::Interrupt;
use crate::app::shared::output;
use crate::image::{PictureFile, file};

/// What it runs.
const SCRIPT: &str = include_str!("peer.py");

/// Between two looks at signals.
const POLL: Duration = Duration::from_millis(50);

/// Samples of one call, at most: Mitsuba numbers them by 32 bits.
const MOST_SAMPLES: u64 = 1 << 30;

/// Lines of its standard error that are kept for a message.
const LAST_LINES: usize = 3;

/// A running Mitsuba with a scene.
pub struct Peer {
    child: Child,
    /// Closed, it ends.
    commands: ChildStdin,
    answers: Receiver<String>,
    said: Arc<Mutex<VecDeque<String>>>,
    /// The picture that it writes.
    picture: PathBuf,
    run: String,
    size: UVec2,
    interrupt: Interrupt,
}

/// A picture, and what it took.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// Linear Rec.709 radiance, row by row from the top.
    pub rgb: Vec<[f32; 3]>,
    /// Of rendering alone; without compiling, if that was done before.
    pub seconds: f64,
}

/// A line that it answers.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Answer {
    pub version: Option<String>,
    pub seconds: Option<f64>,
    pub error: Option<String>,
    /// Variants that there are, where the one that was asked for is not.
    pub known: Option<Vec<String>>,
}

impl Answer {
    /// What a line says; an error if it says that something is wrong, or nothing.
    pub fn of(line: &str) -> Result<Self, PeerError> {
        let answer: Self = serde_json::from_str(line).map_err(|_| PeerError::NoAnswer { line: line.to_owned() })?;
        match (&answer.error, &answer.known) {
            (Some(error), Some(known)) => {
                Err(PeerError::Refused { said: format!("{error}; it has {}", known.join(", ")) })
            }
            (Some(error), None) => Err(PeerError::Refused { said: error.lines().collect::<Vec<_>>().join(" ") }),
            (None, _) => Ok(answer),
        }
    }
}

impl Peer {
    /// Starts it on a scene's file, with pictures of `size`. Its script is beside that, and its pictures are in `folder`. None if a signal
    /// came before it was ready.
    pub fn start(
        python: &Python,
        variant: &str,
        (scene, size): (&Path, UVec2),
        folder: &Path,
        (interrupt, quiet): (&Interrupt, bool),
    ) -> Result<Option<Self>, BenchError> {
        let script = scene.with_file_name("peer.py");
        file::write_text(&script, SCRIPT)?;
        let mut command = Command::new(&python.path);
        command.arg(&script).arg(variant).arg(scene);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let failed = |source| PeerError::NoPython { path: python.path.clone(), source };
        let mut child = command.spawn().map_err(failed)?;
        let (out, errors) = (child.stdout.take(), child.stderr.take());
        let commands = child.stdin.take().expect("invariant: it was asked for");
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            let lines = out.into_iter().flat_map(|out| BufReader::new(out).lines()).map_while(Result::ok);
            lines.take_while(|line| sender.send(line.clone()).is_ok()).for_each(drop);
        });
        let said = Arc::new(Mutex::new(VecDeque::new()));
        let heard = said.clone();
        std::thread::spawn(move || {
            let lines = errors.into_iter().flat_map(|errors| BufReader::new(errors).lines()).map_while(Result::ok);
            for line in lines.filter(|line| !line.trim().is_empty()) {
                let mut said = heard.lock().unwrap_or_else(PoisonError::into_inner);
                if !quiet && !said.contains(&line) {
                    output::note(&format!("mitsuba: {line}"));
                }
                said.push_back(line);
                if said.len() > LAST_LINES {
                    said.pop_front();
                }
            }
        });
        let run = format!("{} {} {variant} {}", python.path.display(), script.display(), scene.display());
        let picture = folder.join("peer.exr");
        let interrupt = interrupt.clone();
        let mut peer = Self { child, commands, answers, said, picture, run, size, interrupt };
        Ok(peer.answer()?.map(|_| peer))
    }

    /// Renders so many samples a pixel. None if a signal came before its end.
    pub fn render(&mut self, spp: u32, seed: u32) -> Result<Option<Rendered>, BenchError> {
        let pixels = u64::from(self.size.x) * u64::from(self.size.y);
        let most = (MOST_SAMPLES / pixels).clamp(1, u64::from(u32::MAX)) as u32;
        let (mut sum, mut seconds, mut done) = (vec![[0.0f64; 3]; pixels as usize], 0.0, 0);
        while done < spp {
            let part = most.min(spp - done);
            // Parts of one picture are of other numbers.
            let Some(part_of_it) = self.part(part, seed.wrapping_add(done.wrapping_mul(0x9e37_79b1)))? else {
                return Ok(None);
            };
            for (sum, pixel) in sum.iter_mut().zip(part_of_it.rgb) {
                (0..3).for_each(|c| sum[c] += f64::from(pixel[c]) * f64::from(part));
            }
            (seconds, done) = (seconds + part_of_it.seconds, done + part);
        }
        let rgb = sum.into_iter().map(|pixel| pixel.map(|channel| (channel / f64::from(spp)) as f32)).collect();
        Ok(Some(Rendered { rgb, seconds }))
    }

    /// The same by one call.
    fn part(&mut self, spp: u32, seed: u32) -> Result<Option<Rendered>, BenchError> {
        let command = format!("render {spp} {seed} {}\n", self.picture.display());
        // Where nobody reads it, the answer that does not come says why.
        let _ = self.commands.write_all(command.as_bytes()).and_then(|()| self.commands.flush());
        let Some(answer) = self.answer()? else { return Ok(None) };
        let no_picture = || PeerError::NoAnswer { line: "a picture of another size".to_owned() };
        let picture = PictureFile::open(&self.picture).and_then(|file| file.read_all()).map_err(|_| no_picture())?;
        if picture.len() != (self.size.x * self.size.y) as usize {
            return Err(no_picture().into());
        }
        Ok(answer.seconds.map(|seconds| Rendered { rgb: picture, seconds }))
    }

    /// Waits for an answer. None if a signal comes first.
    fn answer(&mut self) -> Result<Option<Answer>, BenchError> {
        loop {
            match self.answers.recv_timeout(POLL) {
                Ok(line) => return Ok(Some(Answer::of(&line)?)),
                Err(_) if self.interrupt.requested() => return Ok(None),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Err(self.ended().into()),
            }
        }
    }

    fn ended(&mut self) -> PeerError {
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        let last = said.iter().map(|line| format!("\n    {line}")).collect();
        PeerError::Ended { status, last, run: self.run.clone() }
    }
}

impl Drop for Peer {
    /// Ends it, whatever it is at.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
