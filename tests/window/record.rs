//! The record of edits, by itself: rows come, verdicts find their rows, one row's shaders run.

use lucerna::app::edits::{Edit, Kind, Lint, State, Verdict};
use lucerna::app::window::edits::record::{MOST, Record, RowId};
use lucerna::shader::Library;

/// Shaders that differ by a comment.
fn shaders(text: &str) -> Library {
    Library::embedded().with("lib/own", &format!("// {text}\n"))
}

fn edit(kind: Kind, files: &[&str], verdict: Verdict) -> Edit {
    Edit {
        kind,
        scene: "box".to_owned(),
        files: files.iter().map(|file| (*file).to_owned()).collect(),
        saved: 1000,
        pixels: None,
        lint: Lint::NotLinted,
        verdict,
    }
}

fn saved(file: &str) -> Edit {
    edit(Kind::Shaders, &[file], Verdict::new(State::Waiting, "to be judged"))
}

fn opened() -> Record {
    Record::new(edit(Kind::Opened, &[], Verdict::new(State::None, "")), shaders("first"))
}

fn failed(message: &str) -> Edit {
    edit(Kind::Shaders, &["a.wgsl"], Verdict::new(State::Failed, message))
}

fn ids(record: &Record) -> Vec<RowId> {
    record.rows().map(|row| row.id).collect()
}

fn state(record: &Record, id: RowId) -> State {
    record.row(id).unwrap().edit.verdict.state
}

#[test]
fn each_save_is_a_row_and_is_judged_by_what_ran_before() {
    let mut record = opened();
    assert!(record.to_judge().is_none() && record.last_traced().is_none());
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    let (of, [old, new]) = record.to_judge().unwrap();
    assert!(of == a && old.is_same(&shaders("first")) && new.is_same(&shaders("a")));

    // A scene is a row of its own, has no shaders to go back to, and leaves what runs.
    let scene = record.take(edit(Kind::Scene, &["box.ron"], Verdict::new(State::None, "")), &shaders("a"), false);
    assert_eq!((ids(&record), record.running().id), (vec![scene, a, 0], a));
    assert!(record.row(scene).unwrap().shaders.is_none() && record.go_back(scene).is_none());

    let b = record.take(saved("b.wgsl"), &shaders("b"), true);
    let (of, [old, new]) = record.to_judge().unwrap();
    assert!(of == b && old.is_same(&shaders("a")) && new.is_same(&shaders("b")));

    // A comment changes nothing that is traced: what is asked for is the edit before it.
    let c = record.take(saved("c.wgsl"), &shaders("c"), false);
    assert!(record.running().id == c && record.to_judge().is_none());
    let (of, [old, new]) = record.last_traced().unwrap();
    assert!(of == b && old.is_same(&shaders("a")) && new.is_same(&shaders("c")));
}

#[test]
fn a_verdict_goes_to_its_row_however_late_it_comes() {
    let mut record = opened();
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    assert!(record.judge(a, Verdict::new(State::Judging, "judging: 8 films; no difference above 2 % yet")));
    let b = record.take(saved("b.wgsl"), &shaders("b"), true);
    record.leave(a);
    assert_eq!(record.row(a).unwrap().edit.verdict.short, "left before all was known: no difference above 2 % yet");
    assert!(record.judge(a, Verdict::new(State::Agree, "agrees within 0.5 %")), "the row is still there");
    assert_eq!((state(&record, a), state(&record, b)), (State::Agree, State::Waiting));
    // What is known is not left.
    record.leave(a);
    assert_eq!(state(&record, a), State::Agree);
    assert!(!record.judge(99, Verdict::new(State::Differ, "DIFFERS")), "no row has that name");
    record.judge(b, Verdict::new(State::CannotTell, "can't tell"));
    assert!(record.to_judge().is_none(), "it is judged");
}

#[test]
fn going_back_runs_a_row_and_a_save_goes_on_from_there() {
    let mut record = opened();
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    let b = record.take(saved("b.wgsl"), &shaders("b"), true);
    assert!(record.go_back(b).is_none(), "it runs already");
    assert!(record.go_back(0).unwrap().is_same(&shaders("first")));
    assert_eq!((record.wanted(), record.running().id), (Some(0), b), "it runs once it is compiled");
    assert_eq!(record.take(edit(Kind::Shaders, &[], Verdict::new(State::Waiting, "")), &shaders("first"), true), 0);
    assert_eq!((record.wanted(), record.running().id, ids(&record)), (None, 0, vec![b, a, 0]));
    assert!(record.to_judge().is_none(), "nothing ran before it");

    // Rows that were left before they were judged are, once they run again.
    record.go_back(a).unwrap();
    record.take(edit(Kind::Shaders, &[], Verdict::new(State::Waiting, "")), &shaders("a"), true);
    let (of, [old, _]) = record.to_judge().unwrap();
    assert!(of == a && old.is_same(&shaders("first")));

    // The next save is judged by what ran, which is not the row below it.
    let c = record.take(saved("c.wgsl"), &shaders("c"), true);
    let (before, library) = record.row(c).unwrap().before.clone().unwrap();
    assert!(before == a && library.is_same(&shaders("a")));

    // Another save that comes first takes its place.
    record.go_back(0).unwrap();
    let d = record.take(saved("d.wgsl"), &shaders("d"), true);
    assert_eq!((record.wanted(), record.running().id), (None, d));
}

