//! Checks what a solver concludes: that each clause it learns follows from those before, and that no model is left.
//!
//! A clause follows by *reverse unit propagation* if setting its literals to false and propagating units leads to a conflict.
//! All clauses that conflict analysis learns are of this kind (Goldberg and Novikov, "Verification of proofs of
//! unsatisfiability for CNF formulas", DATE 2003), and their list, with deletions, is a DRUP proof, the part of DRAT that such
//! solvers need (Wetzler, Heule and Hunt, "DRAT-trim", SAT 2014). It is checked while the solver makes it, so that it is stored
//! nowhere. Left out: clauses that only preserve satisfiability (RAT), which this solver does not learn, and the check
//! backwards, which could leave out clauses that the conclusion does not need. It propagates as the engines' solver does, and
//! shares nothing with it: this room believes none of them.

use std::collections::HashMap;

use batsat::Lit;

/// A literal: twice the variable, and one more if it is negated.
type Code = u32;

fn code(lit: Lit) -> Code {
    lit.var().idx() << 1 | u32::from(!lit.sign())
}

/// Where a clause's literals are; none if it was deleted.
#[derive(Clone, Copy, Debug)]
struct Clause {
    start: u32,
    len: u32,
}

/// A clause that has to be looked at when a literal becomes false, and one of its literals: if that is true, it has not.
#[derive(Clone, Copy, Debug)]
struct Watch {
    clause: u32,
    blocker: Code,
}

/// The clauses so far.
#[derive(Debug, Default)]
pub(super) struct Checker {
    literals: Vec<Code>,
    clauses: Vec<Clause>,
    /// By literal, the clauses that watch it.
    watches: Vec<Vec<Watch>>,
    /// By literal: 1 is true, -1 is false.
    values: Vec<i8>,
    /// What is true, in the order of becoming so; without an assumption, what is true in every model.
    trail: Vec<Code>,
    head: usize,
    /// Learnt clauses, by [`key`].
    learnt: HashMap<u64, u32>,
    /// How many literals belong to deleted clauses.
    dead: usize,
    /// No model satisfies the clauses.
    is_refuted: bool,
    /// A clause was learnt that does not follow.
    is_flawed: bool,
}

/// How many literals of deleted clauses are kept at least.
const DEAD: usize = 1_000_000;

/// The same for clauses with the same literals in another order.
fn key(literals: &[Code]) -> u64 {
    let mixed = literals.iter().map(|&l| (u64::from(l) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29));
    mixed.fold(literals.len() as u64, |sum, l| sum.wrapping_add(l.wrapping_mul(l | 1)))
}

impl Checker {
    /// A clause that is given.
    pub(super) fn add(&mut self, clause: &[Lit]) {
        let literals = self.codes(clause);
        self.insert(literals);
    }

    /// A clause that is said to follow.
    pub(super) fn learn(&mut self, clause: &[Lit]) {
        let literals = self.codes(clause);
        if !self.follows(&literals) {
            self.is_flawed = true;
            return;
        }
        let key = key(&literals);
        if let Some(index) = self.insert(literals) {
            self.learnt.insert(key, index);
        }
    }

    /// A learnt clause that is used no more.
    pub(super) fn forget(&mut self, clause: &[Lit]) {
        let mut literals = self.codes(clause);
        let Some(index) = self.learnt.remove(&key(&literals)) else { return };
        let Clause { start, len } = self.clauses[index as usize];
        let mut own = self.literals[start as usize..(start + len) as usize].to_vec();
        own.sort_unstable();
        literals.sort_unstable();
        if own == literals {
            self.clauses[index as usize].len = 0;
            self.dead += len as usize;
            if self.dead > DEAD.max(self.literals.len() / 2) {
                self.compact();
            }
        }
    }

    /// Whether it has been shown that no model has all of `assumptions`.
    pub(super) fn refutes(&mut self, assumptions: &[Lit]) -> bool {
        let negated: Vec<Lit> = assumptions.iter().map(|&lit| !lit).collect();
        let literals = self.codes(&negated);
        !self.is_flawed && self.follows(&literals)
    }

    fn codes(&mut self, clause: &[Lit]) -> Vec<Code> {
        let codes: Vec<Code> = clause.iter().map(|&lit| code(lit)).collect();
        let needed = codes.iter().max().map_or(0, |&largest| (largest as usize | 1) + 1);
        if self.values.len() < needed {
            self.values.resize(needed, 0);
            self.watches.resize_with(needed, Vec::new);
        }
        codes
    }

