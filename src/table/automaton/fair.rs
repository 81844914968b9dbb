//! What it means that the environment does not stay for ever: the fairness of strict conformance.
//!
//! An *open end* is a repetition without an upper bound that is not `ω`: a row, or a block. Step 1 of a cycle (the inputs and the
//! progress flags) takes each word on; of a word that was in an open end before the cycle it
//! *keeps* the word there, or lets it *leave*, to another row or into the open end anew. A word in an `ω` is kept by the table,
//! and counts for neither. The environment stays in an open end for ever if from some cycle on, in each cycle, it keeps a word
//! there and lets none leave. A play is fair if it does so in none. So the environment must offer a way out again and again,
//! and what becomes of the words that take it, in step 2, is for the system to answer for.

use super::Automaton;
use super::edges::{Edge, Target, Update};
use crate::table::duration::Repeat;

/// A repetition without an upper bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpenEnd {
    /// A row, by its leaf.
    Row(usize),
    /// A block.
    Block(usize),
}

/// What a cycle does to a word that was in an open end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keeps {
    /// It goes on there.
    Stays,
    /// It goes elsewhere.
    Leaves,
    /// The table keeps it, in an `ω`.
    Endless,
}

const fn is_open(repeat: Repeat) -> bool {
    matches!(repeat, Repeat::Times { high: None, .. })
}

impl Automaton {
    /// The open ends, rows first.
    #[must_use]
    pub fn open_ends(&self) -> Vec<OpenEnd> {
        let rows = (0..self.leaves.len()).filter(|leaf| is_open(self.leaves[*leaf].repeat)).map(OpenEnd::Row);
        let blocks = (0..self.loops.len()).filter(|block| is_open(self.loops[*block].repeat)).map(OpenEnd::Block);
        rows.chain(blocks).collect()
    }

    /// Whether no word is longer than some length.
    #[must_use]
    pub fn is_bounded(&self) -> bool {
        let bounded = |repeat: Repeat| matches!(repeat, Repeat::Times { high: Some(_), .. });
        self.leaves.iter().all(|leaf| bounded(leaf.repeat)) && self.loops.iter().all(|block| bounded(block.repeat))
    }

    /// What an edge out of the row `from` does to a word in the open end; `None` where the row is not in it.
    #[must_use]
    pub fn keeps(&self, end: OpenEnd, from: usize, edge: &Edge) -> Option<Keeps> {
        match end {
            OpenEnd::Row(leaf) if leaf != from => None,
            OpenEnd::Row(_) => Some(if matches!(edge.target, Target::Stay(_)) { Keeps::Stays } else { Keeps::Leaves }),
            OpenEnd::Block(block) => {
                self.leaves[from].loops.iter().find(|index| **index == block)?;
                let target = edge.site().map(|site| &self.leaves[site.leaf]);
                let place = target.and_then(|leaf| leaf.loops.iter().position(|index| *index == block));
                let anew = edge.updates.contains(&Update::Begin(block));
                let (Some(target), Some(place), false) = (target, place, anew) else { return Some(Keeps::Leaves) };
                let inner = target.loops[place + 1..].iter().map(|index| self.loops[*index].repeat);
                let endless = inner.chain([target.repeat]).any(|repeat| repeat == Repeat::Omega);
                Some(if endless { Keeps::Endless } else { Keeps::Stays })
            }
        }
    }
}
