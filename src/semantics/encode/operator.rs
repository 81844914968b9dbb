//! The operators as terms, one function a family; [`Op`] documents what each one means.

use super::super::expr::{Expr, ExprKind, Fault, Op, RealFunction};
use super::super::scalar::Scalar;
use super::{Context, Unsupported, convert, fixed};
use crate::logic::term::{Node, Op as T, Pool, Term};

/// The term of an operator on operands that are terms already.
pub(super) fn apply<L, C: Context<L>>(
    context: &mut C,
    op: Op,
    expr: &Expr<L>,
    terms: &[Term],
) -> Result<Term, C::Error> {
    let ExprKind::Apply(_, operands) = &expr.kind else {
        return Err(unsupported(expr, "an operator without operands"));
    };
    if terms.len() != arity(op, terms.len()) {
        return Err(unsupported(expr, "an operator with a wrong number of operands"));
    }
    let operand = operands[0].scalar;
    if matches!(op, Op::Div | Op::Mod) && !is_real(expr.scalar) {
        let pool = context.pool();
        let zero = pool.constant(expr.scalar.width(), 0);
        let by_zero = pool.apply(T::Eq, &[terms[1], zero]);
        context.fault(by_zero, Fault::DivisionByZero, expr.place);
    }
    let pool = context.pool();
    let found = match operand {
        Scalar::Real(format) => ieee(pool, op, format, terms),
        Scalar::Fixed { digits, width } => fixed::apply(pool, op, digits, width, terms),
        _ => None,
    };
    if let Some(term) = found {
        return Ok(term);
    }
    match op {
        Op::Convert => Ok(convert::convert(pool, operand, expr.scalar, terms[0])),
        Op::Trunc if is_real(expr.scalar) => Err(unsupported(expr, "`TRUNC` to a `REAL`")),
        Op::Trunc => Ok(convert::trunc(pool, operand, expr.scalar, terms[0])),
        Op::Reinterpret => reinterpret(pool, terms[0], operand, expr.scalar)
            .ok_or_else(|| unsupported(expr, "the bits of a `REAL` in a fixed-point reading")),
        Op::Real(function) => Err(unsupported(expr, &format!("`{}`", name(function)))),
        Op::Bit => match operands[1].kind {
            ExprKind::Const(number) if number < u64::from(operand.width()) => {
                let bit = u32::try_from(number).unwrap_or(0);
                Ok(pool.apply(T::Extract { high: bit, low: bit }, &[terms[0]]))
            }
            _ => Err(unsupported(expr, "a bit whose number is not a constant in range")),
        },
        Op::Sqrt => Err(unsupported(expr, "`SQRT` in a fixed-point reading")),
        Op::Mod if is_real(operand) => Err(unsupported(expr, "`MOD` of `REAL`")),
        _ => Ok(integer(pool, op, operand, terms)),
    }
}

/// How many operands the operator takes, where there are `given`; some go on from left to right.
fn arity(op: Op, given: usize) -> usize {
    match op {
        Op::Add | Op::Mul | Op::And | Op::Or | Op::Xor => given.max(2),
        Op::Neg | Op::Not | Op::Abs | Op::Sqrt | Op::Trunc | Op::Convert | Op::Reinterpret => 1,
        Op::Real(RealFunction::Atan2 | RealFunction::Power) => 2,
        Op::Real(_) => 1,
        Op::Select => 3,
        _ => 2,
    }
}

/// Operators on integers, bit strings, times, dates and truth values.
fn integer(pool: &mut Pool, op: Op, scalar: Scalar, terms: &[Term]) -> Term {
    let signed = scalar.is_signed();
    match op {
        Op::Neg => pool.apply(T::Neg, terms),
        Op::Not => pool.apply(T::Not, terms),
        Op::Add => fold(pool, T::Add, terms),
        Op::Sub => pool.apply(T::Sub, terms),
        Op::Mul => fold(pool, T::Mul, terms),
        Op::Div => pool.apply(if signed { T::Sdiv } else { T::Udiv }, terms),
        Op::Mod => pool.apply(if signed { T::Srem } else { T::Urem }, terms),
        Op::And => fold(pool, T::And, terms),
        Op::Or => fold(pool, T::Or, terms),
        Op::Xor => fold(pool, T::Xor, terms),
        Op::Eq => pool.apply(T::Eq, terms),
        Op::Lt => pool.apply(if signed { T::Slt } else { T::Ult }, terms),
        Op::Le => pool.apply(if signed { T::Sle } else { T::Ule }, terms),
        Op::Shl => shift(pool, T::Shl, terms[0], terms[1]),
        Op::Shr => shift(pool, T::Lshr, terms[0], terms[1]),
        Op::Sar => shift(pool, T::Ashr, terms[0], terms[1]),
        Op::Rol => rotate(pool, true, terms[0], terms[1]),
        Op::Ror => rotate(pool, false, terms[0], terms[1]),
        Op::Abs if signed => absolute(pool, terms[0]),
        Op::Select => pool.apply(T::Ite, terms),
        // `Abs` without a sign; the others have been taken before.
        _ => terms[0],
    }
}

