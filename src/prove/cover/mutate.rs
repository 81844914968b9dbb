//! Mutants of a program: each differs from it in one small change, as people make them by mistake.
//!
//! DeMillo, Lipton and Sayward, *Hints on test data selection* (IEEE Computer 1978); the operators are the five that Offutt et
//! al., *An experimental determination of sufficient mutant operators* (TOSEM 1996), found to suffice, as far as IEC 61131-3 has
//! them, and deleted assignments. Changes are made to the elaborated program, so that they are well typed by construction.

use std::collections::BTreeSet;

use crate::library::ItemId;
use crate::machine::program::{Program, Statement, StatementKind, Value};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// What was changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// The statement is left out.
    Deleted,
    /// The operator is another one.
    Operator(&'static str),
    /// The condition or the value is negated.
    Negated,
    /// The condition always, or never, holds.
    Fixed(bool),
    /// A constant of this type has these bits.
    Constant(Scalar, u64),
}

/// A change and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutation {
    /// Where.
    pub place: Place,
    /// What.
    pub change: Change,
}

/// Every change that can be made to the routines that a cycle runs and that `counts` says yes to, in the order of the source.
#[must_use]
pub fn mutations(program: &Program, counts: &dyn Fn(ItemId) -> bool) -> Vec<(usize, Mutation)> {
    let mut all = pass(&mut program.clone(), counts, None);
    all.sort_by_key(|(number, mutation)| (mutation.place, *number));
    all
}

/// The program with the change of this number.
#[must_use]
pub fn mutant(program: &Program, counts: &dyn Fn(ItemId) -> bool, number: usize) -> Program {
    let mut changed = program.clone();
    pass(&mut changed, counts, Some(number));
    changed
}

/// Offers every change; makes the one with the number that is chosen.
fn pass(program: &mut Program, counts: &dyn Fn(ItemId) -> bool, chosen: Option<usize>) -> Vec<(usize, Mutation)> {
    let run: BTreeSet<usize> = super::probe::run(program);
    let mut mutator = Mutator { chosen, offered: Vec::new(), cycle_time: program.cycle_time };
    for id in run {
        let routine = &mut program.routines[id];
        if routine.item.is_some_and(counts) {
            mutator.block(&mut routine.body);
        }
    }
    mutator.offered
}

struct Mutator {
    chosen: Option<usize>,
    offered: Vec<(usize, Mutation)>,
    cycle_time: u64,
}

impl Mutator {
    /// Offers a change; whether it is to be made.
    fn offer(&mut self, place: Option<Place>, change: Change) -> bool {
        let Some(place) = place else { return false };
        let number = self.offered.len();
        self.offered.push((number, Mutation { place, change }));
        self.chosen == Some(number)
    }

    fn block(&mut self, statements: &mut Vec<Statement>) {
        let mut deleted = None;
        for at in 0..statements.len() {
            let place = statements[at].place;
            let is_assignment =
                matches!(statements[at].kind, StatementKind::Assign { .. } | StatementKind::Copy { .. });
            // Several assignments at one place are a call with its parameters, and none of them is a statement.
            let alone = !(at > 0 && statements[at - 1].place == place)
                && statements.get(at + 1).is_none_or(|next| next.place != place);
            if is_assignment && alone && self.offer(place, Change::Deleted) {
                deleted = Some(at);
            }
            self.statement(&mut statements[at]);
        }
        if let Some(at) = deleted {
            statements.remove(at);
        }
    }

    fn statement(&mut self, statement: &mut Statement) {
        let place = statement.place;
        match &mut statement.kind {
            StatementKind::Assign { value, .. } => self.value(value),
            StatementKind::If { condition, then, otherwise } => {
                let at = condition.place.or(place);
                if self.offer(at, Change::Negated) {
                    negate(condition);
                }
                for truth in [true, false] {
                    if self.offer(at, Change::Fixed(truth)) {
                        condition.kind = ExprKind::Const(u64::from(truth));
                    }
                }
                self.value(condition);
                self.block(then);
                self.block(otherwise);
            }
            StatementKind::Case { selector, arms, otherwise } => {
                self.value(selector);
                arms.iter_mut().for_each(|arm| self.block(&mut arm.body));
                self.block(otherwise);
            }
            StatementKind::For { from, to, by, body, .. } => {
                [from, to, by].into_iter().for_each(|value| self.value(value));
                self.block(body);
            }
            StatementKind::Loop { body, after } => {
                self.block(body);
                self.block(after);
            }
            _ => {}
        }
    }