    fn value(&self, literal: Code) -> i8 {
        self.values[literal as usize]
    }

    fn assign(&mut self, literal: Code) {
        self.values[literal as usize] = 1;
        self.values[(literal ^ 1) as usize] = -1;
        self.trail.push(literal);
    }

    /// Whether a clause follows by reverse unit propagation.
    fn follows(&mut self, literals: &[Code]) -> bool {
        if self.is_refuted {
            return true;
        }
        let before = self.trail.len();
        let mut conflict = false;
        for &literal in literals {
            match self.value(literal) {
                0 => self.assign(literal ^ 1),
                value if value > 0 => conflict = true,
                _ => {}
            }
        }
        let conflict = conflict || !self.propagate();
        for literal in self.trail.drain(before..) {
            self.values[literal as usize] = 0;
            self.values[(literal ^ 1) as usize] = 0;
        }
        self.head = before;
        conflict
    }

    /// Takes a clause in, without one that says nothing; its index, if it is watched.
    fn insert(&mut self, mut literals: Vec<Code>) -> Option<u32> {
        literals.sort_unstable();
        literals.dedup();
        let is_idle =
            literals.windows(2).any(|pair| pair[0] ^ 1 == pair[1]) || literals.iter().any(|&l| self.value(l) > 0);
        if self.is_refuted || is_idle {
            return None;
        }
        // What is false now is false for ever; it goes behind what may be watched.
        literals.sort_by_key(|&literal| self.value(literal) < 0);
        let open = literals.iter().filter(|&&literal| self.value(literal) == 0).count();
        match open {
            0 => self.is_refuted = true,
            1 => {
                self.assign(literals[0]);
                self.is_refuted = !self.propagate();
            }
            _ => return self.watch(&literals),
        }
        None
    }

    fn watch(&mut self, literals: &[Code]) -> Option<u32> {
        let end = self.literals.len() + literals.len();
        let numbers = (self.clauses.len().try_into(), u32::try_from(end), u32::try_from(literals.len()));
        let (Ok(index), Ok(end), Ok(len)) = numbers else {
            // More than 16 GB of clauses: what cannot be taken in is not believed.
            self.is_flawed = true;
            return None;
        };
        self.literals.extend(literals);
        self.clauses.push(Clause { start: end - len, len });
        self.watches[literals[0] as usize].push(Watch { clause: index, blocker: literals[1] });
        self.watches[literals[1] as usize].push(Watch { clause: index, blocker: literals[0] });
        Some(index)
    }

    /// Draws all conclusions from what is true; false at a conflict.
    fn propagate(&mut self) -> bool {
        while let Some(&literal) = self.trail.get(self.head) {
            self.head += 1;
            let falsified = literal ^ 1;
            let mut watches = std::mem::take(&mut self.watches[falsified as usize]);
            let (mut kept, mut at, mut goes_on) = (0, 0, true);
            while at < watches.len() && goes_on {
                let mut watch = watches[at];
                at += 1;
                if self.values[watch.blocker as usize] > 0 || self.keeps(&mut watch, falsified, &mut goes_on) {
                    watches[kept] = watch;
                    kept += 1;
                }
            }
            let end = watches.len();
            watches.copy_within(at..end, kept);
            watches.truncate(kept + end - at);
            self.watches[falsified as usize] = watches;
            if !goes_on {
                return false;
            }
        }
        true
    }

    /// Looks at a clause that watches a literal which has become false; whether it goes on watching it.
    #[inline]
    fn keeps(&mut self, watch: &mut Watch, falsified: Code, goes_on: &mut bool) -> bool {
        let Clause { start, len } = self.clauses[watch.clause as usize];
        if len == 0 {
            return false;
        }
        let literals = &mut self.literals[start as usize..(start + len) as usize];
        if literals[0] == falsified {
            literals.swap(0, 1);
        }
        let first = literals[0];
        watch.blocker = first;
        let value = self.values[first as usize];
        if value > 0 {
            return true;
        }
        let values = &self.values;
        if let Some(other) = literals[2..].iter().position(|&literal| values[literal as usize] >= 0) {
            literals.swap(1, other + 2);
            let watched = literals[1];
            self.watches[watched as usize].push(*watch);
            return false;
        }
        if value < 0 {
            *goes_on = false;
        } else {
            self.assign(first);
        }
        true
    }

