//! The game of a table on the set of words that are still possible, each word by what is left of it.
//!
//! What is left of a word after some cycles is a list of rows and blocks with the counts of what has been done of them (a
//! *rest*); the words that begin alike share it. A cycle takes a rest to the rests behind it: the partial derivatives of
//! Antimirov (*Partial derivatives of regular expressions and finite automaton constructions*, 1996), written down from the
//! definition of `D(T)`. There are no edges, no conditions and no tokens, and nothing of the tool is used.

use std::collections::BTreeSet;

/// How often something is repeated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tau {
    pub(super) low: u32,
    pub(super) high: Option<u32>,
    /// For ever; the bounds do not count.
    pub(super) omega: bool,
    pub(super) flag: bool,
}

impl Tau {
    /// The count from which on larger ones are alike.
    fn cap(self) -> u32 {
        if self.omega { 1 } else { self.high.unwrap_or(self.low.max(1)) }
    }

    fn more(self, count: u32) -> bool {
        self.omega || self.high.is_none_or(|high| count < high)
    }

    /// Without an upper bound, and not for ever.
    fn unbounded(self) -> bool {
        !self.omega && self.high.is_none()
    }

    pub(super) fn text(self) -> String {
        let flag = if self.flag { " p" } else { "" };
        match (self.omega, self.high) {
            (true, _) => "-∞".to_owned(),
            (_, None) => format!(">= {}{flag}", self.low),
            (_, Some(high)) => format!("[{},{high}]{flag}", self.low),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Item {
    /// A row that has been done so often.
    Row(usize, u32),
    /// A block of which so many iterations are over.
    Block(usize, u32),
    /// A block whose next iteration has begun, and has had no cycle yet.
    Begun(usize, u32),
}

/// What is left of a word.
pub(super) type Rest = Vec<Item>;

/// A table's tree.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub(super) rows: Vec<Tau>,
    pub(super) blocks: Vec<(Tau, Vec<Item>)>,
    pub(super) top: Vec<Item>,
}

/// One more cycle of a word.
struct Move {
    row: usize,
    first: bool,
    rest: Rest,
    /// Which item of the rest had the cycle.
    at: usize,
    /// The word goes if the inputs of one of these rows, in its first cycle, fit.
    rivals: Vec<usize>,
}

/// What a row asks in a cycle, its first one or a later one.
pub(super) trait Letter {
    fn inputs(&self, row: usize, first: bool) -> bool;
    fn outputs(&self, row: usize, first: bool) -> bool;
}

/// How the game stands after a cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Uncovered,
    Lost,
    Ended,
    /// The words left; of the repetitions without an upper bound (a bit each), those that the inputs did not keep a word
    /// in: they let one leave, or none went on within.
    Open(BTreeSet<Rest>, u32),
}

impl Tree {
    fn lasts(&self, item: Item) -> bool {
        match item {
            Item::Row(row, _) => self.rows[row].omega || self.rows[row].high != Some(0),
            Item::Block(block, _) | Item::Begun(block, _) => {
                let (tau, body) = &self.blocks[block];
                (tau.omega || tau.high != Some(0)) && body.iter().any(|item| self.lasts(*item))
            }
        }
    }

    /// The least number of iterations: none where one may be without a cycle.
    fn low(&self, block: usize) -> u32 {
        let (tau, body) = &self.blocks[block];
        if body.iter().all(|item| self.may_end(*item)) { 0 } else { tau.low }
    }

    /// Whether nothing more need come of it.
    fn may_end(&self, item: Item) -> bool {
        if !self.lasts(item) {
            return true;
        }
        match item {
            Item::Row(row, count) => !self.rows[row].omega && count >= self.rows[row].low,
            Item::Block(block, count) => !self.blocks[block].0.omega && count >= self.low(block),
            // An iteration without a cycle is over at once, but what is for ever is not left for that.
            Item::Begun(block, _) => !self.blocks[block].0.omega,
        }
    }

    /// `rest` behind a cycle in front of it: iterations that had begun have had one.
    fn after(&self, rest: &[Item]) -> impl Iterator<Item = Item> {
        let done = |item: &Item| match *item {
            Item::Begun(block, count) => Item::Block(block, (count + 1).min(self.blocks[block].0.cap())),
            other => other,
        };
        rest.iter().map(done).collect::<Vec<_>>().into_iter()
    }

