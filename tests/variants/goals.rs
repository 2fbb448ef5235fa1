//! When members are done, which are wanted, and what is refused.

use lucerna::app::variants::record::State;

use super::{answer, command, folder, run};
use crate::support::families::done;

const FAMILY: &str = r#"(extends: "a.ron", sweep: {"materials.grey.ns": [5, 50]})"#;

#[test]
fn members_are_traced_to_samples_to_seconds_or_to_an_error() {
    let folder = folder(FAMILY);
    let by_samples = answer(folder.path(), &["--spp", "16,1,4", "--out", "out"], 0);
    for record in &by_samples.records {
        assert_eq!(record.snapshots.iter().map(|s| s.spp).collect::<Vec<_>>(), [1, 4, 16]);
        assert!(record.snapshots.is_sorted_by(|a, b| a.seconds < b.seconds && a.rays < b.rays));
        assert!(record.repeat.contains("--spp 16") && record.repeat.contains("-D materials.grey.ns="));
    }
    let by_time = answer(folder.path(), &["--time", "0.05,0.1", "--out", "out"], 0);
    for record in &by_time.records {
        assert!(record.snapshots.len() == 2 && record.snapshots[1].seconds >= 0.1 && record.snapshots[0].spp >= 1);
    }
    let by_error = answer(folder.path(), &["--error", "1e-3", "--out", "out"], 0);
    for record in &by_error.records {
        assert!(record.snapshots.len() == 1 && record.snapshots[0].relmse <= 1e-3 && record.snapshots[0].spp >= 4);
    }
    assert_eq!(by_error.records.len(), 2);
}

#[test]
fn some_members_alone_can_be_wanted_and_others_are_kept() {
    let folder = folder(FAMILY);
    let one = answer(folder.path(), &["--only", "50", "--out", "out"], 0);
    assert_eq!((done(&one), &one.records[0].state), (vec!["50"], &State::Missing));
    let both = answer(folder.path(), &["--only", "5", "--out", "out"], 0);
    assert_eq!(done(&both), ["5", "50"]);
    let written = std::fs::read(folder.path().join("out/fam/answer.json")).unwrap();
    assert_eq!(serde_json::from_slice::<lucerna::app::variants::record::Answer>(&written).unwrap().records.len(), 2);
}

/// No device is opened: there is none of this number.
#[test]
fn a_list_renders_nothing() {
    let folder = folder(FAMILY);
    let listed = command(folder.path(), &["--list"]).env("LUCERNA_ADAPTER", "99").output().unwrap();
    let text = String::from_utf8(listed.stdout).unwrap();
    assert!(listed.status.success() && text.matches("to be rendered").count() == 2, "{text}");
    assert!(!folder.path().join("result").exists());
}

#[test]
fn what_can_not_be_meant_is_refused() {
    let folder = folder(FAMILY);
    let refusals: [(&[&str], &str); 4] = [
        (&["--only", "51"], "its members are: 5, 50"),
        (&["--spp", "4", "--time", "1"], "cannot be used with"),
        (&["--jobs", "63"], "adapters"),
        (&["--spp", "0"], "not in 1.."),
    ];
    for (arguments, says) in refusals {
        let run = run(folder.path(), arguments);
        let text = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && text.contains(says), "{arguments:?}: {text}");
    }
}

/// `--size` is for all but those that a sweep gives another, and the table says what was rendered.
#[test]
fn a_sweep_over_sizes_wins_over_the_flag() {
    let folder = super::folder(r#"(extends: "a.ron", members: {"flag": {}, "own": {"film.size": (9, 7)}})"#);
    let answer = super::answer(folder.path(), &["--size", "11x5", "--spp", "1"], 0);
    for (name, width, height) in [("flag", 11, 5), ("own", 9, 7)] {
        let picture = image::open(folder.path().join(format!("result/variants/fam/members/{name}.png"))).unwrap();
        assert_eq!((picture.width(), picture.height()), (width, height), "{name}");
        let size = super::member(&answer, name).settings.iter().rfind(|(path, _)| path == "film.size").unwrap();
        assert_eq!(size.1, format!("({width}, {height})"));
    }
}
