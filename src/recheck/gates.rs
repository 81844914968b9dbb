//! Boolean circuits as clauses (Tseitin's encoding), and arithmetic on vectors of literals, least significant first. Vectors
//! may have any width.

use std::collections::HashMap;

use batsat::{Callbacks, ClauseKind, Lit, Solver, SolverInterface, lbool};

use super::invariant::Rejection;
use super::rup::Checker;

/// Stops a solver that takes too long, and checks what it concludes.
struct Watcher {
    stop: Box<dyn Fn() -> bool>,
    checker: Checker,
}

impl Callbacks for Watcher {
    fn on_new_clause(&mut self, clause: &[Lit], _: ClauseKind) {
        self.checker.learn(clause);
    }

    fn on_delete_clause(&mut self, clause: &[Lit]) {
        self.checker.forget(clause);
    }

    fn stop(&self) -> bool {
        (self.stop)()
    }
}

/// A vector of literals, least significant first.
pub(super) type Word = Vec<Lit>;

/// A solver with the circuit that it was told.
pub(super) struct Gates {
    solver: Solver<Watcher>,
    top: Lit,
    ands: HashMap<(Lit, Lit), Lit>,
    xors: HashMap<(Lit, Lit), Lit>,
    majorities: HashMap<[Lit; 3], Lit>,
    choices: HashMap<[Lit; 3], Lit>,
}

impl Gates {
    pub(super) fn new(stop: Box<dyn Fn() -> bool>) -> Self {
        let mut solver = Solver::new(batsat::SolverOpts::default(), Watcher { stop, checker: Checker::default() });
        let top = Lit::new(solver.new_var_default(), true);
        let mut gates = Self {
            solver,
            top,
            ands: HashMap::new(),
            xors: HashMap::new(),
            majorities: HashMap::new(),
            choices: HashMap::new(),
        };
        gates.clause(&[top]);
        gates
    }

    /// The literal that is true, or the one that is false.
    pub(super) fn constant(&self, value: bool) -> Lit {
        if value { self.top } else { !self.top }
    }

    pub(super) fn fresh(&mut self) -> Lit {
        Lit::new(self.solver.new_var_default(), true)
    }

    pub(super) fn fresh_word(&mut self, width: u32) -> Word {
        (0..width).map(|_| self.fresh()).collect()
    }

    pub(super) fn clause(&mut self, lits: &[Lit]) {
        self.solver.cb_mut().checker.add(lits);
        self.solver.add_clause_reuse(&mut lits.to_vec());
    }

    /// Whether the clauses can be satisfied together with `assumptions`. That they cannot was checked by unit propagation.
    ///
    /// # Errors
    /// If it was stopped, or what the solver says does not follow.
    pub(super) fn satisfiable(&mut self, assumptions: &[Lit]) -> Result<bool, Rejection> {
        let answer = self.solver.solve_limited(assumptions);
        if answer == lbool::TRUE {
            Ok(true)
        } else if answer == lbool::FALSE {
            let is_founded = self.solver.cb_mut().checker.refutes(assumptions);
            if is_founded { Ok(false) } else { Err(Rejection::Unfounded) }
        } else {
            Err(Rejection::OutOfTime)
        }
    }

    /// The value of a literal in the model that [`Gates::satisfiable`] found; false where it did not matter.
    pub(super) fn value(&self, lit: Lit) -> bool {
        self.solver.value_lit(lit) == lbool::TRUE
    }

    pub(super) fn and(&mut self, a: Lit, b: Lit) -> Lit {
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        match (self.known(a), self.known(b)) {
            (Some(false), _) | (_, Some(false)) => return !self.top,
            (Some(true), _) => return b,
            (_, Some(true)) => return a,
            _ => {}
        }
        if a == b {
            return a;
        }
        if a == !b {
            return !self.top;
        }
        if let Some(known) = self.ands.get(&(a, b)) {
            return *known;
        }
        let out = self.fresh();
        self.clause(&[!out, a]);
        self.clause(&[!out, b]);
        self.clause(&[out, !a, !b]);
        self.ands.insert((a, b), out);
        out
    }

    fn known(&self, lit: Lit) -> Option<bool> {
        if lit == self.top {
            Some(true)
        } else if lit == !self.top {
            Some(false)
        } else {
            None
        }
    }

    pub(super) fn or(&mut self, a: Lit, b: Lit) -> Lit {
        !self.and(!a, !b)
    }

