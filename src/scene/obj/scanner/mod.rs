//! Takes the statements of an OBJ file in their order: reports what is wrong, and keeps what is right.
//!
//! Statements come line by line, or in pieces that other threads have read ([`take`]).

mod take;

use std::io::BufRead;
use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

use super::faces::{Group, Grouping};
use super::geometry::{Corners, FaceRun, Values};
use super::libraries::{MAX_LIBRARIES, Statement};
use super::statements::{Corner, KNOWN, MAX_CORNERS, corner, is_beyond_us, numbers, position, unit, usable};
use crate::scene::diagnostic::{Diagnostic, Diagnostics, Severity, Tally};
use crate::scene::lines::{Line, Lines, unquoted, words};
use crate::scene::model::DEFAULT_MATERIAL;
use crate::scene::suggest::did_you_mean;

pub use take::NotPlain;

/// Vertices, normals or texture coordinates that a file may have, and triangles that its faces may come to. No device binds
/// more than 2 GiB, which is 44 million triangles of 48 bytes: what is refused here could not be rendered.
const MAX_COUNT: u32 = 1 << 26;

/// Errors after which the rest is not read: noise has one on every line.
const MAX_ERRORS: u32 = 10;

/// All that a file says.
#[derive(Debug)]
pub struct Scanned {
    pub messages: Diagnostics,
    pub groups: Vec<Group>,
    pub libraries: Vec<Statement>,
    pub values: Values,
    /// The lists that runs of faces are of.
    pub corners: Vec<Corners>,
}

/// Takes statements.
pub struct Scanner<'f> {
    tally: Tally,
    faces: Grouping,
    corners: Vec<Corner>,
    values: Values,
    /// The first list is of faces that came line by line, the others are of pieces.
    lists: Vec<Corners>,
    triangles: u32,
    smoothing: bool,
    errors: u32,
    libraries: Vec<Statement>,
    /// Nothing more is to be read.
    ended: bool,
    /// Lines of the pieces that were taken.
    lines: u32,
    file: &'f Path,
}

impl<'f> Scanner<'f> {
    /// `file` is the name in messages.
    pub fn new(file: &'f Path) -> Self {
        Self {
            tally: Tally::new(file),
            faces: Grouping::default(),
            corners: Vec::new(),
            values: Values::default(),
            lists: vec![Corners::default()],
            triangles: 0,
            smoothing: false,
            errors: 0,
            libraries: Vec::new(),
            ended: false,
            lines: 0,
            file,
        }
    }

