//! Faces, sorted into groups of one object, material and set of attributes.

use std::collections::HashMap;

use super::geometry::FaceRun;
use crate::scene::diagnostic::Diagnostic;

/// Groups that a file may have. Each becomes an entity.
const MAX_GROUPS: usize = 1 << 17;

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
    /// Its faces, in the order of the file.
    pub runs: Vec<FaceRun>,
}

/// Sorts faces into groups.
#[derive(Debug, Default)]
pub struct Grouping {
    pub groups: Vec<Group>,
    numbers: HashMap<(String, Option<String>, bool, bool), usize>,
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

    /// Adds faces that have texture coordinates, or normals, to their group. False where there are too many groups.
    pub fn add(&mut self, run: FaceRun, uvs: bool, normals: bool) -> bool {
        let slot = usize::from(uvs) + 2 * usize::from(normals);
        let number = match self.current[slot] {
            Some(number) => number,
            None => match self.number(uvs, normals) {
                Some(number) => *self.current[slot].insert(number),
                None => return false,
            },
        };
        let runs = &mut self.groups[number].runs;
        match runs.last_mut().filter(|last| last.goes_on_as(&run)) {
            Some(last) => {
                last.faces.end = run.faces.end;
                last.corners += run.corners;
            }
            None => runs.push(run),
        }
        true
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
        let (object, material) = (key.0.clone(), self.material.clone());
        self.groups.push(Group { object, material, uvs, normals, runs: Vec::new() });
        self.numbers.insert(key, self.groups.len() - 1);
        Some(self.groups.len() - 1)
    }
}

impl FaceRun {
    /// Whether another run is just what follows this one in the same list, and counts back from the same place.
    fn goes_on_as(&self, next: &FaceRun) -> bool {
        self.source == next.source
            && self.faces.end == next.faces.start
            && self.starts[0] + self.corners == next.starts[0]
            && self.before == next.before
    }
}
