//! Cells to typed expressions: each part a condition, all of them together.

use std::sync::Arc;

use super::paths::{stop, undecided};
use super::shapes::called;
use super::{Binder, BoundCell, BoundRow, Leaf, Result, Stop, Term};
use crate::semantics::expr::{ExprKind as Kind, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::types::{BOOL, INT};
use crate::semantics::typing::{Operand, Type, TypeError, apply, binary, constant, convert, functions, literal};
use crate::syntax::TokenKind;
use crate::syntax::ast::{BinaryOperator, UnaryOperator};
use crate::table::cell::ast::{
    Arg, BinaryOp, Chunk, ChunkKind, Expr, ExprKind, Interval, Literal, LiteralValue, Predicate, UnaryOp,
};
use crate::table::codes;
use crate::table::model::Cell;
use crate::text::{FileId, Place};

/// What a row's first cycle asks for, and its later ones where that is something else.
type Pair = (Term, Option<Term>);

/// Two constraints joined, in the first cycle and in the later ones.
fn joined(a: Pair, b: Pair, join: impl Fn(Term, Term) -> Term) -> Pair {
    let later = match (a.1, b.1) {
        (None, None) => None,
        (x, y) => Some(join(x.unwrap_or_else(|| a.0.clone()), y.unwrap_or_else(|| b.0.clone()))),
    };
    (join(a.0, b.0), later)
}

/// What a cell's own variable is, and what it may be compared with.
struct Around<'o> {
    own: &'o [Operand<Leaf>],
    file: FileId,
}

fn truth(value: bool, place: Option<Place>) -> Term {
    constant(BOOL, u64::from(value), place)
}

fn both(op: Op, left: Term, right: Term, place: Place) -> Term {
    apply(op, BOOL, vec![left, right], Some(place))
}

/// A type error as one of the cell.
fn typed(place: Place) -> impl Fn(TypeError) -> Box<Stop> {
    move |error| {
        let mut stop = stop(&codes::TABLE_TYPE, error.place.unwrap_or(place), error.message);
        stop.finding.help.extend(error.help);
        stop
    }
}

const fn operator(op: BinaryOp) -> BinaryOperator {
    match op {
        BinaryOp::Or | BinaryOp::Implies => BinaryOperator::Or,
        BinaryOp::Xor => BinaryOperator::Xor,
        BinaryOp::And => BinaryOperator::And,
        BinaryOp::Eq => BinaryOperator::Equal,
        BinaryOp::Ne => BinaryOperator::NotEqual,
        BinaryOp::Lt => BinaryOperator::Less,
        BinaryOp::Le => BinaryOperator::LessEqual,
        BinaryOp::Gt => BinaryOperator::Greater,
        BinaryOp::Ge => BinaryOperator::GreaterEqual,
        BinaryOp::Add => BinaryOperator::Add,
        BinaryOp::Sub => BinaryOperator::Subtract,
        BinaryOp::Mul => BinaryOperator::Multiply,
        BinaryOp::Div => BinaryOperator::Divide,
        BinaryOp::Mod => BinaryOperator::Modulo,
        BinaryOp::Power => BinaryOperator::Power,
    }
}

/// An expression of the type that has no value: evaluated, it faults.
fn no_value(scalar: Scalar, place: Place) -> Term {
    let zero = constant(INT, 0, None);
    let fault = apply(Op::Div, INT, vec![constant(INT, 1, None), zero], Some(place));
    apply(Op::Convert, scalar, vec![fault], Some(place))
}