    fn value(&mut self, value: &mut Value) {
        let place = value.place;
        match &mut value.kind {
            ExprKind::Const(bits) => {
                let scalar = value.scalar;
                for other in others(scalar, *bits, self.cycle_time) {
                    if self.offer(place, Change::Constant(scalar, other)) {
                        *bits = other;
                        return;
                    }
                }
            }
            ExprKind::Read(_) | ExprKind::Address(_) => {}
            ExprKind::Apply(op, operands) => {
                operands.iter_mut().for_each(|operand| self.value(operand));
                self.operator(place, *op, value);
            }
            ExprKind::AndThen(first, second) => {
                self.value(first);
                self.value(second);
                if self.offer(place, Change::Operator("OR_ELSE")) {
                    value.kind = ExprKind::OrElse(first.clone(), second.clone());
                }
            }
            ExprKind::OrElse(first, second) => {
                self.value(first);
                self.value(second);
                if self.offer(place, Change::Operator("AND_THEN")) {
                    value.kind = ExprKind::AndThen(first.clone(), second.clone());
                }
            }
            ExprKind::If(condition, then, otherwise) => {
                [condition, then, otherwise].into_iter().for_each(|part| self.value(part));
            }
        }
    }

    fn operator(&mut self, place: Option<Place>, op: Op, value: &mut Value) {
        let others: &[(Op, &'static str)] = match op {
            Op::Add => &[(Op::Sub, "-")],
            Op::Sub => &[(Op::Add, "+")],
            Op::Mul => &[(Op::Add, "+")],
            Op::Div => &[(Op::Mul, "*")],
            Op::And => &[(Op::Or, "OR")],
            Op::Or | Op::Xor => &[(Op::And, "AND")],
            Op::Lt => &[(Op::Le, "the same comparison with equality")],
            Op::Le => &[(Op::Lt, "the same comparison without equality")],
            _ => &[],
        };
        for (other, name) in others {
            if self.offer(place, Change::Operator(name))
                && let ExprKind::Apply(own, _) = &mut value.kind
            {
                *own = *other;
                return;
            }
        }
        if matches!(op, Op::Lt | Op::Le)
            && self.offer(place, Change::Operator("the opposite comparison"))
            && let ExprKind::Apply(_, operands) = &mut value.kind
        {
            operands.reverse();
            return;
        }
        if matches!(op, Op::Eq | Op::Not) && value.scalar == Scalar::Bool && self.offer(place, Change::Negated) {
            negate(value);
        }
    }
}

/// Puts `NOT` before a `BOOL`, or takes it away.
fn negate(value: &mut Value) {
    let (scalar, place) = (value.scalar, value.place);
    let inner = std::mem::replace(&mut value.kind, ExprKind::Const(0));
    value.kind = match inner {
        ExprKind::Apply(Op::Not, mut operands) if operands.len() == 1 => operands.remove(0).kind,
        kind => ExprKind::Apply(Op::Not, vec![Expr { kind, scalar, place }]),
    };
}

/// Constants near this one: the other truth value, one more and one less, a time one cycle longer and shorter.
fn others(scalar: Scalar, bits: u64, cycle_time: u64) -> Vec<u64> {
    let step = match scalar {
        Scalar::Bool => return vec![bits ^ 1],
        Scalar::Int { .. } | Scalar::Bits(_) => 1,
        Scalar::Time(32) => (cycle_time / 1_000_000).max(1),
        Scalar::Time(_) => cycle_time.max(1),
        _ => return Vec::new(),
    };
    let width = crate::logic::term::mask(scalar.width());
    vec![bits.wrapping_add(step) & width, bits.wrapping_sub(step) & width]
}
