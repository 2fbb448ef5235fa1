//! Where each byte of a joined text came from.

use std::ops::Range;
use std::sync::Arc;

use super::error::{ErrorKind, ShaderError, Source};
use super::generated::FILE;
use super::token::{self, TokenKind};

/// Where the bytes of a joined text came from.
#[derive(Debug, Default)]
pub struct SourceMap {
    /// In order of `start`.
    pieces: Vec<Piece>,
}

#[derive(Debug)]
struct Piece {
    /// Bytes of the joined text.
    range: Range<usize>,
    source: Arc<Source>,
    /// Where the piece starts in the source.
    offset: usize,
    /// Bytes of the source that something else stands for; none where the piece is the source's own text.
    replaced: Option<usize>,
}

impl Piece {
    /// The byte of the source behind one of the joined text: of what is replaced, its start or its end.
    fn origin(&self, at: usize, is_end: bool) -> usize {
        match self.replaced {
            Some(length) => self.offset + if is_end { length } else { 0 },
            None => at.clamp(self.range.start, self.range.end) - self.range.start + self.offset,
        }
    }
}

impl SourceMap {
    /// Appends a piece of a source, which begins there at `offset`.
    pub fn append(&mut self, text: &mut String, piece: &str, source: &Arc<Source>, offset: usize) {
        self.push(text, piece, source, offset, None);
        text.push('\n');
    }

    /// Appends a module's text, with something else in the place of some of its names, which come in order.
    pub fn append_replaced<'r>(
        &mut self,
        text: &mut String,
        module: &str,
        source: &Arc<Source>,
        replaced: impl Iterator<Item = (&'r Range<usize>, String)>,
    ) {
        let mut at = 0;
        for (range, by) in replaced {
            self.push(text, &module[at..range.start], source, at, None);
            self.push(text, &by, source, range.start, Some(range.len()));
            at = range.end;
        }
        self.append(text, &module[at..], source, at);
    }

    fn push(&mut self, text: &mut String, piece: &str, source: &Arc<Source>, offset: usize, replaced: Option<usize>) {
        let start = text.len();
        text.push_str(piece);
        self.pieces.push(Piece { range: start..text.len(), source: source.clone(), offset, replaced });
    }

    fn piece(&self, at: usize) -> &Piece {
        let index = self.pieces.partition_point(|piece| piece.range.start <= at).saturating_sub(1);
        &self.pieces[index]
    }

    /// The source and its range behind a range of the joined text, cut at the last character of the source that is seen.
    pub fn origin(&self, range: Range<usize>) -> (&Arc<Source>, Range<usize>) {
        let piece = self.piece(range.start);
        let end = self.piece(range.end.saturating_sub(1).max(range.start));
        let end = if Arc::ptr_eq(&end.source, &piece.source) { end } else { piece };
        let last = piece.source.text.trim_end().char_indices().next_back().map_or(0, |(at, _)| at);
        let start = piece.origin(range.start, false).min(last);
        (&piece.source, start..end.origin(range.end, true).max(start))
    }

    /// Whether a range of the joined text is in the module that is made from Rust.
    pub fn is_generated(&self, range: &Range<usize>) -> bool {
        self.piece(range.start).source.file == FILE
    }

    /// The first declaration of the module that was asked for: the place of what has no better one.
    pub fn first_declaration(&self) -> Range<usize> {
        let source = &self.pieces.last().expect("invariant: there is a piece for each module").source;
        let text = &source.text;
        let tokens = token::tokenize(source).unwrap_or_default();
        let is_word = |range: &Range<usize>| {
            matches!(&text[range.clone()], "fn" | "struct" | "const" | "var" | "alias" | "override" | "const_assert")
        };
        let words = tokens.into_iter().filter(|token| token.kind == TokenKind::Word);
        let at = words.map(|token| token.range).find(is_word).unwrap_or(0..0);
        let of_source = self.pieces.iter().rev().take_while(|piece| Arc::ptr_eq(&piece.source, source));
        let piece = of_source.filter(|piece| piece.offset <= at.start).max_by_key(|piece| piece.offset);
        let start = piece.map_or(0, |piece| piece.range.start + (at.start - piece.offset).min(piece.range.len()));
        start..start + at.len()
    }

    /// An error at a range of the joined text.
    pub fn error(&self, kind: ErrorKind, range: Range<usize>, message: impl Into<String>) -> ShaderError {
        let (source, range) = self.origin(range);
        ShaderError::at(kind, source, range, message)
    }
}
