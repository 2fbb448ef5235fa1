//! The schemas of scene and variant files: what is shipped fits them, and they have the fields that readers ask for, no others.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use lucerna::scene::variants::plan;
use lucerna::scene::{Assets, Diagnostics, KEYS, Value as KeyValue, load, schema};
use regex_lite::Regex;
use serde_json::Value;

use crate::mtl_maps::write_picture;

/// A field that no reader knows, and that is like none.
const UNKNOWN: &str = "zzzzzzzzzzzzzzzzzzzz";

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(folder);
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.filter(|path| path.extension().is_some_and(|ending| ending == "ron")).collect()
}

/// Alternatives, one by one.
fn flat(schema: &Value) -> Vec<&Value> {
    match schema["anyOf"].as_array() {
        Some(schemas) => schemas.iter().flat_map(flat).collect(),
        None => vec![schema],
    }
}

/// The fields of the object at the end of some steps: `*` goes to entries of lists and maps.
fn fields(schema: &Value, steps: &[&str]) -> BTreeSet<String> {
    let below = |schema: &&Value, step: &str| match step {
        "*" => [schema["items"].clone(), schema["additionalProperties"].clone()],
        _ => [schema["properties"][step].clone(), Value::Null],
    };
    let mut at = vec![schema.clone()];
    for step in steps {
        let next = at.iter().flat_map(flat).flat_map(|schema| below(&schema, step));
        at = next.filter(|schema| schema.is_object()).collect();
    }
    let objects = at.iter().flat_map(flat).filter_map(|schema| schema["properties"].as_object());
    objects.flat_map(|fields| fields.keys().cloned()).collect()
}

/// The fields that a message about an unknown one names.
fn known(errors: &Diagnostics, text: &str) -> BTreeSet<String> {
    let helps = errors.list.iter().filter_map(|error| error.help.as_deref());
    let mut known = helps.filter_map(|help| help.strip_prefix("known fields: "));
    let known = known.next().unwrap_or_else(|| panic!("{text}: {errors}"));
    known.split(", ").map(str::to_owned).collect()
}

#[test]
fn readers_of_scenes_and_their_schema_know_the_same_fields() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    write_picture(&folder.path().join("t.png"));
    let maps = KEYS.iter().filter(|key| matches!(key.value, KeyValue::Map(..))).map(|key| key.scene);
    let mut places = vec![
        (format!("({UNKNOWN}: 1)"), vec![]),
        (format!("(models: [(path: \"m.obj\", {UNKNOWN}: 1)])"), vec!["models", "*"]),
        (format!("(models: [(path: \"m.obj\", transform: ({UNKNOWN}: 1))])"), vec!["models", "*", "transform"]),
        (
            format!("(models: [(path: \"m.obj\", materials: {{ \"a\": ({UNKNOWN}: 1) }})])"),
            vec!["models", "*", "materials", "*"],
        ),
        (format!("(cameras: {{ \"a\": ({UNKNOWN}: 1) }})"), vec!["cameras", "*"]),
        (format!("(lights: {{ \"a\": Point({UNKNOWN}: 1) }})"), vec!["lights", "*", "Point"]),
        (format!("(lights: {{ \"a\": Spot({UNKNOWN}: 1) }})"), vec!["lights", "*", "Spot"]),
        (format!("(film: ({UNKNOWN}: 1))"), vec!["film"]),
        (format!("(animate: (frames: 2, keys: {{ \"film.exposure\": {{ 0: 1 }} }}, {UNKNOWN}: 1))"), vec!["animate"]),
        (format!("(render: ({UNKNOWN}: 1))"), vec!["render"]),
        (format!("(environment: Map(path: \"t.png\", {UNKNOWN}: 1))"), vec!["environment", "Map"]),
        (format!("(environment: Sky(sun: (1, 1), {UNKNOWN}: 1))"), vec!["environment", "Sky"]),
        (format!("(materials: {{ \"a\": ({UNKNOWN}: 1) }})"), vec!["materials", "*"]),
    ];
    places.extend(maps.map(|map| {
        let text = format!("(materials: {{ \"a\": ({map}: (file: \"t.png\", {UNKNOWN}: 1)) }})");
        (text, vec!["materials", "*", map])
    }));
    let path = folder.path().join("s.ron");
    let schema = schema::scene().to_value();
    for (text, steps) in places {
        std::fs::write(&path, &text).expect("a file");
        let errors = load(&path, &[]).expect_err(&text);
        assert_eq!(fields(&schema, &steps), known(&errors, &text), "{steps:?}");
    }
}

