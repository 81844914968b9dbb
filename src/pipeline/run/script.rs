//! The rows of a table one after the other.

use crate::table::Table;
use crate::table::duration::{DurationCell, Repeat};
use crate::table::model::Node;

/// A cycle of a script.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Turn {
    /// The row, by its index among [`Table::rows`].
    pub(super) row: usize,
    /// Whether it is its first cycle.
    pub(super) first: bool,
}

/// The most cycles that a script has.
const MOST: usize = 1_000_000;

/// The shortest run through all rows of `table`: a row or block that may be left out is shown once, a row without an end lasts
/// `cycles`, a block without an end is repeated `repeats` times.
pub(super) fn script(table: &Table, cycles: u64, repeats: u64) -> Result<Vec<Turn>, String> {
    let mut writer = Writer { cycles, repeats, out: Vec::new() };
    writer.nodes(&table.body, 0)?;
    Ok(writer.out)
}

struct Writer {
    cycles: u64,
    repeats: u64,
    out: Vec<Turn>,
}

impl Writer {
    /// Writes nodes whose first row has the index `row`; gives the index of the row behind them.
    fn nodes(&mut self, nodes: &[Node], mut row: usize) -> Result<usize, String> {
        for node in nodes {
            row = match node {
                Node::Row(each) => {
                    for count in 0..count(&each.duration, self.cycles)? {
                        self.push(Turn { row, first: count == 0 })?;
                    }
                    row + 1
                }
                Node::Block(block) => {
                    let times = count(&block.duration, self.repeats)?;
                    for _ in 0..times {
                        self.nodes(&block.children, row)?;
                    }
                    row + rows(&block.children)
                }
            };
        }
        Ok(row)
    }

    fn push(&mut self, turn: Turn) -> Result<(), String> {
        if self.out.len() >= MOST {
            return Err(format!("the run is longer than {MOST} cycles"));
        }
        self.out.push(turn);
        Ok(())
    }
}

/// How often something is done.
fn count(duration: &DurationCell, forever: u64) -> Result<u64, String> {
    match duration.repeat {
        Some(Repeat::Times { low, high }) => Ok(low.max(1).min(high.unwrap_or(u64::MAX))),
        Some(Repeat::Omega) => Ok(forever),
        None => Err(format!("the duration `{}` cannot be counted in cycles", duration.text)),
    }
}

fn rows(nodes: &[Node]) -> usize {
    let count = |node: &Node| match node {
        Node::Row(_) => 1,
        Node::Block(block) => rows(&block.children),
    };
    nodes.iter().map(count).sum()
}
