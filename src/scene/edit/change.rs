//! What is to be written into a scene file: values and the paths that lead to them.

use super::path::Step;
use super::value::Value;

/// A value that is another one now.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub path: Vec<Step>,
    pub value: Value,
    /// The entry that it is a part of, where that is written as a whole if no file has it yet.
    pub entry: Option<Entry>,
}

/// A camera, a light, or the environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub path: Vec<Step>,
    pub value: Value,
}

/// All that differs between two states of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    pub list: Vec<Change>,
    /// What no scene file can say: what it is, and what to do.
    pub unsaid: Vec<(String, String)>,
}

impl Changes {
    /// Adds a value that stands by itself.
    pub fn add(&mut self, path: Vec<Step>, value: Value) {
        self.list.push(Change { path, value, entry: None });
    }

    /// Adds what differs of an entry: `fields` of before and after, at `inner` within it. All of the entry is `whole`.
    pub fn add_fields(
        &mut self,
        entry: &[Step],
        inner: &[Step],
        fields: impl IntoIterator<Item = (&'static str, Value, Value)>,
        whole: &Value,
    ) {
        for (field, before, after) in fields {
            if before != after {
                let path = [entry, inner, &[Step::Field(field)]].concat();
                let entry = Entry { path: entry.to_vec(), value: whole.clone() };
                self.list.push(Change { path, value: after, entry: Some(entry) });
            }
        }
    }
}
