//! An animation that was killed goes on where it was.

use std::process::Stdio;

use super::{answer, command, folder, run, scene};
use crate::support::families::done;
use crate::support::patience::Patience;

#[test]
fn a_run_that_is_killed_goes_on_and_ends_as_an_undisturbed_one() {
    let keys = r#"{ "cameras.front.position": { 0: (0, 0, 3), 7: (1, 1, 3) } }"#;
    let folder = folder(&[("a.ron", &scene(&format!("(frames: 8, keys: {keys})")))]);
    let flags = ["--spp", "256", "--size", "96x64"];
    let whole = answer(folder.path(), &[&flags[..], &["-o", "whole"]].concat(), 0);
    let mut child = command(folder.path(), &[&flags[..], &["-o", "cut", "--quiet"]].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let records = || {
        let entries = std::fs::read_dir(folder.path().join("cut/a/members")).into_iter().flatten().flatten();
        entries.filter(|entry| entry.path().extension().is_some_and(|ending| ending == "json")).count()
    };
    let mut patience = Patience::with(child.id());
    while records() < 2 {
        patience.wait("two frames");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = records();
    assert!((2..8).contains(&kept), "{kept} of 8 were done when it was killed");

    let cut = answer(folder.path(), &[&flags[..], &["-o", "cut"]].concat(), 0);
    assert_eq!((done(&cut).len(), done(&whole).len()), (8, 8));
    for frame in done(&whole) {
        for ending in ["png", "exr"] {
            let [one, two] = ["whole", "cut"]
                .map(|out| std::fs::read(folder.path().join(out).join(format!("a/members/{frame}.{ending}"))).unwrap());
            assert!(one == two, "{frame}.{ending}");
        }
    }
    // No device is opened for what is done.
    let again = command(folder.path(), &[&flags[..], &["-o", "cut"]].concat()).env("LUCERNA_ADAPTER", "99").output();
    let again = again.unwrap();
    let said = String::from_utf8(again.stdout).unwrap();
    assert!(again.status.success() && said.contains("8 of 8 frames, nothing had to be rendered"), "{said}");

    // How fast they are shown changes no frame.
    let listed = run(folder.path(), &[&flags[..], &["-o", "cut", "--list", "--fps", "7"]].concat());
    assert_eq!(String::from_utf8(listed.stdout).unwrap().matches("to be rendered").count(), 0);

    // Frames are of the scene file as it was: another one makes all of them anew.
    let text = std::fs::read_to_string(folder.path().join("a.ron")).unwrap();
    std::fs::write(folder.path().join("a.ron"), text.replace("7: (1, 1, 3)", "7: (1, 1, 4)")).unwrap();
    let listed = run(folder.path(), &[&flags[..], &["-o", "cut", "--list"]].concat());
    assert_eq!(String::from_utf8(listed.stdout).unwrap().matches("to be rendered").count(), 8);
}
