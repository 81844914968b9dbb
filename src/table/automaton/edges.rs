//! From the tree to edges between rows: what follows a row, over the ends and beginnings of the blocks round it.

use super::shape::{Part, Shape};
use super::{Automaton, Leaf, MAX_EDGES, NoAutomaton, Site};
use crate::table::duration::Repeat;

/// A way from a row to the next one, to itself, or to the end of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Where it leads.
    pub target: Target,
    /// What the counts of the token must satisfy before.
    pub conditions: Vec<Condition>,
    /// What becomes of the blocks' counts; blocks that both rows share and that are not named keep theirs.
    pub updates: Vec<Update>,
    /// It may not be taken while one of these fits: the progress flag.
    pub rivals: Vec<Rival>,
}

/// Where an edge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The same row once more: its count goes up by one.
    Stay(usize),
    /// The first cycle of a row: its count is 1.
    Enter(usize),
    /// The end of the table.
    End,
}

/// What counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Counter {
    /// How often the row that the edge leaves has been repeated.
    Row,
    /// The number of the iteration of a block.
    Loop(usize),
}

/// A condition on a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// Which.
    pub counter: Counter,
    /// What it must be.
    pub test: Test,
}

/// What a count must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// At least so many.
    AtLeast(u64),
    /// Fewer than so many.
    Below(u64),
}

impl Test {
    /// Whether `count` is that.
    #[must_use]
    pub const fn admits(self, count: u64) -> bool {
        match self {
            Self::AtLeast(bound) => count >= bound,
            Self::Below(bound) => count < bound,
        }
    }
}

/// What becomes of a block's count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Update {
    /// The block begins: its count is 1.
    Begin(usize),
    /// The next iteration begins: its count goes up by one, up to its saturation.
    Next(usize),
}

impl Update {
    /// The block whose count it sets.
    #[must_use]
    pub const fn block(self) -> usize {
        match self {
            Self::Begin(index) | Self::Next(index) => index,
        }
    }
}

/// A row that the word would be in had it left: while its input constraint holds, a progress flag forbids to go on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rival {
    /// What the counts of the token must satisfy before, for the rival to be one.
    pub conditions: Vec<Condition>,
    /// The row, in its first cycle.
    pub leaf: usize,
}

impl Edge {
    /// The row that it leads to, and in which of its cycles.
    #[must_use]
    pub const fn site(&self) -> Option<Site> {
        match self.target {
            Target::Stay(leaf) => Some(Site { leaf, first: false }),
            Target::Enter(leaf) => Some(Site { leaf, first: true }),
            Target::End => None,
        }
    }

    /// The block whose next iteration it begins.
    fn next(&self) -> Option<usize> {
        self.updates.iter().find_map(|update| match update {
            Update::Next(index) => Some(*index),
            Update::Begin(_) => None,
        })
    }

    /// Whether it begins an iteration of the block.
    fn begins(&self, index: usize) -> bool {
        self.updates.iter().any(|update| matches!(update, Update::Next(i) | Update::Begin(i) if *i == index))
    }

    fn rival(&self, extra: &[Condition]) -> Option<Rival> {
        let Target::Enter(leaf) = self.target else { return None };
        let conditions = extra.iter().chain(&self.conditions).copied().collect();
        Some(Rival { conditions, leaf })
    }
}

/// What follows a row or a block once it is left.
type Ways = Vec<Edge>;

struct Connector {
    shape: Shape,
    /// What follows each leaf, without the condition on its own count.
    after_leaf: Vec<Ways>,
    /// What follows each block.
    after_loop: Vec<Ways>,
    edges: usize,
}

/// Connects the rows of a tree.
pub(super) fn connect(mut shape: Shape) -> Result<Automaton, NoAutomaton> {
    let body = std::mem::take(&mut shape.body);
    let mut connector = Connector {
        after_leaf: vec![Vec::new(); shape.leaves.len()],
        after_loop: vec![Vec::new(); shape.loops.len()],
        shape,
        edges: 0,
    };
    let end = vec![Edge { target: Target::End, conditions: Vec::new(), updates: Vec::new(), rivals: Vec::new() }];
    connector.sequence(&body, &end)?;
    let mut entries = connector.enter(&body);
    let may_be_empty = connector.shape.all_may_be_empty(&body);
    let mut edges: Vec<Ways> = (0..connector.shape.leaves.len()).map(|leaf| connector.edges_of(leaf)).collect();
    connector.add_rivals(&mut entries);
    edges.iter_mut().for_each(|edges| connector.add_rivals(edges));
    let ends = may_be_empty || reaches_end(&entries, &edges);
    Ok(Automaton { leaves: connector.shape.leaves, loops: connector.shape.loops, entries, edges, may_be_empty, ends })
}

/// Whether some way from the beginning leads to the end.
fn reaches_end(entries: &Ways, edges: &[Ways]) -> bool {
    let mut seen = vec![false; edges.len()];
    let mut work: Vec<&Edge> = entries.iter().collect();
    while let Some(edge) = work.pop() {
        match edge.target {
            Target::End => return true,
            Target::Enter(leaf) if !seen[leaf] => {
                seen[leaf] = true;
                work.extend(&edges[leaf]);
            }
            _ => {}
        }
    }
    false
}

