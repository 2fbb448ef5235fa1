//! Lists and maps of scene files, entry by entry.

use crate::scene::ron::{Node, Reader};

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
            .filter_map(|(name, _, node)| Some((name.clone(), read(reader, node, &format!("{path}.{name}"))?)))
            .collect(),
        Err(message) => {
            reader.error(node, path, message);
            Vec::new()
        }
    }
}
