//! The table automaton: every word that the table still admits, tracked at once and exactly.
//!
//! A *token* is a place in the table: a row, how often it has been repeated, and the number of the iteration of each
//! block round it. All words that begin alike share a token, and the words still possible are the set of live tokens.
//! [`Edge`]s lead from row to row under conditions on these counts; a token may take several at once. Counts saturate
//! where nothing tells larger ones apart, so the number of rows and edges does not depend on the durations.
//!
//! The progress flag is a condition on an edge: it may not be taken while the input constraint of a *rival* holds, a row
//! that the word would be in had it left. An iteration of a block that consumes no cycle is none, and a block whose body
//! may be empty may be left out; both follow from `L^k` containing `L^j` for every `j < k` where `L` holds the empty word.
//! A flagged block is tested where an iteration ends and the next one would begin, not where the block is entered.
//! A block for ever that cannot consume a cycle is empty. After Beckert et al., *Generalised Test Tables* (iFM 2017),
//! whose automaton guesses one word, which is not exact where rows overlap.

mod edges;
pub mod encode;
mod fair;
pub mod game;
pub(in crate::table) mod meet;
mod ranges;
mod shape;

use super::duration::Repeat;
use super::model::Table;

pub use edges::{Condition, Counter, Edge, Rival, Target, Test, Update};
pub use fair::{Keeps, OpenEnd};

/// A table unrolled, as far as its durations need no unrolling.
#[derive(Clone, Debug)]
pub struct Automaton {
    /// The rows that can last a cycle at all, from top to bottom.
    pub leaves: Vec<Leaf>,
    /// The repeated blocks.
    pub loops: Vec<Loop>,
    /// The edges from the beginning.
    pub entries: Vec<Edge>,
    /// The edges out of each leaf, the one that stays first.
    pub edges: Vec<Vec<Edge>>,
    /// Whether the table may be over before the first cycle.
    pub may_be_empty: bool,
    /// Whether a word can end.
    pub ends: bool,
}

/// A row that lasts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leaf {
    /// Its index among [`Table::rows`].
    pub row: usize,
    /// The blocks round it, outermost first, as indices into [`Automaton::loops`].
    pub loops: Vec<usize>,
    /// How often it is repeated.
    pub repeat: Repeat,
    /// Whether it must be left as soon as something else fits.
    pub progress: bool,
    /// From this count on, larger counts are not told apart.
    pub saturation: u64,
}

/// A repeated block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loop {
    /// How often; a block whose body may be empty has the lower bound 0.
    pub repeat: Repeat,
    /// Whether it must be left as soon as something else fits.
    pub progress: bool,
    /// From this count on, larger counts are not told apart.
    pub saturation: u64,
}

/// Why a table has no automaton.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoAutomaton {
    /// It has errors.
    Errors,
    /// A duration is a time, and the cycle time is not known.
    NoCycleTime,
    /// It compares several runs, or jumps into other tables.
    Unsupported,
    /// Its rows are left in so many ways that the edges would not fit in memory.
    TooLarge,
}

/// More edges than this are refused.
const MAX_EDGES: usize = 4_000_000;

impl Automaton {
    /// Unrolls `table`.
    ///
    /// # Errors
    /// Why it has no automaton.
    pub fn build(table: &Table) -> Result<Self, NoAutomaton> {
        if table.has_errors() {
            return Err(NoAutomaton::Errors);
        }
        let hold =
            |duration: &super::duration::DurationCell| duration.duration.flag == Some(super::duration::Flag::Hold);
        let rows = table.rows();
        if table.is_relational() || rows.iter().any(|row| !row.gotos.is_empty() || hold(&row.duration)) {
            return Err(NoAutomaton::Unsupported);
        }
        let shape = shape::Shape::of(table)?;
        edges::connect(shape)
    }
}

/// A leaf in its first cycle, where triggers count, or in a later one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Site {
    /// The leaf.
    pub leaf: usize,
    /// Whether it is the first cycle of the row.
    pub first: bool,
}
