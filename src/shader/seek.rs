//! Where naga's front end refuses something, when it does not say: found by giving it less and less of the text.

use std::ops::Range;
use std::sync::Arc;

use super::conditional::blanked;
use super::error::Source;
use super::message;
use super::token::{self, Token};

/// The range in a joined text of what naga refuses with `message`, an error without a place; None where it is in no function.
pub fn place(text: &str, message: &str) -> Option<Range<usize>> {
    let source = Arc::new(Source { file: String::new(), text: text.to_owned() });
    let seeker = Seeker { text, message, tokens: token::tokenize(&source).ok()? };
    let bodies = seeker.bodies();
    if seeker.is_refused(&seeker.without(&bodies)) {
        return None;
    }
    let mut kept = bodies.as_slice();
    while kept.len() > 1 {
        let (left, right) = kept.split_at(kept.len() / 2);
        let others: Vec<_> = bodies.iter().filter(|body| !left.contains(body)).cloned().collect();
        kept = if seeker.is_refused(&seeker.without(&others)) { left } else { right };
    }
    let body = kept.first()?;
    let others: Vec<_> = bodies.iter().filter(|other| *other != body).cloned().collect();
    let alone = seeker.without(&others);
    let statement = seeker.statement(&alone, body)?;
    Some(seeker.index(&statement).unwrap_or_else(|| seeker.bytes(&statement)))
}

struct Seeker<'a> {
    text: &'a str,
    message: &'a str,
    tokens: Vec<Token>,
}

impl Seeker<'_> {
    fn token(&self, i: usize) -> &str {
        self.tokens.get(i).map_or("", |token| &self.text[token.range.clone()])
    }

    fn bytes(&self, tokens: &Range<usize>) -> Range<usize> {
        self.tokens[tokens.start].range.start..self.tokens[tokens.end - 1].range.end
    }

    /// The tokens between the braces of every function.
    fn bodies(&self) -> Vec<Range<usize>> {
        let (mut bodies, mut depth, mut function, mut start) = (Vec::new(), 0, false, 0);
        for i in 0..self.tokens.len() {
            match self.token(i) {
                "fn" if depth == 0 => function = true,
                "{" => {
                    depth += 1;
                    if depth == 1 {
                        start = i + 1;
                    }
                }
                "}" => {
                    depth -= 1;
                    if depth == 0 && std::mem::take(&mut function) && i > start {
                        bodies.push(start..i);
                    }
                }
                _ => {}
            }
        }
        bodies
    }

    /// The text without some functions' bodies, of the same length.
    fn without(&self, bodies: &[Range<usize>]) -> String {
        blanked(self.text, &bodies.iter().map(|body| self.bytes(body)).collect::<Vec<_>>())
    }

    /// Whether naga says the same of another text.
    fn is_refused(&self, text: &str) -> bool {
        let error = naga::front::wgsl::parse_str(text).err();
        error.is_some_and(|error| message::without_handles(error.message()) == self.message)
    }

    /// The statement, or the head of a block, with which the error comes into a body: naga reads from top to bottom.
    fn statement(&self, text: &str, body: &Range<usize>) -> Option<Range<usize>> {
        let mut ends = Vec::new();
        let (mut round, mut braces) = (0, 0usize);
        for i in body.clone() {
            match self.token(i) {
                "(" | "[" => round += 1,
                ")" | "]" => round -= 1,
                "{" => braces += 1,
                "}" => braces = braces.saturating_sub(1),
                _ => {}
            }
            if round == 0 && matches!(self.token(i), ";" | "{" | "}") {
                ends.push((i, braces));
            }
        }
        let whole = self.tokens[body.end].range.start;
        let refused = |&(end, braces): &(usize, usize)| {
            let head = &text[..self.tokens[end].range.end];
            self.is_refused(&format!("{head}{}{}", "}".repeat(braces), &text[whole..]))
        };
        let first = ends.partition_point(|end| !refused(end));
        let start = if first == 0 { body.start } else { ends[first - 1].0 + 1 };
        ends.get(first).filter(|(end, _)| start < *end).map(|(end, _)| start..*end)
    }

    /// The brackets around the index that the message names.
    fn index(&self, statement: &Range<usize>) -> Option<Range<usize>> {
        let index = self.message.strip_prefix("Index ")?.split(' ').next()?;
        let is_it = |&i: &usize| {
            let digits = self.token(i + 1).trim_end_matches(['u', 'i']);
            self.token(i) == "[" && digits == index && self.token(i + 2) == "]"
        };
        let open = statement.clone().find(is_it)?;
        Some(self.bytes(&(open..open + 3)))
    }
}
