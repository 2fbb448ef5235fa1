//! Lists and maps of scene files, entry by entry.

use crate::scene::ron::{Node, Reader};
use crate::scene::suggest::did_you_mean;

/// The entries of a list, those that are right.
pub fn read_list<T>(
    reader: &Reader,
    node: &Node,
    path: &str,
    read: impl Fn(&Reader, &Node, &str) -> Option<T>,
) -> Vec<T> {
    match node.items() {
        Ok(items) => {
            items.iter().enumerate().filter_map(|(i, item)| read(reader, item, &format!("{path}.{i}"))).collect()
        }
        Err(message) => {
            reader.error(node, path, message);
            Vec::new()
        }
    }
}

/// The entries of a map, those that are right. `None` takes away what the file that is extended has.
pub fn read_entries<T>(
    reader: &Reader,
    node: &Node,
    path: &str,
    read: impl Fn(&Reader, &Node, &str) -> Option<T>,
) -> Vec<(String, T)> {
    match node.fields() {
        Ok(fields) => fields
            .iter()
            .filter(|(.., node)| !node.is_none())
            .filter_map(|entry| Some((entry.0.clone(), read_entry(reader, fields, entry, path, &read)?)))
            .collect(),
        Err(message) => {
            reader.error(node, path, message);
            Vec::new()
        }
    }
}

/// The name, its place, and the value of an entry.
type Entry<'a> = (String, &'a str, Node<'a>);

/// One entry of a map. Where a change of a part has made it, and it is no whole one, another entry was meant.
fn read_entry<'a, T>(
    reader: &Reader,
    all: &[Entry<'a>],
    (name, place, node): &Entry<'a>,
    path: &str,
    read: impl Fn(&Reader, &Node, &str) -> Option<T>,
) -> Option<T> {
    let path = format!("{path}.{name}");
    let others = all.iter().map(|(other, ..)| other.as_str()).filter(|other| other != name);
    // A value that was written stands elsewhere than its name.
    let meant = did_you_mean(name, others).filter(|_| std::ptr::eq(*place, node.source));
    let Some(meant) = meant else { return read(reader, node, &path) };
    let alone = Reader::default();
    let entry = read(&alone, node, &path);
    match &entry {
        Some(_) => alone.into_diagnostics().list.into_iter().for_each(|found| reader.push(found)),
        None => reader.push(node.text.error(place, format!("there is no `{path}` to change")).help(meant)),
    }
    entry
}
