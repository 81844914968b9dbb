//! Terms to clauses.

use std::collections::BTreeMap;

use batsat::Lit;

use super::float::{self, Format};
use super::gates::{Gates, Word};
use crate::logic::term::{Node, Op, Pool, Term};

/// The words of the terms of one cycle.
pub(super) type Words = BTreeMap<Term, Word>;

/// The word of `term`, where `words` has those of the variables; what is calculated is kept in it. A variable without a word
/// is free.
pub(super) fn word(gates: &mut Gates, pool: &Pool, words: &mut Words, term: Term) -> Word {
    let mut stack = vec![term];
    while let Some(&next) = stack.last() {
        if words.contains_key(&next) {
            stack.pop();
            continue;
        }
        let width = pool.width(next) as usize;
        let made = match pool.node(next) {
            Node::Const(value) => gates.number(width, value),
            Node::Var(_) => gates.fresh_word(pool.width(next)),
            Node::Apply(op, args) => {
                let args = &args[..op.arity()];
                let missing = args.iter().filter(|arg| !words.contains_key(arg));
                let before = stack.len();
                stack.extend(missing);
                if stack.len() > before {
                    continue;
                }
                let operands: Vec<Word> = args.iter().map(|arg| words[arg].clone()).collect();
                apply(gates, op, &operands)
            }
        };
        words.insert(next, made);
        stack.pop();
    }
    words[&term].clone()
}

fn bit(lit: Lit) -> Word {
    vec![lit]
}

fn apply(gates: &mut Gates, op: Op, args: &[Word]) -> Word {
    let a = &args[0];
    let b = args.get(1).unwrap_or(a);
    match op {
        Op::Not => Gates::inverted(a),
        Op::Neg => gates.negate(a),
        Op::And => gates.map2(a, b, Gates::and),
        Op::Or => gates.map2(a, b, Gates::or),
        Op::Xor => gates.map2(a, b, Gates::xor),
        Op::Add => gates.add(a, b),
        Op::Sub => gates.subtract(a, b).0,
        Op::Mul => gates.multiply(a, b, a.len()),
        Op::Udiv => gates.divide(a, b).0,
        Op::Urem => gates.divide(a, b).1,
        Op::Sdiv | Op::Srem => signed_division(gates, op, a, b),
        Op::Shl => gates.shift_left(a, b),
        Op::Lshr => {
            let fill = gates.constant(false);
            gates.shift_right(a, b, fill)
        }
        Op::Ashr => gates.shift_right(a, b, a[a.len() - 1]),
        Op::Eq => bit(gates.equal(a, b)),
        Op::Ult => bit(gates.unsigned_less(a, b)),
        Op::Ule => bit(!gates.unsigned_less(b, a)),
        Op::Slt => bit(gates.signed_less(a, b)),
        Op::Sle => bit(!gates.signed_less(b, a)),
        Op::Ite => gates.choose(a[0], b, &args[2]),
        Op::Concat => b.iter().chain(a).copied().collect(),
        Op::Extract { high, low } => a[low as usize..=high as usize].to_vec(),
        Op::ZeroExtend(width) => gates.zero_extend(a, width as usize),
        Op::SignExtend(width) => gates.sign_extend(a, width as usize),
        _ => apply_float(gates, op, a, b),
    }
}

fn signed_division(gates: &mut Gates, op: Op, a: &[Lit], b: &[Lit]) -> Word {
    let (sign, other) = (a[a.len() - 1], b[b.len() - 1]);
    let (minus_a, minus_b) = (gates.negate(a), gates.negate(b));
    let (x, y) = (gates.choose(sign, &minus_a, a), gates.choose(other, &minus_b, b));
    let (quotient, rest) = gates.divide(&x, &y);
    if op == Op::Srem {
        let minus = gates.negate(&rest);
        return gates.choose(sign, &minus, &rest);
    }
    let differ = gates.xor(sign, other);
    let minus = gates.negate(&quotient);
    gates.choose(differ, &minus, &quotient)
}

fn apply_float(gates: &mut Gates, op: Op, a: &[Lit], b: &[Lit]) -> Word {
    let format = Format::of(a.len());
    match op {
        Op::FloatAdd => float::add(gates, format, a, b),
        Op::FloatSub => {
            let mut minus = b.to_vec();
            let top = minus.len() - 1;
            minus[top] = !minus[top];
            float::add(gates, format, a, &minus)
        }
        Op::FloatMul => float::multiply(gates, format, a, b),
        Op::FloatDiv => float::divide(gates, format, a, b),
        Op::FloatSqrt => float::square_root(gates, format, a),
        Op::FloatEq => bit(float::equal(gates, format, a, b)),
        Op::FloatLt => bit(float::less(gates, format, a, b, false)),
        Op::FloatLe => bit(float::less(gates, format, a, b, true)),
        Op::FloatToFloat(width) => float::to_float(gates, format, Format::of(width as usize), a),
        Op::SignedToFloat(width) => float::from_integer(gates, Format::of(width as usize), a, true),
        Op::UnsignedToFloat(width) => float::from_integer(gates, Format::of(width as usize), a, false),
        Op::FloatToSigned(width) => float::to_integer(gates, format, a, width as usize, true, false),
        Op::FloatToUnsigned(width) => float::to_integer(gates, format, a, width as usize, false, false),
        Op::FloatTruncate(width) => float::to_integer(gates, format, a, width as usize, true, true),
        _ => unreachable!("the operators over bits are done by `apply`"),
    }
}
