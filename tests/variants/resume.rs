//! A run that was killed, or broke, goes on where it was.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Stdio;

use lucerna::app::variants::record::{Answer, State};

use super::{answer, command, folder, member, run};
use crate::support::families::done;
use crate::support::patience::Patience;

const FAMILY: &str = r#"(
    extends: "a.ron",
    overrides: {"film.size": (96, 64)},
    sweep: {"materials.grey.ns": [5, 50, 500, 5000], "camera": ["front", "left"]},
    reference: (member: "5_front", spp: 512),
    goal: (spp: [64, 256]),
)
"#;

/// All files of all members.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder.join("fam/members")).unwrap();
    let file = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        Some((name, std::fs::read(&path).unwrap())).filter(|(name, _)| !name.ends_with(".json"))
    };
    entries.filter_map(|entry| file(entry.unwrap().path())).collect()
}

/// What does not depend on the time.
fn lasting(answer: &Answer) -> Vec<String> {
    let line = |record: &lucerna::app::variants::record::Record| {
        let snapshots: Vec<_> = record.snapshots.iter().map(|s| (s.spp, s.rays, s.relmse)).collect();
        format!(
            "{} {} {:?} {snapshots:?} {:?} {:?}",
            record.name, record.key, record.state, record.mean, record.against
        )
    };
    answer.records.iter().map(line).collect()
}

#[test]
fn a_run_that_is_killed_goes_on_and_ends_as_an_undisturbed_one() {
    let folder = folder(FAMILY);
    let whole = answer(folder.path(), &["--out", "whole"], 0);
    assert_eq!(done(&whole).len(), 8);
    assert!(whole.records.iter().all(|record| record.against.is_some()));

    let mut child = command(folder.path(), &["--out", "cut", "--quiet"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let members = folder.path().join("cut/fam/members");
    let records = || {
        let entries = std::fs::read_dir(&members).into_iter().flatten().flatten();
        entries.filter(|entry| entry.path().extension().is_some_and(|ending| ending == "json")).count()
    };
    let mut patience = Patience::with(child.id());
    while records() < 2 {
        patience.wait("two members");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = records();
    assert!((2..8).contains(&kept), "{kept} of 8 were done when it was killed");
    std::fs::write(members.join(".lucerna-left.part"), b"half").unwrap();

    let cut = answer(folder.path(), &["--out", "cut"], 0);
    assert_eq!(lasting(&cut), lasting(&whole));
    assert!(files(&folder.path().join("cut")) == files(&folder.path().join("whole")));

    // Nothing is rendered once more, for which no device is opened either.
    let mut again = command(folder.path(), &["--out", "cut"]);
    let again = again.env("LUCERNA_ADAPTER", "99").output().unwrap();
    let said = String::from_utf8(again.stdout).unwrap();
    assert!(again.status.success() && said.contains("nothing had to be rendered"), "{said}");

    // A picture that was touched, and a file that was edited, are made anew; what does not depend on them is not.
    std::fs::write(members.join("50_left.png"), b"").unwrap();
    let touched = answer(folder.path(), &["--out", "cut"], 0);
    assert_eq!(lasting(&touched), lasting(&whole));
    std::fs::write(folder.path().join("a.mtl"), super::MTL.replace("0.6", "0.3")).unwrap();
    let edited = run(folder.path(), &["--out", "cut", "--list"]);
    assert_eq!(String::from_utf8(edited.stdout).unwrap().matches("to be rendered").count(), 9);
}

#[test]
fn a_member_that_breaks_is_marked_and_the_others_are_done() {
    let folder = folder(
        r#"(
    extends: "a.ron",
    sweep: {"materials.grey.ns": [5, 50]},
    members: {
        "wrong": {"materials.gray.kd": (1, 1, 1)},
        "huge": {"film.size": (99999, 1)},
    },
)
"#,
    );
    let answer = answer(folder.path(), &["--out", "out"], 1);
    assert_eq!(done(&answer), ["5", "50"]);
    let State::Failed { message, file, line, .. } = &member(&answer, "wrong").state else { panic!("it is wrong") };
    assert!(message.contains("gray") && file.as_deref() == Some("fam.ron") && *line == 5, "{message}, {file:?}:{line}");
    assert!(matches!(member(&answer, "huge").state, State::Failed { line: 6, .. }));

    // What is wrong with all of them is told once, and nothing is rendered.
    std::fs::write(folder.path().join("a.obj"), "f 1 2 3\n").unwrap();
    let family = r#"(extends: "a.ron", sweep: {"materials.grey.ns": [5, 50]})"#;
    std::fs::write(folder.path().join("fam.ron"), family).unwrap();
    let run = run(folder.path(), &["--out", "other"]);
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.code() == Some(1) && said.matches("error:").count() == 1, "{said}");
    assert!(!folder.path().join("other").exists());
}

/// Members are compared with the reference as the files are now, or with none.
#[test]
fn nothing_is_compared_with_a_reference_that_is_old() {
    let folder = folder(r#"(extends: "a.ron", sweep: {"materials.grey.kd": [0.2, 0.8]}, reference: "0.2")"#);
    let whole = answer(folder.path(), &["--out", "out"], 0);
    assert!(whole.records.iter().all(|record| record.against.is_some()));
    let scene = std::fs::read_to_string(folder.path().join("a.ron")).unwrap();
    std::fs::write(folder.path().join("a.ron"), scene.replace("Constant((1, 1, 1))", "Constant((2, 2, 2))")).unwrap();
    let one = answer(folder.path(), &["--out", "out", "--only", "0.8"], 0);
    assert_eq!(member(&one, "0.2").state, State::Missing);
    assert!(member(&one, "0.8").state == State::Done && member(&one, "0.8").against.is_none());
    let both = answer(folder.path(), &["--out", "out"], 0);
    assert!(both.records.iter().all(|record| record.against.is_some()));
}
