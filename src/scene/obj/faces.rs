//! Faces: indices resolved and checked, sorted into groups of one object, material and set of attributes.

use std::collections::HashMap;
use std::fmt::Write as _;

use crate::scene::diagnostic::Diagnostic;

/// Groups that a file may have. Each becomes an entity.
const MAX_GROUPS: usize = 1 << 17;

/// Bytes of faces that wait to be passed on together.
const MAX_WAITING: usize = 16 << 20;

/// Faces of one object that share material and attributes.
#[derive(Clone, Debug)]
pub struct Group {
    pub object: String,
    /// The name `usemtl` gives, and its place (a warning that lacks its message).
    pub material: Option<(String, Diagnostic)>,
    /// Whether all corners have texture coordinates.
    pub uvs: bool,
    /// Whether all corners have normals.
    pub normals: bool,
}

/// One corner of a face: position, texture coordinate and normal, from 0.
pub type Corner = (u32, Option<u32>, Option<u32>);

/// Sorts faces into groups. They wait here group by group, since tobj makes a mesh of every run of faces it meets:
/// a file that changes its material at every face would give it a mesh a face.
#[derive(Debug, Default)]
pub struct Grouping {
    pub groups: Vec<Group>,
    numbers: HashMap<(String, Option<String>, bool, bool), usize>,
    waiting: Vec<String>,
    waiting_bytes: usize,
    object: Option<String>,
    group: Option<String>,
    material: Option<(String, Diagnostic)>,
    /// The groups of the current object and material, by attributes.
    current: [Option<usize>; 4],
}

impl Grouping {
    /// Takes an `o` statement: what follows belongs to this object.
    pub fn set_object(&mut self, name: &str) {
        self.object = (!name.is_empty()).then(|| name.to_owned());
        self.group = None;
        self.current = [None; 4];
    }

    /// Takes a `g` statement: a part of the object.
    pub fn set_group(&mut self, name: &str) {
        self.group = (!name.is_empty() && name != "default").then(|| name.to_owned());
        self.current = [None; 4];
    }

    /// Takes a `usemtl` statement; `place` is a warning about it that lacks its message.
    pub fn set_material(&mut self, name: &str, place: Diagnostic) {
        self.material = Some((name.to_owned(), place));
        self.current = [None; 4];
    }

    /// Whether a `usemtl` came before.
    pub fn has_material(&self) -> bool {
        self.material.is_some()
    }

    /// Adds a face to its group. False where there are too many groups.
    pub fn add(&mut self, corners: &[Corner]) -> bool {
        let uvs = corners.iter().all(|(_, uv, _)| uv.is_some());
        let normals = corners.iter().all(|(.., normal)| normal.is_some());
        let slot = usize::from(uvs) + 2 * usize::from(normals);
        let number = match self.current[slot] {
            Some(number) => number,
            None => match self.number(uvs, normals) {
                Some(number) => *self.current[slot].insert(number),
                None => return false,
            },
        };
        let face = &mut self.waiting[number];
        let before = face.len();
        face.push('f');
        for (position, uv, normal) in corners {
            // Writing to a string can't fail.
            let _ = match (uv.filter(|_| uvs), normal.filter(|_| normals)) {
                (Some(uv), Some(normal)) => write!(face, " {}/{}/{}", position + 1, uv + 1, normal + 1),
                (Some(uv), None) => write!(face, " {}/{}", position + 1, uv + 1),
                (None, Some(normal)) => write!(face, " {}//{}", position + 1, normal + 1),
                (None, None) => write!(face, " {}", position + 1),
            };
        }
        face.push('\n');
        self.waiting_bytes += face.len() - before;
        true
    }

    /// Whether enough faces wait to be passed on.
    pub fn is_full(&self) -> bool {
        self.waiting_bytes >= MAX_WAITING
    }

    /// Passes the waiting faces on as OBJ text, each group under its number as the object's name.
    pub fn flush(&mut self, out: &mut Vec<u8>) {
        for (number, faces) in self.waiting.iter_mut().enumerate().filter(|(_, faces)| !faces.is_empty()) {
            out.extend_from_slice(format!("o {number}\n").as_bytes());
            out.extend_from_slice(faces.as_bytes());
            *faces = String::new();
        }
        self.waiting_bytes = 0;
    }

    /// The number of the group that faces with these attributes belong to now.
    fn number(&mut self, uvs: bool, normals: bool) -> Option<usize> {
        let object = match (&self.object, &self.group) {
            (Some(object), Some(group)) => format!("{object}/{group}"),
            (Some(name), None) | (None, Some(name)) => name.clone(),
            (None, None) => "object".to_owned(),
        };
        let key = (object, self.material.as_ref().map(|(name, _)| name.clone()), uvs, normals);
        if let Some(number) = self.numbers.get(&key) {
            return Some(*number);
        }
        if self.groups.len() >= MAX_GROUPS {
            return None;
        }
        self.groups.push(Group { object: key.0.clone(), material: self.material.clone(), uvs, normals });
        self.waiting.push(String::new());
        self.numbers.insert(key, self.groups.len() - 1);
        Some(self.groups.len() - 1)
    }
}
