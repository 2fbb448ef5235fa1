//! The building stones of schemas.

use schemars::{Schema, json_schema};
use serde_json::{Map, Value};

/// An object of these fields and no other.
pub fn object(about: &str, fields: impl IntoIterator<Item = (&'static str, Schema)>, required: &[&str]) -> Schema {
    let properties: Map<String, Value> =
        fields.into_iter().map(|(name, schema)| (name.to_owned(), schema.to_value())).collect();
    json_schema!({
        "description": about, "type": "object", "properties": properties, "required": required, "additionalProperties": false,
    })
}

/// An object of named entries that are alike.
pub fn map(about: &str, entry: Schema) -> Schema {
    json_schema!({ "description": about, "type": "object", "additionalProperties": entry })
}

pub fn list(about: &str, entry: Schema) -> Schema {
    json_schema!({ "description": about, "type": "array", "items": entry })
}

/// What may also be `None`.
pub fn or_none(schema: Schema) -> Schema {
    any(vec![schema, json_schema!({ "type": "null" })])
}

pub fn any(schemas: Vec<Schema>) -> Schema {
    json_schema!({ "anyOf": schemas })
}

/// `Name(..)`.
pub fn variant(name: &str, content: Schema) -> Schema {
    let properties: Map<String, Value> = Map::from_iter([(name.to_owned(), content.to_value())]);
    json_schema!({ "type": "object", "properties": properties, "required": [name], "additionalProperties": false })
}

pub fn text(about: &str) -> Schema {
    json_schema!({ "description": about, "type": "string", "minLength": 1 })
}

pub fn number() -> Schema {
    json_schema!({ "type": "number" })
}

pub fn between(least: f64, most: f64) -> Schema {
    json_schema!({ "type": "number", "minimum": least, "maximum": most })
}

pub fn whole(least: u32, most: u32) -> Schema {
    json_schema!({ "type": "integer", "minimum": least, "maximum": most })
}

pub fn switch() -> Schema {
    json_schema!({ "type": "boolean" })
}

/// `(a, b, ..)` of one kind.
pub fn tuple(count: u32, entry: Schema) -> Schema {
    json_schema!({ "type": "array", "items": entry, "minItems": count, "maxItems": count })
}

/// One for all, or one for each of `count`.
pub fn each(count: u32, entry: Schema) -> Schema {
    any(vec![entry.clone(), tuple(count, entry)])
}

/// With a line that says what it is.
pub fn about(text: &str, mut schema: Schema) -> Schema {
    schema.insert("description".to_owned(), text.into());
    schema
}
