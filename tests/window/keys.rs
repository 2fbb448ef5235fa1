//! The table of keys is what docs/window.md lists, and what the command prints.

use lucerna::app::window::keys::{KEYS, listed};

#[test]
fn the_page_on_the_window_lists_every_key() {
    let page = std::fs::read_to_string("docs/window.md").unwrap();
    let printed = listed();
    for (key, meaning) in KEYS {
        let row = format!("| {key} | {meaning} |");
        assert!(page.contains(&row), "docs/window.md lacks the row:\n{row}");
        assert!(printed.lines().any(|line| line.contains(key) && line.ends_with(meaning)), "{printed}");
    }
    assert_eq!(page.matches("\n| F").count(), KEYS.iter().filter(|(key, _)| key.starts_with('F')).count());
}
