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

use super::edges::{Condition, Counter, Edge};
use super::{Automaton, Keeps, OpenEnd, Site, Target, Test, Update, meet};
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

    /// By leaf.
    fn arrivals(&mut self, start: Term) -> Vec<Vec<Arrival>> {
        let automaton = self.automaton;
        let mut arrivals: Vec<Vec<Arrival>> = automaton.leaves.iter().map(|_| Vec::new()).collect();
        if !automaton.may_be_empty {
            for edge in &automaton.entries {
                self.take(edge, start, None, &mut arrivals);
            }
        }
        for holder in 0..self.holders.len() {
            let (leaf, active) = (self.holders[holder].leaf, self.holders[holder].active);
            for edge in &automaton.edges[leaf] {
                self.take(edge, active, Some(holder), &mut arrivals);
            }
        }
        arrivals
    }

    /// Sends the token of a holder (at the beginning there is none) along an edge.
    fn take(&mut self, edge: &Edge, active: Term, from: Option<usize>, arrivals: &mut [Vec<Arrival>]) {
        let Some(site) = edge.site() else { return };
        let mut guard = active;
        if let Some(holder) = from {
            let allowed = self.conditions(holder, &edge.conditions);
            guard = self.pool.and(guard, allowed);
        }
        if self.pool.value(guard) == Some(0) {
            return;
        }
        let fits = self.fits(site);
        guard = self.pool.and(guard, fits);
        for rival in &edge.rivals {
            let there = self.fits(Site { leaf: rival.leaf, first: true });
            let allowed = match from {
                Some(holder) => self.conditions(holder, &rival.conditions),
                None => self.pool.truth(true),
            };
            let forced = self.pool.and(there, allowed);
            let free = self.pool.not(forced);
            guard = self.pool.and(guard, free);
        }
        if let Some(holder) = from {
            self.keep(edge, holder, guard);
        }
        let row = match (edge.target, from) {
            (Target::Stay(leaf), Some(holder)) => {
                self.successor(self.holders[holder].row, self.automaton.leaves[leaf].saturation)
            }
            _ => Moved::Fixed(1),
        };
        let loops = self.loops_after(edge, from, site.leaf);
        arrivals[site.leaf].push(Arrival { guard, site, row, loops });
    }

    /// Notes what the edge does to a word in an open end.
    fn keep(&mut self, edge: &Edge, holder: usize, guard: Term) {
        let leaf = self.holders[holder].leaf;
        for (end, known) in self.ends.iter().zip(&mut self.kept) {
            let moved = match self.automaton.keeps(*end, leaf, edge) {
                Some(Keeps::Stays) => &mut known[0],
                Some(Keeps::Leaves) => &mut known[1],
                Some(Keeps::Endless) | None => continue,
            };
            *moved = self.pool.or(*moved, guard);
        }
    }

    /// For each open end, that a word leaves it or none stays.
    fn fair(&mut self) -> Vec<Term> {
        let kept = std::mem::take(&mut self.kept);
        let fair = |[stays, leaves]: [Term; 2]| {
            let none = self.pool.not(stays);
            self.pool.or(leaves, none)
        };
        kept.into_iter().map(fair).collect()
    }

    fn loops_after(&mut self, edge: &Edge, from: Option<usize>, target: usize) -> Vec<Moved> {
        let automaton = self.automaton;
        let stack = &automaton.leaves[target].loops;
        let mut out = Vec::with_capacity(stack.len());
        for (at, index) in stack.iter().enumerate() {
            let old = from.and_then(|holder| self.holders[holder].loops.get(at).copied());
            let old = old.unwrap_or(Count::Fixed(1));
            let update = edge.updates.iter().find(|update| update.block() == *index);
            out.push(match update {
                None => match old {
                    Count::Fixed(count) => Moved::Fixed(count),
                    Count::Kept(term, _) => Moved::Term(term),
                    Count::Ignored => Moved::Fixed(1),
                },
                Some(Update::Begin(_)) => Moved::Fixed(1),
                Some(Update::Next(_)) => self.successor(old, automaton.loops[*index].saturation),
            });
        }
        out
    }

    /// One more, up to `saturation`.
    fn successor(&mut self, count: Count, saturation: u64) -> Moved {
        match count {
            Count::Ignored => Moved::Fixed(1),
            Count::Fixed(count) => Moved::Fixed((count + 1).min(saturation)),
            Count::Kept(term, width) => {
                let (one, largest) = (self.pool.constant(width, 1), self.pool.constant(width, saturation));
                let (full, more) = (self.pool.eq(term, largest), self.pool.add(term, one));
                Moved::Term(self.pool.ite(full, largest, more))
            }
        }
    }

    fn conditions(&mut self, holder: usize, conditions: &[Condition]) -> Term {
        let (leaf, row, loops) =
            (self.holders[holder].leaf, self.holders[holder].row, self.holders[holder].loops.clone());
        self.admits(leaf, row, &loops, conditions)
    }

    fn admits(&mut self, leaf: usize, row: Count, loops: &[Count], conditions: &[Condition]) -> Term {
        let mut all = self.pool.truth(true);
        for condition in conditions {
            let count = match condition.counter {
                Counter::Row => Some(row),
                Counter::Loop(index) => {
                    let at = self.automaton.leaves[leaf].loops.iter().position(|other| *other == index);
                    at.map(|at| loops[at])
                }
            };
            let holds = match count {
                Some(Count::Fixed(count)) => self.pool.truth(condition.test.admits(count)),
                Some(Count::Kept(term, width)) => self.test(term, width, condition.test),
                // A count that is asked for is kept; a block that is not round the row has none.
                Some(Count::Ignored) | None => self.pool.truth(false),
            };
            all = self.pool.and(all, holds);
        }
        all
    }

    fn test(&mut self, term: Term, width: u32, test: Test) -> Term {
        let (Test::AtLeast(bound) | Test::Below(bound)) = test;
        if bits(bound) > width {
            return self.pool.truth(matches!(test, Test::Below(_)));
        }
        let bound = self.pool.constant(width, bound);
        let below = self.pool.ult(term, bound);
        if matches!(test, Test::Below(_)) { below } else { self.pool.not(below) }
    }

    /// For each holder, whether it holds a token after the answer, and the counts of that token.
    fn survivors(&mut self, arrivals: &[Vec<Arrival>]) -> Vec<(Term, Count, Vec<Count>)> {
        let mut by_row: Vec<std::collections::BTreeMap<u64, Vec<usize>>> = Vec::new();
        for arrivals in arrivals {
            let mut index = std::collections::BTreeMap::<u64, Vec<usize>>::new();
            for (at, arrival) in arrivals.iter().enumerate() {
                if let Moved::Fixed(count) = arrival.row {
                    index.entry(count).or_default().push(at);
                }
            }
            by_row.push(index);
        }
        let holders = 0..self.holders.len();
        holders
            .map(|holder| {
                let (leaf, row) = (self.holders[holder].leaf, self.holders[holder].row);
                let here: Vec<&Arrival> = match row {
                    Count::Fixed(count) => {
                        by_row[leaf].get(&count).into_iter().flatten().map(|at| &arrivals[leaf][*at]).collect()
                    }
                    _ => arrivals[leaf].iter().collect(),
                };
                self.survivor(holder, &here)
            })
            .collect()
    }

    fn survivor(&mut self, holder: usize, arrivals: &[&Arrival]) -> (Term, Count, Vec<Count>) {
        let (keep, row) = (self.holders[holder].keep, self.holders[holder].row);
        let loops = self.holders[holder].loops.clone();
        let mut any = self.pool.truth(false);
        let mut row_after = self.nothing(row);
        let mut loops_after: Vec<Count> = loops.iter().map(|count| self.nothing(*count)).collect();
        for arrival in arrivals {
            let here = self.same_blocks(&loops, &arrival.loops);
            let answered = self.sites.outputs(self.pool, arrival.site);
            let alive = self.pool.and(arrival.guard, here);
            let alive = self.pool.and(alive, answered);
            if self.pool.value(alive) == Some(0) {
                continue;
            }
            let better = self.better(keep, alive, any, arrival.row, row_after);
            row_after = self.merge(better, arrival.row, row_after);
            for (after, moved) in loops_after.iter_mut().zip(&arrival.loops) {
                *after = self.merge(alive, *moved, *after);
            }
            any = self.pool.or(any, alive);
        }
        (any, row_after, loops_after)
    }

    fn nothing(&mut self, count: Count) -> Count {
        match count {
            Count::Kept(_, width) => Count::Kept(self.pool.constant(width, 0), width),
            other => other,
        }
    }

    /// Whether the counts of an arrival are those that a holder is for.
    fn same_blocks(&mut self, holder: &[Count], arrival: &[Moved]) -> Term {
        let mut same = self.pool.truth(true);
        for (count, moved) in holder.iter().zip(arrival) {
            let Count::Fixed(wanted) = *count else { continue };
            let equal = match *moved {
                Moved::Fixed(count) => self.pool.truth(count == wanted),
                Moved::Term(term) => {
                    let width = self.pool.width(term);
                    let wanted = self.pool.constant(width, wanted);
                    self.pool.eq(term, wanted)
                }
            };
            same = self.pool.and(same, equal);
        }
        same
    }

    /// Whether the arrival's count is the one to keep.
    fn better(&mut self, keep: Keep, alive: Term, any: Term, moved: Moved, after: Count) -> Term {
        let Count::Kept(known, width) = after else { return alive };
        let new = self.value(moved, width);
        let wins = match keep {
            Keep::Only => return alive,
            Keep::Youngest => self.pool.ult(new, known),
            Keep::Oldest => self.pool.ult(known, new),
        };
        let first = self.pool.not(any);
        let wins = self.pool.or(first, wins);
        self.pool.and(alive, wins)
    }

    fn value(&mut self, moved: Moved, width: u32) -> Term {
        match moved {
            Moved::Fixed(count) => self.pool.constant(width, count),
            Moved::Term(term) => term,
        }
    }

    fn merge(&mut self, guard: Term, moved: Moved, after: Count) -> Count {
        let Count::Kept(known, width) = after else { return after };
        let new = self.value(moved, width);
        Count::Kept(self.pool.ite(guard, new, known), width)
    }

    fn finish(mut self, start: Term, arrivals: &[Vec<Arrival>], survivors: Vec<(Term, Count, Vec<Count>)>) -> Encoding {
        let tried = self.tried(arrivals);
        let covered = self.pool.any(tried.iter().map(|(_, term)| *term));
        let alive = self.pool.any(survivors.iter().map(|(any, ..)| *any));
        let dead = self.pool.not(alive);
        let lost = self.pool.and(covered, dead);
        let mut ended = self.pool.truth(false);
        let mut live = vec![self.pool.truth(false); self.automaton.leaves.len()];
        for (holder, (any, row, loops)) in survivors.iter().enumerate() {
            let leaf = self.holders[holder].leaf;
            live[leaf] = self.pool.or(live[leaf], *any);
            let automaton = self.automaton;
            for edge in automaton.edges[leaf].iter().filter(|edge| edge.target == Target::End) {
                let allowed = self.admits(leaf, *row, loops, &edge.conditions);
                let here = self.pool.and(*any, allowed);
                ended = self.pool.or(ended, here);
            }
        }
        let states = self.states(start, ended, survivors);
        let active: Vec<Term> = self.holders.iter().map(|holder| holder.active).collect();
        let alive = self.pool.any(active);
        let fair = self.fair();
        Encoding { states, covered, lost, ended, live, alive, fair, tried }
    }

    fn tried(&mut self, arrivals: &[Vec<Arrival>]) -> Vec<(Site, Term)> {
        let mut tried = std::collections::BTreeMap::new();
        for arrival in arrivals.iter().flatten() {
            let known = tried.entry(arrival.site).or_insert_with(|| self.pool.truth(false));
            *known = self.pool.or(*known, arrival.guard);
        }
        tried.into_iter().collect()
    }

    fn states(&mut self, start: Term, ended: Term, survivors: Vec<(Term, Count, Vec<Count>)>) -> Vec<State> {
        let (yes, no) = (self.pool.truth(true), self.pool.truth(false));
        let state = |name: String, variable, initial, next| State {
            variable,
            name,
            initial: Some(initial),
            next,
            origin: None,
        };
        let mut states = vec![state("table.start".to_owned(), start, yes, no)];
        let open = self.pool.not(ended);
        for (holder, (any, row, loops)) in survivors.into_iter().enumerate() {
            let active = self.holders[holder].active;
            let next = self.pool.and(any, open);
            states.push(self.named(active, no, next));
            let kept: Vec<(Count, Count)> = std::iter::once((self.holders[holder].row, row))
                .chain(self.holders[holder].loops.iter().copied().zip(loops))
                .collect();
            for (before, after) in kept {
                if let (Count::Kept(variable, width), Count::Kept(next, _)) = (before, after) {
                    let zero = self.pool.constant(width, 0);
                    states.push(self.named(variable, zero, next));
                }
            }
        }
        states
    }

    fn named(&self, variable: Term, initial: Term, next: Term) -> State {
        let name = match self.pool.node(variable) {
            crate::logic::term::Node::Var(var) => self.pool.name(var).to_owned(),
            _ => String::new(),
        };
        State { variable, name, initial: Some(initial), next, origin: None }
    }
}
