//! Every row of the pass table, edited: all that it makes is made again.

use lucerna::passes::table::TABLE;
use lucerna::passes::{Makes, Pass};

use super::Bench;

/// Not run for a small scene whose film is shown.
const UNUSED: [&str; 9] =
    ["sort scan", "treelet tops", "view", "debug", "probe", "probe colours", "gather", "blocks", "tally"];

/// The pass that finishes what is made.
fn last_of(purpose: Makes) -> &'static str {
    match purpose {
        Makes::Tree => "treelets",
        Makes::Film => "path",
        Makes::Picture => "display",
    }
}

/// What a reload reports where all that the passes of the edited module make starts anew.
fn expected(pass: &Pass) -> &'static str {
    let used = TABLE.iter().find(|other| other.module == pass.module && !UNUSED.contains(&other.name));
    match used.map_or(&[][..], |used| used.makes) {
        [] => "nothing",
        [Makes::Tree] => "tree",
        [Makes::Film] => "film",
        [Makes::Picture] => "picture",
        [Makes::Tree, Makes::Film] => "tree and film",
        other => panic!("{other:?}: say here how a reload reports it"),
    }
}

/// The module's text with an entry point that does nothing.
fn without_work(text: &str, entry: &str) -> String {
    let signature = text.find(&format!("fn {entry}(")).unwrap();
    let body = signature + text[signature..].find('{').unwrap() + 1;
    format!("{}\n    if true {{ return; }}{}", &text[..body], &text[body..])
}

#[test]
fn an_edit_of_any_pass_makes_again_all_that_it_makes() {
    let mut bench = Bench::new();
    for pass in TABLE {
        let file = format!("shaders/{}.wgsl", pass.module);
        let text = bench.read(&file);
        let mut restarts = String::new();
        let ran = bench.dispatches(|bench| {
            bench.write(&file, &without_work(&text, pass.entry));
            restarts = bench.reloaded();
        });
        assert_eq!(restarts, expected(pass), "{}", pass.name);
        if !UNUSED.contains(&pass.name) && restarts != "nothing" {
            assert!(ran.contains_key(pass.name), "{} did not run: {ran:?}", pass.name);
            for purpose in pass.makes {
                assert!(ran.contains_key(last_of(*purpose)), "{}: no {purpose:?} was made: {ran:?}", pass.name);
            }
        }
        bench.write(&file, &text);
        assert_eq!(bench.reloaded(), expected(pass), "{}, put back", pass.name);
        bench.finish();
    }
}