    pub(super) fn xor(&mut self, a: Lit, b: Lit) -> Lit {
        match (self.known(a), self.known(b)) {
            (Some(value), _) => return if value { !b } else { b },
            (_, Some(value)) => return if value { !a } else { a },
            _ => {}
        }
        // Only the variables are kept; the signs go to the result.
        let flip = a.sign() == b.sign();
        let (a, b) = (Lit::new(a.var(), true), Lit::new(b.var(), true));
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        if a == b {
            return self.constant(!flip);
        }
        let out = match self.xors.get(&(a, b)) {
            Some(known) => *known,
            None => {
                let out = self.fresh();
                self.clause(&[!out, a, b]);
                self.clause(&[!out, !a, !b]);
                self.clause(&[out, !a, b]);
                self.clause(&[out, a, !b]);
                self.xors.insert((a, b), out);
                out
            }
        };
        if flip { out } else { !out }
    }

    /// If-then-else: one gate, so that two equal branches say what comes out before the condition is known.
    pub(super) fn mux(&mut self, condition: Lit, then: Lit, otherwise: Lit) -> Lit {
        if then == otherwise {
            return then;
        }
        let known = [condition, then, otherwise].iter().any(|lit| self.known(*lit).is_some());
        if known || condition.var() == then.var() || condition.var() == otherwise.var() || then == !otherwise {
            let (yes, no) = (self.and(condition, then), self.and(!condition, otherwise));
            return self.or(yes, no);
        }
        if let Some(known) = self.choices.get(&[condition, then, otherwise]) {
            return *known;
        }
        let out = self.fresh();
        self.clause(&[!condition, !then, out]);
        self.clause(&[!condition, then, !out]);
        self.clause(&[condition, !otherwise, out]);
        self.clause(&[condition, otherwise, !out]);
        self.clause(&[!then, !otherwise, out]);
        self.clause(&[then, otherwise, !out]);
        self.choices.insert([condition, then, otherwise], out);
        out
    }

    /// Whether two of three are true: one gate, so that any two that agree say what comes out. Carries and comparisons are
    /// chains of these; in gates of two operands a solver finds no order among words.
    fn majority(&mut self, a: Lit, b: Lit, c: Lit) -> Lit {
        let mut three = [a, b, c];
        three.sort_unstable();
        let [a, b, c] = three;
        for (one, x, y) in [(a, b, c), (b, a, c), (c, a, b)] {
            match self.known(one) {
                Some(true) => return self.or(x, y),
                Some(false) => return self.and(x, y),
                None if x == y => return x,
                None if x == !y => return one,
                None => {}
            }
        }
        if let Some(known) = self.majorities.get(&three) {
            return *known;
        }
        let out = self.fresh();
        for (x, y) in [(a, b), (a, c), (b, c)] {
            self.clause(&[!x, !y, out]);
            self.clause(&[x, y, !out]);
        }
        self.majorities.insert(three, out);
        out
    }

    pub(super) fn any(&mut self, word: &[Lit]) -> Lit {
        word.iter().fold(!self.top, |all, lit| self.or(all, *lit))
    }

    pub(super) fn all(&mut self, word: &[Lit]) -> Lit {
        word.iter().fold(self.top, |all, lit| self.and(all, *lit))
    }

    pub(super) fn number(&self, width: usize, value: u64) -> Word {
        (0..width).map(|bit| self.constant(bit < 64 && value >> bit & 1 == 1)).collect()
    }

    pub(super) fn zero_extend(&self, word: &[Lit], width: usize) -> Word {
        (0..width).map(|bit| word.get(bit).copied().unwrap_or(!self.top)).collect()
    }

    pub(super) fn sign_extend(&self, word: &[Lit], width: usize) -> Word {
        let sign = word.last().copied().unwrap_or(!self.top);
        (0..width).map(|bit| word.get(bit).copied().unwrap_or(sign)).collect()
    }

    pub(super) fn map2(&mut self, a: &[Lit], b: &[Lit], f: impl Fn(&mut Self, Lit, Lit) -> Lit) -> Word {
        a.iter().zip(b).map(|(a, b)| f(self, *a, *b)).collect()
    }

    pub(super) fn inverted(word: &[Lit]) -> Word {
        word.iter().map(|lit| !*lit).collect()
    }

    pub(super) fn choose(&mut self, condition: Lit, then: &[Lit], otherwise: &[Lit]) -> Word {
        self.map2(then, otherwise, |gates, a, b| gates.mux(condition, a, b))
    }

    /// The sum, of the width of `a`, and the carry out of it.
    pub(super) fn add_carry(&mut self, a: &[Lit], b: &[Lit], carry: Lit) -> (Word, Lit) {
        let mut carry = carry;
        let mut sum = Word::with_capacity(a.len());
        for (a, b) in a.iter().zip(b) {
            let half = self.xor(*a, *b);
            sum.push(self.xor(half, carry));
            carry = self.majority(*a, *b, carry);
        }
        (sum, carry)
    }

