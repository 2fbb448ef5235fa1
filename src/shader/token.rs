//! Splits WGSL into tokens, as far as the linker needs: identifiers, numbers, texts in quotes, and single characters.

use std::ops::Range;
use std::sync::Arc;

use super::error::{ErrorKind, Place, ShaderError, Source};

/// A token.
#[derive(Clone, Debug)]
pub struct Token {
    pub kind: TokenKind,
    /// Bytes of the source.
    pub range: Range<usize>,
}

/// The kind of a [`Token`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// An identifier or keyword.
    Word,
    Number,
    /// What stands in quotes, with them, on one line: no WGSL, but what the linker takes as a name.
    Text,
    /// One character of punctuation: `->` is two tokens.
    Sign,
}

/// The tokens of a source, comments left out.
pub fn tokenize(source: &Arc<Source>) -> Result<Vec<Token>, ShaderError> {
    let text = source.text.as_str();
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        if rest.starts_with("//") {
            at += rest.find('\n').unwrap_or(rest.len());
        } else if rest.starts_with("/*") {
            at += comment_length(rest)
                .ok_or_else(|| ShaderError::at(ErrorKind::Syntax, source, at..at + 2, "this comment has no end"))?;
        } else if c.is_whitespace() {
            at += c.len_utf8();
        } else {
            let (kind, length) = if c.is_ascii_digit() {
                (TokenKind::Number, span(rest, |c| c.is_alphanumeric() || c == '.'))
            } else if c.is_alphabetic() || c == '_' {
                (TokenKind::Word, span(rest, |c| c.is_alphanumeric() || c == '_'))
            } else if let Some(length) = text_length(rest) {
                (TokenKind::Text, length)
            } else {
                (TokenKind::Sign, c.len_utf8())
            };
            tokens.push(Token { kind, range: at..at + length });
            at += length;
        }
    }
    Ok(tokens)
}

/// Refuses brackets that do not match: in a joined text the error would show up in another module.
pub fn check_brackets(source: &Arc<Source>, tokens: &[Token]) -> Result<(), ShaderError> {
    let error =
        |range: &Range<usize>, message: String| ShaderError::at(ErrorKind::Syntax, source, range.clone(), message);
    let mut open: Vec<(&str, &Range<usize>)> = Vec::new();
    for Token { range, .. } in tokens {
        let closing = &source.text[range.clone()];
        let opening = match closing {
            "(" | "[" | "{" => {
                open.push((closing, range));
                continue;
            }
            ")" => "(",
            "]" => "[",
            "}" => "{",
            _ => continue,
        };
        match open.pop() {
            Some((found, _)) if found == opening => {}
            Some((found, start)) => {
                let line = Place::new(source.clone(), start.clone()).line;
                return Err(error(range, format!("this `{closing}` does not close the `{found}` of line {line}")));
            }
            None => return Err(error(range, format!("this `{closing}` closes nothing"))),
        }
    }
    open.pop().map_or(Ok(()), |(sign, range)| Err(error(range, format!("this `{sign}` is never closed"))))
}

/// The bytes at the start of a text whose characters pass the test.
fn span(text: &str, test: impl Fn(char) -> bool) -> usize {
    text.find(|c| !test(c)).unwrap_or(text.len())
}

/// The length of the text in quotes that starts a text; none where the line has no second quote.
fn text_length(text: &str) -> Option<usize> {
    let inside = text.strip_prefix('"')?;
    let end = inside.find(['"', '\n', '\r'])?;
    inside[end..].starts_with('"').then_some(end + 2)
}

/// The length of the block comment that starts a text; they nest.
fn comment_length(text: &str) -> Option<usize> {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        if text.as_bytes()[at..].starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if text.as_bytes()[at..].starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return Some(at);
            }
        } else {
            at += 1;
        }
    }
    None
}
