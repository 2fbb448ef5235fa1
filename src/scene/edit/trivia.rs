//! What stands between values and means nothing: white space and comments; and commas.

/// A part of a text without values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<'t> {
    Space(&'t str),
    /// `// ..` without the end of its line, or `/* .. */`, in which others may be.
    Comment(&'t str),
    Comma,
}

/// The pieces from a text's start to the first that is none of them.
pub fn pieces(text: &str) -> impl Iterator<Item = Piece<'_>> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let (piece, length) = first(rest)?;
        rest = &rest[length..];
        Some(piece)
    })
}

impl Piece<'_> {
    /// Its length in bytes.
    pub fn len(&self) -> usize {
        match self {
            Self::Space(text) | Self::Comment(text) => text.len(),
            Self::Comma => 1,
        }
    }
}

fn first(text: &str) -> Option<(Piece<'_>, usize)> {
    let spaces = text.find(|c: char| !c.is_whitespace()).unwrap_or(text.len());
    if spaces > 0 {
        return Some((Piece::Space(&text[..spaces]), spaces));
    }
    if text.starts_with(',') {
        return Some((Piece::Comma, 1));
    }
    let length = comment(text)?;
    Some((Piece::Comment(&text[..length]), length))
}

/// The length of the comment that a text begins with.
fn comment(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        let line = text.split('\n').next().unwrap_or_default();
        return Some(line.strip_suffix('\r').unwrap_or(line).len());
    }
    if !text.starts_with("/*") {
        return None;
    }
    let (mut depth, mut at) = (0, 0);
    while at < text.len() {
        match &text.as_bytes()[at..] {
            [b'/', b'*', ..] => (depth, at) = (depth + 1, at + 2),
            [b'*', b'/', ..] if depth == 1 => return Some(at + 2),
            [b'*', b'/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
    }
    Some(text.len())
}

/// The comments within a value that gives way to another, as what may stand behind that.
pub fn comments_within(value: &str) -> String {
    let mut found = String::new();
    let mut rest = value;
    while let Some(c) = rest.chars().next() {
        let length = match comment(rest) {
            Some(length) => {
                let text = &rest[..length];
                match text.strip_prefix("//") {
                    // Within the other kind, signs of comments would count.
                    Some(line) => {
                        let line = line.trim_end().replace("*/", "* /").replace("/*", "/ *");
                        found += &format!(" /*{line} */");
                    }
                    None => found += &format!(" {text}"),
                }
                length
            }
            None => literal(rest).unwrap_or(c.len_utf8()),
        };
        rest = &rest[length..];
    }
    found
}

/// The length of the string that a text begins with, raw ones too.
fn literal(text: &str) -> Option<usize> {
    let hashes = text.strip_prefix('r').map(|rest| rest.len() - rest.trim_start_matches('#').len());
    if let Some(hashes) = hashes.filter(|hashes| text[1 + hashes..].starts_with('"')) {
        let close = format!("\"{}", "#".repeat(hashes));
        let start = hashes + 2;
        return Some(text[start..].find(&close).map_or(text.len(), |at| start + at + close.len()));
    }
    let quoted = text.strip_prefix('"')?;
    let mut escaped = false;
    for (at, c) in quoted.char_indices() {
        match c {
            '"' if !escaped => return Some(at + 2),
            _ => escaped = c == '\\' && !escaped,
        }
    }
    Some(text.len())
}