    pub(super) fn add(&mut self, a: &[Lit], b: &[Lit]) -> Word {
        self.add_carry(a, b, !self.top).0
    }

    /// The difference, and whether `a >= b` as unsigned numbers.
    pub(super) fn subtract(&mut self, a: &[Lit], b: &[Lit]) -> (Word, Lit) {
        self.add_carry(a, &Self::inverted(b), self.top)
    }

    pub(super) fn negate(&mut self, a: &[Lit]) -> Word {
        let zero = self.number(a.len(), 0);
        self.subtract(&zero, a).0
    }

    pub(super) fn equal(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let same = self.map2(a, b, |gates, a, b| !gates.xor(a, b));
        self.all(&same)
    }

    pub(super) fn unsigned_less(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let not_less = a.iter().zip(b).fold(self.top, |carry, (a, b)| self.majority(*a, !*b, carry));
        !not_less
    }

    pub(super) fn signed_less(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let flip = |word: &[Lit]| {
            let mut word = word.to_vec();
            if let Some(sign) = word.last_mut() {
                *sign = !*sign;
            }
            word
        };
        self.unsigned_less(&flip(a), &flip(b))
    }

    /// The product, as wide as both together.
    pub(super) fn multiply(&mut self, a: &[Lit], b: &[Lit], width: usize) -> Word {
        let mut sum = self.number(width, 0);
        for (shift, bit) in b.iter().enumerate().take(width) {
            let mut row = self.number(shift, 0);
            row.extend(a.iter().take(width - shift).map(|lit| (*lit, *bit)).map(|(lit, bit)| self.and(lit, bit)));
            let row = self.zero_extend(&row, width);
            sum = self.add(&sum, &row);
        }
        sum
    }

    /// Quotient and remainder by long division; by zero, all ones and the dividend.
    pub(super) fn divide(&mut self, a: &[Lit], b: &[Lit]) -> (Word, Word) {
        let wide = b.len() + 1;
        let divisor = self.zero_extend(b, wide);
        let mut rest = self.number(wide, 0);
        let mut quotient = self.number(a.len(), 0);
        for bit in (0..a.len()).rev() {
            rest.insert(0, a[bit]);
            rest.truncate(wide);
            let (difference, fits) = self.subtract(&rest, &divisor);
            quotient[bit] = fits;
            rest = self.choose(fits, &difference, &rest);
        }
        rest.truncate(b.len());
        (quotient, rest)
    }

    /// Shifted left by `amount`; what comes in is false.
    pub(super) fn shift_left(&mut self, word: &[Lit], amount: &[Lit]) -> Word {
        let low = !self.top;
        self.shift(word, amount, low, |word, by, index, fill| if index >= by { word[index - by] } else { fill })
    }

    /// Shifted right by `amount`; `fill` comes in.
    pub(super) fn shift_right(&mut self, word: &[Lit], amount: &[Lit], fill: Lit) -> Word {
        self.shift(word, amount, fill, |word, by, index, fill| word.get(index + by).copied().unwrap_or(fill))
    }

    fn shift(
        &mut self,
        word: &[Lit],
        amount: &[Lit],
        fill: Lit,
        moved: impl Fn(&[Lit], usize, usize, Lit) -> Lit,
    ) -> Word {
        let mut out = word.to_vec();
        let mut beyond = !self.top;
        for (stage, bit) in amount.iter().enumerate() {
            match 1_usize.checked_shl(u32::try_from(stage).unwrap_or(u32::MAX)).filter(|by| *by < word.len()) {
                Some(by) => {
                    let shifted: Word = (0..out.len()).map(|index| moved(&out, by, index, fill)).collect();
                    out = self.choose(*bit, &shifted, &out);
                }
                None => beyond = self.or(beyond, *bit),
            }
        }
        let gone = vec![fill; out.len()];
        self.choose(beyond, &gone, &out)
    }

    /// Shifted right; whether a true bit was lost is kept in the lowest bit.
    pub(super) fn shift_right_sticky(&mut self, word: &[Lit], amount: &[Lit]) -> Word {
        let none = !self.top;
        let mut out = word.to_vec();
        for (stage, bit) in amount.iter().enumerate() {
            let by = 1_usize.checked_shl(u32::try_from(stage).unwrap_or(u32::MAX)).unwrap_or(usize::MAX).min(out.len());
            let lost = self.any(&out[..by]);
            let mut moved: Word = out[by..].to_vec();
            moved.resize(out.len(), none);
            moved[0] = self.or(moved[0], lost);
            out = self.choose(*bit, &moved, &out);
        }
        out
    }
}
