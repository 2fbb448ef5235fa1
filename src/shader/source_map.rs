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
}

impl SourceMap {
    /// Appends a piece of a source, which begins there at `offset`.
    pub fn append(&mut self, text: &mut String, piece: &str, source: &Arc<Source>, offset: usize) {
        let start = text.len();
        text.push_str(piece);
        self.pieces.push(Piece { range: start..text.len(), source: source.clone(), offset });
        text.push('\n');
    }

    fn piece(&self, at: usize) -> &Piece {
        let index = self.pieces.partition_point(|piece| piece.range.start <= at).saturating_sub(1);
        &self.pieces[index]
    }

    /// The source and its range behind a range of the joined text, cut at the last character of the source that is seen.
    pub fn origin(&self, range: Range<usize>) -> (&Arc<Source>, Range<usize>) {
        let piece = self.piece(range.start);
        let map = |at: usize| at.clamp(piece.range.start, piece.range.end) - piece.range.start + piece.offset;
        let last = piece.source.text.trim_end().char_indices().next_back().map_or(0, |(at, _)| at);
        let start = map(range.start).min(last);
        (&piece.source, start..map(range.end).max(start))
    }

    /// Whether a range of the joined text is in the module that is made from Rust.
    pub fn is_generated(&self, range: &Range<usize>) -> bool {
        self.piece(range.start).source.file == FILE
    }

    /// The first declaration of the module that was asked for: the place of what has no better one.
    pub fn first_declaration(&self) -> Range<usize> {
        let piece = self.pieces.last().expect("invariant: there is a piece for each module");
        let text = &piece.source.text;
        let tokens = token::tokenize(&piece.source).unwrap_or_default();
        let is_word = |range: &Range<usize>| {
            matches!(&text[range.clone()], "fn" | "struct" | "const" | "var" | "alias" | "override" | "const_assert")
        };
        let words = tokens.into_iter().filter(|token| token.kind == TokenKind::Word);
        let at = words.map(|token| token.range).find(is_word).unwrap_or(0..0);
        at.start + piece.range.start..at.end + piece.range.start
    }

    /// An error at a range of the joined text.
    pub fn error(&self, kind: ErrorKind, range: Range<usize>, message: impl Into<String>) -> ShaderError {
        let (source, range) = self.origin(range);
        ShaderError::at(kind, source, range, message)
    }
}
