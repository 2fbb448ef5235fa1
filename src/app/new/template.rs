//! The text of a new scene file: what there is to change, with what it does.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::components::{Camera, Daylight, Environment, Film, Render, ShaderValues};
use crate::scene::{SceneDescription, edit};

/// The sun's elevation and azimuth, degrees.
const SUN: [f64; 2] = [45.0, 120.0];

/// Segments of the longest path.
const DEPTH: u32 = 16;

/// Letters of a commented line, beyond which what a material is goes without saying.
const WIDE: usize = 120;

/// A scene of one model, as it is `alone`, seen by a camera of a name, and lit by what of it emits, else by day.
pub fn scene(model: &str, (name, camera): (&str, &Camera), alone: &SceneDescription) -> String {
    let [width, height] = alone.film.size.to_array();
    let light = match alone.environment {
        None => "    // The model's own lights; for a sky beside them:\n    // environment: Sky(sun: (45, 120)),\n",
        Some(_) => {
            "    // A clear day: the sun's height above the horizon and its direction from -z towards +x, degrees; haze from 2 to 10.\n    \
             environment: Sky(sun: (45, 120), turbidity: 3, strength: 1),\n    \
             // A picture all around: environment: Map(path: \"sky.exr\", strength: 1),\n"
        }
    };
    format!(
        "// Saved while `lucerna view` or `lucerna watch` shows it, a change is seen at once; a mistake is told with its line.\n\
         // `lucerna schema` lists every field.\n\
         (\n    \
         models: [\n        \
         // Paths are relative to this file; also transform: (scale: 2, rotate_y: 30, translate: (0, 1, 0)).\n        \
         (path: {model:?}),\n    \
         ],\n    \
         cameras: {{\n        \
         // In the window, C copies where the camera is as such a line.\n        \
         {}\n    \
         }},\n    \
         // Pixels, and brighter or darker by stops.\n    \
         film: (size: ({width}, {height}), exposure: 0),\n    \
         // Without `spp`, samples a pixel, it is rendered until it is good.\n    \
         render: (max_depth: 16),\n\
         {light}    \
         // A lamp: a point, W/sr.\n    \
         // lights: {{ \"lamp\": Point(position: {}, intensity: {}) }},\n\
         {})\n",
        edit::camera_line(name, camera),
        vector(rounded_to(camera.position, scale_of(camera))),
        number(4.0 * (camera.position - camera.look_at).length_squared()),
        materials(alone),
    )
}

/// What such a file says of the scene beside its models, seen as it is `alone`: what differs from this is to be written into it.
pub fn said(alone: &SceneDescription) -> SceneDescription {
    let [elevation, azimuth] = SUN;
    let ground = glam::Vec3::splat(0.3);
    let day = Daylight { elevation, azimuth, turbidity: 3.0, ground, strength: 1.0, sun_size: Daylight::SUN_SIZE };
    SceneDescription {
        film: Film { size: alone.film.size, ..Film::default() },
        render: Render { max_depth: DEPTH, ..Render::default() },
        environment: alone.environment.as_ref().map(|_| Environment::Daylight(day)),
        lights: BTreeMap::new(),
        shader: ShaderValues::default(),
        ..alone.clone()
    }
}

/// The changes that may be made to materials: each as it is, behind `//`.
fn materials(alone: &SceneDescription) -> String {
    let mut text = String::from(
        "    // Materials as their library has them: take the // away, and change them.\n    materials: {\n",
    );
    for (key, material) in &alone.materials {
        let name = key.split_once(':').map_or(key.as_str(), |(_, name)| name);
        let line = format!("        // {}", edit::material_line(name, material, None));
        let kind = format!("  // {}", material.appearance().kind);
        text += &line;
        text += if line.len() + kind.len() <= WIDE { &kind } else { "" };
        text += "\n";
    }
    text + "    },\n"
}

fn vector(v: DVec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

/// Three digits of a number.
fn number(value: f64) -> String {
    let unit = 10f64.powf((value.abs().max(1e-30).log10().floor() - 2.0).clamp(-300.0, 300.0));
    rounded_to(DVec3::splat(value), unit).x.to_string()
}

/// The camera of a scene, its numbers as short as they may be: no more than a thousandth of its distance is lost.
pub fn rounded(alone: &SceneDescription) -> Camera {
    let camera = alone.cameras.get(&alone.active).copied().unwrap_or_default();
    let unit = scale_of(&camera);
    Camera { position: rounded_to(camera.position, unit), look_at: rounded_to(camera.look_at, unit), ..camera }
}

/// The power of ten below a thousandth of the distance that a camera looks at.
fn scale_of(camera: &Camera) -> f64 {
    10f64.powf(((camera.position - camera.look_at).length().max(1e-30).log10() - 3.0).floor())
}

/// A vector at whole multiples of a power of ten.
fn rounded_to(v: DVec3, unit: f64) -> DVec3 {
    // Divided by a whole number where that is one, so that no digits follow.
    let at = |x: f64| if unit < 1.0 { (x / unit).round() / (1.0 / unit).round() } else { (x / unit).round() * unit };
    DVec3::new(at(v.x), at(v.y), at(v.z)) + DVec3::ZERO
}
