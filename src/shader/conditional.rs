//! `@if(feature)`, `@elif(feature)` and `@else` before declarations, statements, struct members and parameters.
//!
//! Nothing moves: attributes and what is switched off become spaces, so that every place keeps its line and column.

use std::ops::Range;
use std::sync::Arc;

use super::error::{ErrorKind, ShaderError, Source};
use super::token::{Token, TokenKind};
use super::{Features, token};

/// A module with its conditions decided.
pub struct Resolved {
    /// As long as the source, line by line.
    pub text: String,
    /// The tokens that are left.
    pub tokens: Vec<Token>,
    /// Every feature that any condition names, decided branches or not.
    pub named: Features,
}

/// Decides the conditions of a source.
pub fn resolve(source: &Arc<Source>, features: &Features) -> Result<Resolved, ShaderError> {
    let tokens = token::tokenize(source)?;
    token::check_brackets(source, &tokens)?;
    let mut resolver = Resolver {
        source,
        features,
        tokens: &tokens,
        blank: Vec::new(),
        live: Vec::new(),
        named: Features::new(),
        nesting: 0,
    };
    resolver.walk(0..tokens.len(), false, true)?;
    let Resolver { blank, live, named, .. } = resolver;
    Ok(Resolved { text: blanked(&source.text, &blank), tokens: live, named })
}

/// The text with ranges of it turned to spaces, lines kept.
pub fn blanked(text: &str, ranges: &[Range<usize>]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for byte in ranges.iter().flat_map(|range| range.clone()) {
        if bytes[byte] != b'\n' && bytes[byte] != b'\r' {
            bytes[byte] = b' ';
        }
    }
    String::from_utf8(bytes).expect("invariant: ranges start and end at tokens, so whole characters turn to spaces")
}

struct Resolver<'a> {
    source: &'a Arc<Source>,
    features: &'a Features,
    tokens: &'a [Token],
    blank: Vec<Range<usize>>,
    live: Vec<Token>,
    named: Features,
    nesting: usize,
}

