//! The search: propagation, conflict analysis, decisions, restarts.

use super::{NONE, Solver, Watch};
use crate::logic::aig::Lit;

/// The reluctant doubling sequence 1 1 2 1 1 2 4 …, at `index` from 1.
fn luby(index: u64) -> u64 {
    let mut index = index;
    loop {
        let bits = 64 - index.leading_zeros();
        if index == (1 << bits) - 1 {
            return 1 << (bits - 1);
        }
        index -= (1 << (bits - 1)) - 1;
    }
}

impl Solver {
    /// Draws conclusions; the clause that fails, or `NONE`.
    pub(super) fn propagate(&mut self) -> u32 {
        while self.head < self.trail.len() {
            let falsified = !self.trail[self.head];
            self.head += 1;
            let mut list = std::mem::take(&mut self.watches[falsified.0 as usize]);
            self.ticks += 1 + list.len() as u64 / 4;
            let conflict = self.visit(&mut list, falsified);
            self.watches[falsified.0 as usize] = list;
            if conflict != NONE {
                self.head = self.trail.len();
                return conflict;
            }
        }
        NONE
    }

    fn visit(&mut self, list: &mut Vec<Watch>, falsified: Lit) -> u32 {
        let (mut from, mut to) = (0, 0);
        let mut conflict = NONE;
        while from < list.len() {
            let watch = list[from];
            from += 1;
            let blocker = watch.blocker;
            if self.value_of(blocker) > 0 || (self.confined && !self.inside[blocker.node() as usize]) {
                list[to] = watch;
                to += 1;
                continue;
            }
            let clause = watch.clause;
            if self.lit(clause, 0) == falsified {
                self.swap(clause, 0, 1);
            }
            let first = self.lit(clause, 0);
            let kept = Watch { clause, blocker: first };
            if first != blocker && self.value_of(first) > 0 {
                list[to] = kept;
                to += 1;
                continue;
            }
            if let Some(at) = (2..self.size(clause)).find(|&at| self.value_of(self.lit(clause, at)) >= 0) {
                self.swap(clause, 1, at);
                let lit = self.lit(clause, 1);
                self.watches[lit.0 as usize].push(kept);
                continue;
            }
            list[to] = kept;
            to += 1;
            if self.value_of(first) < 0 {
                conflict = clause;
                break;
            }
            self.assign(first, clause);
        }
        if to < from {
            list.drain(to..from);
        }
        conflict
    }

    fn bump(&mut self, var: u32) {
        self.activity[var as usize] += self.step;
        if self.activity[var as usize] > 1e100 {
            self.activity.iter_mut().for_each(|a| *a *= 1e-100);
            self.step *= 1e-100;
        }
        self.heap.bumped(var, &self.activity);
    }

    /// The first unique implication point: the clause to learn, asserting literal first, and the level to go back to.
    fn analyze(&mut self, mut conflict: u32) -> (Vec<Lit>, usize) {
        let current = self.levels.len() as u32;
        let mut learnt = vec![Lit::FALSE];
        let mut open = 0;
        let mut at = self.trail.len();
        let mut skip = 0;
        self.note_resolved(NONE, conflict);
        loop {
            for index in skip..self.size(conflict) {
                let lit = self.lit(conflict, index);
                let var = lit.node();
                if !self.seen[var as usize] && self.level[var as usize] > 0 {
                    self.seen[var as usize] = true;
                    self.bump(var);
                    if self.level[var as usize] == current {
                        open += 1;
                    } else {
                        learnt.push(lit);
                    }
                }
            }
            let lit = loop {
                at -= 1;
                let lit = self.trail[at];
                if self.seen[lit.node() as usize] {
                    break lit;
                }
            };
            self.seen[lit.node() as usize] = false;
            open -= 1;
            if open == 0 {
                learnt[0] = !lit;
                break;
            }
            conflict = self.reason[lit.node() as usize];
            self.note_resolved(lit.node(), conflict);
            skip = 1;
        }
        self.minimize(&mut learnt);
        self.note_learnt();
        let back = self.second_highest(&mut learnt);
        (learnt, back)
    }

    fn minimize(&mut self, learnt: &mut Vec<Lit>) {
        let marked: Vec<Lit> = learnt[1..].to_vec();
        let mut touched = Vec::new();
        let mut kept = vec![learnt[0]];
        for &lit in &marked {
            if self.reason[lit.node() as usize] == NONE || !self.redundant(lit, &mut touched) {
                kept.push(lit);
            }
        }
        for lit in marked.iter().chain(&touched) {
            self.seen[lit.node() as usize] = false;
        }
        if self.log.is_some() {
            self.note_removed(marked.iter().filter(|lit| !kept.contains(lit)).chain(&touched).copied());
        }
        *learnt = kept;
    }

