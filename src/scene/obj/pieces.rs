//! Cuts a file into pieces at ends of lines, and has them read by all processors.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::plain::Piece;
use super::scanner::{NotPlain, Scanned, Scanner};
use crate::parallel;
use crate::scene::lines::{LINE_LIMIT, Line, Lines};

/// Bytes of a piece, about: many of them for each processor, and few enough that what is read twice of each costs nothing.
pub const PIECE: usize = 2 << 20;

/// Reads a whole file by pieces of about `size` bytes: what it comes to, and what is told of it, is as if it was read line by line.
pub fn read(file: &Path, handle: &File, size: usize) -> Result<Scanned, NotPlain> {
    let length = handle.metadata().map_err(|_| NotPlain)?.len();
    let cutter = Mutex::new(Cutter { handle, size, offset: 0, held: Vec::new(), ended: false, number: 0 });
    let run = || {
        let mut pieces = Vec::new();
        loop {
            let next = cutter.lock().unwrap_or_else(PoisonError::into_inner).next();
            match next {
                Ok(Some((number, offset, bytes))) => {
                    pieces.push((number, Piece::read(&bytes, offset).ok_or(NotPlain)?))
                }
                Ok(None) => return Ok(pieces),
                Err(NotPlain) => return Err(NotPlain),
            }
        }
    };
    let most = usize::try_from(length).unwrap_or(usize::MAX) / size + 1;
    let read = parallel::on_threads(most, run).into_iter().collect::<Result<Vec<_>, NotPlain>>()?;
    let mut pieces: Vec<(u32, Piece)> = read.into_iter().flatten().collect();
    pieces.sort_by_key(|(number, _)| *number);
    let line_at = |offset: u64, before: u32| {
        let mut handle = handle;
        handle.seek(SeekFrom::Start(offset)).ok()?;
        let mut line = Line::default();
        let found = Lines::behind(BufReader::new(handle), file, before).next(&mut line).ok()?;
        found.then_some(line)
    };
    Scanner::new(file).take(pieces.into_iter().map(|(_, piece)| piece), line_at)
}

/// Cuts pieces off a file from its beginning.
struct Cutter<'f> {
    handle: &'f File,
    size: usize,
    /// Where what is held begins.
    offset: u64,
    /// Read, and not passed on.
    held: Vec<u8>,
    ended: bool,
    number: u32,
}

impl Cutter<'_> {
    /// The next piece: its number, where it begins, and its bytes. None at the end.
    fn next(&mut self) -> Result<Option<(u32, u64, Vec<u8>)>, NotPlain> {
        let mut from = self.size;
        loop {
            self.fill(from + self.size.clamp(1 << 8, 1 << 16))?;
            let cut = match cut(&self.held, from) {
                Some(cut) => cut,
                None if self.ended => self.held.len(),
                None if self.held.len() > self.size + LINE_LIMIT => return Err(NotPlain),
                None => {
                    from = self.held.len() - 1;
                    continue;
                }
            };
            if cut == 0 {
                return Ok(None);
            }
            let rest = self.held.split_off(cut);
            let bytes = std::mem::replace(&mut self.held, rest);
            let place = (self.number, self.offset);
            self.number += 1;
            self.offset += cut as u64;
            return Ok(Some((place.0, place.1, bytes)));
        }
    }

    /// Has at least so many bytes held, where there are.
    fn fill(&mut self, length: usize) -> Result<(), NotPlain> {
        let Some(more) = length.checked_sub(self.held.len()).filter(|_| !self.ended) else { return Ok(()) };
        self.held.reserve(more);
        let mut handle = self.handle;
        let read = handle.by_ref().take(more as u64).read_to_end(&mut self.held).map_err(|_| NotPlain)?;
        self.ended = read < more;
        Ok(())
    }
}

/// Behind the first end of a line that is at `from` or later, and which a next line neither continues nor belongs to. None where what is
/// there doesn't tell.
fn cut(bytes: &[u8], from: usize) -> Option<usize> {
    (from.saturating_sub(1)..bytes.len()).find_map(|at| {
        let is_end = match bytes[at] {
            b'\n' => true,
            b'\r' => bytes.get(at + 1).is_some_and(|next| *next != b'\n'),
            _ => false,
        };
        let before = bytes[..at].strip_suffix(b"\r").unwrap_or(&bytes[..at]);
        (is_end && !before.trim_ascii_end().ends_with(b"\\")).then_some(at + 1)
    })
}
