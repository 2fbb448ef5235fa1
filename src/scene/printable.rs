//! Names and words of files, as they may be shown on a terminal.

/// The text without what a terminal would obey; lines stay lines.
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}

/// A name, in one line.
pub fn printable_name(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
