//! Reads OBJ text, reports what is wrong in it, and passes on what is right.

use std::io::{BufRead, Read};
use std::path::Path;

use super::faces::{Corner, Group, Grouping};
use super::libraries::{MAX_LIBRARIES, Statement};
use super::statements::{Counts, KNOWN, corner, is_beyond_us, numbers, position};
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity, Tally};
use crate::scene::lines::{Line, Lines, unquoted, words};
use crate::scene::model::DEFAULT_MATERIAL;
use crate::scene::suggest::did_you_mean;

/// Vertices, normals or texture coordinates that a file may have, and triangles that its faces may come to. No device binds
/// more than 2 GiB, which is 44 million triangles of 48 bytes: what is refused here could not be rendered.
const MAX_COUNT: u32 = 1 << 26;

/// Corners that a face may have: clipping the ears of a face takes up to the square of its corners.
const MAX_CORNERS: usize = 1 << 14;

/// Errors after which the rest is not read: noise has one on every line.
const MAX_ERRORS: u32 = 10;

/// Bytes of plain text made at once.
const BLOCK: usize = 1 << 16;

/// What a file says beside its geometry.
#[derive(Debug)]
pub struct Scanned {
    pub messages: Diagnostics,
    pub groups: Vec<Group>,
    pub libraries: Vec<Statement>,
}

/// Plain OBJ text for tobj, made from a file as it is read.
pub struct Scanner<'f, R> {
    lines: Lines<R>,
    line: Line,
    tally: Tally,
    faces: Grouping,
    corners: Vec<Corner>,
    counts: Counts,
    triangles: u32,
    smoothing: bool,
    errors: u32,
    libraries: Vec<Statement>,
    out: Vec<u8>,
    /// Bytes of `out` that were read.
    taken: usize,
    ended: bool,
    file: &'f Path,
}

impl<'f, R: BufRead> Scanner<'f, R> {
    /// `file` is the name in messages.
    pub fn new(reader: R, file: &'f Path) -> Self {
        Self {
            lines: Lines::new(reader, file),
            line: Line::default(),
            tally: Tally::new(file),
            faces: Grouping::default(),
            corners: Vec::new(),
            counts: Counts { positions: 0, uvs: 0, normals: 0 },
            triangles: 0,
            smoothing: false,
            errors: 0,
            libraries: Vec::new(),
            out: Vec::with_capacity(2 * BLOCK),
            taken: 0,
            ended: false,
            file,
        }
    }

    /// What there was, when all was read.
    pub fn finish(mut self) -> Scanned {
        let zeros = self.lines.zeros();
        if self.triangles == 0 && !self.tally.diagnostics.has_errors() {
            let end = self.lines.number().max(1);
            let error = zeros.unwrap_or_else(|| {
                Diagnostic::at(Severity::Error, self.file, end, "", 0, "the file ends here without a face")
                    .help("a model needs `v` and `f` lines; was it exported whole?")
            });
            self.tally.diagnostics.push(error);
        } else if let Some(zeros) = zeros {
            let message = "zero bytes fill the end of this file: they are left out".to_owned();
            self.tally.diagnostics.push(Diagnostic { severity: Severity::Warning, message, ..zeros });
        }
        Scanned { messages: self.tally.finish(), groups: self.faces.groups, libraries: self.libraries }
    }

    /// Makes the next block of plain text.
    fn fill(&mut self) {
        self.out.clear();
        self.taken = 0;
        while self.out.len() < BLOCK && !self.ended {
            let mut line = std::mem::take(&mut self.line);
            match self.lines.next(&mut line) {
                Ok(true) => {
                    if let Err(error) = self.statement(&line) {
                        self.tally.diagnostics.push(error);
                        self.errors += 1;
                        self.ended |= self.errors >= MAX_ERRORS;
                    }
                }
                Ok(false) => self.ended = true,
                Err(error) => {
                    self.tally.diagnostics.push(error);
                    self.ended = true;
                }
            }
            self.line = line;
            if self.ended || self.faces.is_full() {
                self.faces.flush(&mut self.out);
            }
            if self.errors > 0 {
                // The model is lost: read on for further messages, and give tobj no more work.
                self.out.clear();
            }
        }
    }

    /// Takes one statement.
    fn statement(&mut self, line: &Line) -> Result<(), Diagnostic> {
        let Some((key, rest)) = line.statement() else { return Ok(()) };
        match key {
            "v" => self.vertex(line, key, rest),
            "vn" => self.normal(line, key, rest),
            "vt" => self.uv(line, key, rest),
            "f" | "fo" => self.face(line, key, rest),
            "o" => {
                self.faces.set_object(rest);
                Ok(())
            }
            "g" => {
                self.faces.set_group(rest);
                Ok(())
            }
            "usemtl" if rest.is_empty() => Err(line.error(key, "`usemtl` without a name")),
            "usemtl" => {
                self.faces.set_material(unquoted(rest), line.warning(rest, ""));
                Ok(())
            }
            "mtllib" => self.library(line, key, rest),
            "s" => {
                self.smoothing = !matches!(rest, "off" | "0" | "null");
                Ok(())
            }
            "l" | "p" => {
                self.tally.once("points and lines", || {
                    line.warning(key, "points and lines have no surface: they are left out in this whole file")
                });
                Ok(())
            }
            _ if is_beyond_us(key) => {
                self.tally.push("statements not supported", || {
                    line.warning(key, format!("`{key}` is not supported: it is left out"))
                });
                Ok(())
            }
            _ => Err(unknown(line, key)),
        }
    }