impl Connector {
    /// Every way into `parts`: the first of them, and those behind parts that may be left out.
    fn enter(&self, parts: &[Part]) -> Ways {
        let mut out = Vec::new();
        for part in parts {
            match part {
                Part::Leaf(leaf) => out.push(Edge {
                    target: Target::Enter(*leaf),
                    conditions: Vec::new(),
                    updates: Vec::new(),
                    rivals: Vec::new(),
                }),
                Part::Loop(index, children) => {
                    let mut inner = self.enter(children);
                    inner.iter_mut().for_each(|edge| edge.updates.insert(0, Update::Begin(*index)));
                    out.append(&mut inner);
                }
            }
            if !self.shape.may_be_empty(part) {
                break;
            }
        }
        out
    }

    /// Sets what follows each of `parts`, where `behind` follows the last of them.
    fn sequence(&mut self, parts: &[Part], behind: &Ways) -> Result<(), NoAutomaton> {
        for (at, part) in parts.iter().enumerate() {
            let rest = &parts[at + 1..];
            let mut ways = self.enter(rest);
            if self.shape.all_may_be_empty(rest) {
                ways.extend(behind.iter().cloned());
            }
            self.edges += ways.len();
            if self.edges > MAX_EDGES {
                return Err(NoAutomaton::TooLarge);
            }
            match part {
                Part::Leaf(leaf) => self.after_leaf[*leaf] = ways,
                Part::Loop(index, children) => {
                    let behind = self.end_of_iteration(*index, children, &ways);
                    self.after_loop[*index] = ways;
                    self.sequence(children, &behind)?;
                }
            }
        }
        Ok(())
    }

    /// What follows an iteration of a block: the next one, or what follows the block.
    fn end_of_iteration(&self, index: usize, children: &[Part], after: &Ways) -> Ways {
        let counter = Counter::Loop(index);
        let mut out = self.enter(children);
        for edge in &mut out {
            edge.updates.insert(0, Update::Next(index));
            if let Repeat::Times { high: Some(high), .. } = self.shape.loops[index].repeat {
                edge.conditions.push(Condition { counter, test: Test::Below(high) });
            }
        }
        if let Repeat::Times { low, .. } = self.shape.loops[index].repeat {
            out.extend(after.iter().cloned().map(|edge| guarded(edge, counter, low)));
        }
        out
    }

    fn edges_of(&self, index: usize) -> Ways {
        let leaf = &self.shape.leaves[index];
        let mut stay =
            Edge { target: Target::Stay(index), conditions: Vec::new(), updates: Vec::new(), rivals: Vec::new() };
        let Repeat::Times { low, high } = leaf.repeat else { return vec![stay] };
        let mut out = Vec::new();
        if let Some(high) = high {
            stay.conditions.push(Condition { counter: Counter::Row, test: Test::Below(high) });
        }
        if high != Some(1) {
            if leaf.progress {
                let could_leave = could_leave(Counter::Row, low);
                stay.rivals = self.after_leaf[index].iter().filter_map(|edge| edge.rival(&could_leave)).collect();
            }
            out.push(stay);
        }
        out.extend(self.after_leaf[index].iter().cloned().map(|edge| guarded(edge, Counter::Row, low)));
        out
    }

    /// The progress flags of what an edge enters: a row that could be left out, a block that could end.
    fn add_rivals(&self, edges: &mut Ways) {
        for edge in edges {
            let mut rivals = Vec::new();
            if let Target::Enter(index) = edge.target
                && skippable(&self.shape.leaves[index])
            {
                // A way back into a block that begins here would make an iteration of no cycle.
                let other = |way: &&Edge| way.next().is_none_or(|index| !edge.begins(index));
                let ways = self.after_leaf[index].iter().filter(other);
                rivals.extend(ways.filter_map(|way| way.rival(&[])).map(|rival| without_begun(rival, edge)));
            }
            if let Some(index) = edge.next()
                && self.shape.loops[index].progress
                && let Repeat::Times { low, .. } = self.shape.loops[index].repeat
            {
                let could_leave = could_leave(Counter::Loop(index), low);
                rivals.extend(self.after_loop[index].iter().filter_map(|way| way.rival(&could_leave)));
            }
            edge.rivals.append(&mut rivals);
        }
    }
}

/// A flagged row that may last no cycle.
const fn skippable(leaf: &Leaf) -> bool {
    leaf.progress && matches!(leaf.repeat, Repeat::Times { low: 0, .. })
}

fn could_leave(counter: Counter, low: u64) -> Vec<Condition> {
    if low > 1 { vec![Condition { counter, test: Test::AtLeast(low) }] } else { Vec::new() }
}

/// The edge, where leaving needs a count of at least `low`; a token's counts are 1 at least.
fn guarded(mut edge: Edge, counter: Counter, low: u64) -> Edge {
    if low > 1 {
        edge.conditions.push(Condition { counter, test: Test::AtLeast(low) });
    }
    edge
}

/// A block that begins with the row that is left out ends without an iteration, which its lower bound of 0 admits.
fn without_begun(mut rival: Rival, edge: &Edge) -> Rival {
    rival.conditions.retain(|condition| match condition.counter {
        Counter::Row => false,
        Counter::Loop(index) => !edge.begins(index),
    });
    rival
}
