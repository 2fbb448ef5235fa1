//! Pictures that are written while they are made: strips of rows go to a thread a file, so that memory holds two of them at most, however
//! large the picture is.

use std::io;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::file::SaveError;
use super::source::{Frame, Metadata, Source, Strip, Told};
use super::write::{Kind, Output};

/// The pixels of some rows.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// Linear Rec.709 radiance, row by row.
    pub linear: Vec<[f32; 3]>,
    /// The same as it is shown: sRGB, 8 bits, the fourth is ignored.
    pub display: Vec<[u8; 4]>,
}

/// What a thread is sent.
enum Part {
    Rows(Arc<Rows>),
    /// There are no more, and what repeats the render is this. Without it, the picture was given up.
    End(Arc<Vec<(&'static str, String)>>),
}

/// The rows that a thread is sent.
struct Sent {
    parts: Receiver<Part>,
    rows: Arc<Rows>,
    metadata: Arc<Vec<(&'static str, String)>>,
    ended: bool,
    /// Bytes that metadata may take.
    most: usize,
    waited: Duration,
}

impl Source for Sent {
    fn strip(&mut self) -> io::Result<Option<Strip<'_>>> {
        // Before waiting for others: what is held here can't be freed.
        self.rows = Arc::default();
        let begin = Instant::now();
        let part = if self.ended { None } else { Some(self.parts.recv()) };
        self.waited += begin.elapsed();
        match part {
            None => Ok(None),
            Some(Ok(Part::Rows(rows))) => {
                self.rows = rows;
                Ok(Some(Strip { linear: &self.rows.linear, display: &self.rows.display }))
            }
            Some(Ok(Part::End(metadata))) => {
                (self.metadata, self.ended) = (metadata, true);
                Ok(None)
            }
            Some(Err(_)) => Err(io::Error::other("the picture was given up")),
        }
    }

    fn metadata(&self) -> Told<'_> {
        if self.ended { Told::Now(&self.metadata) } else { Told::AtTheEnd(self.most) }
    }
}

/// A file that is being written.
struct Written {
    output: Output,
    parts: SyncSender<Part>,
    thread: JoinHandle<(Result<(), SaveError>, f64)>,
}

/// How the writing of a file ended.
pub type Ending = (Output, Result<f64, SaveError>);

impl Written {
    fn begin(output: Output, frame: Frame, most: usize) -> Self {
        let (parts, received) = sync_channel(0);
        let file = output.clone();
        let thread = std::thread::spawn(move || {
            let begin = Instant::now();
            let (rows, metadata) = Default::default();
            let mut sent = Sent { parts: received, rows, metadata, ended: false, most, waited: Duration::ZERO };
            let result = file.write_rows(&frame, &mut sent);
            (result, begin.elapsed().saturating_sub(sent.waited).as_secs_f64())
        });
        Self { output, parts, thread }
    }

    /// Waits until the thread is done; of one that was not sent the end, the file is gone then.
    fn end(self) -> Ending {
        drop(self.parts);
        let (result, seconds) = self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (self.output, result.map(|()| seconds))
    }
}

/// Files that are written strip by strip. Dropped before their end, they leave nothing.
#[derive(Default)]
pub struct Strips {
    files: Vec<Written>,
    /// Those that could not be written to their end.
    failed: Vec<Ending>,
}

impl Strips {
    /// Begins the pictures among some files. `most`: bytes that metadata take at most, as JSON.
    pub fn begin(files: &[Output], frame: Frame, most: usize) -> Self {
        let pictures = files.iter().filter(|file| file.kind != Kind::Json);
        Self { files: pictures.map(|file| Written::begin(file.clone(), frame, most)).collect(), failed: Vec::new() }
    }

    /// Hands the rows below the last ones to all that can still be written; waits for those that still write the last ones.
    pub fn add(&mut self, rows: Rows) {
        let rows = Arc::new(rows);
        self.send(|| Part::Rows(rows.clone()));
    }

    /// Whether not one of some pictures can be written any more.
    pub fn have_all_failed(&self) -> bool {
        self.files.is_empty() && !self.failed.is_empty()
    }

    /// Ends all of them: what is left of their windows is black. Says of each file how that went, in no order.
    pub fn finish(mut self, metadata: &Metadata) -> Vec<Ending> {
        let metadata = Arc::new(metadata.to_vec());
        self.send(|| Part::End(metadata.clone()));
        let mut endings = std::mem::take(&mut self.failed);
        endings.extend(std::mem::take(&mut self.files).into_iter().map(Written::end));
        endings
    }

    fn send(&mut self, part: impl Fn() -> Part) {
        for file in std::mem::take(&mut self.files) {
            match file.parts.send(part()) {
                Ok(()) => self.files.push(file),
                // The thread has gone: it could not write.
                Err(_) => self.failed.push(file.end()),
            }
        }
    }
}

impl Drop for Strips {
    fn drop(&mut self) {
        std::mem::take(&mut self.files).into_iter().for_each(|file| drop(file.end()));
    }
}