impl Binder<'_> {
    /// Binds every row.
    pub(super) fn bind_rows(&mut self) -> Vec<BoundRow> {
        let table = self.table;
        let mut above: Vec<(Option<Arc<BoundCell>>, bool)> = vec![(None, false); table.columns.len()];
        let mut out = Vec::new();
        for row in table.rows() {
            for (index, cell) in row.cells.iter().enumerate() {
                if let Some(cell) = cell {
                    above[index] = self.own_cell(cell, index);
                }
            }
            let spoiled = row.duration.spoiled || above.iter().any(|(_, wrong)| *wrong);
            out.push(BoundRow { cells: above.iter().map(|(cell, _)| cell.clone()).collect(), spoiled });
        }
        out
    }

    /// The cell, and whether it is wrong.
    fn own_cell(&mut self, cell: &Cell, column: usize) -> (Option<Arc<BoundCell>>, bool) {
        let subject = std::mem::take(&mut self.subjects[column]);
        let bound = match &subject {
            Some(own) => self.cell(cell, own),
            None if cell.constraint.as_ref().is_some_and(crate::table::cell::ast::Constraint::is_any) => None,
            None => return (None, true),
        };
        self.subjects[column] = subject;
        match bound {
            Some(Ok(cell)) => (Some(Arc::new(cell)), false),
            Some(Err(stop)) => {
                self.report(*stop);
                (None, true)
            }
            None => (None, cell.constraint.is_none()),
        }
    }

    /// What a cell of a column says; nothing where it admits anything or could not be read.
    pub(super) fn cell(&mut self, cell: &Cell, own: &[Operand<Leaf>]) -> Option<Result<BoundCell>> {
        let constraint = cell.constraint.as_ref().filter(|constraint| !constraint.is_any())?;
        let around = Around { own, file: cell.place.file };
        let mut all: Option<Pair> = None;
        for chunk in &constraint.chunks {
            let pair = match self.chunk(chunk, &around) {
                Ok(pair) => pair,
                Err(stop) => return Some(Err(stop)),
            };
            all = Some(match all {
                None => pair,
                Some(before) => joined(before, pair, |a, b| both(Op::And, a, b, cell.place)),
            });
        }
        let (first, later) = all?;
        Some(Ok(BoundCell { first, later, place: cell.place }))
    }

    fn chunk(&mut self, chunk: &Chunk, around: &Around<'_>) -> Result<Pair> {
        let place = Place::new(around.file, chunk.span);
        let always = |term: Term| (term, None);
        Ok(match &chunk.kind {
            ChunkKind::Any => always(truth(true, Some(place))),
            ChunkKind::Trigger(inner) => (self.chunk(inner, around)?.0, Some(truth(true, Some(place)))),
            ChunkKind::Value(expr) => always(self.compared(BinaryOp::Eq, expr, around, place)?),
            ChunkKind::Compare(op, expr) => always(self.compared(*op, expr, around, place)?),
            ChunkKind::Condition(expr) => {
                let operand = self.operand(expr, Some(around.own), None, around.file)?;
                always(convert::logical(operand).map_err(typed(place))?)
            }
            ChunkKind::Interval(interval) => always(self.interval(interval, around, place)?),
            ChunkKind::Guarded(arms) => {
                let mut out = always(truth(false, Some(place)));
                for arm in arms.iter().rev() {
                    let guard = self.operand(&arm.guard, Some(around.own), None, around.file)?;
                    let guard = convert::logical(guard).map_err(typed(place))?;
                    let then = self.chunk(&arm.then, around)?;
                    let choose = |then: Term, otherwise: Term| Term {
                        kind: Kind::If(Box::new(guard.clone()), Box::new(then), Box::new(otherwise)),
                        scalar: BOOL,
                        place: Some(place),
                    };
                    out = joined(then, out, choose);
                }
                out
            }
            ChunkKind::Predicate(predicate) => always(self.predicate(predicate, around, place)?),
        })
    }

    /// The column's own variable; one with several arguments has none.
    fn own<'o>(&self, around: &Around<'o>, place: Place) -> Result<&'o Operand<Leaf>> {
        match around.own {
            [own] => Ok(own),
            _ => Err(stop(&codes::TABLE_TYPE, place, "a column with several arguments has no value of its own")),
        }
    }

    fn compared(&mut self, op: BinaryOp, expr: &Expr, around: &Around<'_>, place: Place) -> Result<Term> {
        let own = self.own(around, place)?;
        let right = self.operand(expr, Some(around.own), type_of(own), around.file)?;
        self.comparison(op, own.clone(), right, place)
    }

    /// A comparison of two operands, of one enumeration where they are of enumerations.
    fn comparison(&self, op: BinaryOp, left: Operand<Leaf>, right: Operand<Leaf>, place: Place) -> Result<Term> {
        if let (Some(a @ Type::Enumeration { item: x, .. }), Some(b @ Type::Enumeration { item: y, .. })) =
            (type_of(&left), type_of(&right))
            && (x != y || x.is_none() && a != b)
        {
            let message = format!("a `{}` is compared with a `{}`", called(a), called(b));
            return Err(stop(&codes::TABLE_TYPE, place, message));
        }
        let result = binary::binary(operator(op), left, right, Some(place)).map_err(typed(place))?;
        convert::logical(result).map_err(typed(place))
    }

    fn interval(&mut self, interval: &Interval, around: &Around<'_>, place: Place) -> Result<Term> {
        let low = if interval.low_closed { BinaryOp::Ge } else { BinaryOp::Gt };
        let high = if interval.high_closed { BinaryOp::Le } else { BinaryOp::Lt };
        let mut out = None;
        for (op, end) in [(low, &interval.low), (high, &interval.high)] {
            let Some(end) = end else { continue };
            let term = self.compared(op, end, around, place)?;
            out = Some(match out {
                None => term,
                Some(other) => both(Op::And, other, term, place),
            });
        }
        Ok(out.unwrap_or_else(|| truth(true, Some(place))))
    }

    fn predicate(&mut self, predicate: &Predicate, around: &Around<'_>, place: Place) -> Result<Term> {
        match (predicate, around.own) {
            (Predicate::Compare(op), [left, right]) => self.comparison(*op, left.clone(), right.clone(), place),
            (Predicate::Compare(_), _) => Err(stop(&codes::TABLE_TYPE, place, "this predicate takes two arguments")),
            (Predicate::Function(name), own) => {
                let result = self.call_own(name, own.to_vec(), place)?;
                let result = result.ok_or_else(|| self.no_function(name, place))?;
                convert::logical(result).map_err(typed(place))
            }
        }
    }

    /// What an expression is. `own` is the column's variable, `expected` the type that the expression is compared with.
    pub(super) fn operand(
        &mut self,
        expr: &Expr,
        own: Option<&[Operand<Leaf>]>,
        expected: Option<&Type>,
        file: FileId,
    ) -> Result<Operand<Leaf>> {
        let place = Place::new(file, expr.span);
        match &expr.kind {
            ExprKind::Own => match own {
                Some([own]) => Ok(own.clone().at(Some(place))),
                _ => Err(stop(&codes::TABLE_CELL, place, "a comparison without a left side stands for nothing here")),
            },
            ExprKind::Literal(literal) => value(literal, place),
            ExprKind::EnumValue { ty, name } => self.qualified(ty, name, place),
            ExprKind::Name(path) => self.name(path, 0, expected, place),
            ExprKind::Past(path, ago) => self.name(path, *ago, expected, place),
            ExprKind::Unary(op, inner) => {
                let inner = self.operand(inner, own, expected, file)?;
                let op = match op {
                    UnaryOp::Minus => UnaryOperator::Negate,
                    UnaryOp::Plus => UnaryOperator::Plus,
                    UnaryOp::Not => UnaryOperator::Not,
                };
                binary::unary(op, inner, Some(place)).map_err(typed(place))
            }
            ExprKind::Binary(op, left, right) => self.binary(*op, left, right, (own, expected, place)),
            ExprKind::Call { name, args } => self.call(name, args, (own, expected, place)),
            ExprKind::Guarded(arms) => self.guarded(arms, (own, expected, place)),
        }
    }

    fn binary(
        &mut self,
        op: BinaryOp,
        left: &Expr,
        right: &Expr,
        (own, expected, place): (Option<&[Operand<Leaf>]>, Option<&Type>, Place),
    ) -> Result<Operand<Leaf>> {
        let file = place.file;
        if op.is_comparison() {
            // A value of an enumeration on one side is of the type of the other side.
            let (left, right) = match self.operand(left, own, None, file) {
                Ok(left) => {
                    let right = self.operand(right, own, type_of(&left), file)?;
                    (left, right)
                }
                Err(stop) => {
                    let Ok(right) = self.operand(right, own, None, file) else { return Err(stop) };
                    let Some(type_) = type_of(&right) else { return Err(stop) };
                    (self.operand(left, own, Some(type_), file)?, right.clone())
                }
            };
            return self.comparison(op, left, right, place).map(Operand::of);
        }
        let (left, right) = (self.operand(left, own, expected, file)?, self.operand(right, own, expected, file)?);
        let left = match op {
            BinaryOp::Implies => binary::unary(UnaryOperator::Not, left, Some(place)).map_err(typed(place))?,
            _ => left,
        };
        binary::binary(operator(op), left, right, Some(place)).map_err(typed(place))
    }

    fn call(
        &mut self,
        name: &str,
        args: &[Arg],
        (own, expected, place): (Option<&[Operand<Leaf>]>, Option<&Type>, Place),
    ) -> Result<Operand<Leaf>> {
        let mut values: Vec<Option<Operand<Leaf>>> = vec![None; args.len()];
        for (at, arg) in args.iter().enumerate() {
            let slot = match &arg.name {
                Some(formal) => self.position(name, formal),
                None => Some(at),
            };
            let value = self.operand(&arg.value, own, expected, place.file)?;
            match slot.and_then(|slot| values.get_mut(slot)) {
                Some(slot @ None) => *slot = Some(value),
                _ => {
                    let formal = arg.name.as_deref().unwrap_or("");
                    let message = format!("`{name}` has no argument `{formal}` that could stand here");
                    return Err(stop(&codes::TABLE_TYPE, place, message));
                }
            }
        }
        let values: Vec<Operand<Leaf>> = values.into_iter().flatten().collect();
        if let Some(result) = self.call_own(name, values.clone(), place)? {
            return Ok(result);
        }
        match functions::call(name, values, Some(place)) {
            Some(result) => result.map_err(typed(place)),
            None => Err(self.no_function(name, place)),
        }
    }

    fn guarded(
        &mut self,
        arms: &[(Expr, Expr)],
        (own, expected, place): (Option<&[Operand<Leaf>]>, Option<&Type>, Place),
    ) -> Result<Operand<Leaf>> {
        let mut bound = Vec::new();
        for (guard, then) in arms {
            let guard = self.operand(guard, own, None, place.file)?;
            let guard = convert::logical(guard).map_err(typed(place))?;
            bound.push((guard, self.operand(then, own, expected, place.file)?));
        }
        // All arms in one type: that of what the cell is compared with, or of the first arm that has one.
        let type_ = bound.iter().find_map(|(_, then)| type_of(then).cloned()).or_else(|| expected.cloned());
        let type_ = type_.unwrap_or(Type::Scalar(INT));
        let mut out = no_value(type_.scalar().unwrap_or(BOOL), place);
        for (guard, then) in bound.into_iter().rev() {
            let then = convert::assigned(then, &type_).map_err(typed(place))?;
            if then.lossy {
                let message = format!("the arms are of different types, and not all fit into `{}`", called(&type_));
                return Err(stop(&codes::TABLE_TYPE, place, message));
            }
            let scalar = out.scalar;
            let kind = Kind::If(Box::new(guard), Box::new(then.expr), Box::new(out));
            out = Term { kind, scalar, place: Some(place) };
        }
        Ok(Operand::Typed(out, type_))
    }
}

