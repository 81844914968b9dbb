//! Ways through the automaton: shortest ones to a row and from there to the end, by breadth-first search over rows and the
//! counts of the blocks round them.

use std::collections::{BTreeMap, VecDeque};

use super::mixed;
use crate::table::automaton::{Automaton, Condition, Counter, Edge, Rival, Target, Update};
use crate::table::duration::Repeat;

/// A way.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) visits: Vec<Visit>,
}

/// A row on the way.
#[derive(Clone, Debug)]
pub(super) struct Visit {
    pub(super) leaf: usize,
    pub(super) cycles: u64,
    /// Rows whose inputs must not fit where it is entered.
    pub(super) entry: Vec<Rival>,
    /// The numbers of the iterations of the blocks round it.
    pub(super) loops: Vec<u64>,
    /// The same of the row before it, for what its edge's rivals ask.
    before: Option<(usize, u64, Vec<u64>)>,
}

/// A row and the iterations of its blocks.
type Place = (usize, Vec<u64>);

pub(super) struct Planner<'a> {
    pub(super) automaton: &'a Automaton,
    pub(super) forever: u64,
}

/// More places than this are not searched.
const MAX_PLACES: usize = 20_000;

/// No drawn way is longer.
const MAX_VISITS: usize = 60;

impl Visit {
    /// The rows whose inputs must not fit when it is entered: a progress flag would have forbidden it.
    pub(super) fn forbidden(&self, automaton: &Automaton) -> Vec<usize> {
        let holds = |rival: &&Rival| match &self.before {
            None => true,
            Some((leaf, count, loops)) => rival.conditions.iter().all(|c| admits(automaton, c, *leaf, *count, loops)),
        };
        self.entry.iter().filter(holds).map(|rival| rival.leaf).collect()
    }
}

/// Whether the counts satisfy the condition.
pub(super) fn admits(automaton: &Automaton, condition: &Condition, leaf: usize, count: u64, loops: &[u64]) -> bool {
    let count = match condition.counter {
        Counter::Row => Some(count),
        Counter::Loop(index) => {
            let at = automaton.leaves[leaf].loops.iter().position(|other| *other == index);
            at.and_then(|at| loops.get(at).copied())
        }
    };
    count.is_some_and(|count| condition.test.admits(count))
}

