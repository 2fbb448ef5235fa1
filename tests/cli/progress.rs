//! Progress fits into a terminal of 80 columns.

use lucerna::app::shared::progress::{bar_line, fitted};

#[test]
fn a_line_with_a_bar_is_short_however_long_its_parts_are() {
    let message = "1234567 spp, error 1.2e-3, 12:33:44 left";
    for name in
        ["a", "cornell-box", "a scene with a name that nobody would give to a scene", "œuvre ßß ー ー ー ー ー ー"]
    {
        for done in [0.0, 0.05, 0.5, 0.999, 1.0, f64::NAN] {
            let line = bar_line(name, done, message);
            assert!(line.chars().count() <= 79, "{line}");
        }
    }
    assert_eq!(bar_line("box", 0.5, "8 spp"), "box [========>       ]  50 %  8 spp");
    assert_eq!(bar_line("box", 1.0, "8 spp"), "box [================] 100 %  8 spp");
    // What a render says is whole beside a usual name.
    assert!(bar_line("cornell-box", 0.5, "1234 spp, error 1.2e-3, 12:33 left").ends_with("12:33 left"));
    assert_eq!(fitted(&"x".repeat(200)).chars().count(), 79);
}

/// As a terminal has it: what is drawn over and over has no line that would wrap.
#[test]
#[cfg(target_os = "linux")]
fn on_a_terminal_no_line_is_wider() {
    let folder = super::folder_with("", b"");
    let command = format!("stty cols 80; {} render a.ron --time 1 -o a.json", env!("CARGO_BIN_EXE_lucerna"));
    let run =
        std::process::Command::new("script").args(["-qec", &command, "/dev/null"]).current_dir(folder.path()).output();
    let Ok(run) = run else { return };
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success() && text.contains(" spp"), "{text}");
    // Colours and moves of the cursor take no room.
    let mut plain = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once('\u{1b}') {
        plain += before;
        rest = after.trim_start_matches('[').trim_start_matches(|c: char| c.is_ascii_digit() || ";?".contains(c));
        rest = rest.get(1..).unwrap_or_default();
    }
    plain += rest;
    let bars: Vec<&str> =
        plain.split(['\n', '\r']).filter(|line| line.contains(" [=") || line.contains(" [>")).collect();
    assert!(!bars.is_empty(), "{text:?}");
    assert!(bars.iter().all(|line| line.trim_end().chars().count() < 80), "{bars:?}");
}