#[test]
fn readers_of_variant_files_and_their_schema_know_the_same_fields() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("s.ron"), "()").expect("a file");
    let path = folder.path().join("v.ron");
    let schema = schema::variants().to_value();
    for (field, steps) in [("", vec![]), ("reference", vec!["reference"]), ("goal", vec!["goal"])] {
        let value = if field.is_empty() { format!("{UNKNOWN}: 1") } else { format!("{field}: ({UNKNOWN}: 1)") };
        let text = format!("(extends: \"s.ron\", members: {{ \"a\": {{ \"film.exposure\": 1 }} }}, {value})");
        std::fs::write(&path, &text).expect("a file");
        let errors = plan(&path, &[], &Assets::new()).expect_err(&text);
        let mut known = known(&errors, &text);
        // Which is taken out of the file before it is read.
        known.extend(field.is_empty().then(|| "extends".to_owned()));
        assert_eq!(fields(&schema, &steps), known, "{field}");
    }
}

/// Whether a value fits a schema, by the keywords that ours have; another is a mistake of the schema's.
fn check(schema: &Value, value: &Value) -> Result<(), String> {
    let Some(keywords) = schema.as_object() else {
        return if *schema == Value::Bool(false) { Err(format!("{value}: nothing may be here")) } else { Ok(()) };
    };
    keywords.iter().try_for_each(|(keyword, by)| check_one(keyword, by, keywords, value))
}

fn check_one(keyword: &str, by: &Value, all: &serde_json::Map<String, Value>, value: &Value) -> Result<(), String> {
    let (number, limit) = (value.as_f64(), by.as_f64().unwrap_or_default());
    let (list, object) = (value.as_array(), value.as_object());
    let within = |path: &str, schema: &Value, value: &Value| check(schema, value).map_err(|e| format!("{path}: {e}"));
    let right = match keyword {
        "$schema" | "title" | "description" | "patternProperties" => true,
        "type" => match by {
            Value::Array(types) => types.iter().any(|by| is_of_type(by, value)),
            by => is_of_type(by, value),
        },
        "const" => by == value,
        "enum" => by.as_array().expect("a list").contains(value),
        "minimum" => number.is_none_or(|number| number >= limit),
        "maximum" => number.is_none_or(|number| number <= limit),
        "minLength" => value.as_str().is_none_or(|text| text.chars().count() as f64 >= limit),
        "minItems" => list.is_none_or(|list| list.len() as f64 >= limit),
        "maxItems" => list.is_none_or(|list| list.len() as f64 <= limit),
        "minProperties" => object.is_none_or(|object| object.len() as f64 >= limit),
        "required" => by
            .as_array()
            .expect("a list")
            .iter()
            .all(|name| object.is_none_or(|object| object.contains_key(name.as_str().expect("a name")))),
        "anyOf" => {
            let errors: Vec<String> =
                by.as_array().expect("a list").iter().filter_map(|schema| check(schema, value).err()).collect();
            if errors.len() == by.as_array().map_or(0, Vec::len) {
                return Err(errors.join("; "));
            }
            true
        }
        "prefixItems" => {
            let pairs = by.as_array().expect("a list").iter().zip(list.into_iter().flatten());
            return pairs.enumerate().try_for_each(|(i, (by, item))| within(&i.to_string(), by, item));
        }
        "items" => {
            let first = all.get("prefixItems").and_then(Value::as_array).map_or(0, Vec::len);
            let mut items = list.into_iter().flatten().enumerate().skip(first);
            return items.try_for_each(|(i, item)| within(&i.to_string(), by, item));
        }
        "properties" => {
            let mut fields = object.into_iter().flatten();
            return fields
                .try_for_each(|(name, value)| within(name, by.get(name).unwrap_or(&Value::Bool(true)), value));
        }
        "additionalProperties" => {
            let named = |name: &str| all.get("properties").is_some_and(|named| named.get(name).is_some());
            let mut others =
                object.into_iter().flatten().filter(|(name, _)| !named(name) && patterns(all, name).is_empty());
            return others.try_for_each(|(name, value)| within(name, by, value));
        }
        other => panic!("the keyword `{other}` is not checked"),
    };
    if keyword == "patternProperties" {
        let mut fields = object.into_iter().flatten();
        return fields
            .try_for_each(|(name, value)| patterns(all, name).into_iter().try_for_each(|by| within(name, by, value)));
    }
    if right { Ok(()) } else { Err(format!("{value} is not `{keyword}` {by}")) }
}

