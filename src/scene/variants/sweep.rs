//! The sweep of a variant file: axes, and what each changes.

use super::values::{SweptValue, refuse_equal, values_of};
use crate::scene::diagnostic::{Diagnostic, Severity};
use crate::scene::ron::{Kind, Node, Reader};

/// An axis as it is written.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Of the axis: its path, or the name of a `zip`.
    pub name: String,
    /// Of each value.
    pub labels: Vec<String>,
    /// Paths that change together, with as many values each.
    pub columns: Vec<Column>,
    /// Where the axis is written: a warning without its message.
    pub place: Diagnostic,
}

/// A path and what it goes through.
#[derive(Clone, Debug)]
pub struct Column {
    pub path: String,
    pub place: Diagnostic,
    pub values: Vec<SweptValue>,
}

/// Reads all axes; what is wrong is reported.
pub fn read_sweep(reader: &Reader, node: &Node) -> Option<Vec<Swept>> {
    let fields = node.fields().map_err(|message| reader.error(node, "sweep", message)).ok()?;
    if fields.is_empty() {
        let error = node.text.error(node.source, "sweep: there is nothing to go through");
        reader.push(error.help("write { \"path\": [a, b, ..], .. }, or leave `sweep` out"));
        return None;
    }
    let axes: Vec<_> =
        fields.iter().map(|field| read_axis(node, field).map_err(|error| reader.push(error)).ok()).collect();
    axes.into_iter().collect()
}

fn read_axis(sweep: &Node, (name, place, node): &(String, &str, Node)) -> Result<Swept, Diagnostic> {
    let about = |error: Diagnostic| Diagnostic { message: format!("sweep of `{name}`: {}", error.message), ..error };
    let place = sweep.text.at(Severity::Warning, place, "");
    let Kind::Variant("zip", Some(content)) = &node.kind else {
        let values = values_of(node).map_err(about)?;
        refuse_equal(&values).map_err(about)?;
        let labels = values.iter().map(|value| value.label.clone()).collect();
        let column = Column { path: name.clone(), place: place.clone(), values };
        return Ok(Swept { name: name.clone(), labels, columns: vec![column], place });
    };
    let error = |node: &Node, message: String| about(node.text.error(node.source, message));
    let content = content.inner();
    let fields = content.fields().map_err(|message| {
        error(content, format!("zip: {message}")).help("write zip({ \"path\": [a, b], \"path\": [c, d] })")
    })?;
    let column = |(path, place, node): &(String, &str, Node)| {
        let place = content.text.at(Severity::Warning, place, "");
        Ok(Column { path: path.clone(), place, values: values_of(node).map_err(about)? })
    };
    let columns = fields.iter().map(column).collect::<Result<Vec<_>, Diagnostic>>()?;
    let Some(first) = columns.first() else {
        return Err(error(content, "zip: there is nothing to go through".into())
            .help("write zip({ \"path\": [a, b], \"path\": [c, d] })"));
    };
    if let Some(other) = columns.iter().find(|column| column.values.len() != first.values.len()) {
        let (one, two) = (first.values.len(), other.values.len());
        let message =
            format!("sweep of `{name}`: zip: `{}` has {two} values, and `{}` has {one}", other.path, first.path);
        return Err(Diagnostic { severity: Severity::Error, message, ..other.place.clone() }
            .help("what changes together needs as many values each"));
    }
    refuse_equal(&first.values).map_err(about)?;
    let labels = first.values.iter().map(|value| value.label.clone()).collect();
    Ok(Swept { name: name.clone(), labels, columns, place })
}
