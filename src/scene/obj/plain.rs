//! Plain lines of OBJ text, of which nothing is to be told whatever came before them: read from a piece of a file without knowing the rest.
//!
//! What is not plain (names, comments behind numbers, continued lines, all that is wrong or odd) is kept as it is written, for who takes the
//! pieces in their order.

use glam::{DVec3, Vec2, Vec3};

use super::decimal::decimal;
use super::geometry::{Corners, Counts, Values};
use super::statements::{MAX_CORNERS, unit, usable};
use crate::scene::lines::{CTRL_Z, LINE_LIMIT, Line, Lines};
use crate::scene::model::FARTHEST;

/// A piece of a file, read.
#[derive(Debug, Default)]
pub struct Piece {
    pub values: Values,
    pub corners: Corners,
    /// What is in it, in the order of its lines.
    pub events: Vec<Event>,
    /// The lines that are not plain, one behind the other.
    pub odd: Vec<u8>,
    /// Ends of lines.
    pub lines: u32,
    /// Where it begins in the file, bytes.
    pub offset: u64,
}

/// What follows next in a piece.
#[derive(Clone, Debug)]
pub enum Event {
    /// So many values.
    Values(Counts),
    Faces(PlainFaces),
    /// A line that is not plain: its bytes, and the lines before it in this piece.
    Line {
        bytes: u32,
        before: u32,
    },
}

/// Faces between which nothing else stands, and which have the same attributes.
#[derive(Clone, Debug)]
pub struct PlainFaces {
    pub faces: u32,
    pub corners: u32,
    pub uvs: bool,
    pub normals: bool,
    /// Where the first of them begins in the piece, and the lines before it there.
    pub first: u64,
    pub before: u32,
    /// The greatest and the least index, as written; 0 where there is none of that sign.
    greatest: [i32; 3],
    least: [i32; 3],
}

impl PlainFaces {
    /// Whether every index is of a value among those that came before.
    pub fn fits(&self, before: Counts) -> bool {
        let most = before.map(i64::from);
        (0..3).all(|kind| i64::from(self.greatest[kind]) <= most[kind] && -i64::from(self.least[kind]) <= most[kind])
    }
}

impl Piece {
    /// Reads a piece of a file that begins and ends with a line; `offset` is where it begins. None where lines have to be read in their order.
    pub fn read(bytes: &[u8], offset: u64) -> Option<Self> {
        let piece = Self { offset, ..Self::default() };
        let mut reader = Reader { bytes, at: 0, piece, weights: false };
        reader.piece.values.positions.reserve(bytes.len() / 64);
        while reader.at < bytes.len() {
            let start = reader.at;
            reader.line()?;
            // An error, even where the line is a comment.
            if reader.at - start > LINE_LIMIT {
                return None;
            }
        }
        Some(reader.piece)
    }

    /// Takes note of values.
    fn count(&mut self, kind: usize) {
        if let Some(Event::Values(counts)) = self.events.last_mut() {
            counts[kind] += 1;
        } else {
            let mut counts = [0; 3];
            counts[kind] = 1;
            self.events.push(Event::Values(counts));
        }
    }
}

/// Reads a piece from its beginning.
struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
    piece: Piece,
    /// A vertex with a weight or a colour was kept as it is: of others there is nothing to be told.
    weights: bool,
}

/// The line is not plain.
struct Odd;