    /// `v x y z`. A wrong one still counts, so that later indices keep their meaning.
    fn vertex(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        count(&mut self.counts.positions, line, key)?;
        let ([x, y, z], more) = position(line, key, rest)?;
        self.put(&["v ", x, " ", y, " ", z, "\n"]);
        if more {
            self.tally.once("weights", || {
                line.warning(key, "weights and colours of vertices are left out in this whole file")
            });
        }
        Ok(())
    }

    /// `vn x y z`. Zero stands for a normal that can't be used, and is replaced by the face's own.
    fn normal(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        count(&mut self.counts.normals, line, key)?;
        let values = numbers::<3>(line, key, rest, 3)?;
        let normal = values.map(|value| value.unwrap_or(f64::NAN));
        let length = normal.iter().map(|value| value * value).sum::<f64>().sqrt();
        let usable = length > 1e-150 && length.is_finite();
        if !usable {
            self.tally.push("normals without a direction", || {
                line.warning(key, "this normal has no direction: the normals of the faces that use it take its place")
            });
            self.put(&["vn 0 0 0\n"]);
            return Ok(());
        }
        let text = format!("vn {} {} {}\n", normal[0], normal[1], normal[2]);
        self.put(&[&text]);
        Ok(())
    }

    /// `vt u [v]`.
    fn uv(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        count(&mut self.counts.uvs, line, key)?;
        let values = numbers::<2>(line, key, rest, 1)?;
        if values.contains(&None) {
            self.tally.push("texture coordinates that are not finite", || {
                line.warning(key, "this texture coordinate is not finite: 0 takes its place")
            });
        }
        let [u, v] = values.map(|value| value.unwrap_or(0.0));
        let text = format!("vt {u} {v}\n");
        self.put(&[&text]);
        Ok(())
    }

    /// `f` and its corners.
    fn face(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        self.corners.clear();
        for word in words(rest) {
            if self.corners.len() == MAX_CORNERS {
                let message = format!("a face of more than {MAX_CORNERS} corners");
                return Err(line.error(word, message).help("triangulate the model before export"));
            }
            self.corners.push(corner(line, word, self.counts)?);
        }
        if self.corners.len() < 3 {
            let message = format!("a face has at least three corners, this one has {}", self.corners.len());
            return Err(line.error(key, message));
        }
        self.triangles = self.triangles.saturating_add(self.corners.len() as u32 - 2);
        if self.triangles > MAX_COUNT {
            self.ended = true;
            return Err(line.error(key, format!("more than {MAX_COUNT} triangles")).help("split the model into files"));
        }
        self.warn_of_face(line, key);
        if self.errors == 0 && !self.faces.add(&self.corners) {
            self.ended = true;
            return Err(line.error(key, "too many objects and groups").help("join some of them before export"));
        }
        Ok(())
    }

    /// Attributes that are given for some corners only, and smoothing that nothing tells the shape of.
    fn warn_of_face(&mut self, line: &Line, key: &str) {
        let uvs = self.corners.iter().filter(|(_, uv, _)| uv.is_some()).count();
        let normals = self.corners.iter().filter(|(.., normal)| normal.is_some()).count();
        if [uvs, normals].iter().any(|count| *count > 0 && *count < self.corners.len()) {
            self.tally.push("faces with incomplete corners", || {
                line.warning(key, "normals or texture coordinates of some corners only: this face is used without them")
            });
        }
        if !self.faces.has_material() {
            self.tally.once("faces without material", || {
                let message =
                    format!("no `usemtl` before this face: such faces are rendered as `{DEFAULT_MATERIAL}`, a grey");
                line.warning(key, message).help("a scene file can change it under `materials`")
            });
        }
        if self.smoothing && normals == 0 {
            self.tally.once("smoothing", || {
                line.warning(
                    key,
                    "a smoothing group (`s`) without normals: such faces are rendered flat in this whole file",
                )
            });
        }
    }

    /// `mtllib` and its names.
    fn library(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        if rest.is_empty() {
            self.tally.push("libraries without a name", || {
                line.warning(key, "`mtllib` without a file name is left out").help("name the model's .mtl file")
            });
            return Ok(());
        }
        if self.libraries.len() >= MAX_LIBRARIES {
            return Err(line.error(key, format!("more than {MAX_LIBRARIES} material libraries")));
        }
        self.libraries.push(Statement { names: rest.to_owned(), place: line.warning(rest, "") });
        Ok(())
    }

    fn put(&mut self, pieces: &[&str]) {
        for piece in pieces {
            self.out.extend_from_slice(piece.as_bytes());
        }
    }
}

/// Counts one more vertex, normal or texture coordinate.
fn count(counter: &mut u32, line: &Line, key: &str) -> Result<(), Diagnostic> {
    if *counter >= MAX_COUNT {
        return Err(line.error(key, format!("more than {MAX_COUNT} `{key}` lines")).help("split the model into files"));
    }
    *counter += 1;
    Ok(())
}

/// A statement that OBJ files don't have.
fn unknown(line: &Line, key: &str) -> Diagnostic {
    let short: String = key.chars().take(40).collect();
    let help = did_you_mean(key, KNOWN.iter().copied());
    let help = help.unwrap_or_else(|| "is this an OBJ file? Comments begin with `#`".into());
    line.error(key, format!("unknown statement `{short}`")).help(help)
}

impl<R: BufRead> Read for Scanner<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let available = self.fill_buf()?;
        let count = available.len().min(buffer.len());
        buffer[..count].copy_from_slice(&available[..count]);
        self.consume(count);
        Ok(count)
    }
}

impl<R: BufRead> BufRead for Scanner<'_, R> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.taken == self.out.len() && !self.ended {
            self.fill();
        }
        Ok(&self.out[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        self.taken += amount;
    }
}
