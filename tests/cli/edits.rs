//! `lucerna edits`: the record that windows keep on the disk, listed and written out.

use std::path::Path;

use lucerna::app::edits::{Edit, EditsFolder, Kept, Kind, Lint, MOST, PLACE, State, Verdict};
use lucerna::shader::Library;
use serde_json::Value;

use super::{lucerna, refused};

fn edit(kind: Kind, file: &str, verdict: Verdict) -> Edit {
    let files = if file.is_empty() { Vec::new() } else { vec![format!("shaders/lib/{file}")] };
    Edit { kind, scene: "cornell-box".into(), files, saved: 1000, pixels: Some(0.25), lint: Lint::Clean, verdict }
}

fn verdict(state: State, short: &str) -> Verdict {
    Verdict { state, short: short.to_owned(), line: format!("judged: {short}, in many words") }
}

/// Keeps an edit whose shaders differ by a comment.
fn keep(folder: &EditsFolder, edit: Edit, before: Option<u32>, text: Option<&str>) -> u32 {
    let library = text.map(|text| Library::embedded().with("lib/own", &format!("// {text}\n")));
    let shaders = library.map(|library| folder.keep_texts(&library).unwrap());
    let mut kept = Kept { number: 0, window: "1-1".to_owned(), before, shaders, edit };
    folder.add(&mut kept).unwrap();
    kept.number
}

/// The opening, an edit, and a failed one.
fn filled(folder: &Path) -> EditsFolder {
    let edits = EditsFolder::new(folder.join(PLACE));
    let first = keep(&edits, edit(Kind::Opened, "", Verdict::new(State::None, "")), None, Some("first"));
    let right = verdict(State::Agree, "agrees within 0.5 %, 1.80x more efficient");
    assert_eq!(keep(&edits, edit(Kind::Shaders, "rng.wgsl", right), Some(first), Some("second")), 2);
    let wrong = Verdict::new(State::Failed, "failed: shaders/lib/rng.wgsl:1:2: no");
    keep(&edits, edit(Kind::Shaders, "rng.wgsl", wrong), None, None);
    edits
}

