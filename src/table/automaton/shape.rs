//! The tree of a table with what never lasts taken out: rows and blocks of duration 0, blocks without rows.

use super::{Leaf, Loop, NoAutomaton};
use crate::table::duration::{DurationCell, Repeat};
use crate::table::model::{Node, Table};

/// The tree.
pub(super) struct Shape {
    pub(super) leaves: Vec<Leaf>,
    pub(super) loops: Vec<Loop>,
    pub(super) body: Vec<Part>,
}

/// A row or a block of the tree.
pub(super) enum Part {
    Leaf(usize),
    Loop(usize, Vec<Part>),
}

impl Shape {
    pub(super) fn of(table: &Table) -> Result<Self, NoAutomaton> {
        let mut shape = Self { leaves: Vec::new(), loops: Vec::new(), body: Vec::new() };
        shape.body = shape.parts(&table.body, &mut 0, &mut Vec::new())?;
        Ok(shape)
    }

    fn parts(&mut self, nodes: &[Node], row: &mut usize, round: &mut Vec<usize>) -> Result<Vec<Part>, NoAutomaton> {
        let mut out = Vec::new();
        for node in nodes {
            match node {
                Node::Row(node) => {
                    let repeat = repeat(&node.duration)?;
                    let progress = node.duration.duration.has_progress();
                    if lasts(repeat) {
                        let saturation = saturation(repeat, 2);
                        let leaf = Leaf { row: *row, loops: round.clone(), repeat, progress, saturation };
                        self.leaves.push(leaf);
                        out.push(Part::Leaf(self.leaves.len() - 1));
                    }
                    *row += 1;
                }
                Node::Block(block) => {
                    let repeat = repeat(&block.duration)?;
                    let progress = block.duration.duration.has_progress();
                    let (leaves, loops) = (self.leaves.len(), self.loops.len());
                    self.loops.push(Loop { repeat, progress, saturation: 1 });
                    round.push(loops);
                    let children = self.parts(&block.children, row, round)?;
                    round.pop();
                    if children.is_empty() || !lasts(repeat) {
                        self.leaves.truncate(leaves);
                        self.loops.truncate(loops);
                        continue;
                    }
                    let repeat = if self.all_may_be_empty(&children) { without_lower(repeat) } else { repeat };
                    self.loops[loops] = Loop { repeat, progress, saturation: saturation(repeat, 1) };
                    out.push(Part::Loop(loops, children));
                }
            }
        }
        Ok(out)
    }

    /// Whether `part` may be left out.
    pub(super) fn may_be_empty(&self, part: &Part) -> bool {
        let repeat = match part {
            Part::Leaf(leaf) => self.leaves[*leaf].repeat,
            Part::Loop(index, _) => self.loops[*index].repeat,
        };
        matches!(repeat, Repeat::Times { low: 0, .. })
    }

    /// Whether all of `parts` may be left out.
    pub(super) fn all_may_be_empty(&self, parts: &[Part]) -> bool {
        parts.iter().all(|part| self.may_be_empty(part))
    }
}

fn repeat(duration: &DurationCell) -> Result<Repeat, NoAutomaton> {
    duration.repeat.ok_or(NoAutomaton::NoCycleTime)
}

/// Whether it can last a cycle.
fn lasts(repeat: Repeat) -> bool {
    !matches!(repeat, Repeat::Times { high: Some(0), .. })
}

/// A body that may be empty fills any number of iterations with none.
const fn without_lower(repeat: Repeat) -> Repeat {
    match repeat {
        Repeat::Times { high, .. } => Repeat::Times { low: 0, high },
        Repeat::Omega => Repeat::Omega,
    }
}

/// The count from which on larger ones are not told apart; `least` are told apart in any case.
fn saturation(repeat: Repeat, least: u64) -> u64 {
    match repeat {
        Repeat::Times { high: Some(high), .. } => high.max(1),
        Repeat::Times { low, high: None } => low.max(least),
        Repeat::Omega => least,
    }
}
