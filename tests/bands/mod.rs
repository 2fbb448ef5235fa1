//! Pictures larger than a device's buffers, made band by band; what memory is taken; and what is refused for want of room.

mod cut;
mod memory;
mod refused;
mod render;
mod strips;
#[cfg(unix)]
mod trouble;

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Runs the binary in a folder, on a device whose buffers have so many bytes at most; its own, if none is said.
fn lucerna(folder: &Path, most: Option<u64>, arguments: &[&str]) -> Output {
    command(folder, most, arguments).output().unwrap()
}

fn command(folder: &Path, most: Option<u64>, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    match most {
        Some(bytes) => command.env("LUCERNA_MOST_BUFFER", bytes.to_string()),
        None => command.env_remove("LUCERNA_MOST_BUFFER"),
    };
    command
}

/// The report of a render of one of the project's scenes, of which no more than results lie in the folder.
#[track_caller]
fn report(folder: &Path, most: Option<u64>, arguments: &[&str]) -> serde_json::Value {
    let run = lucerna(folder, most, &[arguments, &["--quiet", "--json"]].concat());
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(0), "{arguments:?} said:\n{said}");
    serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}: {:?}", run.stdout))
}

/// The path of one of the project's scenes.
fn scene(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes").join(name).with_extension("ron").display().to_string()
}

/// Width, pixels and text of a PNG.
fn png_of(path: &Path) -> (u32, Vec<u8>, Vec<(String, String)>) {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    reader.finish().unwrap();
    let text = &reader.info().uncompressed_latin1_text;
    (frame.width, pixels, text.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone())).collect())
}

/// Pixels of an EXR, to the bit, where its window begins, and its metadata.
fn exr_of(path: &Path) -> (Vec<[u32; 3]>, [i32; 2], serde_json::Value) {
    let image = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b].map(f32::to_bits);
        },
    );
    let layer = image.unwrap().layer_data;
    let text = match &layer.attributes.other[&exr::meta::attribute::Text::from("lucerna")] {
        exr::meta::attribute::AttributeValue::Text(text) => text.as_slice().to_vec(),
        other => panic!("{other:?}"),
    };
    let place = layer.attributes.layer_position;
    (layer.channel_data.pixels.1, [place.x(), place.y()], serde_json::from_slice(&text).unwrap())
}