    /// The next cycles that the first `within` items of a rest can have.
    fn moves(&self, rest: &[Item], within: usize) -> Vec<Move> {
        let mut out = Vec::new();
        for at in 0..within {
            let behind = &rest[at + 1..];
            match rest[at] {
                Item::Row(row, count) => {
                    let tau = self.rows[row];
                    if tau.more(count) && self.lasts(rest[at]) {
                        let rivals = if tau.flag && count >= tau.low { self.firsts(behind) } else { Vec::new() };
                        let mut next = vec![Item::Row(row, (count + 1).min(tau.cap()))];
                        next.extend(self.after(behind));
                        out.push(Move { row, first: count == 0, rest: next, at, rivals });
                    }
                }
                Item::Block(block, count) => {
                    let (tau, body) = &self.blocks[block];
                    if tau.more(count) && self.lasts(rest[at]) {
                        let again = tau.flag && count > 0 && count >= self.low(block);
                        let rivals = if again { self.firsts(behind) } else { Vec::new() };
                        let inner: Rest = body
                            .iter()
                            .copied()
                            .chain([Item::Begun(block, count)])
                            .chain(behind.iter().copied())
                            .collect();
                        for mut one in self.moves(&inner, body.len()) {
                            one.rivals.extend(&rivals);
                            out.push(Move { at, ..one });
                        }
                    }
                }
                Item::Begun(..) => {}
            }
            if !self.may_end(rest[at]) {
                break;
            }
        }
        out
    }

    /// The rows that could come next.
    fn firsts(&self, rest: &[Item]) -> Vec<usize> {
        self.moves(rest, rest.len()).into_iter().map(|one| one.row).collect()
    }

    fn over(&self, rest: &[Item]) -> bool {
        rest.iter().all(|item| self.may_end(*item))
    }

    /// All words; `None` where one is empty, so that the end is reached at once.
    pub(super) fn begin(&self) -> Option<BTreeSet<Rest>> {
        (!self.over(&self.top)).then(|| BTreeSet::from([self.top.clone()]))
    }

    /// A bit for each repetition without an upper bound: rows, then blocks.
    pub(super) fn units(&self) -> u32 {
        let rows = self.rows.iter().map(|tau| tau.unbounded());
        let bits = rows.chain(self.blocks.iter().map(|(tau, _)| tau.unbounded())).enumerate();
        bits.map(|(bit, unit)| u32::from(unit) << bit).sum()
    }

    /// The unbounded repetitions that what has been done of `rest` is in, and where in it they stand.
    fn inside(&self, rest: &[Item]) -> Vec<(usize, u32)> {
        let unit = |(at, item): (usize, &Item)| match *item {
            Item::Row(row, count) => (count > 0 && self.rows[row].unbounded()).then_some((at, 1 << row)),
            Item::Block(block, count) => {
                let bit = 1 << (self.rows.len() + block);
                (count > 0 && self.blocks[block].0.unbounded()).then_some((at, bit))
            }
            Item::Begun(..) => None,
        };
        rest.iter().enumerate().filter_map(unit).collect()
    }

    /// Whether some word ends.
    pub(super) fn ends(&self) -> bool {
        self.top.iter().all(|item| self.can_end(*item))
    }

    fn can_end(&self, item: Item) -> bool {
        if self.may_end(item) {
            return true;
        }
        match item {
            Item::Row(row, _) => !self.rows[row].omega,
            Item::Block(block, _) | Item::Begun(block, _) => {
                let (tau, body) = &self.blocks[block];
                !tau.omega && body.iter().all(|item| self.can_end(*item))
            }
        }
    }

    /// Whether what has been done of `rest` is in something for ever, within the unbounded repetition `unit`.
    fn is_endless(&self, rest: &[Item], unit: u32) -> bool {
        let inner = rest.iter().take_while(|item| match **item {
            Item::Row(row, _) => 1 << row != unit,
            Item::Block(block, _) | Item::Begun(block, _) => 1 << (self.rows.len() + block) != unit,
        });
        inner.into_iter().any(|item| match *item {
            Item::Row(row, count) => count > 0 && self.rows[row].omega,
            Item::Block(block, count) => count > 0 && self.blocks[block].0.omega,
            Item::Begun(..) => false,
        })
    }

    /// Plays a cycle.
    pub(super) fn play(&self, words: &BTreeSet<Rest>, letter: &dyn Letter) -> Outcome {
        let (mut covered, mut left) = (false, BTreeSet::new());
        let (mut stay, mut leave) = (0, 0);
        for word in words {
            let units = self.inside(word);
            for one in self.moves(word, word.len()) {
                let forced = |row: &usize| letter.inputs(*row, true);
                if !letter.inputs(one.row, one.first) || one.rivals.iter().any(forced) {
                    continue;
                }
                covered = true;
                for (at, unit) in &units {
                    if one.at > *at {
                        leave |= unit;
                    } else if !self.is_endless(&one.rest, *unit) {
                        stay |= unit;
                    }
                }
                if letter.outputs(one.row, one.first) {
                    left.insert(one.rest);
                }
            }
        }
        if !covered {
            Outcome::Uncovered
        } else if left.is_empty() {
            Outcome::Lost
        } else if left.iter().any(|rest| self.over(rest)) {
            Outcome::Ended
        } else {
            Outcome::Open(left, self.units() & (leave | !stay))
        }
    }
}