impl Reader<'_> {
    /// Reads one line.
    fn line(&mut self) -> Option<()> {
        let start = self.at;
        self.blank();
        let next = |more: usize| self.bytes.get(self.at + more).copied();
        let read = match (next(0), next(1), next(2)) {
            (None | Some(b'\n' | b'\r'), ..) => self.end(),
            (Some(b'#'), ..) => {
                self.skip();
                self.end()
            }
            (Some(b'v'), Some(b' ' | b'\t'), _) => self.vertex(),
            (Some(b'v'), Some(b't'), Some(b' ' | b'\t')) => self.uv(),
            (Some(b'v'), Some(b'n'), Some(b' ' | b'\t')) => self.normal(),
            (Some(b'f'), Some(b' ' | b'\t'), _) => self.face(start),
            _ => Err(Odd),
        };
        read.or_else(|Odd| {
            self.at = start;
            self.keep().ok_or(Odd)
        })
        .ok()
    }

    /// Keeps a line as it is written, with those that continue it.
    fn keep(&mut self) -> Option<()> {
        let mut rest = &self.bytes[self.at..];
        let mut line = Line::default();
        // A mark at the beginning of the file belongs to no line, and is no such mark anywhere else.
        let first = self.piece.offset == 0 && self.at == 0;
        Lines::behind(&mut rest, std::path::Path::new(""), u32::from(!first)).next(&mut line).ok()?;
        let mut end = self.bytes.len() - rest.len();
        if self.bytes[end - 1] == b'\r' && rest.first() == Some(&b'\n') {
            end += 1;
        }
        let kept = &self.bytes[self.at..end];
        // These may be the end of the file, which only what follows them tells.
        if kept.iter().any(|byte| matches!(*byte, 0 | CTRL_Z)) {
            return None;
        }
        self.piece.odd.extend_from_slice(kept);
        self.piece.events.push(Event::Line { bytes: kept.len() as u32, before: self.piece.lines });
        self.piece.lines += line.physical() as u32;
        self.at = end;
        Some(())
    }

    /// `v x y z`.
    fn vertex(&mut self) -> Result<(), Odd> {
        self.at += 1;
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            *coordinate = self.number()?;
            if !(-FARTHEST..=FARTHEST).contains(coordinate) {
                return Err(Odd);
            }
        }
        self.blank();
        if !self.is_at_end() {
            if !std::mem::replace(&mut self.weights, true) {
                return Err(Odd);
            }
            self.words()?;
        }
        self.end()?;
        self.piece.values.positions.push(DVec3::from_array(position));
        self.piece.count(0);
        Ok(())
    }

    /// `vt u [v]`.
    fn uv(&mut self) -> Result<(), Odd> {
        self.at += 2;
        let u = self.number()? as f32;
        self.blank();
        let v = if self.is_at_end() { 0.0 } else { self.number()? as f32 };
        if !(u.is_finite() && v.is_finite()) {
            return Err(Odd);
        }
        self.words()?;
        self.end()?;
        self.piece.values.uvs.push(Vec2::new(u, v));
        self.piece.count(1);
        Ok(())
    }

    /// `vn x y z`.
    fn normal(&mut self) -> Result<(), Odd> {
        self.at += 2;
        let normal = DVec3::new(self.number()?, self.number()?, self.number()?);
        if !(normal.as_vec3().is_finite() && usable(normal)) {
            return Err(Odd);
        }
        self.words()?;
        self.end()?;
        let unit: Vec3 = unit(normal);
        self.piece.values.normals.push(unit);
        self.piece.count(2);
        Ok(())
    }

    /// `f` and its corners, of which all have the same attributes. `start` is where its line begins.
    fn face(&mut self, start: usize) -> Result<(), Odd> {
        let before = self.piece.corners.indices.each_ref().map(Vec::len);
        let read = self.corners();
        if read.is_err() {
            self.piece.corners.indices.iter_mut().zip(before).for_each(|(indices, before)| indices.truncate(before));
        }
        let corners = read?;
        let [_, uvs, normals] = [0, 1, 2].map(|kind| self.piece.corners.indices[kind].len() > before[kind]);
        self.piece.corners.arities.push(corners as u16);
        let alike = |faces: &&mut PlainFaces| faces.uvs == uvs && faces.normals == normals;
        let last = match self.piece.events.last_mut() {
            Some(Event::Faces(faces)) => Some(faces).filter(alike),
            _ => None,
        };
        let lists = &self.piece.corners.indices;
        let new = [0, 1, 2].map(|kind| &lists[kind][before[kind]..]);
        let greatest = new.map(|indices| indices.iter().copied().max().unwrap_or(0).max(0));
        let least = new.map(|indices| indices.iter().copied().min().unwrap_or(0).min(0));
        if let Some(faces) = last {
            faces.faces += 1;
            faces.corners += corners as u32;
            for kind in 0..3 {
                faces.greatest[kind] = faces.greatest[kind].max(greatest[kind]);
                faces.least[kind] = faces.least[kind].min(least[kind]);
            }
            return Ok(());
        }
        self.piece.events.push(Event::Faces(PlainFaces {
            faces: 1,
            corners: corners as u32,
            uvs,
            normals,
            first: start as u64,
            // The line of the face itself has been counted, where it has an end.
            before: self.piece.lines
                - u32::from(self.bytes[..self.at].ends_with(b"\n") || self.bytes[..self.at].ends_with(b"\r")),
            greatest,
            least,
        }));
        Ok(())
    }

    /// The corners of a face to the end of its line, how many they are.
    fn corners(&mut self) -> Result<usize, Odd> {
        self.at += 1;
        let mut count = 0;
        let mut attributes = None;
        loop {
            self.blank();
            if self.is_at_end() {
                break;
            }
            let has = self.corner()?;
            if *attributes.get_or_insert(has) != has || count == MAX_CORNERS {
                return Err(Odd);
            }
            count += 1;
        }
        self.end()?;
        if count < 3 { Err(Odd) } else { Ok(count) }
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`; whether there are the second and the third.
    fn corner(&mut self) -> Result<[bool; 2], Odd> {
        let position = self.index()?.ok_or(Odd)?;
        self.piece.corners.indices[0].push(position);
        let mut has = [false; 2];
        for (kind, has) in [1, 2].into_iter().zip(&mut has) {
            if self.bytes.get(self.at) != Some(&b'/') {
                break;
            }
            self.at += 1;
            if let Some(index) = self.index()? {
                self.piece.corners.indices[kind].push(index);
                *has = true;
            }
        }
        if self.is_at_end() || matches!(self.bytes[self.at], b' ' | b'\t') { Ok(has) } else { Err(Odd) }
    }

    /// An index other than 0; none where there is no digit.
    fn index(&mut self) -> Result<Option<i32>, Odd> {
        let negative = self.bytes.get(self.at) == Some(&b'-');
        self.at += usize::from(negative);
        let start = self.at;
        let mut index = 0i32;
        while let Some(digit) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_digit()) {
            if self.at - start == 9 {
                return Err(Odd);
            }
            index = index * 10 + i32::from(digit - b'0');
            self.at += 1;
        }
        match (self.at == start, index) {
            (true, _) if !negative => Ok(None),
            (true, _) | (_, 0) => Err(Odd),
            _ => Ok(Some(if negative { -index } else { index })),
        }
    }

    /// The next word as a number.
    fn number(&mut self) -> Result<f64, Odd> {
        self.blank();
        let (value, length) = decimal(&self.bytes[self.at..]).ok_or(Odd)?;
        self.at += length;
        Ok(value)
    }

    /// Skips words that mean nothing, up to the end of the line; a comment may go on in the next line.
    fn words(&mut self) -> Result<(), Odd> {
        while !self.is_at_end() {
            match self.bytes[self.at] {
                b'\\' | b'#' => return Err(Odd),
                b'\t' | b' '..=b'~' => self.at += 1,
                _ => return Err(Odd),
            }
        }
        Ok(())
    }

    /// Skips spaces.
    fn blank(&mut self) {
        while matches!(self.bytes.get(self.at), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    /// Skips to the end of the line, whatever it holds.
    fn skip(&mut self) {
        while !self.is_at_end() {
            self.at += 1;
        }
    }

    fn is_at_end(&self) -> bool {
        matches!(self.bytes.get(self.at), None | Some(b'\n' | b'\r'))
    }

    /// Takes the end of the line.
    fn end(&mut self) -> Result<(), Odd> {
        self.blank();
        match self.bytes.get(self.at) {
            None => return Ok(()),
            Some(b'\n') => self.at += 1,
            Some(b'\r') => self.at += 1 + usize::from(self.bytes.get(self.at + 1) == Some(&b'\n')),
            Some(_) => return Err(Odd),
        }
        self.piece.lines += 1;
        Ok(())
    }
}
