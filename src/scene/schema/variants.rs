//! The schema of variant files.

use schemars::{Schema, json_schema};
use serde_json::{Map, Value};

use super::parts::{about, any, between, map, number, object, or_none, text, variant, whole};
use super::scene::{camera, fields, light, material, model, shader_value};
use super::values::{keys, settings};
use crate::scene::settings::Group;

/// What a variant file may hold.
pub fn variants() -> Schema {
    let fields = [
        ("extends", text("the scene that is varied, or another variant file, relative to this one")),
        ("overrides", or_none(changes("values of all members, by their paths in the scene file"))),
        ("sweep", or_none(sweep())),
        ("members", or_none(map("members beside the sweep, by name", changes("values, by their paths")))),
        ("reference", or_none(any(vec![text("the member that others are compared with"), reference()]))),
        ("goal", or_none(goal())),
    ];
    let mut schema = object("A family of scenes of Lucerna.", fields, &["extends"]);
    schema.insert("$schema".to_owned(), "https://json-schema.org/draft/2020-12/schema".into());
    schema.insert("title".to_owned(), "Variant file".into());
    schema
}

/// Paths and values; `of` says what stands at a path for the value.
fn by_path(doc: &str, of: impl Fn(Schema) -> Schema) -> Schema {
    let mut paths: Map<String, Value> = Map::new();
    let mut add = |path: String, schema: Schema| drop(paths.insert(path, of(schema).to_value()));
    for (group, name) in [(Group::Film, "film"), (Group::Render, "render")] {
        settings(group).for_each(|(field, schema)| add(format!("{name}.{field}"), or_none(schema)));
    }
    let beside = [
        ("scene", text("another scene file than that of `extends`, relative to this file")),
        ("shaders", text("a folder of shaders, relative to this file; None: those that all others have")),
    ];
    let parts = fields().filter(|(name, _)| !matches!(*name, "extends" | "animate")).chain(beside);
    parts.for_each(|(path, schema)| add(path.to_owned(), or_none(schema)));
    let mut patterns: Map<String, Value> = Map::new();
    let mut add = |pattern: String, schema: Schema| drop(patterns.insert(pattern, of(schema).to_value()));
    // A name in double quotes may hold dots.
    const NAME: &str = r#"("[^"]+"|[^.]+)"#;
    keys().for_each(|(key, schema)| add(format!(r"^materials\.{NAME}\.{key}$"), or_none(schema)));
    add(format!(r"^materials\.{NAME}$"), or_none(material()));
    add(format!(r"^cameras\.{NAME}$"), or_none(camera()));
    add(format!(r"^lights\.{NAME}$"), or_none(light()));
    add(r"^models\.[0-9]+$".to_owned(), model());
    add(format!(r"^shader\.{NAME}$"), or_none(shader_value()));
    json_schema!({ "description": doc, "type": "object", "properties": paths, "patternProperties": patterns })
}

fn changes(doc: &str) -> Schema {
    by_path(doc, |value| value)
}

/// What a path goes through.
fn axis(value: Schema) -> Schema {
    let steps = |name: &str| {
        let ends = [number(), number(), whole(1, u32::MAX)];
        variant(name, json_schema!({ "type": "array", "prefixItems": ends, "items": false, "minItems": 3 }))
    };
    any(vec![
        json_schema!({ "type": "array", "items": value.clone(), "minItems": 1 }),
        about("(from, to, count): even steps", steps("range")),
        about("(from, to, count): steps of one factor", steps("log")),
        about("values by name", variant("named", map("values by name", value))),
    ])
}

fn sweep() -> Schema {
    let together = about("paths that change together", variant("zip", by_path("paths and as many values each", axis)));
    let mut schema = by_path("what is gone through, by paths; a name of its own with zip({..})", axis);
    let other = any(vec![axis(json_schema!({})), together]);
    schema.insert("additionalProperties".to_owned(), other.to_value());
    schema.insert("minProperties".to_owned(), 1.into());
    schema
}

fn reference() -> Schema {
    let fields = [
        ("member", text("the member that others are compared with")),
        ("spp", or_none(about("samples a pixel of a film of its own", whole(1, u32::MAX)))),
    ];
    object("the member that others are compared with", fields, &["member"])
}

/// One value, or several that ascend.
fn one_or_more(value: Schema) -> Schema {
    any(vec![value.clone(), json_schema!({ "type": "array", "items": value, "minItems": 1 })])
}

fn goal() -> Schema {
    let above = |schema: Schema| or_none(one_or_more(schema));
    let fields = [
        ("spp", above(whole(1, u32::MAX))),
        ("time", above(between(0.0, f64::MAX))),
        ("error", or_none(between(0.0, f64::MAX))),
    ];
    let one = fields.map(|(name, schema)| object("when a member is done", [(name, schema)], &[name]));
    any(one.into())
}
