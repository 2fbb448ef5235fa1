//! Textures that an adapter has no room for are told: each once, in the same words by every command.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use glam::UVec2;
use image::{ExtendedColorType as Colour, ImageFormat};
use lucerna::app::shared::textures::TextureNotices;
use lucerna::engine::TextureUse;
use serde_json::Value;
use tempfile::TempDir;

use super::encoded;
use crate::support;

/// Texels a side of a picture that has to be halved where a binding holds 128 MiB.
const SIDE: u32 = 5200;

/// A folder with a scene, `a.ron`, whose texture does not fit; none where the adapter has room for it.
pub fn crowded() -> Option<TempDir> {
    let words = 4 * u64::from(SIDE) * u64::from(SIDE);
    if support::gpu().limits.max_storage_buffer_binding_size > words {
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let obj = "mtllib a.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    let scene = r#"(
    models: [(path: "a.obj")],
    cameras: { "front": (position: (0, 0, 3), look_at: (0, 0, 0), fov_y: 40) },
    film: (size: (20, 12)),
    render: (spp: 2, max_depth: 3),
)
"#;
    let codes = vec![128; 3 * (SIDE * SIDE) as usize];
    let picture = encoded(ImageFormat::Png, [SIDE; 2], Colour::Rgb8, &codes);
    for (name, bytes) in [
        ("a.obj", obj.as_bytes()),
        ("a.mtl", b"newmtl a\nmap_Kd a.png\n"),
        ("a.ron", scene.as_bytes()),
        ("a.png", &picture),
    ] {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    Some(folder)
}

/// What is told of it.
pub fn words() -> String {
    let half = SIDE / 2;
    format!(
        "of {SIDE}x{SIDE} texels is halved once to {half}x{half}: this adapter has no room for more (`lucerna doctor`)"
    )
}

fn lucerna(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucerna"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command
}

#[test]
fn each_is_told_once() {
    let used = |name: &str, halvings: u32, for_room: u32| TextureUse {
        name: name.to_owned(),
        size: UVec2::new(4096, 1),
        halvings,
        for_room,
        bytes: 4,
    };
    let mut notices = TextureNotices::default();
    let (fits, asked) = (used("a", 0, 0), used("b", 2, 0));
    assert!(notices.fresh(&[], None).is_empty() && notices.fresh(&[fits.clone(), asked.clone()], None).is_empty());
    let told = notices.fresh(&[fits.clone(), asked.clone(), used("c", 3, 1)], None);
    let right = "the texture `c` of 4096x1 texels is halved once to 512x1: this adapter has no room for more (`lucerna doctor`)";
    assert_eq!(told, [right]);
    assert!(notices.fresh(&[used("c", 3, 1), fits], None).is_empty());
    let told = notices.fresh(&[used("c", 4, 2), used("d", 1, 1)], None);
    assert!(told.len() == 2 && told[0].contains("`c`") && told[0].contains("halved 2 times to 256x1"), "{told:?}");
    // It fits, and then it does not again.
    assert!(notices.fresh(&[], None).is_empty());
    let sky = Some((UVec2::new(9000, 4500), 2));
    let told = notices.fresh(&[], sky);
    let of_sky = "the environment's picture of 9000x4500 pixels is halved 2 times to 2250x1125: this adapter has no room for more";
    assert!(told.len() == 1 && told[0].starts_with(of_sky), "{told:?}");
    assert!(notices.fresh(&[], sky).is_empty());
    assert_eq!(notices.fresh(&[used("c", 3, 1)], None), [right]);
}

#[test]
fn commands_tell_it_alike() {
    let Some(folder) = crowded() else { return };
    let run = lucerna(folder.path(), &["render", "a.ron", "-o", "a.png.exr"]).output().unwrap();
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.success() && said.contains("warning: the texture `") && said.contains(&words()), "{said}");
    let quiet = lucerna(folder.path(), &["render", "a.ron", "-q", "-o", "a.exr"]).output().unwrap();
    assert!(quiet.stderr.is_empty());

    let mut watch = lucerna(folder.path(), &["watch", "a.ron"]);
    let mut child = watch.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok);
    let mut events = lines.map(|line| serde_json::from_str::<Value>(&line).unwrap());
    let told: Vec<Value> = events.by_ref().take_while(|event| event["event"] != "finished").collect();
    child.kill().unwrap();
    let stderr =
        BufReader::new(child.stderr.take().unwrap()).lines().map_while(Result::ok).collect::<Vec<_>>().join("\n");
    child.wait().unwrap();
    let kinds: Vec<&Value> = told.iter().map(|event| &event["event"]).filter(|kind| *kind != "compiling").collect();
    assert_eq!(kinds, ["watching", "textures"], "{told:?}");
    let event = told.iter().find(|event| event["event"] == "textures").unwrap();
    let message = event["warnings"][0]["message"].as_str().unwrap();
    assert!(message.starts_with("the texture `") && message.contains(&words()), "{event}");
    assert!(
        stderr.contains(&format!("warning: {message}")) && said.contains(&format!("warning: {message}")),
        "{stderr}"
    );
}