    /// Gives back the memory of deleted clauses, and of those that are true in every model.
    fn compact(&mut self) {
        let mut literals = Vec::with_capacity(self.literals.len() - self.dead);
        for clause in &mut self.clauses {
            let own = clause.start as usize..(clause.start + clause.len) as usize;
            // No further behind than before.
            clause.start = u32::try_from(literals.len()).unwrap_or(clause.start);
            if self.literals[own.clone()].iter().any(|&literal| self.values[literal as usize] > 0) {
                clause.len = 0;
                continue;
            }
            literals.extend_from_slice(&self.literals[own]);
        }
        self.literals = literals;
        self.dead = 0;
    }
}

#[cfg(test)]
mod tests {
    use batsat::Var;
    use proptest::prelude::*;

    use super::super::gates::Gates;
    use super::*;

    const VARIABLES: u32 = 6;

    type Small = Vec<(u32, bool)>;

    fn clause() -> impl Strategy<Value = Small> {
        prop::collection::vec((0..VARIABLES, any::<bool>()), 0..4)
    }

    fn lits(clause: &Small) -> Vec<Lit> {
        clause.iter().map(|&(variable, sign)| Lit::new(Var::unsafe_from_idx(variable), sign)).collect()
    }

    /// By enumeration.
    fn entails(clauses: &[Small], conclusion: &Small) -> bool {
        let holds =
            |clause: &Small, model: u32| clause.iter().any(|&(variable, sign)| (model >> variable & 1 == 1) == sign);
        (0..1 << VARIABLES).all(|model| holds(conclusion, model) || !clauses.iter().all(|clause| holds(clause, model)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2_000))]

        /// What is believed follows, whatever was said and deleted before.
        #[test]
        fn only_what_follows_is_believed(
            given in prop::collection::vec(clause(), 0..20),
            said in prop::collection::vec((clause(), any::<bool>()), 0..12),
            assumptions in clause(),
        ) {
            let mut checker = Checker::default();
            given.iter().for_each(|clause| checker.add(&lits(clause)));
            for (clause, is_kept) in &said {
                checker.learn(&lits(clause));
                prop_assert!(checker.is_flawed || entails(&given, clause));
                if !is_kept {
                    checker.forget(&lits(clause));
                }
            }
            if checker.refutes(&lits(&assumptions)) {
                let negated = assumptions.iter().map(|&(variable, sign)| (variable, !sign)).collect();
                prop_assert!(entails(&given, &negated));
            }
        }

        /// A clause that says what units already do is believed, also with others deleted.
        #[test]
        fn what_propagates_is_believed(given in prop::collection::vec(clause(), 1..20)) {
            let mut checker = Checker::default();
            given.iter().for_each(|clause| checker.add(&lits(clause)));
            for clause in &given {
                checker.learn(&lits(clause));
                checker.forget(&lits(clause));
            }
            prop_assert!(!checker.is_flawed);
        }
    }

    /// Pigeons, one more than holes, no two in a hole: thousands of clauses are learnt, and many of them deleted.
    #[test]
    fn a_solvers_refutation_is_believed_and_nothing_else() {
        let holes = 7;
        let mut gates = Gates::new(Box::new(|| false));
        let sits: Vec<Vec<Lit>> = (0..=holes).map(|_| (0..holes).map(|_| gates.fresh()).collect()).collect();
        let all_sit = gates.fresh();
        for pigeon in &sits {
            gates.clause(&[&[!all_sit], pigeon.as_slice()].concat());
        }
        for hole in 0..holes {
            for one in 0..sits.len() {
                for other in 0..one {
                    gates.clause(&[!sits[one][hole], !sits[other][hole]]);
                }
            }
        }
        assert_eq!(gates.satisfiable(&[all_sit]), Ok(false));
        assert_eq!(gates.satisfiable(&[]), Ok(true));
        let mut checker = Checker::default();
        checker.add(&[sits[0][0], sits[0][1]]);
        assert!(!checker.refutes(&[!sits[0][0]]), "the other one may be true");
        checker.learn(&[sits[0][0]]);
        assert!(
            !checker.refutes(&[!sits[0][0], !sits[0][1]]),
            "what was learnt does not follow, so nothing is believed"
        );
    }
}
