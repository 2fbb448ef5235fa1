//! The table of keys is what the README lists.

use lucerna::app::window::keys::KEYS;

#[test]
fn the_readme_lists_every_key() {
    let readme = std::fs::read_to_string("README.md").unwrap();
    for (key, meaning) in KEYS {
        let row = format!("| {key} | {meaning} |");
        assert!(readme.contains(&row), "README.md lacks the row:\n{row}");
    }
    assert_eq!(readme.matches("\n| F").count(), KEYS.iter().filter(|(key, _)| key.starts_with('F')).count());
}