    /// Takes a whole file, line by line.
    pub fn read(mut self, reader: impl BufRead) -> Scanned {
        let mut lines = Lines::new(reader, self.file);
        let mut line = Line::default();
        while !self.ended {
            match lines.next(&mut line) {
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
        }
        let zeros = lines.zeros();
        if self.triangles == 0 && !self.tally.diagnostics.has_errors() {
            let end = lines.number().max(1);
            let error = zeros.unwrap_or_else(|| {
                Diagnostic::at(Severity::Error, self.file, end, "", 0, "the file ends here without a face")
                    .help("a model needs `v` and `f` lines; was it exported whole?")
            });
            self.tally.diagnostics.push(error);
        } else if let Some(zeros) = zeros {
            let message = "zero bytes fill the end of this file: they are left out".to_owned();
            self.tally.diagnostics.push(Diagnostic { severity: Severity::Warning, message, ..zeros });
        }
        self.finish()
    }

    fn finish(self) -> Scanned {
        Scanned {
            messages: self.tally.finish(),
            groups: self.faces.groups,
            libraries: self.libraries,
            values: self.values,
            corners: self.lists,
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
        count(self.values.positions.len(), line, key)?;
        self.values.positions.push(DVec3::ZERO);
        let ([x, y, z], more) = position(line, key, rest)?;
        *last(&mut self.values.positions) = DVec3::new(x, y, z);
        if more {
            self.tally.once("weights", || {
                line.warning(key, "weights and colours of vertices are left out in this whole file")
            });
        }
        Ok(())
    }

    /// `vn x y z`. Zero stands for a normal that can't be used, and is replaced by the face's own.
    fn normal(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        count(self.values.normals.len(), line, key)?;
        self.values.normals.push(Vec3::ZERO);
        let values = numbers::<3>(line, key, rest, 3)?;
        let normal = DVec3::from_array(values.map(|value| value.unwrap_or(f64::NAN)));
        if usable(normal) {
            *last(&mut self.values.normals) = unit(normal);
        } else {
            self.tally.push("normals without a direction", || {
                line.warning(key, "this normal has no direction: the normals of the faces that use it take its place")
            });
        }
        Ok(())
    }

    /// `vt u [v]`.
    fn uv(&mut self, line: &Line, key: &str, rest: &str) -> Result<(), Diagnostic> {
        count(self.values.uvs.len(), line, key)?;
        self.values.uvs.push(Vec2::ZERO);
        let values = numbers::<2>(line, key, rest, 1)?;
        if values.contains(&None) {
            self.tally.push("texture coordinates that are not finite", || {
                line.warning(key, "this texture coordinate is not finite: 0 takes its place")
            });
        }
        let [u, v] = values.map(|value| value.unwrap_or(0.0) as f32);
        *last(&mut self.values.uvs) = Vec2::new(u, v);
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
            self.corners.push(corner(line, word, self.values.counts())?);
        }
        if self.corners.len() < 3 {
            let message = format!("a face has at least three corners, this one has {}", self.corners.len());
            return Err(line.error(key, message));
        }
        if self.count_triangles(self.corners.len() as u32 - 2).is_none() {
            self.ended = true;
            return Err(line.error(key, format!("more than {MAX_COUNT} triangles")).help("split the model into files"));
        }
        self.warn_of_face(line, key);
        if self.errors == 0 && !self.add_face() {
            self.ended = true;
            return Err(line.error(key, "too many objects and groups").help("join some of them before export"));
        }
        Ok(())
    }

    /// Counts triangles of faces; none where they are too many.
    fn count_triangles(&mut self, more: u32) -> Option<()> {
        self.triangles = self.triangles.saturating_add(more);
        (self.triangles <= MAX_COUNT).then_some(())
    }

    /// Adds the face of `corners` to its group. False where there are too many groups.
    fn add_face(&mut self) -> bool {
        let uvs = self.corners.iter().all(|(_, uv, _)| uv.is_some());
        let normals = self.corners.iter().all(|(.., normal)| normal.is_some());
        let list = &mut self.lists[0];
        let starts = list.indices.each_ref().map(|indices| indices.len() as u32);
        let [to_positions, to_uvs, to_normals] = &mut list.indices;
        // From 1, as files have them.
        let written = |index: u32| index as i32 + 1;
        for (position, uv, normal) in &self.corners {
            to_positions.push(written(*position));
            to_uvs.extend(uv.filter(|_| uvs).map(written));
            to_normals.extend(normal.filter(|_| normals).map(written));
        }
        let face = list.arities.len() as u32;
        list.arities.push(self.corners.len() as u16);
        let corners = self.corners.len() as u32;
        self.faces.add(FaceRun { source: 0, faces: face..face + 1, starts, corners, before: [0; 3] }, uvs, normals)
    }

    /// Attributes that are given for some corners only, and what else is to be told of a face.
    fn warn_of_face(&mut self, line: &Line, key: &str) {
        let uvs = self.corners.iter().filter(|(_, uv, _)| uv.is_some()).count();
        let normals = self.corners.iter().filter(|(.., normal)| normal.is_some()).count();
        if [uvs, normals].iter().any(|count| *count > 0 && *count < self.corners.len()) {
            self.tally.push("faces with incomplete corners", || {
                line.warning(key, "normals or texture coordinates of some corners only: this face is used without them")
            });
        }
        self.tell_of_face(line, key, normals > 0);
    }

    /// A face without material, and smoothing that nothing tells the shape of.
    fn tell_of_face(&mut self, line: &Line, key: &str, normals: bool) {
        if !self.faces.has_material() {
            self.tally.once("faces without material", || {
                let message =
                    format!("no `usemtl` before this face: such faces are rendered as `{DEFAULT_MATERIAL}`, a grey");
                line.warning(key, message).help("a scene file can change it under `materials`")
            });
        }
        if self.smoothing && !normals {
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
}

/// Refuses one more vertex, normal or texture coordinate where there are too many.
fn count(held: usize, line: &Line, key: &str) -> Result<(), Diagnostic> {
    if held >= MAX_COUNT as usize {
        return Err(line.error(key, format!("more than {MAX_COUNT} `{key}` lines")).help("split the model into files"));
    }
    Ok(())
}

/// What was just added to a list.
fn last<T>(list: &mut [T]) -> &mut T {
    list.last_mut().expect("invariant: something was just added")
}

/// A statement that OBJ files don't have.
fn unknown(line: &Line, key: &str) -> Diagnostic {
    let short: String = key.chars().take(40).collect();
    let help = did_you_mean(key, KNOWN.iter().copied());
    let help = help.unwrap_or_else(|| "is this an OBJ file? Comments begin with `#`".into());
    line.error(key, format!("unknown statement `{short}`")).help(help)
}