impl<'a> Resolver<'a> {
    fn text(&self, i: usize) -> &'a str {
        self.tokens.get(i).map_or("", |token| &self.source.text[token.range.clone()])
    }

    fn error(&self, i: usize, message: impl Into<String>) -> ShaderError {
        let end = self.source.text.len();
        let range = self.tokens.get(i).map_or(end..end, |token| token.range.clone());
        ShaderError::at(ErrorKind::Syntax, self.source, range, message)
    }

    /// Refuses to recurse as deep as a hostile file wants.
    fn enter(&mut self, i: usize) -> Result<(), ShaderError> {
        self.nesting += 1;
        if self.nesting > 64 { Err(self.error(i, "conditions are nested more than 64 deep")) } else { Ok(()) }
    }

    fn is_attribute(&self, i: usize, name: &str) -> bool {
        self.text(i) == "@" && self.text(i + 1) == name
    }

    /// Goes through tokens; those that are live are kept. In a list, commas end an item.
    fn walk(&mut self, range: Range<usize>, list: bool, live: bool) -> Result<(), ShaderError> {
        self.enter(range.start)?;
        let mut lists = vec![list];
        let mut i = range.start;
        while i < range.end {
            if self.is_attribute(i, "if") {
                i = self.chain(i, *lists.last().unwrap_or(&false), live)?;
                continue;
            }
            if self.is_attribute(i, "else") || self.is_attribute(i, "elif") {
                return Err(self.error(i, format!("this @{} follows no @if", self.text(i + 1))));
            }
            match self.text(i) {
                "(" | "[" => lists.push(true),
                "{" => lists.push(i >= 2 && self.text(i - 2) == "struct"),
                ")" | "]" | "}" => {
                    lists.pop();
                }
                _ => {}
            }
            if live {
                self.live.push(self.tokens[i].clone());
            }
            i += 1;
        }
        self.nesting -= 1;
        Ok(())
    }

    /// Decides an `@if` with what follows it, and returns the token behind.
    fn chain(&mut self, start: usize, list: bool, live: bool) -> Result<usize, ShaderError> {
        if start > 0 && !matches!(self.text(start - 1), ";" | "}" | "{" | "," | "(") {
            return Err(self.error(start, "an @if stands before the other attributes, one for each item: join with &&"));
        }
        let (mut i, mut taken) = (start, false);
        loop {
            let last = self.text(i + 1) == "else";
            let (condition, item) = if last { (true, i + 2) } else { self.condition(i + 2)? };
            self.blank.push(self.tokens[i].range.start..self.tokens[item - 1].range.end);
            let end = self.item_end(item, list)?;
            let keep = live && condition && !taken;
            self.walk(item..end, list, keep)?;
            if condition && !taken {
                taken = true;
            } else {
                self.blank.push(self.tokens[item].range.start..self.tokens[end - 1].range.end);
            }
            i = end;
            if last || !(self.is_attribute(i, "else") || self.is_attribute(i, "elif")) {
                return Ok(i);
            }
        }
    }

    /// The token behind the item that starts at a token.
    fn item_end(&self, start: usize, list: bool) -> Result<usize, ShaderError> {
        let import = self.text(start) == "import";
        let (mut depth, mut angles) = (0, 0);
        let mut i = start;
        while i < self.tokens.len() {
            match self.text(i) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" if depth == 0 => break,
                ")" | "]" => depth -= 1,
                "}" => {
                    depth -= 1;
                    if depth == 0 && !list && !import && self.text(i + 1) != "else" {
                        return Ok(i + 1);
                    }
                }
                "<" if depth == 0 => angles += 1,
                ">" if depth == 0 => angles -= 1,
                "," if list && depth == 0 && angles <= 0 => return Ok(i + 1),
                ";" if !list && depth == 0 => return Ok(i + 1),
                _ => {}
            }
            i += 1;
        }
        if list && i > start && i < self.tokens.len() {
            return Ok(i);
        }
        Err(self.error(i, "an @if or @else wants a declaration, statement, struct member or parameter behind it"))
    }

    /// The value of the condition in parentheses at a token, and the token behind them.
    fn condition(&mut self, open: usize) -> Result<(bool, usize), ShaderError> {
        self.expect(open, "(")?;
        let (value, close) = self.any_of(open + 1)?;
        self.expect(close, ")")?;
        Ok((value, close + 1))
    }

    fn expect(&self, i: usize, sign: &str) -> Result<(), ShaderError> {
        if self.text(i) == sign {
            return Ok(());
        }
        Err(self.error(i, format!("this condition wants `{sign}` here; it is made of features, !, &&, || and ()")))
    }

    fn any_of(&mut self, start: usize) -> Result<(bool, usize), ShaderError> {
        let (mut value, mut i) = self.all_of(start)?;
        while self.text(i) == "|" && self.text(i + 1) == "|" {
            let (right, end) = self.all_of(i + 2)?;
            value |= right;
            i = end;
        }
        Ok((value, i))
    }

    fn all_of(&mut self, start: usize) -> Result<(bool, usize), ShaderError> {
        let (mut value, mut i) = self.single(start)?;
        while self.text(i) == "&" && self.text(i + 1) == "&" {
            let (right, end) = self.single(i + 2)?;
            value &= right;
            i = end;
        }
        Ok((value, i))
    }

    fn single(&mut self, start: usize) -> Result<(bool, usize), ShaderError> {
        let negations = (start..).take_while(|&i| self.text(i) == "!").count();
        let i = start + negations;
        let flip = negations % 2 == 1;
        match self.text(i) {
            "(" => {
                self.enter(i)?;
                let (value, close) = self.any_of(i + 1)?;
                self.expect(close, ")")?;
                self.nesting -= 1;
                Ok((value != flip, close + 1))
            }
            "true" => Ok((!flip, i + 1)),
            "false" => Ok((flip, i + 1)),
            name if self.tokens.get(i).is_some_and(|token| token.kind == TokenKind::Word) => {
                self.named.insert(name.to_owned());
                Ok((self.features.contains(name) != flip, i + 1))
            }
            _ => Err(self.error(i, "a feature's name belongs here")),
        }
    }
}
