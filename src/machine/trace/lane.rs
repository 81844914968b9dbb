//! Signals as spans of equal values, and an axis on which long stretches without a change are short: what diagrams
//! are drawn from.

use super::{Signal, Trace};
use crate::machine::program::Role;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::literal;

/// A signal as a diagram shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lane {
    /// Its name.
    pub name: String,
    /// What the variable is for.
    pub role: Role,
    /// Whether it is drawn as a level that is high or low.
    pub is_level: bool,
    /// Its values, in order, without a gap.
    pub spans: Vec<Span>,
}

/// Some cycles with the same value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first cycle, from 0.
    pub from: usize,
    /// The first cycle behind it.
    pub to: usize,
    /// Whether the value is other than zero.
    pub high: bool,
    /// The value as it is written.
    pub text: String,
}

/// Where cycles stand in a diagram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// For each cycle its column; the last element is the width.
    columns: Vec<usize>,
    /// The cycles at which something changes, the first one among them.
    pub changes: Vec<usize>,
}

/// The lanes of a trace, in the order of its signals.
#[must_use]
pub fn lanes(trace: &Trace) -> Vec<Lane> {
    let cycles = trace.cycles();
    trace.signals.iter().map(|signal| lane(signal, cycles)).collect()
}

fn lane(signal: &Signal, cycles: usize) -> Lane {
    let mut spans: Vec<Span> = Vec::new();
    let values = &signal.values[..cycles.min(signal.values.len())];
    for (cycle, value) in values.iter().enumerate() {
        match spans.last_mut() {
            Some(last) if values[last.from] == *value => last.to = cycle + 1,
            _ => {
                let text = literal(&signal.kind, *value);
                spans.push(Span { from: cycle, to: cycle + 1, high: *value != 0, text });
            }
        }
    }
    Lane { name: signal.name.clone(), role: signal.role, is_level: signal.kind.scalar == Scalar::Bool, spans }
}

impl Axis {
    /// An axis on which a stretch without a change takes at most `longest` columns, but as many as the values that begin
    /// there need up to `widest`.
    #[must_use]
    pub fn new(lanes: &[Lane], longest: usize, widest: usize) -> Self {
        let spans = || lanes.iter().flat_map(|lane| lane.spans.iter().map(move |span| (lane.is_level, span)));
        let cycles = spans().map(|(_, span)| span.to).max().unwrap_or(0);
        let mut needs = vec![None; cycles];
        for (is_level, span) in spans() {
            let width = if is_level { 0 } else { span.text.chars().count() + 1 };
            needs[span.from] = needs[span.from].max(Some(width.min(widest)));
        }
        let changes: Vec<usize> = (0..cycles).filter(|cycle| needs[*cycle].is_some()).collect();
        let mut columns = Vec::with_capacity(cycles + 1);
        let mut at = 0;
        for (index, from) in changes.iter().enumerate() {
            let to = changes.get(index + 1).copied().unwrap_or(cycles);
            let length = to - from;
            // A value has room until the next change of any lane only.
            let width = length.min(longest).max(needs[*from].unwrap_or(0).min(length.max(2)));
            columns.extend((0..length).map(|cycle| at + cycle * width / length));
            at += width;
        }
        columns.push(at);
        Self { columns, changes }
    }

    /// The column of a cycle; the width for what is behind the last one.
    #[must_use]
    pub fn column(&self, cycle: usize) -> usize {
        self.columns.get(cycle).or(self.columns.last()).copied().unwrap_or(0)
    }

    /// How many columns there are.
    #[must_use]
    pub fn width(&self) -> usize {
        self.columns.last().copied().unwrap_or(0)
    }
}