/// The type of an operand that has one.
fn type_of(operand: &Operand<Leaf>) -> Option<&Type> {
    match operand {
        Operand::Typed(_, type_) => Some(type_),
        _ => None,
    }
}

/// The value of a literal.
fn value(literal: &Literal, place: Place) -> Result<Operand<Leaf>> {
    let wrong = |message: String| stop(&codes::TABLE_TYPE, place, message);
    let of = |scalar: Scalar, bits: u64| Operand::of(constant(scalar, bits, Some(place)));
    let number = |prefix: &Option<String>, kind: TokenKind, text: &str, negative: bool| {
        literal::parse(prefix.as_deref(), negative, kind, text)
            .map_err(wrong)?
            .operand(Some(place))
            .ok_or_else(|| stop(&codes::TABLE_TYPE, place, format!("`{}` is no number", literal.text)))
    };
    match &literal.value {
        LiteralValue::Bool(value) => Ok(of(BOOL, u64::from(*value))),
        LiteralValue::Int(value, None) => Ok(Operand::Integer(*value, Some(place))),
        LiteralValue::Int(value, prefix) => {
            number(prefix, TokenKind::Integer, &value.unsigned_abs().to_string(), *value < 0)
        }
        LiteralValue::Real(text, prefix) => number(prefix, TokenKind::Real, text, false),
        LiteralValue::Time(nanos, long) => time(*nanos, *long).map_or_else(
            || Err(stop(&codes::TABLE_TYPE, place, format!("`{}` does not fit into a `TIME`", literal.text))),
            |(scalar, bits)| Ok(of(scalar, bits)),
        ),
        LiteralValue::Text(..) => Err(undecided(place, "a string in a cell")),
        LiteralValue::Date(prefix, _) => {
            let kind = match prefix.as_str() {
                "TOD" | "TIME_OF_DAY" | "LTOD" | "LTIME_OF_DAY" => TokenKind::TimeOfDay,
                "DT" | "DATE_AND_TIME" | "LDT" | "LDATE_AND_TIME" => TokenKind::DateAndTime,
                _ => TokenKind::Date,
            };
            number(&None, kind, &literal.text, false)
        }
    }
}

/// A time in milliseconds as a `TIME`, or, where that cannot hold it, in nanoseconds as an `LTIME`.
fn time(nanos: i128, long: bool) -> Option<(Scalar, u64)> {
    let milliseconds = u32::try_from(nanos / 1_000_000).ok().filter(|_| nanos % 1_000_000 == 0 && !long);
    match milliseconds {
        Some(milliseconds) => Some((Scalar::Time(32), u64::from(milliseconds))),
        None => u64::try_from(nanos).ok().map(|nanos| (Scalar::Time(64), nanos)),
    }
}
