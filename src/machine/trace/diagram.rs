//! A trace as a timing diagram in the terminal, in Unicode.
//!
//! ```text
//! cycle     1     7      57
//! Start  ───┐
//!           └─────────────
//! ET       │T#0ms │T#10ms
//! ```
//!
//! A level takes two lines, another value one. A stretch in which nothing changes is drawn short; the ruler gives the
//! number of the cycle at each change, where there is room. A diagram that is too wide goes on below.

use super::Trace;
use super::lane::{Axis, Lane, lanes};

/// How a diagram is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How many characters a line may have.
    pub width: usize,
    /// A cycle to point at, from 0.
    pub mark: Option<usize>,
}

impl Default for Options {
    fn default() -> Self {
        Self { width: 100, mark: None }
    }
}

/// The columns that a stretch without a change takes at most.
const LONGEST: usize = 8;
/// The columns that a value gets at most.
const WIDEST: usize = 12;

/// Draws a trace; every line ends with a line feed.
#[must_use]
pub fn draw(trace: &Trace, options: &Options) -> String {
    let lanes = lanes(trace);
    let axis = Axis::new(&lanes, LONGEST, WIDEST);
    let names = lanes.iter().map(|lane| lane.name.chars().count()).chain([5]).max().unwrap_or(5);
    let room = options.width.saturating_sub(names + 2).max(20);
    let mut rows: Vec<(String, Vec<char>)> = vec![("cycle".to_owned(), ruler(&axis))];
    for lane in &lanes {
        rows.extend(drawn(lane, &axis));
    }
    if let Some(mark) = options.mark {
        let mut row = vec![' '; axis.width()];
        if let Some(column) = row.get_mut(axis.column(mark)) {
            *column = '▲';
        }
        rows.push((String::new(), row));
    }
    let mut out = String::new();
    for from in (0..axis.width()).step_by(room) {
        if from > 0 {
            out.push('\n');
        }
        for (name, row) in &rows {
            let piece: String = row.iter().skip(from).take(room).collect();
            out.push_str(format!("{name:<names$}  {piece}").trim_end());
            out.push('\n');
        }
    }
    out
}

/// The numbers of the cycles at which something changes.
fn ruler(axis: &Axis) -> Vec<char> {
    let mut row = vec![' '; axis.width()];
    let mut free = 0;
    for cycle in &axis.changes {
        let (column, number) = (axis.column(*cycle), (cycle + 1).to_string());
        if column >= free && column + number.len() <= row.len() {
            put(&mut row, column, &number);
            free = column + number.len() + 1;
        }
    }
    row
}

fn put(row: &mut [char], at: usize, text: &str) {
    for (cell, character) in row.iter_mut().skip(at).zip(text.chars()) {
        *cell = character;
    }
}

fn drawn(lane: &Lane, axis: &Axis) -> Vec<(String, Vec<char>)> {
    if lane.is_level {
        let (high, low) = level(lane, axis);
        vec![(lane.name.clone(), high), (String::new(), low)]
    } else {
        vec![(lane.name.clone(), values(lane, axis))]
    }
}

fn level(lane: &Lane, axis: &Axis) -> (Vec<char>, Vec<char>) {
    let (mut high, mut low) = (vec![' '; axis.width()], vec![' '; axis.width()]);
    for (index, span) in lane.spans.iter().enumerate() {
        let (from, to) = (axis.column(span.from), axis.column(span.to));
        let row = if span.high { &mut high } else { &mut low };
        row[from..to].fill('─');
        if index > 0 && from < to {
            let (above, below) = if span.high { ('┌', '┘') } else { ('┐', '└') };
            high[from] = above;
            low[from] = below;
        }
    }
    (high, low)
}

fn values(lane: &Lane, axis: &Axis) -> Vec<char> {
    let mut row = vec![' '; axis.width()];
    for span in &lane.spans {
        let (from, to) = (axis.column(span.from), axis.column(span.to));
        let room = to - from;
        if room < 2 {
            row[from..to].fill('╳');
            continue;
        }
        row[from] = '│';
        let length = span.text.chars().count();
        if length < room {
            put(&mut row, from + 1, &span.text);
        } else {
            let cut: String = span.text.chars().take(room - 2).chain(['…']).collect();
            put(&mut row, from + 1, &cut);
        }
    }
    row
}
