//! Help: short with a flag, long by `help`, and topics.

use std::path::Path;

use super::{lucerna, refused};

fn printed(arguments: &[&str]) -> String {
    let run = lucerna(Path::new("."), arguments);
    assert_eq!(run.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn a_flag_prints_a_line_for_each_argument() {
    for command in [
        "render", "view", "watch", "variants", "animate", "judge", "edits", "check", "new", "compare", "bench",
        "stress",
    ] {
        let (short, long) = (printed(&[command, "--help"]), printed(&["help", command]));
        assert_eq!(short, printed(&[command, "-h"]), "{command}");
        assert!(short.lines().count() <= long.lines().count(), "{command}");
        assert!(short.contains("help exit-codes") && !short.contains("130"), "{command}: {short}");
    }
    let short = printed(&["render", "--help"]);
    assert!(short.lines().count() < 50, "{short}");
    assert!(printed(&["help", "render"]).contains("Evenly spread points"), "what values mean is in the long help");
    assert!(printed(&["help", "bench", "sort"]).contains("--runs"));
}

#[test]
fn topics_are_printed() {
    let codes = printed(&["help", "exit-codes"]);
    assert!(codes.contains("Exit codes") && codes.contains("130  interrupted"), "{codes}");
    assert!(printed(&["help", "paths"]).contains("models[0].transform.scale=2"));
    let keys = printed(&["help", "keys"]);
    assert!(keys.contains("F11") && printed(&["view", "--help"]).contains(keys.trim_end()), "{keys}");
    let said = refused(2, Path::new("."), &["help", "rendr"]);
    assert!(said.contains("`rendr`") && said.contains("render") && said.contains("exit-codes"), "{said}");
}
