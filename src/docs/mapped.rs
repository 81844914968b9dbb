//! Text with the way back to the file.
//!
//! Cleaning a comment drops bytes, reading it by a convention rewrites some: a [`Mapped`] keeps, for
//! each run of its text, where in the file that run stands. Text of this program's own (the `**`
//! that an element `<b>` becomes) stands where the text before it ends, and places never leave the
//! comment.

use std::ops::Range;

use crate::text::{FileId, Fragment, Place, Span, SpanMap};

/// Text, and where each run of it stands in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mapped {
    file: FileId,
    text: String,
    runs: Vec<(u32, u32)>,
    low: u32,
    high: u32,
}

impl Mapped {
    /// Empty text of `file`.
    pub(super) const fn new(file: FileId) -> Self {
        Self { file, text: String::new(), runs: Vec::new(), low: u32::MAX, high: 0 }
    }

    /// Empty text in the place of `other`.
    pub(super) const fn beside(other: &Self) -> Self {
        Self { file: other.file, text: String::new(), runs: Vec::new(), low: other.low, high: other.high }
    }

    pub(super) fn as_str(&self) -> &str {
        &self.text
    }

    pub(super) fn is_blank(&self) -> bool {
        self.text.trim().is_empty()
    }

    /// Appends `text`, which stands at byte `at` of the file.
    pub(super) fn push(&mut self, text: &str, at: u32) {
        if !text.is_empty() {
            self.low = self.low.min(at);
            self.high = self.high.max(at + length(text));
            self.push_run(text, at);
        }
    }

    fn push_run(&mut self, text: &str, at: u32) {
        let offset = self.len();
        let follows = self.runs.last().is_some_and(|(from, to)| to + (offset - from) == at);
        if !follows {
            self.runs.push((offset, at));
        }
        self.text.push_str(text);
    }

    /// Appends text of this program's own.
    pub(super) fn add(&mut self, text: &str) {
        if text.is_empty() {
            return;
        }
        let at = self.end().clamp(self.low.min(self.high), self.high);
        self.runs.push((self.len(), at));
        self.text.push_str(text);
        self.runs.push((self.len(), at));
    }

    /// Appends `span` of `fragment`, which may have seams.
    pub(super) fn push_fragment(&mut self, fragment: &Fragment, span: Span) {
        let text = span.of(&fragment.text);
        if text.is_empty() {
            return;
        }
        let first = fragment.map.offset(span.start);
        let last = fragment.map.offset(span.end - 1);
        if last.checked_sub(first) == Some(span.len() - 1) || text.chars().count() == 1 {
            self.push(text, first);
            return;
        }
        let mut middle = text.len() / 2;
        while middle > 0 && !text.is_char_boundary(middle) {
            middle -= 1;
        }
        if middle == 0 {
            middle = text.chars().next().map_or(1, char::len_utf8);
        }
        let cut = span.start + u32::try_from(middle).unwrap_or(u32::MAX);
        self.push_fragment(fragment, Span::new(span.start, cut));
        self.push_fragment(fragment, Span::new(cut, span.end));
    }

    /// Appends a part of `other`.
    pub(super) fn append(&mut self, other: &Self, range: Range<usize>) {
        let Some(part) = other.text.get(range.clone()) else { return };
        if part.is_empty() {
            return;
        }
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        let (start, end) = (small(range.start), small(range.end));
        let first = other.runs.partition_point(|run| run.0 <= start).saturating_sub(1);
        for i in first..other.runs.len() {
            let (from, to) = other.runs[i];
            let until = other.runs.get(i + 1).map_or(end, |next| next.0).min(end);
            let begin = from.max(start);
            if begin >= end {
                break;
            }
            if begin < until {
                let piece = &other.text[begin as usize..until as usize];
                self.push_run(piece, to + (begin - from));
            }
        }
    }

