//! The global variables of a table. One that is declared without a type has that of the columns whose cells name it: of the
//! column that it is a value of, or else of any column whose cells it stands in; of several numeric types, the one that holds
//! all their values.

use super::{Binder, BoundGlobal, Leaf};
use crate::semantics::expr::{Expr as Typed, ExprKind as TypedKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Operand, Type, types};
use crate::table::cell::ast::{Chunk, ChunkKind, Expr, ExprKind};
use crate::table::model::Global;

impl Binder<'_> {
    /// Gives every global variable its type.
    pub(super) fn type_globals(&mut self) {
        let table = self.table;
        for global in &table.globals {
            let type_ = match &global.ty {
                Some(ty) if !ty.text.eq_ignore_ascii_case("ENUM") => {
                    let type_ = self.named_type(&ty.text);
                    if type_.is_none() {
                        let stop = self.no_type(&ty.text, ty.place);
                        self.report(*stop);
                    }
                    type_
                }
                _ => self.compared_with(global),
            };
            self.globals.push(type_);
        }
    }

    /// The type of the columns that a global variable is compared with.
    fn compared_with(&self, global: &Global) -> Option<Type> {
        let (mut direct, mut loose): (Option<Type>, Option<Type>) = (None, None);
        for row in self.table.rows() {
            for (cell, subject) in row.cells.iter().zip(&self.subjects) {
                let constraint = cell.as_ref().and_then(|cell| cell.constraint.as_ref());
                let (Some(constraint), Some([Operand::Typed(_, type_)])) = (constraint, subject.as_deref()) else {
                    continue;
                };
                for chunk in &constraint.chunks {
                    match mention(chunk, &global.name) {
                        Mention::Value => direct = joined(direct, type_),
                        Mention::Part => loose = joined(loose, type_),
                        Mention::None => {}
                    }
                }
            }
        }
        direct.or(loose)
    }

    /// The global variables with their constraints.
    pub(super) fn bind_globals(&mut self) -> Vec<BoundGlobal> {
        let table = self.table;
        let mut out = Vec::new();
        for (index, global) in table.globals.iter().enumerate() {
            let type_ = self.globals[index].clone();
            let scalar = type_.as_ref().and_then(Type::scalar).unwrap_or(Scalar::Bool);
            let enumeration = match &type_ {
                Some(Type::Enumeration { item, .. }) => *item,
                _ => None,
            };
            let labels = type_.as_ref().map_or_else(Vec::new, |type_| self.labels(type_));
            let mut constraint = None;
            if let (Some(cell), Some(type_)) = (&global.constraint, type_) {
                let kind = TypedKind::Read(Leaf::Global(index));
                let own = Operand::Typed(Typed { kind, scalar, place: Some(cell.place) }, type_);
                match self.cell(cell, &[own]) {
                    Some(Ok(cell)) => constraint = Some(cell.first),
                    Some(Err(stop)) => self.report(*stop),
                    None => {}
                }
            }
            out.push(BoundGlobal {
                name: global.name.clone(),
                scalar,
                enumeration,
                labels,
                constraint,
                place: global.place,
            });
        }
        out
    }
}

/// How a part of a cell names a global variable.
enum Mention {
    None,
    /// As the value that the column is compared with.
    Value,
    /// Somewhere inside.
    Part,
}

fn mention(chunk: &Chunk, name: &str) -> Mention {
    let names = |expr: &Expr| matches!(&expr.kind, ExprKind::Name(path) if path.is_plain() && path.name.eq_ignore_ascii_case(name));
    let value = match &chunk.kind {
        ChunkKind::Value(expr) | ChunkKind::Compare(_, expr) => names(expr),
        ChunkKind::Interval(interval) => interval.low.iter().chain(&interval.high).any(names),
        ChunkKind::Trigger(inner) => return mention(inner, name),
        _ => false,
    };
    if value {
        return Mention::Value;
    }
    let mut part = false;
    chunk.walk(&mut |expr| part |= names(expr));
    if part { Mention::Part } else { Mention::None }
}

/// The type that holds the values of both; the first one where there is none.
fn joined(known: Option<Type>, other: &Type) -> Option<Type> {
    let other = match other {
        Type::Subrange { base, .. } => Type::Scalar(*base),
        other => other.clone(),
    };
    let Some(known) = known else { return Some(other) };
    match (&known, &other) {
        (Type::Scalar(a), Type::Scalar(b)) => Some(types::common(*a, *b).map_or(known, Type::Scalar)),
        _ => Some(known),
    }
}
