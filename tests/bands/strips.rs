//! Files that are written strip by strip hold what those hold that are written at once.

use std::path::Path;

use glam::UVec2;
use lucerna::components::Crop;
use lucerna::image::{Frame, Output, Outputs, Picture, Rows};
use serde_json::Value;

use super::{exr_of, png_of};

const WIDTH: usize = 5;
const HEIGHT: usize = 83;

/// Bytes of the metadata as JSON.
const EXACT: usize = r#"{"scene":"Küche/日本.ron","spp":"42"}"#.len();

struct Sample {
    linear: Vec<[f32; 3]>,
    display: Vec<[u8; 4]>,
    metadata: Vec<(&'static str, String)>,
}

impl Sample {
    fn new() -> Self {
        let pixel = |i: usize| [i as f32 * 0.37, 1e-30 * i as f32, 1e6 / (i + 1) as f32];
        let metadata = vec![("scene", "Küche/日本.ron".to_owned()), ("spp", "42".to_owned())];
        let display = (0..WIDTH * HEIGHT).map(|i| [i as u8, (i / 7) as u8, 255 - i as u8, 9]).collect();
        Self { linear: (0..WIDTH * HEIGHT).map(pixel).collect(), display, metadata }
    }

    /// Rows from the top, as they are handed over.
    fn rows(&self, first: usize, count: usize) -> Rows {
        let range = first * WIDTH..(first + count) * WIDTH;
        Rows { linear: self.linear[range.clone()].to_vec(), display: self.display[range].to_vec() }
    }
}

fn frame() -> Frame {
    let min = UVec2::new(2, 9);
    Frame { size: UVec2::new(100, 200), window: Crop { min, max: min + UVec2::new(WIDTH as u32, HEIGHT as u32) } }
}

fn outputs(folder: &Path, name: &str) -> Outputs {
    let files = ["png", "exr", "json"].map(|ending| Output::new(folder.join(format!("{name}.{ending}"))).unwrap());
    let (outputs, failures) = Outputs::prepare(&files, &[]);
    assert!(failures.is_empty());
    outputs
}

/// Writes the sample in strips of such heights; rows that are left are not written. Returns the outputs.
fn written(folder: &Path, name: &str, heights: &[usize], most: usize) -> Outputs {
    let (sample, mut outputs) = (Sample::new(), outputs(folder, name));
    let mut strips = outputs.begin(frame(), most);
    let mut first = 0;
    for count in heights {
        strips.add(sample.rows(first, *count));
        first += count;
    }
    let failures = outputs.finish(strips, &sample.metadata, |written| serde_json::json!(written.names()));
    assert!(failures.is_empty(), "{failures:?}");
    outputs
}

/// Of a number of rows of a file: its PNG's and its EXR's pixels.
fn pixels(folder: &Path, name: &str) -> (Vec<u8>, Vec<[u32; 3]>) {
    let (width, png, _) = png_of(&folder.join(format!("{name}.png")));
    let (exr, place, _) = exr_of(&folder.join(format!("{name}.exr")));
    assert_eq!((width as usize, place), (WIDTH, [2, 9]));
    (png, exr)
}

#[test]
fn strips_of_any_height_give_the_same_picture() {
    let (folder, sample) = (tempfile::tempdir().unwrap(), Sample::new());
    let (frame, report) = (frame(), Value::Null);
    let Sample { linear, display, metadata } = &sample;
    let picture = Picture { size: frame.size, window: frame.window, linear, display, metadata, report: &report };
    assert!(outputs(folder.path(), "whole").write(&picture, |_| Value::Null).is_empty());
    let whole = pixels(folder.path(), "whole");
    assert_eq!(whole.1, linear.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>());
    // An EXR has blocks of 16 rows; strips begin and end anywhere in them.
    for (name, heights) in [
        ("a", vec![83]),
        ("b", vec![16; 5].into_iter().chain([3]).collect()),
        ("c", vec![8, 8, 32, 1, 34]),
        ("d", vec![1; 83]),
        ("e", vec![33, 50]),
        ("f", vec![15, 17, 51]),
    ] {
        let outputs = written(folder.path(), name, &heights, 200);
        assert_eq!(pixels(folder.path(), name), whole, "{heights:?}");
        assert_eq!(outputs.seconds().len(), 2);
        let listed: Vec<String> =
            serde_json::from_slice(&std::fs::read(folder.path().join(format!("{name}.json"))).unwrap()).unwrap();
        assert_eq!(listed, outputs.names());
        assert_eq!(listed.len(), 3);
    }
}

#[test]
fn what_is_known_at_the_end_is_in_the_files() {
    let folder = tempfile::tempdir().unwrap();
    for (name, most) in [("exact", EXACT), ("room", 500)] {
        written(folder.path(), name, &[83], most);
        let (.., text) = png_of(&folder.path().join(format!("{name}.png")));
        assert_eq!(text, [("spp".to_owned(), "42".to_owned())]);
        let (.., metadata) = exr_of(&folder.path().join(format!("{name}.exr")));
        assert_eq!(metadata, serde_json::json!({ "scene": "Küche/日本.ron", "spp": "42" }), "{name}");
    }
}

#[test]
fn rows_that_are_left_are_black() {
    let folder = tempfile::tempdir().unwrap();
    for (name, heights) in [("none", vec![]), ("few", vec![3]), ("many", vec![16, 5, 60])] {
        written(folder.path(), name, &heights, 200);
        let there = heights.iter().sum::<usize>() * WIDTH;
        let (png, exr) = pixels(folder.path(), name);
        let sample = Sample::new();
        let shown: Vec<u8> = sample.display[..there].iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        assert_eq!(png[..3 * there], shown);
        assert!(png.len() == 3 * WIDTH * HEIGHT && png[3 * there..].iter().all(|code| *code == 0), "{name}");
        assert_eq!(exr[there..], vec![[0; 3]; WIDTH * HEIGHT - there], "{name}");
    }
}

#[test]
fn pictures_that_are_given_up_leave_nothing() {
    let (folder, sample) = (tempfile::tempdir().unwrap(), Sample::new());
    let outputs = outputs(folder.path(), "x");
    let mut strips = outputs.begin(frame(), 200);
    strips.add(sample.rows(0, 20));
    drop(strips);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn one_file_that_fails_stops_no_other() {
    let (folder, sample) = (tempfile::tempdir().unwrap(), Sample::new());
    for broken in ["x.png", "x.exr"] {
        let mut outputs = outputs(folder.path(), "x");
        let mut strips = outputs.begin(frame(), 200);
        strips.add(sample.rows(0, 40));
        // Something comes in the way while it renders.
        std::fs::create_dir(folder.path().join(broken)).unwrap();
        strips.add(sample.rows(40, 43));
        let failures = outputs.finish(strips, &sample.metadata, |written| serde_json::json!(written.names()));
        assert!(failures.len() == 1 && failures[0].to_string().contains(broken), "{failures:?}");
        assert!(outputs.names().len() == 2 && !outputs.names().iter().any(|name| name.ends_with(broken)));
        std::fs::remove_dir(folder.path().join(broken)).unwrap();
        for name in outputs.names() {
            std::fs::remove_file(name).unwrap();
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