impl Planner<'_> {
    /// The shortest and the longest that a row lasts.
    fn bounds(&self, leaf: usize) -> (u64, u64) {
        match self.automaton.leaves[leaf].repeat {
            Repeat::Omega => (self.forever.max(1), self.forever.max(1)),
            Repeat::Times { low, high: Some(high) } => (low.max(1), high),
            Repeat::Times { low, high: None } => (low.max(1), low.max(1) + self.forever.max(1)),
        }
    }

    fn loops_after(&self, edge: &Edge, from: &[u64], target: usize) -> Vec<u64> {
        let stack = self.automaton.leaves[target].loops.iter().enumerate();
        let count = |(at, index): (usize, &usize)| {
            let old = from.get(at).copied().unwrap_or(1);
            match edge.updates.iter().find(|update| update.block() == *index) {
                None => old,
                Some(Update::Begin(_)) => 1,
                Some(Update::Next(_)) => (old + 1).min(self.automaton.loops[*index].saturation),
            }
        };
        stack.map(count).collect()
    }

    /// The visits that may follow, with their shortest durations; and whether the way may end.
    fn next(&self, visit: Option<&Visit>) -> (Vec<Visit>, bool) {
        let edges = visit.map_or(&self.automaton.entries, |visit| &self.automaton.edges[visit.leaf]);
        let mut ends = false;
        let mut out = Vec::new();
        for edge in edges {
            let fits = visit
                .is_none_or(|v| edge.conditions.iter().all(|c| admits(self.automaton, c, v.leaf, v.cycles, &v.loops)));
            match edge.target {
                _ if !fits => {}
                Target::End => ends = true,
                Target::Stay(_) => {}
                Target::Enter(leaf) => out.push(Visit {
                    leaf,
                    cycles: self.bounds(leaf).0,
                    entry: edge.rivals.clone(),
                    loops: self.loops_after(edge, visit.map_or(&[], |visit| &visit.loops), leaf),
                    before: visit.map(|visit| (visit.leaf, visit.cycles, visit.loops.clone())),
                }),
            }
        }
        (out, ends)
    }

    /// The shortest way from behind `from` to a visit that `goal` accepts, which may be `from` itself.
    fn search(&self, from: Option<Visit>, goal: &dyn Fn(&Visit) -> bool) -> Option<Vec<Visit>> {
        let mut came: BTreeMap<Place, (Option<Place>, Visit)> = BTreeMap::new();
        let mut queue: VecDeque<Visit> = VecDeque::new();
        if let Some(from) = &from
            && goal(from)
        {
            return Some(Vec::new());
        }
        let start = from.as_ref().map(|visit| (visit.leaf, visit.loops.clone()));
        let mut current = from;
        loop {
            let before = current.as_ref().map(|visit| (visit.leaf, visit.loops.clone()));
            for visit in self.next(current.as_ref()).0 {
                let place = (visit.leaf, visit.loops.clone());
                if start.as_ref() == Some(&place) || came.contains_key(&place) || came.len() > MAX_PLACES {
                    continue;
                }
                came.insert(place.clone(), (before.clone(), visit.clone()));
                if goal(&visit) {
                    return Some(back(&came, place));
                }
                queue.push_back(visit);
            }
            current = Some(queue.pop_front()?);
        }
    }

    fn may_end(&self, visit: &Visit) -> bool {
        self.next(Some(visit)).1 || self.automaton.leaves[visit.leaf].repeat == Repeat::Omega
    }

    /// The rest of a way to the end of the table, or into a row that lasts for ever; as far as it goes where there is neither.
    fn finished(&self, mut visits: Vec<Visit>) -> Plan {
        if let Some(last) = visits.last().cloned()
            && let Some(rest) = self.search(Some(last), &|visit| self.may_end(visit))
        {
            visits.extend(rest);
        }
        Plan { visits }
    }

    /// Ways such that every row that can be reached is on one of them.
    pub(super) fn ways(&self) -> Vec<Plan> {
        let mut out: Vec<Plan> = Vec::new();
        for leaf in 0..self.automaton.leaves.len() {
            if out.iter().any(|plan| plan.visits.iter().any(|visit| visit.leaf == leaf)) {
                continue;
            }
            if let Some(visits) = self.search(None, &|visit| visit.leaf == leaf) {
                out.push(self.finished(visits));
            }
        }
        out
    }

    /// One way through as many rows as it meets: from each on to the first one that it has not seen.
    pub(super) fn tour(&self) -> Plan {
        let mut visits: Vec<Visit> = Vec::new();
        while visits.len() < MAX_VISITS {
            let last = visits.last();
            let unseen = |leaf: &usize| !visits.iter().any(|visit| visit.leaf == *leaf);
            let mut ways = (0..self.automaton.leaves.len())
                .filter(unseen)
                .filter_map(|leaf| self.search(last.cloned(), &|visit| visit.leaf == leaf));
            match ways.next() {
                Some(more) => visits.extend(more),
                None => break,
            }
        }
        self.finished(visits)
    }

    /// The same way, where each visit lasts up to `cycles` if it may.
    pub(super) fn lasting(&self, plan: &Plan, cycles: u64) -> Plan {
        self.timed(plan, &|_, (low, high)| low.max(cycles.min(high)))
    }

    /// Ways such that every row is on one of them for its shortest and on one for its longest time.
    pub(super) fn covering(&self) -> Vec<Plan> {
        let mut out: Vec<Plan> = Vec::new();
        for leaf in 0..self.automaton.leaves.len() {
            let (low, high) = self.bounds(leaf);
            for cycles in [low, high] {
                let there = |plan: &Plan| plan.visits.iter().any(|v| v.leaf == leaf && v.cycles == cycles);
                if out.iter().any(there) {
                    continue;
                }
                if let Some(mut visits) = self.search(None, &|visit| visit.leaf == leaf) {
                    if let Some(last) = visits.last_mut() {
                        last.cycles = cycles;
                    }
                    out.push(self.finished(visits));
                }
            }
        }
        out
    }

    /// The same way, where the visits that `long` says last their longest time. A visit that could not be left then keeps its own.
    pub(super) fn stretched(&self, plan: &Plan, long: &dyn Fn(usize) -> bool) -> Plan {
        self.timed(plan, &|at, (low, high)| if long(at) { high } else { low })
    }

    fn timed(&self, plan: &Plan, cycles: &dyn Fn(usize, (u64, u64)) -> u64) -> Plan {
        let mut plan = plan.clone();
        for at in 0..plan.visits.len() {
            plan.visits[at].cycles = cycles(at, self.bounds(plan.visits[at].leaf));
            let (leaf, cycles, loops) = (plan.visits[at].leaf, plan.visits[at].cycles, plan.visits[at].loops.clone());
            if let Some(next) = plan.visits.get_mut(at + 1) {
                next.before = Some((leaf, cycles, loops));
            }
        }
        plan
    }

    /// A way that is drawn.
    pub(super) fn drawn(&self, seed: u64) -> Option<Plan> {
        let mut visits: Vec<Visit> = Vec::new();
        let mut state = seed;
        let mut draw = |below: u64| {
            state = mixed(state);
            if below == 0 { 0 } else { state % below }
        };
        while visits.len() < MAX_VISITS {
            let (mut choices, ends) = self.next(visits.last());
            let all = choices.len() as u64 + u64::from(ends);
            let choice = draw(all);
            if choices.is_empty() || choice >= choices.len() as u64 {
                break;
            }
            let mut visit = choices.swap_remove(usize::try_from(choice).unwrap_or(0));
            let (low, high) = self.bounds(visit.leaf);
            visit.cycles = low + draw(high - low + 1);
            visits.push(visit);
        }
        let unfinished = visits.last().is_some_and(|last| !self.may_end(last));
        match visits.is_empty() {
            true => None,
            false if unfinished => Some(self.finished(visits)),
            false => Some(Plan { visits }),
        }
    }
}

/// The visits on the way to `place`.
fn back(came: &BTreeMap<Place, (Option<Place>, Visit)>, place: Place) -> Vec<Visit> {
    let mut out = Vec::new();
    let mut at = Some(place);
    while let Some((before, visit)) = at.as_ref().and_then(|place| came.get(place)) {
        out.push(visit.clone());
        at = before.clone();
    }
    out.reverse();
    out
}