/// An operator over two or more operands, from left to right.
fn fold(pool: &mut Pool, op: T, terms: &[Term]) -> Term {
    terms[1..].iter().fold(terms[0], |left, right| pool.apply(op, &[left, *right]))
}

/// The absolute value in two's complement.
pub(super) fn absolute(pool: &mut Pool, term: Term) -> Term {
    let zero = pool.constant(pool.width(term), 0);
    let negative = pool.apply(T::Slt, &[term, zero]);
    let opposite = pool.apply(T::Neg, &[term]);
    pool.apply(T::Ite, &[negative, opposite, term])
}

/// A shift whose amount may have another width: both are extended to the wider one, in which nothing is lost.
fn shift(pool: &mut Pool, op: T, term: Term, amount: Term) -> Term {
    let (width, wide) = (pool.width(term), pool.width(term).max(pool.width(amount)));
    let extend = if op == T::Ashr { T::SignExtend(wide) } else { T::ZeroExtend(wide) };
    let long = if wide == width { term } else { pool.apply(extend, &[term]) };
    let amount = convert::resize(pool, amount, wide, false);
    let shifted = pool.apply(op, &[long, amount]);
    convert::resize(pool, shifted, width, false)
}

/// A rotation by the amount modulo the width; widths are powers of two.
fn rotate(pool: &mut Pool, left: bool, term: Term, amount: Term) -> Term {
    let width = pool.width(term);
    let bits = width.trailing_zeros();
    if bits == 0 {
        return term;
    }
    let amount = pool.apply(T::Extract { high: bits - 1, low: 0 }, &[amount]);
    if let Node::Const(by) = pool.node(amount) {
        let by = u32::try_from(by).unwrap_or(0);
        let cut = if left { width - by } else { by } % width;
        if cut == 0 {
            return term;
        }
        let (low, high) = (
            pool.apply(T::Extract { high: cut - 1, low: 0 }, &[term]),
            pool.apply(T::Extract { high: width - 1, low: cut }, &[term]),
        );
        return pool.apply(T::Concat, &[low, high]);
    }
    let amount = pool.apply(T::ZeroExtend(width), &[amount]);
    let whole = pool.constant(width, u64::from(width));
    let rest = pool.apply(T::Sub, &[whole, amount]);
    let (there, back) = if left { (T::Shl, T::Lshr) } else { (T::Lshr, T::Shl) };
    let (first, second) = (pool.apply(there, &[term, amount]), pool.apply(back, &[term, rest]));
    pool.apply(T::Or, &[first, second])
}

/// The bits as they are; a `REAL` has none in a fixed-point reading.
fn reinterpret(pool: &mut Pool, term: Term, from: Scalar, to: Scalar) -> Option<Term> {
    let fixed = |scalar| matches!(scalar, Scalar::Fixed { .. });
    (fixed(from) == fixed(to)).then(|| convert::resize(pool, term, to.width(), false))
}

/// Whether it is a real, in whatever reading.
const fn is_real(scalar: Scalar) -> bool {
    matches!(scalar, Scalar::Real(_) | Scalar::Fixed { .. })
}

/// Operators on IEEE 754 numbers.
fn ieee(pool: &mut Pool, op: Op, format: u32, terms: &[Term]) -> Option<Term> {
    let sign = 1 << (format - 1);
    Some(match op {
        Op::Neg => {
            let sign = pool.constant(format, sign);
            pool.apply(T::Xor, &[terms[0], sign])
        }
        Op::Abs => {
            let rest = pool.constant(format, !sign);
            pool.apply(T::And, &[terms[0], rest])
        }
        Op::Add => fold(pool, T::FloatAdd, terms),
        Op::Sub => pool.apply(T::FloatSub, terms),
        Op::Mul => fold(pool, T::FloatMul, terms),
        Op::Div => pool.apply(T::FloatDiv, terms),
        Op::Eq => pool.apply(T::FloatEq, terms),
        Op::Lt => pool.apply(T::FloatLt, terms),
        Op::Le => pool.apply(T::FloatLe, terms),
        Op::Sqrt => pool.apply(T::FloatSqrt, terms),
        _ => return None,
    })
}

/// The name of a function as it is written.
fn name(function: RealFunction) -> &'static str {
    match function {
        RealFunction::Sin => "SIN",
        RealFunction::Cos => "COS",
        RealFunction::Tan => "TAN",
        RealFunction::Asin => "ASIN",
        RealFunction::Acos => "ACOS",
        RealFunction::Atan => "ATAN",
        RealFunction::Atan2 => "ATAN2",
        RealFunction::Exp => "EXP",
        RealFunction::Ln => "LN",
        RealFunction::Log => "LOG",
        RealFunction::Power => "EXPT",
    }
}

/// The error for an expression.
fn unsupported<L, E: From<Unsupported>>(expr: &Expr<L>, what: &str) -> E {
    Unsupported { what: what.to_owned(), place: expr.place }.into()
}
