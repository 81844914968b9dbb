//! The game of conformance, played cycle by cycle on the automaton.
//!
//! The caller judges the constraints; the game keeps the live tokens and says who has won.

use std::collections::BTreeMap;

use super::ranges::Ranges;
use super::{Automaton, Condition, Counter, Edge, Keeps, OpenEnd, Rival, Site, Target, Test, Update};

/// Whether a row's constraints hold in the cycle that is played.
pub trait Judge {
    /// Whether the input constraint holds.
    fn inputs_fit(&mut self, site: Site) -> bool;
    /// Whether the output constraint holds.
    fn outputs_fit(&mut self, site: Site) -> bool;
}

/// How the game stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It goes on.
    Open,
    /// The system has won: the inputs are not those of the table any more.
    Uncovered,
    /// The system has won: the end of the table is reached.
    Ended,
    /// The system has lost.
    Lost {
        /// The rows whose inputs fitted and whose outputs did not, in the cycle that was lost.
        rows: Vec<Site>,
    },
}

/// A game in progress.
#[derive(Clone, Debug)]
pub struct Game<'a> {
    automaton: &'a Automaton,
    tokens: Vec<Tokens>,
    cycle: u64,
    standing: Standing,
    ends: Vec<OpenEnd>,
    fair: Vec<bool>,
}

/// The live tokens of a row: for each choice of the blocks' counts, the counts of the row.
type Tokens = BTreeMap<Vec<u64>, Ranges>;

impl<'a> Game<'a> {
    /// A game before its first cycle. A table that may be empty has reached its end already.
    #[must_use]
    pub fn new(automaton: &'a Automaton) -> Self {
        let standing = if automaton.may_be_empty { Standing::Ended } else { Standing::Open };
        let ends = automaton.open_ends();
        let tokens = vec![Tokens::new(); automaton.leaves.len()];
        Self { automaton, tokens, cycle: 0, standing, fair: vec![true; ends.len()], ends }
    }

    /// How it stands.
    #[must_use]
    pub const fn standing(&self) -> &Standing {
        &self.standing
    }

    /// How many cycles have been played.
    #[must_use]
    pub const fn cycle(&self) -> u64 {
        self.cycle
    }

    /// The rows that may be the current one, as leaves.
    #[must_use]
    pub fn live(&self) -> Vec<usize> {
        (0..self.tokens.len()).filter(|leaf| !self.tokens[*leaf].is_empty()).collect()
    }

    /// For each of [`Automaton::open_ends`], that the environment did not stay in it in the cycle played last.
    #[must_use]
    pub fn fair(&self) -> &[bool] {
        &self.fair
    }

    /// Whether the same words are possible.
    #[must_use]
    pub fn same_words(&self, other: &Self) -> bool {
        self.tokens == other.tokens
    }

    /// How many ranges of counts the live tokens take; what a cycle costs is in proportion.
    #[must_use]
    pub fn weight(&self) -> usize {
        self.tokens.iter().flat_map(BTreeMap::values).map(|ranges| ranges.iter().count()).sum()
    }

    /// Plays one cycle, unless the game is over.
    pub fn play(&mut self, judge: &mut dyn Judge) -> &Standing {
        if self.standing != Standing::Open {
            return &self.standing;
        }
        let round = Round {
            automaton: self.automaton,
            judge,
            inputs: BTreeMap::new(),
            moved: BTreeMap::new(),
            kept: self.ends.iter().map(|end| (*end, [false; 2])).collect(),
        };
        let (moved, fair) = round.play(&self.tokens, self.cycle == 0);
        self.fair = fair;
        self.cycle += 1;
        self.standing = match moved {
            Moved::Uncovered => Standing::Uncovered,
            Moved::Lost(rows) => Standing::Lost { rows },
            Moved::Alive(tokens) => {
                self.tokens = tokens;
                if self.at_end() { Standing::Ended } else { Standing::Open }
            }
        };
        &self.standing
    }

    /// Whether a word of exactly the length played is still possible.
    fn at_end(&self) -> bool {
        let ends = |leaf: usize, edge: &Edge, loops: &[u64], counts: &Ranges| {
            edge.target == Target::End && !self.automaton.admitted(&edge.conditions, leaf, loops, counts).is_empty()
        };
        self.tokens.iter().enumerate().any(|(leaf, tokens)| {
            let edges = &self.automaton.edges[leaf];
            tokens.iter().any(|(loops, counts)| edges.iter().any(|edge| ends(leaf, edge, loops, counts)))
        })
    }
}

impl Automaton {
    /// The block's count in a token of `leaf`, whose blocks' counts are `loops`.
    fn loop_count(&self, leaf: usize, loops: &[u64], index: usize) -> Option<u64> {
        let at = self.leaves[leaf].loops.iter().position(|other| *other == index)?;
        loops.get(at).copied()
    }

    /// The range of the row's counts that `conditions` admit; `None` where a block's count does not fit.
    fn range(&self, conditions: &[Condition], leaf: usize, loops: &[u64]) -> Option<(u64, u64)> {
        let (mut low, mut high) = (1, u64::MAX);
        for condition in conditions {
            match (condition.counter, condition.test) {
                (Counter::Row, Test::AtLeast(bound)) => low = low.max(bound),
                (Counter::Row, Test::Below(bound)) => high = high.min(bound.checked_sub(1)?),
                (Counter::Loop(index), test) => {
                    if !test.admits(self.loop_count(leaf, loops, index)?) {
                        return None;
                    }
                }
            }
        }
        (low <= high).then_some((low, high))
    }

