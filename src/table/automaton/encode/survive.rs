//! Which tokens are left after the answer, what that says of the game, and what is kept of them.

use std::collections::BTreeMap;

use super::{Arrival, Count, Encoder, Encoding, Keep, Moved};
use crate::logic::system::State;
use crate::logic::term::{Node, Term};
use crate::table::automaton::{Site, Target};

/// Whether a holder holds a token, and the counts of that token.
type Survivor = (Term, Count, Vec<Count>);

impl Encoder<'_, '_> {
    /// For each holder, whether it holds a token after the answer, and the counts of that token.
    pub(super) fn survivors(&mut self, arrivals: &[Vec<Arrival>]) -> Vec<Survivor> {
        let mut by_row: Vec<BTreeMap<u64, Vec<usize>>> = Vec::new();
        for arrivals in arrivals {
            let mut index = BTreeMap::<u64, Vec<usize>>::new();
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

    fn survivor(&mut self, holder: usize, arrivals: &[&Arrival]) -> Survivor {
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

    pub(super) fn finish(mut self, start: Term, arrivals: &[Vec<Arrival>], survivors: Vec<Survivor>) -> Encoding {
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
        let mut tried = BTreeMap::new();
        for arrival in arrivals.iter().flatten() {
            let known = tried.entry(arrival.site).or_insert_with(|| self.pool.truth(false));
            *known = self.pool.or(*known, arrival.guard);
        }
        tried.into_iter().collect()
    }

    fn states(&mut self, start: Term, ended: Term, survivors: Vec<Survivor>) -> Vec<State> {
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
            Node::Var(var) => self.pool.name(var).to_owned(),
            _ => String::new(),
        };
        State { variable, name, initial: Some(initial), next, origin: None }
    }
}
