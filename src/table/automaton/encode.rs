//! The game of a table as part of a transition system: what [`Game`](super::game::Game) plays on values, in terms.
//!
//! A *holder* is a place for tokens of one row: a bit that says whether one lives, and the counts that tell apart what it
//! may do next. A row that never holds two tokens has one holder with binary counters. One that may hold several has
//! a holder for each combination of its blocks' counts, and within it, by what its edges ask of the row's count:
//!
//! * nothing: no count;
//! * only an upper bound (`[0,n]`, `[1,n]`): the youngest token can do all that an older one can, so its count is kept;
//! * only a lower bound (`[m,∞]`): the oldest one can, and its count is kept;
//! * both, or a progress flag that depends on the count: a holder for each count.
//!
//! So the number of state bits grows with the logarithm of the durations, except where rows that may overlap have two
//! bounds. Dropping a token all of whose continuations another one has changes neither which cycles are covered nor
//! which are lost, since the game asks of the set of words only whether it is empty and whether one ends.

mod arrive;
mod survive;

use super::edges::{Condition, Counter, Edge};
use super::{Automaton, OpenEnd, Site, Test, meet};
use crate::logic::system::State;
use crate::logic::term::{Pool, Term};

/// The constraints of the rows in terms of one cycle, width 1.
pub trait Sites {
    /// Whether the assumptions of the row hold.
    fn inputs(&mut self, pool: &mut Pool, site: Site) -> Term;
    /// Whether its assertions hold.
    fn outputs(&mut self, pool: &mut Pool, site: Site) -> Term;
    /// Whether some values satisfy the constraints of both; may say so too often.
    fn compatible(&mut self, one: Site, other: Site) -> bool;
}

/// The game in terms.
#[derive(Clone, Debug)]
pub struct Encoding {
    /// Its memory.
    pub states: Vec<State>,
    /// The cycle's inputs fit a word that was still possible.
    pub covered: Term,
    /// The inputs fitted, and no word is left: the table is violated.
    pub lost: Term,
    /// A word has ended: the table is conformed to.
    pub ended: Term,
    /// For each leaf, whether a word that is in it is still possible after the cycle.
    pub live: Vec<Term>,
    /// A word is in a row at the beginning of the cycle.
    pub alive: Term,
    /// For each of [`Automaton::open_ends`], that the environment does not stay in it in this cycle.
    pub fair: Vec<Term>,
    /// For each site, whether the inputs admit a word that is there in this cycle.
    pub tried: Vec<(Site, Term)>,
}

/// More holders than this are refused.
const MAX_HOLDERS: usize = 1 << 20;

/// What is known of a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Count {
    /// Nobody asks.
    Ignored,
    /// Always this.
    Fixed(u64),
    /// A state variable.
    Kept(Term, u32),
}

/// Which count a holder with several tokens keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keep {
    /// There is one token at most.
    Only,
    Youngest,
    Oldest,
}

struct Holder {
    leaf: usize,
    keep: Keep,
    active: Term,
    row: Count,
    /// One for each block round the row, outermost first.
    loops: Vec<Count>,
}

/// A token on its way into a row.
struct Arrival {
    guard: Term,
    site: Site,
    row: Moved,
    loops: Vec<Moved>,
}

/// A count on its way.
#[derive(Clone, Copy, Debug)]
enum Moved {
    Fixed(u64),
    Term(Term),
}

/// Encodes the game of `automaton`; `None` where it would need more than a million holders.
pub fn encode(automaton: &Automaton, pool: &mut Pool, sites: &mut dyn Sites) -> Option<Encoding> {
    let crowded = meet::crowded(automaton, &mut |one, other| sites.compatible(one, other));
    let ends = automaton.open_ends();
    let no = pool.truth(false);
    let mut encoder = Encoder {
        kept: vec![[no, no]; ends.len()],
        ends,
        automaton,
        pool,
        sites,
        holders: Vec::new(),
        fits: std::collections::BTreeMap::new(),
    };
    for (leaf, crowded) in crowded.iter().enumerate() {
        encoder.add_holders(leaf, *crowded)?;
    }
    Some(encoder.encode())
}

struct Encoder<'a, 's> {
    automaton: &'a Automaton,
    pool: &'a mut Pool,
    sites: &'s mut dyn Sites,
    holders: Vec<Holder>,
    fits: std::collections::BTreeMap<Site, Term>,
    ends: Vec<OpenEnd>,
    /// For each open end, whether a word stays in it, and whether one leaves.
    kept: Vec<[Term; 2]>,
}