    /// Those of `counts` that `conditions` admit.
    fn admitted(&self, conditions: &[Condition], leaf: usize, loops: &[u64], counts: &Ranges) -> Ranges {
        self.range(conditions, leaf, loops).map_or_else(Ranges::default, |(low, high)| counts.between(low, high))
    }

    /// The counts of the blocks round `target` after the edge.
    fn counts_after(&self, edge: &Edge, from: &[u64], target: usize) -> Vec<u64> {
        let stack = &self.leaves[target].loops;
        let count = |(at, index): (usize, &usize)| {
            let old = from.get(at).copied().unwrap_or(1);
            let update =
                edge.updates.iter().find(|update| matches!(update, Update::Begin(i) | Update::Next(i) if i == index));
            match update {
                None => old,
                Some(Update::Begin(_)) => 1,
                Some(Update::Next(_)) => (old + 1).min(self.loops[*index].saturation),
            }
        };
        stack.iter().enumerate().map(count).collect()
    }
}

enum Moved {
    Uncovered,
    Lost(Vec<Site>),
    Alive(Vec<Tokens>),
}

/// One cycle: each constraint is judged once.
struct Round<'a, 'j> {
    automaton: &'a Automaton,
    judge: &'j mut dyn Judge,
    inputs: BTreeMap<Site, bool>,
    /// The tokens whose inputs fit, by where they are.
    moved: BTreeMap<Site, Tokens>,
    /// For each open end, whether a word stays in it, and whether one leaves.
    kept: Vec<(OpenEnd, [bool; 2])>,
}

impl Round<'_, '_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        if let Some(known) = self.inputs.get(&site) {
            return *known;
        }
        let fits = self.judge.inputs_fit(site);
        self.inputs.insert(site, fits);
        fits
    }

    fn play(mut self, tokens: &[Tokens], first: bool) -> (Moved, Vec<bool>) {
        let automaton = self.automaton;
        if first {
            for edge in &automaton.entries {
                self.take(edge, None, &[], &Ranges::one(1));
            }
        }
        for (leaf, tokens) in tokens.iter().enumerate() {
            for (loops, counts) in tokens {
                for edge in &automaton.edges[leaf] {
                    self.take(edge, Some(leaf), loops, counts);
                }
            }
        }
        let fair = self.kept.iter().map(|(_, [stays, leaves])| *leaves || !stays).collect();
        (self.answer(), fair)
    }

    /// Moves the tokens of one place along one edge.
    fn take(&mut self, edge: &Edge, from: Option<usize>, loops: &[u64], counts: &Ranges) {
        let Some(site) = edge.site() else { return };
        let counts = match from {
            Some(leaf) => self.automaton.admitted(&edge.conditions, leaf, loops, counts),
            None => counts.clone(),
        };
        if counts.is_empty() || !self.inputs_fit(site) {
            return;
        }
        let counts = self.not_forced(&edge.rivals, from, loops, counts);
        if counts.is_empty() {
            return;
        }
        for (end, known) in &mut self.kept {
            match from.and_then(|leaf| self.automaton.keeps(*end, leaf, edge)) {
                Some(Keeps::Stays) => known[0] = true,
                Some(Keeps::Leaves) => known[1] = true,
                Some(Keeps::Endless) | None => {}
            }
        }
        let (loops, counts) = match edge.target {
            Target::Stay(leaf) => (loops.to_vec(), counts.next(self.automaton.leaves[leaf].saturation)),
            _ => (self.automaton.counts_after(edge, loops, site.leaf), Ranges::one(1)),
        };
        self.moved.entry(site).or_default().entry(loops).or_default().union(&counts);
    }

    /// The counts at which no progress flag forbids the edge.
    fn not_forced(&mut self, rivals: &[Rival], from: Option<usize>, loops: &[u64], mut counts: Ranges) -> Ranges {
        for rival in rivals {
            let range = match from {
                Some(leaf) => self.automaton.range(&rival.conditions, leaf, loops),
                None => Some((1, u64::MAX)),
            };
            let Some((low, high)) = range else { continue };
            if counts.meets(low, high) && self.inputs_fit(Site { leaf: rival.leaf, first: true }) {
                let mut free = counts.between(0, low - 1);
                if high < u64::MAX {
                    free.union(&counts.between(high + 1, u64::MAX));
                }
                counts = free;
            }
        }
        counts
    }

    /// What is left once the system has answered.
    fn answer(self) -> Moved {
        if self.moved.is_empty() {
            return Moved::Uncovered;
        }
        let mut alive = vec![Tokens::new(); self.automaton.leaves.len()];
        let (mut lost, mut any) = (Vec::new(), false);
        for (site, tokens) in self.moved {
            if !self.judge.outputs_fit(site) {
                lost.push(site);
                continue;
            }
            any = true;
            for (loops, counts) in tokens {
                alive[site.leaf].entry(loops).or_default().union(&counts);
            }
        }
        if any { Moved::Alive(alive) } else { Moved::Lost(lost) }
    }
}