    /// Whether the literal follows from others that are marked; marks what it goes through where that holds.
    fn redundant(&mut self, lit: Lit, touched: &mut Vec<Lit>) -> bool {
        let before = touched.len();
        let mut stack = vec![lit];
        while let Some(lit) = stack.pop() {
            let reason = self.reason[lit.node() as usize];
            for index in 1..self.size(reason) {
                let next = self.lit(reason, index);
                let var = next.node() as usize;
                if self.seen[var] || self.level[var] == 0 {
                    continue;
                }
                if self.reason[var] == NONE {
                    for lit in touched.drain(before..) {
                        self.seen[lit.node() as usize] = false;
                    }
                    return false;
                }
                self.seen[var] = true;
                touched.push(next);
                stack.push(next);
            }
        }
        true
    }

    fn second_highest(&self, learnt: &mut [Lit]) -> usize {
        let highest = (1..learnt.len()).max_by_key(|&i| self.level[learnt[i].node() as usize]);
        highest.map_or(0, |at| {
            learnt.swap(1, at);
            self.level[learnt[1].node() as usize] as usize
        })
    }

    /// The assumptions that the falsity of `lit`, an assumption, rests on.
    fn analyze_final(&mut self, lit: Lit) {
        self.failed.push(lit);
        if self.levels.is_empty() {
            return;
        }
        self.seen[lit.node() as usize] = true;
        for at in (self.levels[0]..self.trail.len()).rev() {
            let on = self.trail[at];
            let var = on.node() as usize;
            if !self.seen[var] {
                continue;
            }
            self.seen[var] = false;
            let reason = self.reason[var];
            if reason == NONE {
                self.failed.push(on);
                continue;
            }
            for index in 1..self.size(reason) {
                let below = self.lit(reason, index).node() as usize;
                if self.level[below] > 0 {
                    self.seen[below] = true;
                }
            }
        }
        self.seen[lit.node() as usize] = false;
    }

    fn learn(&mut self, learnt: &[Lit]) {
        if let [unit] = learnt {
            self.note_kept(Some(*unit), NONE);
            self.assign(*unit, NONE);
            return;
        }
        self.stamp += 1;
        let mut distinct = 0;
        for lit in learnt {
            let level = self.level[lit.node() as usize] as usize;
            if self.stamps[level] != self.stamp {
                self.stamps[level] = self.stamp;
                distinct += 1;
            }
        }
        let clause = self.store(learnt, true, distinct);
        self.note_kept(None, clause);
        let guarded = self.guard.is_some_and(|g| learnt.iter().any(|l| l.node() == g));
        if guarded {
            self.guarded.push(clause);
        } else {
            self.learnts.push(clause);
        }
        self.assign(learnt[0], clause);
    }

    /// Goes one assumption or decision deeper; `Some` when there is nothing left to do.
    fn deepen(&mut self, assumptions: &[Lit]) -> Option<bool> {
        while let Some(&next) = assumptions.get(self.levels.len()) {
            match self.value_of(next) {
                0 => {
                    self.levels.push(self.trail.len());
                    self.assign(next, NONE);
                    return None;
                }
                1 => self.levels.push(self.trail.len()),
                _ => {
                    self.analyze_final(next);
                    return Some(false);
                }
            }
        }
        while let Some(var) = self.heap.pop(&self.activity) {
            if self.values[2 * var as usize] == 0 {
                self.levels.push(self.trail.len());
                let lit = Lit::of(var).invert_if(!self.phase[var as usize]);
                self.assign(lit, NONE);
                return None;
            }
        }
        Some(true)
    }

    /// Looks at the clock once in a while.
    fn is_stopped(&mut self) -> bool {
        if self.ticks < self.look {
            return false;
        }
        let stopped = self.stop.reached();
        if !stopped {
            self.look = self.ticks + 300_000;
        }
        stopped
    }

    pub(super) fn search(&mut self, assumptions: &[Lit], until: u64) -> Option<bool> {
        self.stamps.resize(self.stamps.len().max(self.level.len() + assumptions.len() + 2), 0);
        let (mut round, mut conflicts) = (1, 0);
        loop {
            let conflict = self.propagate();
            if conflict != NONE {
                if self.levels.is_empty() {
                    self.broken = true;
                    self.note_end(conflict);
                    return Some(false);
                }
                conflicts += 1;
                let (learnt, back) = self.analyze(conflict);
                self.back_to(back);
                self.learn(&learnt);
                self.step /= 0.95;
            } else if self.ticks > until || self.is_stopped() {
                return None;
            } else if conflicts >= 100 * luby(round) {
                (round, conflicts) = (round + 1, 0);
                self.back_to(0);
            } else if let Some(answer) = self.deepen(assumptions) {
                return Some(answer);
            }
        }
    }
}