/// Whether a condition of the automaton asks for a count of the block.
fn loop_matters(automaton: &Automaton, index: usize) -> bool {
    let edges = automaton.edges.iter().flatten().chain(&automaton.entries);
    let mut conditions =
        edges.flat_map(|edge| edge.conditions.iter().chain(edge.rivals.iter().flat_map(|rival| &rival.conditions)));
    conditions.any(|condition| condition.counter == Counter::Loop(index))
}

/// What the edges of a leaf ask of its count: a lower bound, an upper bound, and something of a progress flag.
fn asked(edges: &[Edge]) -> (bool, bool, bool) {
    let of_row = |condition: &&Condition| condition.counter == Counter::Row;
    let conditions: Vec<Test> =
        edges.iter().flat_map(|edge| edge.conditions.iter().filter(of_row)).map(|condition| condition.test).collect();
    let low = conditions.iter().any(|test| matches!(test, Test::AtLeast(_)));
    let high = conditions.iter().any(|test| matches!(test, Test::Below(_)));
    let flag = edges.iter().flat_map(|edge| &edge.rivals).flat_map(|rival| &rival.conditions).any(|c| of_row(&c));
    (low, high, flag)
}

const fn bits(largest: u64) -> u32 {
    64 - largest.leading_zeros()
}

impl Encoder<'_, '_> {
    fn add_holders(&mut self, leaf: usize, crowded: bool) -> Option<()> {
        let automaton = self.automaton;
        let (low, high, flag) = asked(&automaton.edges[leaf]);
        let saturation = automaton.leaves[leaf].saturation;
        let row_matters = low || high || flag;
        let stack: Vec<Option<u64>> = automaton.leaves[leaf]
            .loops
            .iter()
            .map(|index| loop_matters(automaton, *index).then(|| automaton.loops[*index].saturation))
            .collect();
        if !crowded {
            let row = self.register(row_matters.then_some(saturation), leaf, "row");
            let loops = stack.iter().map(|largest| self.register(*largest, leaf, "block")).collect();
            self.hold(leaf, Keep::Only, row, loops);
            return Some(());
        }
        let mut combinations = vec![Vec::new()];
        for largest in &stack {
            let counts: Vec<Count> =
                largest.map_or_else(|| vec![Count::Ignored], |largest| (1..=largest).map(Count::Fixed).collect());
            if combinations.len().saturating_mul(counts.len()) > MAX_HOLDERS {
                return None;
            }
            let longer = |old: &Vec<Count>| counts.iter().map(|c| [old.as_slice(), &[*c]].concat()).collect::<Vec<_>>();
            combinations = combinations.iter().flat_map(longer).collect();
        }
        for loops in combinations {
            let keep = match (low, high, flag) {
                (false, true, false) => Some(Keep::Youngest),
                (true, false, false) => Some(Keep::Oldest),
                (false, false, false) => Some(Keep::Only),
                _ => None,
            };
            match keep {
                Some(keep) => {
                    let row = self.register(row_matters.then_some(saturation), leaf, "row");
                    self.hold(leaf, keep, row, loops);
                }
                None => {
                    if saturation as usize > MAX_HOLDERS - self.holders.len().min(MAX_HOLDERS) {
                        return None;
                    }
                    for count in 1..=saturation {
                        self.hold(leaf, Keep::Only, Count::Fixed(count), loops.clone());
                    }
                }
            }
        }
        Some(())
    }

    fn register(&mut self, largest: Option<u64>, leaf: usize, what: &str) -> Count {
        let Some(largest) = largest else { return Count::Ignored };
        let width = bits(largest);
        let name = format!("table.leaf{leaf}.{what}.{}", self.holders.len());
        Count::Kept(self.pool.variable(width, name), width)
    }

    fn hold(&mut self, leaf: usize, keep: Keep, row: Count, loops: Vec<Count>) {
        let active = self.pool.variable(1, format!("table.leaf{leaf}.live.{}", self.holders.len()));
        self.holders.push(Holder { leaf, keep, active, row, loops });
    }

    /// Whether the row's assumptions hold, asked once.
    fn fits(&mut self, site: Site) -> Term {
        if let Some(known) = self.fits.get(&site) {
            return *known;
        }
        let term = self.sites.inputs(self.pool, site);
        self.fits.insert(site, term);
        term
    }

    fn encode(mut self) -> Encoding {
        let start = self.pool.variable(1, "table.start");
        let arrivals = self.arrivals(start);
        let survivors = self.survivors(&arrivals);
        self.finish(start, &arrivals, survivors)
    }
}
