//! Interrupts, full disks and files that can't be written, while a picture is made band by band.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::{command, exr_of, png_of, report, scene};

const SIXTEEN_ROWS: u64 = 64 << 10;

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Starts a render that never ends by itself, and waits until it has begun with such a row.
fn started(folder: &Path, row: u32, more: &[&str]) -> (std::process::Child, BufReader<std::process::ChildStderr>) {
    let scene = scene("cornell-data");
    let arguments =
        [&["render", &scene, "--size", "64x64", "-o", "x.png", "-o", "x.exr", "-o", "x.json"], more].concat();
    let mut child =
        command(folder, Some(SIXTEEN_ROWS), &arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap());
    // A line every ten seconds.
    let mut line = String::new();
    while !line.contains(&format!("rows {row}-")) {
        line.clear();
        assert!(said.read_line(&mut line).unwrap() > 0, "it ended before row {row}");
    }
    (child, said)
}

fn tell(child: &std::process::Child, signal: &str) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

#[test]
fn an_interrupt_writes_the_rows_that_there_are_and_says_how_to_have_the_rest() {
    let folder = tempfile::tempdir().unwrap();
    // The second band is under way after a fourth of the time.
    let (mut child, mut said) = started(folder.path(), 16, &["--time", "60", "--json"]);
    tell(&child, "-INT");
    let (mut out, mut rest) = (String::new(), String::new());
    child.stdout.take().unwrap().read_to_string(&mut out).unwrap();
    said.read_to_string(&mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{rest}");
    assert_eq!(names(folder.path()), ["x.exr", "x.json", "x.png"]);
    let told: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&told["interrupted"], &told["spp"], &told["relative_error"]), (&json!(true), &json!(0), &Value::Null));
    assert_eq!((&told["bands"][0]["rows"], &told["bands"][1]["rows"]), (&json!([0, 16]), &json!([16, 32])));
    let command = told["rest"].as_str().unwrap();
    assert!(command.contains("--time 60") && command.contains("--crop 0,64,16,64"), "{command}");
    assert!(command.contains("-o x-rows-16.exr") && rest.contains(command) && rest.contains("row 32 of 64"), "{rest}");
    let (film, _, metadata) = exr_of(&folder.path().join("x.exr"));
    let lit = |rows: std::ops::Range<usize>| film[64 * rows.start..64 * rows.end].iter().any(|pixel| *pixel != [0; 3]);
    assert!(lit(0..16) && lit(16..32) && !lit(32..64));
    assert_eq!(metadata["spp"], "0");
    assert!(png_of(&folder.path().join("x.png")).1[3 * 64 * 32..].iter().all(|code| *code == 0));
    // The command is one, and its rows are those of the whole.
    let quick = command.replace("--time 60", "--spp 2").replacen("lucerna", env!("CARGO_BIN_EXE_lucerna"), 1);
    let run = Command::new("sh").args(["-c", &quick]).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{quick}: {}", String::from_utf8_lossy(&run.stderr));
    let (part, place, _) = exr_of(&folder.path().join("x-rows-16.exr"));
    report(folder.path(), None, &["render", &scene("cornell-data"), "--size", "64x64", "--spp", "2", "-o", "y.exr"]);
    let (whole, ..) = exr_of(&folder.path().join("y.exr"));
    assert!(place == [0, 16] && part == whole[64 * 16..], "the rest is not that of the whole");
}

#[test]
fn a_second_interrupt_leaves_no_half_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let (mut child, _said) = started(folder.path(), 16, &["--time", "60"]);
    assert!(names(folder.path()).iter().any(|name| name.ends_with(".part")), "nothing is being written");
    tell(&child, "-INT");
    tell(&child, "-INT");
    child.wait().unwrap();
    // Either ends it: what there was is written, or nothing is left.
    assert!(!names(folder.path()).iter().any(|name| name.ends_with(".part")), "{:?}", names(folder.path()));
}

/// Runs a render in a folder whose folder `full` is a disk of 24 KiB: exit code, stdout and stderr. None where nobody may mount one.
#[cfg(target_os = "linux")]
fn on_a_small_disk(folder: &Path, arguments: &str) -> Option<(Option<i32>, String, String)> {
    let unshare = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["-Urm", "sh", "-c", script]).current_dir(folder);
        command.env("LUCERNA_MOST_BUFFER", SIXTEEN_ROWS.to_string()).output()
    };
    std::fs::create_dir(folder.join("full")).unwrap();
    let mount = "mount -t tmpfs -o size=24k none full";
    unshare(mount).ok().filter(|run| run.status.success())?;
    let render = format!("'{}' render '{}' --spp 1 --quiet", env!("CARGO_BIN_EXE_lucerna"), scene("cornell-data"));
    let run = unshare(&format!("{mount} && {render} {arguments}; code=$?; ls -A full >&2; exit $code")).unwrap();
    Some((run.status.code(), String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap()))
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_costs_no_file_on_another() {
    let folder = tempfile::tempdir().unwrap();
    // The EXR takes some 47 KiB.
    let run = on_a_small_disk(folder.path(), "--size 64x64 -o full/x.exr -o x.png -o x.json --json");
    let Some((code, out, said)) = run else { return };
    assert_eq!(code, Some(1), "{said}");
    assert!(said.matches("error:").count() == 1 && said.contains("full/x.exr: can't write"), "{said}");
    assert!(said.ends_with("with -o FILE\n"), "something is left there: {said}");
    assert_eq!(names(folder.path()), ["full", "x.json", "x.png"]);
    let told: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&told["outputs"], told["bands"].as_array().unwrap().len()), (&json!(["x.png", "x.json"]), 4));
    assert_eq!(png_of(&folder.path().join("x.png")).1.len(), 3 * 64 * 64);
}

#[cfg(target_os = "linux")]
#[test]
fn where_no_file_can_be_written_any_more_tracing_ends() {
    let folder = tempfile::tempdir().unwrap();
    let run = on_a_small_disk(folder.path(), "--size 64x512 -o full/x.exr -o full/y.exr");
    let Some((code, out, said)) = run else { return };
    assert_eq!((code, out.as_str()), (Some(1), ""), "{said}");
    assert!(said.contains("x.exr: can't write") && said.contains("y.exr: can't write"), "{said}");
    assert!(said.ends_with("with -o FILE\n"), "something is left there: {said}");
}
