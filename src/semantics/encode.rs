//! Typed expressions as bit-vector terms: the second of their two meanings, the first being their evaluation on values.
//!
//! Evaluation follows the expression from left to right under a guard: what `AND_THEN`, `OR_ELSE` and `If` do not evaluate cannot
//! fault. Of the faults reported, the first one whose condition holds is the one that occurs; values that are made from
//! a part that faults mean nothing.
//!
//! `REAL` is IEEE 754; in a program that is read in fixed point ([`super::fixed`]) there are scaled integers in its place.

mod convert;
mod fixed;
mod operator;

pub use convert::resize;

use super::expr::{Expr, ExprKind, Fault};
use crate::logic::term::{self, Pool, Term};
use crate::text::Place;

/// What has no meaning as a term.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// What it is, as a phrase: "`SIN` of `REAL`".
    pub what: String,
    /// Where it stands.
    pub place: Option<Place>,
}

/// What stands around an expression: its leaves, the terms that it becomes, and what happens when it faults.
pub trait Context<L> {
    /// Why an expression has no term.
    type Error: From<Unsupported>;

    /// Where the terms are made.
    fn pool(&mut self) -> &mut Pool;

    /// The value of a leaf.
    ///
    /// # Errors
    /// Where it has none.
    fn read(&mut self, leaf: &L, at: &Expr<L>) -> Result<Term, Self::Error>;

    /// The address of a leaf.
    ///
    /// # Errors
    /// Where it has none.
    fn address(&mut self, leaf: &L, at: &Expr<L>) -> Result<Term, Self::Error>;

    /// Where `condition` holds and the guard does, the run stops with the fault.
    fn fault(&mut self, condition: Term, fault: Fault, place: Option<Place>);

    /// Narrows the guard by a condition and returns the one before.
    fn narrow(&mut self, condition: Term) -> Term;

    /// Sets the guard back.
    fn widen(&mut self, before: Term);
}

/// The term of an expression in its context.
///
/// # Errors
/// Where a part of it has no term.
pub fn value<L, C: Context<L>>(context: &mut C, expr: &Expr<L>) -> Result<Term, C::Error> {
    match &expr.kind {
        ExprKind::Const(bits) => {
            let width = expr.scalar.width();
            Ok(context.pool().constant(width, *bits & term::mask(width)))
        }
        ExprKind::Read(leaf) => context.read(leaf, expr),
        ExprKind::Address(leaf) => context.address(leaf, expr),
        ExprKind::Apply(op, operands) => {
            let mut terms = Vec::with_capacity(operands.len());
            for operand in operands {
                terms.push(value(context, operand)?);
            }
            operator::apply(context, *op, expr, &terms)
        }
        ExprKind::AndThen(left, right) => {
            let left = value(context, left)?;
            let no = context.pool().truth(false);
            branches(context, left, Ok(right), Err(no))
        }
        ExprKind::OrElse(left, right) => {
            let left = value(context, left)?;
            let yes = context.pool().truth(true);
            branches(context, left, Err(yes), Ok(right))
        }
        ExprKind::If(condition, then, otherwise) => {
            let condition = value(context, condition)?;
            branches(context, condition, Ok(then), Ok(otherwise))
        }
    }
}

/// One branch where the condition holds and the other one where not; a branch is an expression or a term.
fn branches<L, C: Context<L>>(
    context: &mut C,
    condition: Term,
    then: Result<&Expr<L>, Term>,
    otherwise: Result<&Expr<L>, Term>,
) -> Result<Term, C::Error> {
    let branch = |context: &mut C, guard: Term, what: Result<&Expr<L>, Term>| match what {
        Err(term) => Ok(term),
        Ok(expr) => {
            let before = context.narrow(guard);
            let term = value(context, expr);
            context.widen(before);
            term
        }
    };
    let yes = context.pool().truth(true);
    match context.pool().value(condition) {
        Some(0) => branch(context, yes, otherwise),
        Some(_) => branch(context, yes, then),
        None => {
            let yes = branch(context, condition, then)?;
            let opposite = context.pool().apply(term::Op::Not, &[condition]);
            let no = branch(context, opposite, otherwise)?;
            Ok(context.pool().apply(term::Op::Ite, &[condition, yes, no]))
        }
    }
}

/// A fault that an expression may run into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Guarded {
    /// Where it holds, width 1, and no earlier one does, the fault occurs.
    pub condition: Term,
    /// Which.
    pub fault: Fault,
    /// Where.
    pub place: Option<Place>,
}

/// An expression as terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoded {
    /// Its value; it means nothing where it faults.
    pub value: Term,
    /// Its faults, in the order of evaluation.
    pub faults: Vec<Guarded>,
}

/// The terms of an expression whose leaves are simple: `leaf` gives the value of each, of the leaf's type.
///
/// # Errors
/// Where a part has no term; the address of a leaf never has one here.
pub fn encode<L>(
    pool: &mut Pool,
    expr: &Expr<L>,
    leaf: &mut impl FnMut(&mut Pool, &L) -> Term,
) -> Result<Encoded, Unsupported> {
    let guard = pool.truth(true);
    let mut plain = Plain { pool, leaf, guard, faults: Vec::new() };
    let value = value(&mut plain, expr)?;
    Ok(Encoded { value, faults: plain.faults })
}

/// The context of an expression whose leaves are values.
struct Plain<'a, F> {
    pool: &'a mut Pool,
    leaf: &'a mut F,
    guard: Term,
    faults: Vec<Guarded>,
}

impl<L, F: FnMut(&mut Pool, &L) -> Term> Context<L> for Plain<'_, F> {
    type Error = Unsupported;

    fn pool(&mut self) -> &mut Pool {
        self.pool
    }

    fn read(&mut self, leaf: &L, _: &Expr<L>) -> Result<Term, Unsupported> {
        Ok((self.leaf)(self.pool, leaf))
    }

    fn address(&mut self, _: &L, at: &Expr<L>) -> Result<Term, Unsupported> {
        Err(Unsupported { what: "an address".to_owned(), place: at.place })
    }

    fn fault(&mut self, condition: Term, fault: Fault, place: Option<Place>) {
        let condition = self.pool.apply(term::Op::And, &[self.guard, condition]);
        if self.pool.value(condition) != Some(0) {
            self.faults.push(Guarded { condition, fault, place });
        }
    }

    fn narrow(&mut self, condition: Term) -> Term {
        let narrowed = self.pool.apply(term::Op::And, &[self.guard, condition]);
        std::mem::replace(&mut self.guard, narrowed)
    }

    fn widen(&mut self, before: Term) {
        self.guard = before;
    }
}
