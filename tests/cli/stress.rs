//! `lucerna stress`: its list, its table, and what it ends with.

use std::path::Path;

use lucerna::stress::rows::ALL;
use serde_json::Value;

use super::{lucerna, refused};

fn out(run: &std::process::Output) -> String {
    String::from_utf8(run.stdout.clone()).unwrap()
}

#[test]
fn rows_are_listed_and_chosen_by_name() {
    let list = out(&lucerna(Path::new("."), &["stress", "--list"]));
    assert!(ALL.iter().all(|row| list.contains(row.holds) && list.contains(row.quantity)), "{list}");
    let said = refused(2, Path::new("."), &["stress", "--only", "edge", "--only", "hedge"]);
    assert!(said.contains("`hedge`") && said.contains("edges, slivers"), "{said}");
}

#[test]
fn a_row_is_told_as_text_and_as_json() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("stress.json");
    let run = lucerna(Path::new("."), &["stress", "--only", "bad-samples", "-o", file.to_str().unwrap()]);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let text = out(&run);
    assert!(text.contains("bad-samples") && text.contains("holds") && text.contains("1 hold, 0 fail"), "{text}");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let row = &json["rows"][0];
    assert_eq!((&json["holds"], &row["verdict"], &row["measured"]), (&true.into(), &"holds".into(), &0.0.into()));
    assert!(row["samples"].as_u64().unwrap() > 1000 && row["below_at_95_percent"].as_f64().unwrap() < 1e-3, "{json}");
}

#[test]
fn random_edits_begin_with_the_seed_that_is_given() {
    let flags = ["stress", "--only", "random-edits", "--seed", "17", "--time", "0.1", "--json", "--quiet"];
    let run = lucerna(Path::new("."), &flags);
    assert_eq!(run.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.stderr));
    let json: Value = serde_json::from_str(&out(&run)).unwrap();
    let row = &json["rows"][0];
    assert!(row["note"].as_str().unwrap().contains("1 seeds from --seed 17"), "{json}");
    assert!(row["samples"].as_u64().unwrap() >= 24 && run.stderr.is_empty(), "{json}");
}

#[test]
fn shaders_that_are_wrong_fail() {
    let folder = tempfile::tempdir().unwrap();
    for name in lucerna::shader::Library::embedded().modules() {
        let file = folder.path().join(format!("{name}.wgsl"));
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        let text = lucerna::shader::Library::embedded().text(name).unwrap().to_owned();
        let wrong = text.replace("select(material.emission,", "select(0.99 * material.emission,");
        std::fs::write(file, wrong).unwrap();
    }
    let shaders = folder.path().to_str().unwrap();
    let run = lucerna(Path::new("."), &["stress", "--only", "furnace", "--json", "--shaders", shaders]);
    assert_eq!(run.status.code(), Some(7), "{}", String::from_utf8_lossy(&run.stderr));
    let json: Value = serde_json::from_str(&out(&run)).unwrap();
    let row = &json["rows"][0];
    assert_eq!((&json["holds"], &row["verdict"]), (&false.into(), &"FAILS".into()));
    assert!(
        (row["measured"].as_f64().unwrap() - 0.01).abs() < 1e-4 && row["margin"].as_f64().unwrap() < 0.01,
        "{json}"
    );
}
