//! What is otherwise in Mitsuba than in Lucerna.

use std::fmt;

use crate::scene::{Audit, Diagnostic, printable_name};

/// How much a picture of Mitsuba's differs for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// In what is hardly seen.
    Slight,
    /// It is another picture.
    Another,
}

/// One difference.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    pub weight: Weight,
    /// The material that it is of, with the file and line of what makes it so, where a file does.
    pub material: Option<(String, Option<(String, u32)>)>,
    pub text: String,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some((name, place)) = &self.material else { return f.write_str(&self.text) };
        let name = printable_name(name);
        match place {
            Some((file, line)) => write!(f, "{file}:{line}: {name}: {}", self.text),
            None => write!(f, "{name}: {}", self.text),
        }
    }
}

/// The differences of a scene, each told once.
#[derive(Debug)]
pub struct Notes {
    audit: Audit,
    pub list: Vec<Note>,
}

impl Notes {
    /// `audit` is what says where each material is written.
    pub fn new(audit: Audit) -> Self {
        Self { audit, list: Vec::new() }
    }

    /// Of the scene.
    pub fn say(&mut self, weight: Weight, text: &str) {
        self.push(Note { weight, material: None, text: text.to_owned() });
    }

    /// Of a material: `key` is the number that makes it so, as the table of keys has it.
    pub fn say_of(&mut self, name: &str, key: &str, text: String) {
        let material = Some((name.to_owned(), self.place(name, key)));
        self.push(Note { weight: Weight::Another, material, text });
    }

    fn push(&mut self, note: Note) {
        if !self.list.contains(&note) {
            self.list.push(note);
        }
    }

    /// Where a number of a material is given: the scene file, if that does, else the library; at least one that is of this material.
    fn place(&self, name: &str, key: &str) -> Option<(String, u32)> {
        let bare = |audited: &str| name.rsplit_once(':').is_some_and(|(_, last)| last == audited);
        let of = self.audit.materials.iter().find(|found| found.name == name || bare(&found.name))?;
        let edit = of.edits.iter().find(|(field, _)| field.eq_ignore_ascii_case(key)).map(|(_, place)| place);
        let says =
            |statement: &str| statement.split_whitespace().next().is_some_and(|word| word.eq_ignore_ascii_case(key));
        let said = of.statements.iter().find(|verdict| says(&verdict.statement)).map(|verdict| &verdict.place);
        let any = || of.statements.first().map(|v| &v.place).or_else(|| of.edits.first().map(|(_, place)| place));
        edit.or(said).or_else(any).map(|place: &Diagnostic| (place.file.display().to_string(), place.line))
    }
}
