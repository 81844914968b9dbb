//! A piece of text with the way back to the user's file: what every reader and parser of the room works on.

use std::sync::Arc;

use crate::text::{FileId, Place, Span, SpanMap};

/// Text to read, and where in a file each byte of it stands.
#[derive(Clone, Debug)]
pub struct Piece<'a> {
    /// The file.
    pub file: FileId,
    /// The text.
    pub text: &'a str,
    base: u32,
    map: Arc<SpanMap>,
    /// Where in the file the text ends that this one was made from: rewritten text may be longer.
    limit: u32,
}

impl<'a> Piece<'a> {
    /// `text`, whose bytes stand in `file` where `map` says.
    #[must_use]
    pub fn new(file: FileId, text: &'a str, map: &SpanMap) -> Self {
        Self { file, text, base: 0, map: Arc::new(map.clone()), limit: u32::MAX }
    }

    /// `text`, which stands in `file` as it is, from byte `start` on.
    #[must_use]
    pub fn verbatim(file: FileId, text: &'a str, start: u32) -> Self {
        Self { file, text, base: 0, map: Arc::new(SpanMap::verbatim(start)), limit: u32::MAX }
    }

    /// The part of this piece in `range` (of its own text); empty where the range does not fit.
    #[must_use]
    pub fn part(&self, range: std::ops::Range<usize>) -> Piece<'a> {
        let base = self.base + u32::try_from(range.start).unwrap_or(u32::MAX);
        Piece {
            file: self.file,
            text: self.text.get(range).unwrap_or(""),
            base,
            map: Arc::clone(&self.map),
            limit: self.limit,
        }
    }

    /// How many bytes this piece begins behind `other`, both being parts of one piece.
    #[must_use]
    pub const fn behind(&self, other: &Piece<'_>) -> u32 {
        self.base.saturating_sub(other.base)
    }

    /// Another text made from this one, where `runs` pairs offsets of `text` with offsets of this piece.
    #[must_use]
    pub fn rewritten<'b>(&self, text: &'b str, runs: &[(u32, u32)]) -> Piece<'b> {
        let runs: Vec<(u32, u32)> = runs.iter().map(|(from, to)| (*from, self.map.offset(self.base + to))).collect();
        Piece { file: self.file, text, base: 0, map: Arc::new(SpanMap::new(runs)), limit: self.limit }
    }

    /// The same text, none of whose places reach beyond the end of `whole`.
    #[must_use]
    pub fn within(mut self, whole: &Piece<'_>) -> Self {
        self.limit = whole.whole().span.end;
        self
    }

    /// Without white space at both ends.
    #[must_use]
    pub fn trimmed(&self) -> Piece<'a> {
        let start = self.text.len() - self.text.trim_start().len();
        self.part(start..start + self.text.trim().len())
    }

    /// The file's span for a span of this piece.
    #[must_use]
    pub fn span(&self, span: Span) -> Span {
        let span = self.map.span(span.shifted(self.base));
        Span::new(span.start.min(self.limit), span.end.min(self.limit))
    }

    /// The place of a span of this piece.
    #[must_use]
    pub fn place(&self, span: Span) -> Place {
        Place::new(self.file, self.span(span))
    }

    /// The place of a range of this piece.
    #[must_use]
    pub fn at(&self, range: std::ops::Range<usize>) -> Place {
        self.place(range.into())
    }

    /// The place of the whole piece.
    #[must_use]
    pub fn whole(&self) -> Place {
        self.at(0..self.text.len())
    }

    /// Each line with the range that it takes, without its line break.
    pub fn lines(&self) -> impl Iterator<Item = Piece<'a>> + '_ {
        let mut start = 0;
        self.text.split_inclusive('\n').map(move |line| {
            let begin = start;
            start += line.len();
            self.part(begin..begin + line.trim_end_matches(['\n', '\r']).len())
        })
    }
}
