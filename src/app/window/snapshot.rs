//! Saves what the window shows to `result/`, as PNG and EXR.

use std::path::Path;

use super::repeat::Shown;
use crate::app::shared::describe;
use crate::image::{Kind, Output, Outputs, Picture, SaveError};
use crate::scene::edit;

/// Numbers that are tried for a name that is free.
const MOST_NAMES: u32 = 100_000;

/// Writes the film under the first name that is free in `folder`, `SCENE-1.png` and `.exr`. Returns the names of the files
/// that were written, and why the others were not.
pub fn save(folder: &Path, shown: &Shown) -> (Vec<String>, Vec<SaveError>) {
    let Shown { scene, film, .. } = shown;
    let path = |n: u32, extension: &str| folder.join(format!("{}-{n}.{extension}", scene.name));
    let free = |n: &u32| !path(*n, "png").exists() && !path(*n, "exr").exists();
    let number = (1..MOST_NAMES).find(free).unwrap_or(MOST_NAMES);
    let metadata = metadata(shown);
    let picture = Picture {
        size: film.size,
        window: film.window,
        linear: &film.rgb,
        display: &film.picture,
        metadata: &metadata,
        report: &serde_json::Value::Null,
    };
    let files = [("png", Kind::Png), ("exr", Kind::Exr)];
    let files = files.map(|(extension, kind)| Output { path: path(number, extension), kind });
    let (mut outputs, mut failures) = Outputs::prepare(&files, &[]);
    failures.extend(outputs.write(&picture, |_| serde_json::Value::Null));
    (outputs.names(), failures)
}

/// What it takes to come back to this picture. The camera is as it was moved, as a line for the scene file.
fn metadata(shown: &Shown) -> Vec<(&'static str, String)> {
    let Shown { scene, film, adapter, .. } = shown;
    let camera = scene.cameras.get(&scene.active).map(|camera| edit::camera_line(&scene.active, camera));
    let mut data = vec![
        ("Software", concat!("Lucerna ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("scene", scene.name.clone()),
        ("camera", camera.unwrap_or_default()),
        ("size", format!("{}x{}", film.size.x, film.size.y)),
        ("spp", film.spp.to_string()),
    ];
    data.extend(describe::settings(scene).map(|(setting, text)| (setting.field, text)));
    let values: Vec<String> = scene.shader.0.iter().map(|(name, value)| format!("{name}={value}")).collect();
    if !values.is_empty() {
        data.push(("shader", values.join("; ")));
    }
    data.extend([("adapter", adapter.clone()), ("repeat", shown.repeat().line)]);
    data
}
