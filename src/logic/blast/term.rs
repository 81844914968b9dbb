//! Terms as words over a graph, operands first, without recursion.

use std::collections::HashMap;

use super::float;
use super::word::{self, Word};
use crate::logic::aig::{Aig, Lit};
use crate::logic::eval::below;
use crate::logic::term::{Node, Op, Pool, Term};

/// The words of terms.
#[derive(Debug)]
pub struct Blaster<'p> {
    pool: &'p Pool,
    aig: Aig,
    words: Vec<Option<Word>>,
    /// Quotients and remainders come together, also for signed operands whose magnitudes are the same.
    divisions: HashMap<(Word, Word), (Word, Word)>,
}

impl<'p> Blaster<'p> {
    /// Over an empty graph.
    #[must_use]
    pub fn new(pool: &'p Pool) -> Self {
        Self::with(pool, Aig::default())
    }

    /// Over a graph; no term has a word yet.
    #[must_use]
    pub fn with(pool: &'p Pool, aig: Aig) -> Self {
        Self { pool, aig, words: vec![None; pool.len()], divisions: HashMap::new() }
    }

    /// The graph.
    #[must_use]
    pub fn finish(self) -> Aig {
        self.aig
    }

    /// The graph as it is.
    #[must_use]
    pub const fn aig(&self) -> &Aig {
        &self.aig
    }

    /// Gives a term, a variable as a rule, new leaves, and returns them.
    pub fn fresh(&mut self, term: Term) -> Vec<Lit> {
        let word: Word = (0..self.pool.width(term)).map(|_| self.aig.leaf()).collect();
        self.bind(term, word.clone());
        word
    }

    /// Gives a term a word, as wide as it is.
    pub fn bind(&mut self, term: Term, word: Vec<Lit>) {
        self.words[term.0 as usize] = Some(word);
    }

    /// The word of a term that was blasted or bound.
    ///
    /// # Panics
    ///
    /// Where it was not.
    #[must_use]
    pub fn word(&self, term: Term) -> &[Lit] {
        self.words[term.0 as usize].as_deref().expect("the term was blasted")
    }

    /// Makes the words of the terms and of all below. A variable that has no word gets new leaves.
    pub fn blast(&mut self, terms: impl IntoIterator<Item = Term>) {
        for term in below(self.pool, terms) {
            if self.words[term.0 as usize].is_some() {
                continue;
            }
            let width = self.pool.width(term);
            let word = match self.pool.node(term) {
                Node::Const(value) => word::constant(value, width as usize),
                Node::Var(_) => (0..width).map(|_| self.aig.leaf()).collect(),
                Node::Apply(op, operands) => self.apply(op, operands),
            };
            debug_assert_eq!(word.len(), width as usize, "{op:?}", op = self.pool.node(term));
            self.words[term.0 as usize] = Some(word);
        }
    }

    fn apply(&mut self, op: Op, operands: [Term; 3]) -> Word {
        let [a, b, c] = operands.map(|operand| self.word(operand).to_vec());
        let aig = &mut self.aig;
        match op {
            Op::Not => word::not(&a),
            Op::Neg => word::neg(aig, &a),
            Op::And => a.iter().zip(&b).map(|(a, b)| aig.and(*a, *b)).collect(),
            Op::Or => a.iter().zip(&b).map(|(a, b)| aig.or(*a, *b)).collect(),
            Op::Xor => a.iter().zip(&b).map(|(a, b)| aig.xor(*a, *b)).collect(),
            Op::Add => word::add(aig, &a, &b),
            Op::Sub => word::sub(aig, &a, &b),
            Op::Mul => word::mul(aig, &a, &b, a.len()),
            Op::Udiv => self.divide(a, b).0,
            Op::Urem => self.divide(a, b).1,
            Op::Sdiv | Op::Srem => self.signed_division(op, &a, &b),
            Op::Shl => word::shift_left(aig, &a, &b),
            Op::Lshr => word::shift_right(aig, &a, &b, Lit::FALSE),
            Op::Ashr => word::shift_right(aig, &a, &b, word::sign(&a)),
            Op::Eq => vec![word::eq(aig, &a, &b)],
            Op::Ult => vec![word::ult(aig, &a, &b)],
            Op::Ule => vec![!word::ult(aig, &b, &a)],
            Op::Slt => vec![word::slt(aig, &a, &b)],
            Op::Sle => vec![!word::slt(aig, &b, &a)],
            Op::Ite => word::ite(aig, a[0], &b, &c),
            Op::Concat => [b, a].concat(),
            Op::Extract { high, low } => a[low as usize..=high as usize].to_vec(),
            Op::ZeroExtend(to) => word::zero_extend(&a, to as usize),
            Op::SignExtend(to) => word::sign_extend(&a, to as usize),
            _ => float_operator(aig, op, &a, &b),
        }
    }

    fn divide(&mut self, a: Word, b: Word) -> (Word, Word) {
        let key = (a, b);
        if let Some(known) = self.divisions.get(&key) {
            return known.clone();
        }
        let result = word::divide(&mut self.aig, &key.0, &key.1);
        self.divisions.insert(key, result.clone());
        result
    }

    fn signed_division(&mut self, op: Op, a: &[Lit], b: &[Lit]) -> Word {
        let (left, right) = (word::sign(a), word::sign(b));
        let (x, y) = (word::negated_if(&mut self.aig, left, a), word::negated_if(&mut self.aig, right, b));
        let (quotient, remainder) = self.divide(x, y);
        if op == Op::Srem {
            return word::negated_if(&mut self.aig, left, &remainder);
        }
        let differ = self.aig.xor(left, right);
        word::negated_if(&mut self.aig, differ, &quotient)
    }
}

fn float_operator(aig: &mut Aig, op: Op, a: &[Lit], b: &[Lit]) -> Word {
    let integer = |width: u32, signed, truncate| float::ToInteger { width: width as usize, signed, truncate };
    match op {
        Op::FloatAdd => float::add(aig, a, b),
        Op::FloatSub => {
            let mut negative = b.to_vec();
            let high = negative.len() - 1;
            negative[high] = !negative[high];
            float::add(aig, a, &negative)
        }
        Op::FloatMul => float::mul(aig, a, b),
        Op::FloatDiv => float::div(aig, a, b),
        Op::FloatSqrt => float::sqrt(aig, a),
        Op::FloatEq => vec![float::eq(aig, a, b)],
        Op::FloatLt => vec![float::lt(aig, a, b)],
        Op::FloatLe => vec![float::le(aig, a, b)],
        Op::FloatToFloat(to) => float::to_float(aig, a, to as usize),
        Op::SignedToFloat(to) => float::from_integer(aig, a, true, to as usize),
        Op::UnsignedToFloat(to) => float::from_integer(aig, a, false, to as usize),
        Op::FloatToSigned(to) => float::to_integer(aig, a, integer(to, true, false)),
        Op::FloatToUnsigned(to) => float::to_integer(aig, a, integer(to, false, false)),
        Op::FloatTruncate(to) => float::to_integer(aig, a, integer(to, true, true)),
        _ => unreachable!("integer operators are blasted elsewhere"),
    }
}
