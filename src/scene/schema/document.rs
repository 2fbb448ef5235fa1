//! A RON file as the JSON that schemas describe.

use std::path::Path;

use serde_json::{Map, Value};

use crate::scene::diagnostic::Diagnostic;
use crate::scene::file::scene_fields;
use crate::scene::read::SCENE_LIMIT;
use crate::scene::ron::{Kind, Node, parse};
use crate::scene::text::Text;

/// A scene or variant file as JSON, without what it extends.
pub fn document(path: &Path) -> Result<Value, Diagnostic> {
    let text = Text::read(path, SCENE_LIMIT)?;
    Ok(value_of(&scene_fields(parse(&text)?)))
}

fn value_of(node: &Node) -> Value {
    match &node.kind {
        Kind::Fields(fields) => fields.iter().map(|(name, _, node)| (name.clone(), value_of(node))).collect(),
        Kind::Items(items) if items.is_empty() && node.source.starts_with('(') => Value::Object(Map::new()),
        Kind::Items(items) => items.iter().map(value_of).collect(),
        Kind::Variant("None", None) => Value::Null,
        Kind::Variant(name, None) => Value::String((*name).to_owned()),
        Kind::Variant(name, Some(content)) => {
            Value::Object(Map::from_iter([((*name).to_owned(), value_of(content.inner()))]))
        }
        Kind::Scalar => scalar(node),
    }
}

/// A number, a string or a boolean; what JSON has no word for is the string that is written.
fn scalar(node: &Node) -> Value {
    if let Ok(whole) = ron::from_str::<i64>(node.source) {
        return whole.into();
    }
    let number = node.number(f64::MIN, f64::MAX).ok().and_then(serde_json::Number::from_f64);
    match (number, node.boolean(), node.string()) {
        (Some(number), ..) => number.into(),
        (None, Ok(boolean), _) => boolean.into(),
        (None, Err(_), Ok(text)) => text.into(),
        (None, Err(_), Err(_)) => node.source.into(),
    }
}