fn printed(folder: &Path, arguments: &[&str]) -> String {
    let run = lucerna(folder, arguments);
    assert_eq!(run.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn edits_are_listed_newest_first() {
    let folder = tempfile::tempdir().unwrap();
    assert!(printed(folder.path(), &["edits"]).contains("no edits in result/edits"));
    assert_eq!(printed(folder.path(), &["edits", "--json"]), "[]\n");
    let edits = filled(folder.path());
    let list = printed(folder.path(), &["edits"]);
    let list =
        list.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ") + "\n").collect::<String>();
    let lines: Vec<&str> = list.lines().collect();
    assert!(lines[0].starts_with("edit") && lines[0].ends_with("verdict") && lines.len() == 4, "{list}");
    assert!(lines[1].starts_with("3 ") && lines[1].ends_with("failed: shaders/lib/rng.wgsl:1:2: no"), "{list}");
    assert!(lines[2].contains("rng.wgsl 250 ms nothing found 1 agrees within 0.5 %, 1.80x more efficient"), "{list}");
    assert!(lines[3].contains("as the window opened"), "{list}");

    let json: Vec<Value> = serde_json::from_str(&printed(folder.path(), &["edits", "--json"])).unwrap();
    assert_eq!(json.len(), 3);
    assert_eq!(
        (&json[1]["number"], &json[1]["before"], &json[1]["verdict"]["state"]),
        (&2.into(), &1.into(), &"agree".into())
    );
    assert_eq!((&json[0]["has_shaders"], &json[0]["pixels"]), (&false.into(), &0.25.into()));

    // What was known last, and what can't be read is told and left out.
    let mut kept = edits.list().unwrap().edits.remove(1);
    kept.edit.verdict = verdict(State::Judging, "judging: 4 films");
    edits.update(&kept).unwrap();
    std::fs::write(folder.path().join(PLACE).join("4.json"), "{").unwrap();
    let run = lucerna(folder.path(), &["edits"]);
    assert!(String::from_utf8_lossy(&run.stdout).contains("not judged yet"));
    assert!(String::from_utf8_lossy(&run.stderr).contains("4.json"), "{}", String::from_utf8_lossy(&run.stderr));
}

#[test]
fn the_shaders_of_an_edit_are_written_out() {
    let folder = tempfile::tempdir().unwrap();
    let edits = filled(folder.path());
    let said = printed(folder.path(), &["edits", "2", "--output", "second"]);
    let judged = "lucerna judge cornell-box --old second-before --new second";
    assert!(said.contains("lucerna edits 1 --output second-before") && said.contains(judged), "{said}");
    let written = Library::open(&folder.path().join("second")).unwrap();
    assert!(written.is_same(&Library::embedded().with("lib/own", "// second\n")));
    assert!(
        printed(folder.path(), &["edits", "2"])
            .contains("judged: agrees within 0.5 %, 1.80x more efficient, in many words")
    );

    // Nothing is written over but by force, and what has no shaders is not written.
    assert!(refused(2, folder.path(), &["edits", "1", "--output", "second"]).contains("--force"));
    printed(folder.path(), &["edits", "1", "--output", "second", "--force"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("second/lib/own.wgsl")).unwrap(), "// first\n");
    assert!(refused(2, folder.path(), &["edits", "3", "--output", "third"]).contains("edit 3 has no shaders"));
    assert!(refused(2, folder.path(), &["edits", "9"]).contains("there are 1 to 3"));

    // A text that was tampered with is not what ran.
    let listed = edits.list().unwrap();
    let name = &listed.edits[1].shaders.as_ref().unwrap()["lib/own"];
    std::fs::write(folder.path().join(PLACE).join(format!("texts/{name}.wgsl")), "// other\n").unwrap();
    assert!(refused(1, folder.path(), &["edits", "2", "-o", "again"]).contains("is not what was written"));
    assert!(!folder.path().join("again").exists(), "all or nothing");
}

/// A record may come from anywhere.
#[test]
fn what_a_record_names_stays_within_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let edits = filled(folder.path());
    let kept = edits.list().unwrap().edits.remove(1);
    let shaders = kept.shaders.clone().unwrap();
    let elsewhere = folder.path().join("above").display().to_string().replace('\\', "/");
    for module in ["../above", "lib/../../above", &elsewhere, "", "lib/", "lib/v1.2"] {
        let named = shaders.values().next().map(|text| (module.to_owned(), text.clone()));
        edits.update(&Kept { shaders: Some(named.into_iter().collect()), ..kept.clone() }).unwrap();
        let said = refused(1, folder.path(), &["edits", "2", "-o", "below/out"]);
        assert!(said.contains(&format!("`{module}` is no name of a shader")), "{said}");
        assert!(!folder.path().join("below").exists() && !folder.path().join("above.wgsl").exists(), "{module}");
    }
    std::fs::write(folder.path().join("secret.wgsl"), "").unwrap();
    let text = "../../../secret".to_owned();
    edits.update(&Kept { shaders: Some([("lib/own".to_owned(), text)].into()), ..kept }).unwrap();
    assert!(refused(1, folder.path(), &["edits", "2", "-o", "out"]).contains("is no name of a text"));
}

/// What is named otherwise than this folder names its files is not its own, and no number is beyond the last.
#[test]
fn other_names_are_no_edits() {
    let folder = tempfile::tempdir().unwrap();
    let edits = filled(folder.path());
    for name in ["+7.json", "007.json", "7.JSON", "7.json.json"] {
        std::fs::copy(edits.path().join("1.json"), edits.path().join(name)).unwrap();
    }
    let listed = edits.list().unwrap();
    assert!(listed.unread.is_empty() && listed.edits.len() == 3, "{:?}", listed.unread);
    std::fs::copy(edits.path().join("1.json"), edits.path().join(format!("{}.json", u32::MAX))).unwrap();
    let mut kept = listed.edits[0].clone();
    assert!(edits.add(&mut kept).unwrap_err().to_string().contains("no more numbers"));
    assert!(!edits.path().join("0.json").exists());
}

#[test]
fn the_oldest_edits_go_and_numbers_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let edits = EditsFolder::new(folder.path());
    for n in 0..MOST + 3 {
        keep(&edits, edit(Kind::Scene, "a.ron", Verdict::new(State::None, "")), None, (n == 0).then_some("old"));
    }
    let listed = edits.list().unwrap();
    assert!(listed.unread.is_empty());
    assert_eq!((listed.edits.len(), listed.edits[0].number), (MOST, 4));
    // Texts may be of an edit that another window is about to write.
    assert!(std::fs::read_dir(folder.path().join("texts")).unwrap().count() > 1);
}

#[test]
fn what_a_terminal_would_obey_is_not_printed() {
    let folder = tempfile::tempdir().unwrap();
    let edits = EditsFolder::new(folder.path().join(PLACE));
    let hostile = verdict(State::Differ, "\u{1b}[2J wrong\u{7}");
    keep(&edits, edit(Kind::Shaders, "r\u{1b}ng.wgsl", hostile), None, None);
    for arguments in [&["edits"][..], &["edits", "1"], &["edits", "--json"]] {
        let text = printed(folder.path(), arguments);
        assert!(text.contains("wrong") && !text.contains(['\u{1b}', '\u{7}']), "{text:?}");
    }
}
