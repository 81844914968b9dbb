//! Builds a [`Fragment`] piece by piece and keeps the way back.

use crate::text::{Fragment, Run, Span, SpanMap};

/// A fragment in the making.
#[derive(Debug, Default)]
pub(crate) struct FragmentBuilder {
    text: String,
    runs: Vec<Run>,
}

impl FragmentBuilder {
    pub(crate) fn new() -> Self {
        Self::default()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// How many line ends the text ends in.
    pub(crate) fn trailing_line_ends(&self) -> usize {
        self.text.bytes().rev().take_while(|byte| *byte == b'\n').count()
    }

    /// Adds the text at `span` of `file` as it stands there.
    pub(crate) fn verbatim(&mut self, file: &str, span: Span) -> &mut Self {
        self.placed(span.of(file), span.start)
    }

    /// Adds `text`, which stands in the file at `at`.
    pub(crate) fn placed(&mut self, text: &str, at: u32) -> &mut Self {
        if text.is_empty() {
            return self;
        }
        let from = self.len();
        let continues =
            self.runs.last().is_some_and(|run| run.stands_for.is_none() && run.to + (from - run.from) == at);
        if !continues {
            self.runs.push(Run::verbatim(from, at));
        }
        self.text.push_str(text);
        self
    }

    /// Adds `text`, which stands for `span` of the file.
    pub(crate) fn standing_for(&mut self, text: &str, span: Span) -> &mut Self {
        if text.is_empty() {
            return self;
        }
        let run = Run::standing_for(self.len(), span);
        let continues = self.runs.last().is_some_and(|last| Run { from: run.from, ..*last } == run);
        if !continues {
            self.runs.push(run);
        }
        self.text.push_str(text);
        self
    }

    /// Adds `fragment` of the same file.
    pub(crate) fn fragment(&mut self, fragment: &Fragment) -> &mut Self {
        let by = self.len();
        if !fragment.text.is_empty() {
            self.runs.extend(fragment.map.runs().iter().map(|run| Run { from: run.from + by, ..*run }));
            self.text.push_str(&fragment.text);
        }
        self
    }

    /// Adds the bytes from `start` to `end` of `fragment`, which is of the same file.
    pub(crate) fn piece(&mut self, fragment: &Fragment, start: usize, end: usize) -> &mut Self {
        let wanted = Span::from(start..end);
        let runs = fragment.map.runs();
        for (index, run) in runs.iter().enumerate() {
            let until = runs.get(index + 1).map_or(wanted.end, |next| next.from).min(wanted.end);
            let from = run.from.max(wanted.start);
            if from >= until {
                continue;
            }
            let text = Span::new(from, until).of(&fragment.text);
            let to = fragment.map.offset(from);
            match run.stands_for {
                None => self.placed(text, to),
                Some(length) => self.standing_for(text, Span::new(to, to + length)),
            };
        }
        self
    }

    /// The fragment; an empty one stands at `start`.
    pub(crate) fn finish(self, start: u32) -> Fragment {
        let map = if self.runs.is_empty() { SpanMap::verbatim(start) } else { SpanMap::new(self.runs) };
        Fragment { text: self.text.into(), map }
    }

    fn len(&self) -> u32 {
        u32::try_from(self.text.len()).unwrap_or(u32::MAX)
    }
}
