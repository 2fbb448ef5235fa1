//! Keeps edits on the disk, in a thread of its own: a slow disk makes no frame late.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use super::record::RowId;
use crate::app::edits::{Edit, EditsFolder, Kept, now};
use crate::image::SaveError;
use crate::shader::Library;

/// What the thread is told.
enum Message {
    /// An entry, the row before it, and its shaders.
    Keep(RowId, Box<Edit>, Option<RowId>, Option<Library>),
    /// More is known of an entry.
    Update(RowId, Box<Edit>),
    /// To be answered when all before it is done.
    Flush(Sender<()>),
}

/// What the thread says.
pub enum Said {
    /// The number of an entry.
    Number(RowId, u32),
    /// The first time that something could not be written.
    Failed(SaveError),
}

/// The thread, and what it has said.
pub struct Keeper {
    messages: Sender<Message>,
    said: Receiver<Said>,
}

impl Keeper {
    /// Keeps edits in a folder, which is made with the first. `wake` is called when there is something to hear.
    pub fn new(folder: PathBuf, wake: impl Fn() + Send + 'static) -> Self {
        let (messages, told) = channel();
        let (answers, said) = channel();
        std::thread::spawn(move || {
            let mut shelf = Shelf { folder: EditsFolder::new(folder), window: window(), kept: BTreeMap::new() };
            let mut failed = false;
            for message in told {
                let answer = match shelf.follow(message) {
                    Ok(answer) => answer,
                    // Told once: the next would fail for the same reason.
                    Err(error) => (!std::mem::replace(&mut failed, true)).then_some(Said::Failed(error)),
                };
                if let Some(answer) = answer {
                    let _ = answers.send(answer);
                    wake();
                }
            }
        });
        Self { messages, said }
    }

    /// Keeps an entry, with the shaders that may be gone back to.
    pub fn keep(&self, id: RowId, edit: &Edit, before: Option<RowId>, shaders: Option<Library>) {
        // A thread that is gone panicked, and has said so.
        let _ = self.messages.send(Message::Keep(id, Box::new(edit.clone()), before, shaders));
    }

    /// Keeps what is known of an entry by now.
    pub fn update(&self, id: RowId, edit: &Edit) {
        let _ = self.messages.send(Message::Update(id, Box::new(edit.clone())));
    }

    /// What was said since the last call.
    pub fn said(&self) -> impl Iterator<Item = Said> {
        self.said.try_iter()
    }

    /// Waits until all is written, or for so long.
    pub fn flush(&self, patience: Duration) {
        let (done, wait) = channel();
        if self.messages.send(Message::Flush(done)).is_ok() {
            let _ = wait.recv_timeout(patience);
        }
    }
}

/// The thread's own state.
struct Shelf {
    folder: EditsFolder,
    window: String,
    kept: BTreeMap<RowId, Kept>,
}

impl Shelf {
    fn follow(&mut self, message: Message) -> Result<Option<Said>, SaveError> {
        match message {
            Message::Keep(id, edit, before, shaders) => {
                let before = before.and_then(|before| Some(self.kept.get(&before)?.number));
                let shaders = shaders.map(|shaders| self.folder.keep_texts(&shaders)).transpose()?;
                let mut kept = Kept { number: 0, window: self.window.clone(), before, shaders, edit: *edit };
                self.folder.add(&mut kept)?;
                let number = kept.number;
                self.kept.insert(id, kept);
                Ok(Some(Said::Number(id, number)))
            }
            Message::Update(id, edit) => {
                if let Some(kept) = self.kept.get_mut(&id) {
                    kept.edit = *edit;
                    self.folder.update(kept)?;
                }
                Ok(None)
            }
            Message::Flush(done) => {
                let _ = done.send(());
                Ok(None)
            }
        }
    }
}

/// By which this window is told from others.
fn window() -> String {
    format!("{}-{}", now(), std::process::id())
}