/// The schemas of the patterns that a name fits.
fn patterns<'s>(schema: &'s serde_json::Map<String, Value>, name: &str) -> Vec<&'s Value> {
    let patterns = schema.get("patternProperties").and_then(Value::as_object).into_iter().flatten();
    patterns.filter(|(by, _)| Regex::new(by).expect("a pattern").is_match(name)).map(|(_, schema)| schema).collect()
}

fn is_of_type(by: &Value, value: &Value) -> bool {
    match by.as_str().expect("a type") {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("there is no type `{other}`"),
    }
}

#[test]
fn what_is_shipped_fits_and_what_is_wrong_does_not() {
    let (of_scenes, of_variants) = (schema::scene().to_value(), schema::variants().to_value());
    for (folder, schema) in [("scenes", &of_scenes), ("variants", &of_variants)] {
        let files = files(folder);
        assert!(files.len() >= 6, "{folder}");
        for path in files {
            let document = schema::document(&path).unwrap_or_else(|error| panic!("{error}"));
            check(schema, &document).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        }
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.ron");
    let fits = |text: &str| {
        std::fs::write(&path, text).expect("a file");
        let document = schema::document(&path).unwrap_or_else(|error| panic!("{text}: {error}"));
        (check(&of_scenes, &document).is_ok(), check(&of_variants, &document).is_ok())
    };
    for right in [
        "Scene(film: (size: (3, 4), exposure: -1.5), render: (sampler: Pcg, roulette: false), camera: None)",
        "(environment: Constant((1, 0.5, 0)), materials: { \"a\": (kd: 0.5, map_kd: Off, norm: None), \"b\": None })",
        "(environment: Constant(1, 1, 1), models: [], cameras: {}, film: ())",
        "(extends: \"b.ron\", cameras: { \"front\": (fov_y: 30) })",
        "(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), aperture: 1, focus: Distance(2), shift: (0, -1)) })",
        "(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), focus: At((0, 0, 0))) })",
        "(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), focus: LookAt) })",
        "(lights: { \"a\": Point(position: (0, 0, 1), intensity: 2), \"b\": Spot(angle: 30, blend: 1), \"c\": None })",
        "(extends: \"b.ron\", materials: { \"a\": (map_ns: (file: \"a.png\", scale: 2, clamp: (true, false), channel: Red)) })",
    ] {
        assert!(fits(right).0, "{right}");
    }
    for right in [
        "(animate: (frames: 9, fps: 25, keys: { \"film.exposure\": { 0: -1, \"0.5 s\": 2 } }))",
        "(animate: (keys: { \"camera\": Step({ 0: \"a\" }), \"cameras.a.fov_y\": Smooth({ 0: 1, 4: 2 }), \"render.seed\": None }))",
    ] {
        assert!(fits(right).0, "{right}");
    }
    for wrong in [
        "(animate: (frames: 0, keys: {}))",
        "(animate: (frames: 9, keys: { \"film.exposure\": { \"first\": 1 } }))",
        "(animate: (frames: 9, keys: { \"film.exposure\": 1 }))",
        "(animate: (frames: 9, keys: { \"film.exposure\": Jump({ 0: 1 }) }))",
        "(flim: ())",
        "(film: (size: (3, 4, 5)))",
        "(render: (sampler: Sobel))",
        "(render: (spp: 0))",
        "(models: [(name: \"a\")])",
        "(environment: Constant(-1))",
        "(environment: Moon())",
        "(cameras: { \"a\": (position: (0, 0)) })",
        "(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), aperture: -1) })",
        "(cameras: { \"a\": (position: (0, 0, 1), look_at: (0, 0, 0), focus: 2) })",
        "(lights: { \"a\": Point(intensity: -1) })",
        "(lights: { \"a\": Spot(blend: 2) })",
        "(lights: { \"a\": Sun() })",
        "(materials: { \"a\": (pr: 1.5) })",
        "(materials: { \"a\": (map_kd: (channel: Red)) })",
    ] {
        assert!(!fits(wrong).0, "{wrong}");
    }
    for right in [
        "(extends: \"a.ron\", sweep: { \"materials.a.pr\": range(0, 1, 3), \"shader.RADIUS\": [1, 2], \"camera\": [front] })",
        "(extends: \"a.ron\", sweep: { \"x\": zip({ \"film.exposure\": log(1, 2, 2), \"environment\": named({ \"a\": Constant(1) }) }) })",
        "(extends: \"a.ron\", members: { \"a\": { \"materials.\\\"m:a.b\\\".kd\": 1 } }, reference: \"a\", goal: (spp: [1, 2]))",
        "(extends: \"a.ron\", overrides: { \"models.0.transform.scale\": 2 }, goal: (time: 0.5), reference: (member: \"a\", spp: 4))",
    ] {
        assert!(fits(right).1, "{right}");
    }
    for wrong in [
        "(sweep: { \"film.exposure\": [1] })",
        "(extends: \"a.ron\", sweep: {})",
        "(extends: \"a.ron\", sweep: { \"film.exposure\": [] })",
        "(extends: \"a.ron\", sweep: { \"film.exposure\": 1 })",
        "(extends: \"a.ron\", sweep: { \"film.exposure\": range(0, 1) })",
        "(extends: \"a.ron\", sweep: { \"film.exposure\": [\"bright\"] })",
        "(extends: \"a.ron\", sweep: { \"materials.a.pr\": named({ \"dull\": 2 }) })",
        "(extends: \"a.ron\", overrides: { \"render.integrator\": Pth })",
        "(extends: \"a.ron\", goal: (error: \"small\"))",
        "(extends: \"a.ron\", goal: ())",
        "(extends: \"a.ron\", goal: (spp: 1, time: 1))",
        "(extends: \"a.ron\", members: { \"a\": 1 })",
    ] {
        assert!(!fits(wrong).1, "{wrong}");
    }
}

#[test]
fn the_command_prints_schemas_and_files() {
    let printed = |arguments: &[&str]| -> Value {
        let run = Command::new(env!("CARGO_BIN_EXE_lucerna")).arg("schema").args(arguments).output().expect("a run");
        assert!(run.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
        serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{arguments:?}: {error}"))
    };
    for (arguments, title) in
        [(&[] as &[&str], "Scene file"), (&["scene"], "Scene file"), (&["variants"], "Variant file")]
    {
        let schema = printed(arguments);
        assert_eq!(schema["title"], title);
    }
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/teapot.ron");
    let document = printed(&["--of", scene.to_str().expect("a path")]);
    assert_eq!(document["render"]["energy"], "Preserve");
    assert_eq!(document["film"]["size"], serde_json::json!([512, 512]));
    let run =
        Command::new(env!("CARGO_BIN_EXE_lucerna")).args(["schema", "--of", "nowhere.ron"]).output().expect("a run");
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&run.stderr).contains("there is no such file"));
}
