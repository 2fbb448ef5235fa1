//! The schema of scene files. Ranges that only one reader knows are left to it: it says what is wrong at its place.

use schemars::{Schema, json_schema};
use serde_json::Map;

use super::parts::{
    about, any, between, each, list, map, number, object, or_none, switch, text, tuple, variant, whole,
};
use super::values::{keys, settings};
use crate::components::{Lens, PointLight, SpotCone};
use crate::scene::animate::{FPS, FPS_RANGE, MOST_FRAMES};
use crate::scene::settings::Group;

/// What a scene file may hold.
pub fn scene() -> Schema {
    let mut schema = object("A scene of Lucerna.", fields().map(|(name, schema)| (name, or_none(schema))), &[]);
    schema.insert("$schema".to_owned(), "https://json-schema.org/draft/2020-12/schema".into());
    schema.insert("title".to_owned(), "Scene file".into());
    schema
}

/// The fields of a scene file.
pub fn fields() -> impl Iterator<Item = (&'static str, Schema)> {
    [
        ("extends", text("a scene file, relative to this one: what this one says is written over it")),
        ("models", list("what is in the scene", model())),
        ("cameras", map("views, by name", or_none(camera()))),
        ("camera", text("the view that is rendered; without it, the first by name")),
        ("lights", map("lights without extent, by name", or_none(light()))),
        ("film", film()),
        ("render", render()),
        ("environment", environment()),
        ("materials", map("changes of materials, by `name` or `model:name`", or_none(material()))),
        ("shader", map("values of parameters that shaders declare by `override`, by name", or_none(shader_value()))),
        ("animate", animation()),
    ]
    .into_iter()
}

/// Which of them a shader takes, it says itself.
pub fn shader_value() -> Schema {
    any(vec![number(), switch()])
}

fn film() -> Schema {
    object("the picture", settings(Group::Film).map(|(name, schema)| (name, or_none(schema))), &[])
}

fn render() -> Schema {
    object("how it is rendered", settings(Group::Render).map(|(name, schema)| (name, or_none(schema))), &[])
}

pub fn material() -> Schema {
    object("numbers and maps of a material", keys().map(|(name, schema)| (name, or_none(schema))), &[])
}

pub fn model() -> Schema {
    let fields = [
        ("path", text("an .obj file, relative to the folder of the file that names it")),
        ("name", or_none(text("first part of the names of its meshes and materials; without it, the file's"))),
        (
            "parent",
            or_none(text("the name of the model that it moves with: its transform is in the space of that one")),
        ),
        ("transform", or_none(transform())),
        ("materials", or_none(map("changes of its materials alone, by their names", or_none(material())))),
    ];
    object("a model", fields, &["path"])
}

/// The turns about the axes.
fn turns() -> impl Iterator<Item = (&'static str, Schema)> {
    ["rotate_x", "rotate_y", "rotate_z"].into_iter().map(|name| (name, or_none(about("degrees", number()))))
}

fn transform() -> Schema {
    let fields = [
        ("matrix", or_none(about("three rows of four, instead of all else", tuple(3, tuple(4, number()))))),
        ("scale", or_none(each(3, number()))),
        ("translate", or_none(tuple(3, number()))),
    ];
    object("scale, then turns about x, y and z, then translation", fields.into_iter().chain(turns()), &[])
}

pub fn camera() -> Schema {
    let fields = [
        ("position", tuple(3, number())),
        ("look_at", tuple(3, number())),
        ("up", or_none(tuple(3, number()))),
        ("fov_y", or_none(about("degrees from the bottom of the picture to its top", number()))),
        (
            "aperture",
            or_none(about("radius of the lens, scene units; 0 is a pinhole", between(0.0, Lens::MOST_APERTURE))),
        ),
        ("focus", or_none(focus())),
        (
            "shift",
            or_none(about(
                "of the lens to the right and up, in heights of the picture",
                tuple(2, between(-Lens::MOST_SHIFT, Lens::MOST_SHIFT)),
            )),
        ),
    ];
    // What a file extends may have the others.
    object("a view: position and look_at, unless the file extends one that has them", fields, &[])
}

pub fn light() -> Schema {
    let common = || {
        let intensity = each(3, between(0.0, PointLight::MOST_INTENSITY));
        [("position", tuple(3, number())), ("intensity", about("W/sr where radiance is W/(m^2 sr)", intensity))]
    };
    let [least, most] = SpotCone::ANGLES;
    let cone = [
        ("look_at", about("a point of the cone's axis", tuple(3, number()))),
        ("angle", or_none(about("across the cone, degrees", between(least, most)))),
        (
            "blend",
            or_none(about(
                "the part of the cone's angle on which the light fades: 0 is a sharp edge",
                between(0.0, 1.0),
            )),
        ),
    ];
    // What a file extends may have the others.
    let point = object("a point that shines everywhere: position and intensity", common(), &[]);
    let spot = object("a point that shines into a cone: and look_at", common().into_iter().chain(cone), &[]);
    any(vec![variant("Point", point), variant("Spot", spot)])
}

/// What is sharp.
fn focus() -> Schema {
    let [nearest, farthest] = Lens::FOCUS_RANGE;
    let words = [
        json_schema!({ "const": "LookAt", "description": "the point that is looked at" }),
        variant("Distance", about("along the viewing axis, scene units", between(nearest, farthest))),
        variant("At", about("a point of world space", tuple(3, number()))),
    ];
    any(words.into())
}

fn animation() -> Schema {
    let values = || {
        let times = Map::from_iter([(r"^([0-9]+|[0-9.]+ *s)$".to_owned(), json_schema!({}).to_value())]);
        json_schema!({
            "description": "values by the number of a frame, as 24, or by seconds, as \"1.5s\"",
            "type": "object", "patternProperties": times, "additionalProperties": false,
        })
    };
    let track = any(vec![
        about("values that go from key to key on straight lines", values()),
        about("on a smooth curve, never beyond the keys", variant("Smooth", values())),
        about("at once", variant("Step", values())),
    ]);
    let fields = [
        ("frames", about("how many there are", whole(1, MOST_FRAMES))),
        ("fps", or_none(about(&format!("frames a second; {FPS} without it"), between(FPS_RANGE[0], FPS_RANGE[1])))),
        ("keys", map("what changes, by paths such as `cameras.front.position`", or_none(track))),
    ];
    // What a file extends may have the others.
    object("values that change with time: frames and keys, unless the file extends one that has them", fields, &[])
}

fn environment() -> Schema {
    let colour = || each(3, json_schema!({ "type": "number", "minimum": 0 }));
    let map = [
        (
            "path",
            text("an EXR, HDR or PNG by longitude and latitude, relative to the folder of the file that names it"),
        ),
        ("strength", or_none(number())),
        ("tint", or_none(colour())),
    ];
    let map = object("light of a picture", map.into_iter().chain(turns()), &["path"]);
    let day = [
        ("sun", about("elevation and azimuth, degrees", tuple(2, number()))),
        ("turbidity", or_none(about("haze, 1 to 10", number()))),
        ("ground", or_none(colour())),
        ("strength", or_none(number())),
        ("sun_size", or_none(about("angle across the sun, degrees", number()))),
    ];
    let day = object("a clear day", day, &["sun"]);
    any(vec![variant("Constant", colour()), variant("Map", map), variant("Sky", day)])
}