#[test]
fn everything_read_again_is_no_edit() {
    let mut record = opened();
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    let again = || edit(Kind::Shaders, &[], Verdict::new(State::Waiting, ""));
    assert_eq!((record.take(again(), &shaders("a"), false), ids(&record).len()), (a, 2));
    record.go_back(0);
    record.take(again(), &shaders("first"), true);
    assert_eq!((record.take(again(), &shaders("a"), true), ids(&record).len()), (a, 2));
    assert_eq!(record.running().id, a);
}

#[test]
fn what_fails_is_a_row_and_what_is_taken_back_does_not_run() {
    let mut record = opened();
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    let wrong = record.fail(failed("failed: a.wgsl:1:2: no"), &shaders("a"));
    assert_eq!((state(&record, wrong), record.running().id), (State::Failed, a));
    assert!(record.go_back(wrong).is_none(), "there is nothing to go back to");
    assert!(record.to_judge().is_some_and(|(of, _)| of == a), "what runs is judged all the same");

    // A loop that does not end is found when it runs: its own row is the one that failed.
    let endless = record.take(saved("b.wgsl"), &shaders("b"), true);
    assert_eq!(record.fail(failed("failed: b.wgsl:3:1: this loop does not end"), &shaders("a")), endless);
    assert_eq!((state(&record, endless), record.running().id), (State::Failed, a));
    assert!(!record.judge(endless, Verdict::new(State::Agree, "agrees")), "it was taken back");

    // So can a row fail that was gone back to: what ran before runs.
    record.go_back(0).unwrap();
    record.take(edit(Kind::Shaders, &[], Verdict::new(State::Waiting, "")), &shaders("first"), true);
    assert_eq!(record.running().id, 0);
    record.fail(failed("failed: this loop does not end"), &shaders("a"));
    assert_eq!((record.running().id, state(&record, 0)), (a, State::None));
}

#[test]
fn pixels_and_lint_find_their_rows() {
    let mut record = opened();
    assert_eq!(record.show(0.1), None);
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    assert_eq!((record.show(0.25), record.show(0.5)), (Some(a), None));
    assert_eq!(record.row(a).unwrap().edit.pixels_told(), "250 ms");
    assert_eq!(record.lint(Lint::Warned(vec!["lib/a.wgsl: pdf is off".to_owned()])), a);

    // A warning stands until surfaces are linted again and found to be right.
    let b = record.take(saved("b.wgsl"), &shaders("b"), true);
    let told = |record: &Record, id: RowId| {
        let row = record.row(id).unwrap();
        row.edit.lint_told(record.inherited(row))
    };
    assert_eq!(told(&record, b), "lint, as before: pdf is off");
    let c = record.take(saved("c.wgsl"), &shaders("c"), true);
    record.lint(Lint::Clean);
    assert_eq!((told(&record, c), told(&record, a)), ("lint: nothing found".to_owned(), "lint: pdf is off".to_owned()));
    let d = record.take(saved("d.wgsl"), &shaders("d"), true);
    assert_eq!(told(&record, d), "not linted: surfaces run the same code");
}

#[test]
fn the_oldest_rows_go_but_not_the_first_nor_the_one_that_runs() {
    let mut record = opened();
    let a = record.take(saved("a.wgsl"), &shaders("a"), true);
    for n in 0..MOST + 5 {
        record.fail(failed(&n.to_string()), &shaders("a"));
    }
    assert_eq!((record.rows().len(), record.dropped()), (MOST, 7));
    assert!(record.row(0).is_some() && record.running().id == a);
    assert!(record.to_judge().is_some(), "what it is judged by is kept with it");
}

#[test]
fn rows_say_what_was_saved() {
    let what = |files: &[&str]| edit(Kind::Shaders, files, Verdict::new(State::None, "")).what();
    assert_eq!(what(&["shaders/lib/rng.wgsl"]), "rng.wgsl");
    assert_eq!(what(&["C:\\own\\rng.wgsl", "b.wgsl", "c.wgsl"]), "rng.wgsl and 2 more");
    assert_eq!(what(&[]), "everything, read again");
}
