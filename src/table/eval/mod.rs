//! Cells over concrete values: what a row admits in one cycle of a run.
//!
//! A cell whose expression has no value (a division by zero, no guard that holds) is not satisfied.

mod functions;
mod value;

use super::cell::ast::{
    BinaryOp, Chunk, ChunkKind, Constraint, Expr, ExprKind, Literal, LiteralValue, Path, Predicate, UnaryOp,
};
use super::model::Subject;

pub use functions::is_standard;
pub use value::{IntType, NoValue, Value};

/// What names stand for in the cycle that is looked at.
pub trait Scope {
    /// The value of a variable or of a global variable of the table, `ago` cycles before; `None` for a name that is neither,
    /// which is then taken for a value of an enum.
    fn value(&self, path: &Path, ago: u32) -> Option<Value>;

    /// Calls a function that the table brings along.
    fn call(&self, name: &str, args: &[Value]) -> Option<Value>;
}

type Result<T> = std::result::Result<T, NoValue>;

/// A cell's own variable and its surroundings.
pub struct Evaluator<'s> {
    scope: &'s dyn Scope,
    subject: &'s Subject,
}

impl<'s> Evaluator<'s> {
    /// An evaluator for the cells of a column.
    #[must_use]
    pub fn new(scope: &'s dyn Scope, subject: &'s Subject) -> Self {
        Self { scope, subject }
    }

    /// Whether the cell holds; triggers count if it is the row's first cycle.
    #[must_use]
    pub fn holds(&self, constraint: &Constraint, first: bool) -> bool {
        constraint.chunks.iter().all(|chunk| self.chunk(chunk, first).unwrap_or(false))
    }

    fn chunk(&self, chunk: &Chunk, first: bool) -> Result<bool> {
        match &chunk.kind {
            ChunkKind::Any => Ok(true),
            ChunkKind::Trigger(inner) => {
                if first {
                    self.chunk(inner, first)
                } else {
                    Ok(true)
                }
            }
            ChunkKind::Value(expr) => self.own()?.same(&self.expr(expr)?),
            ChunkKind::Compare(op, expr) => Value::binary(*op, &self.own()?, &self.expr(expr)?)?.truth(),
            ChunkKind::Condition(expr) => self.expr(expr)?.truth(),
            ChunkKind::Interval(interval) => {
                let own = self.own()?;
                let above = if interval.low_closed { BinaryOp::Ge } else { BinaryOp::Gt };
                let below = if interval.high_closed { BinaryOp::Le } else { BinaryOp::Lt };
                let end = |op, end: &Option<Expr>| match end {
                    Some(expr) => Value::binary(op, &own, &self.expr(expr)?)?.truth(),
                    None => Ok(true),
                };
                Ok(end(above, &interval.low)? && end(below, &interval.high)?)
            }
            ChunkKind::Guarded(arms) => {
                for arm in arms {
                    if self.expr(&arm.guard)?.truth()? {
                        return self.chunk(&arm.then, first);
                    }
                }
                Ok(false)
            }
            ChunkKind::Predicate(predicate) => self.predicate(predicate),
        }
    }

    /// The value of the column's own variable or projection.
    fn own(&self) -> Result<Value> {
        match self.subject {
            Subject::Variable(path) => self.name(path, 0),
            Subject::Projection(exprs) => match exprs.as_slice() {
                [expr] => self.expr(expr),
                _ => Err(NoValue("a column with several arguments has no value of its own".to_owned())),
            },
        }
    }

    fn predicate(&self, predicate: &Predicate) -> Result<bool> {
        let Subject::Projection(exprs) = self.subject else {
            return Err(NoValue("a predicate needs a column with several arguments".to_owned()));
        };
        let args = exprs.iter().map(|expr| self.expr(expr)).collect::<Result<Vec<Value>>>()?;
        match (predicate, args.as_slice()) {
            (Predicate::Compare(op), [left, right]) => Value::binary(*op, left, right)?.truth(),
            (Predicate::Function(name), args) => self.call(name, args)?.truth(),
            _ => Err(NoValue("this predicate takes two arguments".to_owned())),
        }
    }

    fn name(&self, path: &Path, ago: u32) -> Result<Value> {
        match self.scope.value(path, ago) {
            Some(value) => Ok(value),
            None if ago == 0 => Ok(Value::Enum(path.steps.last().map_or_else(|| path.name.clone(), last_step))),
            None => Err(NoValue(format!("`{}` has no value so long ago", path.name))),
        }
    }

    /// The value of an expression.
    ///
    /// # Errors
    /// Where it has none.
    pub fn expr(&self, expr: &Expr) -> Result<Value> {
        match &expr.kind {
            ExprKind::Own => self.own(),
            ExprKind::Literal(literal) => constant(literal),
            ExprKind::EnumValue { name, .. } => Ok(Value::Enum(name.clone())),
            ExprKind::Name(path) => self.name(path, 0),
            ExprKind::Past(path, ago) => self.name(path, *ago),
            ExprKind::Unary(op, inner) => {
                let inner = self.expr(inner)?;
                match op {
                    UnaryOp::Minus => inner.negated(),
                    UnaryOp::Plus => Ok(inner),
                    UnaryOp::Not => inner.inverted(),
                }
            }
            ExprKind::Binary(op, left, right) => Value::binary(*op, &self.expr(left)?, &self.expr(right)?),
            ExprKind::Call { name, args } => {
                let values = args.iter().map(|arg| self.expr(&arg.value)).collect::<Result<Vec<Value>>>()?;
                let named: Vec<Option<&str>> = args.iter().map(|arg| arg.name.as_deref()).collect();
                match functions::standard(name, &named, &values) {
                    Some(result) => result,
                    None => self.call(name, &values),
                }
            }
            ExprKind::Guarded(arms) => {
                for (guard, then) in arms {
                    if self.expr(guard)?.truth()? {
                        return self.expr(then);
                    }
                }
                Err(NoValue("no guard holds".to_owned()))
            }
        }
    }

    fn call(&self, name: &str, args: &[Value]) -> Result<Value> {
        self.scope.call(name, args).ok_or_else(|| NoValue(format!("no function is named `{name}`")))
    }
}

fn last_step(step: &super::cell::ast::Step) -> String {
    match step {
        super::cell::ast::Step::Member(name) => name.clone(),
        super::cell::ast::Step::Index(_) => String::new(),
    }
}

/// The value of a literal.
///
/// # Errors
/// Dates have none here.
pub fn constant(literal: &Literal) -> Result<Value> {
    match &literal.value {
        LiteralValue::Bool(value) => Ok(Value::Bool(*value)),
        LiteralValue::Int(value, ty) => Ok(Value::Int(*value, ty.as_deref().and_then(IntType::named))),
        LiteralValue::Real(text, _) => {
            text.parse().map(Value::Real).map_err(|_| NoValue(format!("`{text}` is no number")))
        }
        LiteralValue::Time(nanos, _) => Ok(Value::Time(*nanos)),
        LiteralValue::Text(text, _) => Ok(Value::Text(text.clone())),
        LiteralValue::Date(..) => Err(NoValue("dates are not calculated with".to_owned())),
    }
}