    /// Appends all of `other`.
    pub(super) fn append_all(&mut self, other: &Self) {
        self.append(other, 0..other.text.len());
    }

    /// A part.
    pub(super) fn slice(&self, range: Range<usize>) -> Self {
        let mut out = Self::beside(self);
        out.append(self, range);
        out
    }

    /// A part without white space around it.
    pub(super) fn trimmed(&self, range: Range<usize>) -> Self {
        self.slice(trim(&self.text, range))
    }

    /// The lines, each without its line break.
    pub(super) fn lines(&self) -> Vec<Range<usize>> {
        let mut out = Vec::new();
        let mut start = 0;
        for line in self.text.split('\n') {
            out.push(start..start + line.len());
            start += line.len() + 1;
        }
        out
    }

    /// The same text, whose places stay in `place`.
    pub(super) const fn within(mut self, place: Place) -> Self {
        self.low = place.span.start;
        self.high = place.span.end;
        self
    }

    /// Where a part stands in the file, never outside the comment.
    pub(super) fn place(&self, range: Range<usize>) -> Place {
        let (start, end) = (small(range.start), small(range.end));
        let first = self.offset(start);
        let last = if end > start { self.offset(end - 1) + 1 } else { first };
        let (low, high) = (self.low.min(self.high), self.high);
        Place::new(self.file, Span::new(first.clamp(low, high), last.clamp(low, high)))
    }

    /// Where all of it stands.
    pub(super) fn whole(&self) -> Place {
        self.place(0..self.text.len())
    }

    /// From offsets in the text to offsets in the file.
    pub(super) fn map(&self) -> SpanMap {
        SpanMap::new(self.runs.clone())
    }

    fn offset(&self, at: u32) -> u32 {
        let after = self.runs.partition_point(|run| run.0 <= at);
        match self.runs.get(after.saturating_sub(1)) {
            Some((from, to)) => to + at.saturating_sub(*from),
            None => self.low.min(self.high),
        }
    }

    fn end(&self) -> u32 {
        self.runs.last().map_or(self.low, |(from, to)| to + (self.len() - from))
    }

    fn len(&self) -> u32 {
        length(&self.text)
    }
}

/// `range` without the white space at its ends.
pub(super) fn trim(text: &str, range: Range<usize>) -> Range<usize> {
    let part = text.get(range.clone()).unwrap_or("");
    let start = range.start + (part.len() - part.trim_start().len());
    start..start + part.trim().len()
}

fn length(text: &str) -> u32 {
    small(text.len())
}

fn small(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Mapped {
        let mut text = Mapped::new(FileId(0));
        text.push("brief", 10);
        text.add("**");
        text.push("detail", 30);
        text
    }

    #[test]
    fn a_part_knows_where_it_stands() {
        let text = sample();
        assert_eq!(text.place(1..3).span, Span::new(11, 13));
        assert_eq!(text.place(8..10).span, Span::new(31, 33));
        assert_eq!(text.slice(8..10).place(0..2).span, Span::new(31, 33));
    }

    #[test]
    fn text_of_our_own_stands_within_the_comment() {
        let place = sample().place(5..7);
        assert!(Span::new(10, 36).contains(place.span), "{place:?}");
    }

    #[test]
    fn copies_of_text_of_our_own_stay_there_too() {
        let mut text = sample();
        text.add("[`long`]");
        let copy = text.slice(8..text.as_str().len());
        assert_eq!(copy.slice(0..copy.as_str().len()).whole().span.end, 36);
    }

    #[test]
    fn a_seam_makes_two_runs() {
        let fragment = Fragment { text: "abcdef".into(), map: SpanMap::new(vec![(0, 100), (3, 200)]) };
        let mut text = Mapped::new(FileId(0));
        text.push_fragment(&fragment, Span::new(1, 6));
        assert_eq!(text.place(0..2).span, Span::new(101, 103));
        assert_eq!(text.place(2..5).span, Span::new(200, 203));
    }
}
