//! Takes pieces in their order: the plain statements of each in bulk, and all other lines one by one.
//!
//! Plain statements need no message, whatever came before them, or say how it is known that they don't.

use super::super::geometry::{Counts, FaceRun, Values};
use super::super::plain::{Event, Piece, PlainFaces};
use super::{MAX_COUNT, Scanned, Scanner};
use crate::scene::lines::{Line, Lines};

/// What can't be told of a piece by itself, or in bulk: the file has to be read line by line.
#[derive(Clone, Copy, Debug)]
pub struct NotPlain;

impl Scanner<'_> {
    /// Takes the pieces of a whole file, in their order. `line_at` reads the line at a byte of the file, whose number is one more than that
    /// given.
    pub fn take(
        mut self,
        pieces: impl IntoIterator<Item = Piece>,
        line_at: impl Fn(u64, u32) -> Option<Line>,
    ) -> Result<Scanned, NotPlain> {
        for piece in pieces {
            self.take_piece(piece, &line_at)?;
        }
        // Why there is none, is told by who reads line by line.
        if self.triangles == 0 { Err(NotPlain) } else { Ok(self.finish()) }
    }

    fn take_piece(&mut self, piece: Piece, line_at: &impl Fn(u64, u32) -> Option<Line>) -> Result<(), NotPlain> {
        let Piece { values, corners, events, odd, lines, offset } = piece;
        let source = self.lists.len() as u32;
        self.lists.push(corners);
        let mut line = Line::default();
        let (mut at, mut faces, mut starts, mut text) = ([0; 3], 0, [0; 3], odd.as_slice());
        for event in events {
            match event {
                Event::Values(counts) => at = self.take_values(&values, at, counts)?,
                Event::Line { bytes, before } => {
                    let (one, rest) = text.split_at(bytes as usize);
                    text = rest;
                    let mut reader = Lines::behind(one, self.file, self.lines + before);
                    match reader.next(&mut line).map_err(|_| NotPlain)? {
                        true => self.statement(&line).map_err(|_| NotPlain)?,
                        false => return Err(NotPlain),
                    }
                }
                Event::Faces(plain) => {
                    let PlainFaces { corners, uvs, normals, .. } = plain;
                    let run = FaceRun {
                        source,
                        faces: faces..faces + plain.faces,
                        starts,
                        corners,
                        before: self.values.counts(),
                    };
                    faces = run.faces.end;
                    [true, uvs, normals].iter().zip(&mut starts).for_each(|(has, at)| *at += u32::from(*has) * corners);
                    let line = (offset + plain.first, self.lines + plain.before);
                    self.take_faces(&plain, run, || line_at(line.0, line.1))?;
                }
            }
        }
        self.lines += lines;
        Ok(())
    }

    /// Takes faces of a piece; `line` reads the first one's.
    fn take_faces(
        &mut self,
        plain: &PlainFaces,
        run: FaceRun,
        line: impl FnOnce() -> Option<Line>,
    ) -> Result<(), NotPlain> {
        if !plain.fits(run.before) {
            return Err(NotPlain);
        }
        self.count_triangles(plain.corners - 2 * plain.faces).ok_or(NotPlain)?;
        if self.has_to_tell(plain.normals) {
            let line = line().ok_or(NotPlain)?;
            let (key, _) = line.statement().ok_or(NotPlain)?;
            self.tell_of_face(&line, key, plain.normals);
        }
        if self.faces.add(run, plain.uvs, plain.normals) { Ok(()) } else { Err(NotPlain) }
    }

    /// Takes the next values of a piece, from its `at` on. Returns what follows them.
    fn take_values(&mut self, values: &Values, at: Counts, counts: Counts) -> Result<Counts, NotPlain> {
        let [positions, uvs, normals] = [0, 1, 2].map(|kind| at[kind] as usize..(at[kind] + counts[kind]) as usize);
        self.values.positions.extend_from_slice(&values.positions[positions]);
        self.values.uvs.extend_from_slice(&values.uvs[uvs]);
        self.values.normals.extend_from_slice(&values.normals[normals]);
        match self.values.counts().iter().all(|count| *count <= MAX_COUNT) {
            true => Ok([0, 1, 2].map(|kind| at[kind] + counts[kind])),
            false => Err(NotPlain),
        }
    }

    /// Whether `tell_of_face` may have something to tell that was not told before.
    fn has_to_tell(&self, normals: bool) -> bool {
        !self.faces.has_material() && !self.tally.has_told("faces without material")
            || self.smoothing && !normals && !self.tally.has_told("smoothing")
    }
}
