//! Where clauses live: one arena of numbers. A clause is a header, its quality, and its literals; the first two are
//! watched.

use super::{NONE, Solver, Watch};
use crate::logic::aig::Lit;

/// Numbers before a clause's literals.
const HEAD: usize = 2;
const LEARNT: u32 = 1;
const DEAD: u32 = 2;

impl Solver {
    pub(super) fn store(&mut self, lits: &[Lit], learnt: bool, quality: u32) -> u32 {
        let clause = self.arena.len() as u32;
        self.arena.push(((lits.len() as u32) << 2) | (u32::from(learnt) * LEARNT));
        self.arena.push(quality);
        self.arena.extend(lits.iter().map(|l| l.0));
        self.watch(clause);
        clause
    }

    fn watch(&mut self, clause: u32) {
        let (a, b) = (self.lit(clause, 0), self.lit(clause, 1));
        self.watches[a.0 as usize].push(Watch { clause, blocker: b });
        self.watches[b.0 as usize].push(Watch { clause, blocker: a });
    }

    pub(super) fn size(&self, clause: u32) -> usize {
        (self.arena[clause as usize] >> 2) as usize
    }

    pub(super) fn lit(&self, clause: u32, at: usize) -> Lit {
        Lit(self.arena[clause as usize + HEAD + at])
    }

    pub(super) fn swap(&mut self, clause: u32, a: usize, b: usize) {
        let start = clause as usize + HEAD;
        self.arena.swap(start + a, start + b);
    }

    fn quality(&self, clause: u32) -> u32 {
        self.arena[clause as usize + 1]
    }

    fn is_dead(&self, clause: u32) -> bool {
        self.arena[clause as usize] & DEAD != 0
    }

    fn kill(&mut self, clause: u32) {
        self.arena[clause as usize] |= DEAD;
        self.wasted += self.size(clause) + HEAD;
    }

    /// Forgets the temporary clause of the last question and what was learnt from it.
    pub(super) fn drop_guarded(&mut self) {
        let Some(var) = self.guard else { return };
        for clause in std::mem::take(&mut self.guarded) {
            for at in 0..2 {
                let lit = self.lit(clause, at);
                self.watches[lit.0 as usize].retain(|w| w.clause != clause);
            }
            self.kill(clause);
        }
        let guard = Lit::of(var);
        if self.value_of(guard) != 0 {
            self.trail.retain(|l| l.node() != var);
            self.values[guard.0 as usize] = 0;
            self.values[(!guard).0 as usize] = 0;
        }
    }

    /// At level 0: drops poor learnt clauses when there are too many, and compacts the arena.
    pub(super) fn tidy(&mut self) {
        if self.learnts.len() > self.most_learnts {
            let mut order = std::mem::take(&mut self.learnts);
            order.sort_by_key(|&c| (self.quality(c), std::cmp::Reverse(c)));
            let keep = order.len() / 2;
            for &clause in &order[keep..] {
                if self.quality(clause) > 2 {
                    self.kill(clause);
                }
            }
            order.retain(|&c| !self.is_dead(c));
            order.sort_unstable();
            self.learnts = order;
            self.most_learnts += 200;
            self.compact();
        } else if self.wasted > 10_000 && self.wasted * 2 > self.arena.len() {
            self.compact();
        }
    }

    fn compact(&mut self) {
        for &lit in &self.trail {
            self.reason[lit.node() as usize] = NONE;
        }
        for list in &mut self.watches {
            list.clear();
        }
        let old = std::mem::take(&mut self.arena);
        self.wasted = 0;
        let mut originals = std::mem::take(&mut self.originals);
        let mut learnts = std::mem::take(&mut self.learnts);
        for list in [&mut originals, &mut learnts] {
            list.retain_mut(|clause| self.carry(&old, clause));
        }
        self.originals = originals;
        self.learnts = learnts;
    }

    /// Copies a clause into the new arena, unless it is true for good.
    fn carry(&mut self, old: &[u32], clause: &mut u32) -> bool {
        let at = *clause as usize;
        let end = at + HEAD + (old[at] >> 2) as usize;
        if old[at] & DEAD != 0 || old[at + HEAD..end].iter().any(|&l| self.value_of(Lit(l)) > 0) {
            return false;
        }
        *clause = self.arena.len() as u32;
        self.arena.extend_from_slice(&old[at..end]);
        self.watch(*clause);
        true
    }
}
