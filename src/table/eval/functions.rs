//! The standard functions that cells may call, of IEC 61131-3, tables 28 to 32.

use std::cmp::Ordering;

use super::value::{NoValue, Value};
use crate::table::cell::ast::BinaryOp;

type Result<T> = std::result::Result<T, NoValue>;

/// The standard function's result; `None` where `name` is none.
pub(super) fn standard(name: &str, named: &[Option<&str>], args: &[Value]) -> Option<Result<Value>> {
    let name = name.to_ascii_uppercase();
    let formals = formals(&name)?;
    Some(ordered(formals, named, args).and_then(|args| apply(&name, &args)))
}

/// Whether cells can call the function without the table bringing it along.
#[must_use]
pub fn is_standard(name: &str) -> bool {
    formals(&name.to_ascii_uppercase()).is_some()
}

/// The names of the arguments; functions that take any number of them have none.
fn formals(name: &str) -> Option<&'static [&'static str]> {
    Some(match name {
        "SEL" => &["G", "IN0", "IN1"],
        "LIMIT" => &["MN", "IN", "MX"],
        "ABS" | "NOT" | "MOVE" | "TRUNC" | "SQRT" => &["IN"],
        "EXPT" | "SUB" | "DIV" | "MOD" | "NE" => &["IN1", "IN2"],
        "MIN" | "MAX" | "MUX" | "ADD" | "MUL" | "AND" | "OR" | "XOR" | "EQ" | "LT" | "LE" | "GT" | "GE" => &[],
        _ => return None,
    })
}

fn ordered(formals: &[&str], named: &[Option<&str>], args: &[Value]) -> Result<Vec<Value>> {
    if named.iter().all(Option::is_none) || formals.is_empty() {
        return Ok(args.to_vec());
    }
    let find = |formal: &&str| {
        let at = named.iter().position(|name| name.is_some_and(|name| name.eq_ignore_ascii_case(formal)));
        at.map(|at| args[at].clone()).ok_or_else(|| NoValue(format!("argument `{formal}` is missing")))
    };
    formals.iter().map(find).collect()
}

fn apply(name: &str, args: &[Value]) -> Result<Value> {
    match (name, args) {
        // IEC 61131-3: IN1 where G is true.
        ("SEL", [choice, no, yes]) => Ok(if choice.truth()? { yes.clone() } else { no.clone() }),
        ("LIMIT", [low, value, high]) => least(&greatest(low, value)?, high),
        ("MIN", [first, rest @ ..]) => {
            rest.iter().try_fold(first.clone(), |least_so_far, next| least(&least_so_far, next))
        }
        ("MAX", [first, rest @ ..]) => rest.iter().try_fold(first.clone(), |most, next| greatest(&most, next)),
        ("MUX", [Value::Int(index, _), rest @ ..]) => {
            let value = usize::try_from(*index).ok().and_then(|index| rest.get(index));
            value.cloned().ok_or_else(|| NoValue(format!("`MUX` has no input {index}")))
        }
        ("ABS", [value]) => {
            if value.order(&zero(value))? == Some(Ordering::Less) {
                value.negated()
            } else {
                Ok(value.clone())
            }
        }
        ("NOT", [value]) => value.inverted(),
        ("MOVE", [value]) => Ok(value.clone()),
        #[allow(clippy::cast_possible_truncation, reason = "TRUNC cuts, and `as` saturates")]
        ("TRUNC", [Value::Real(value)]) => Ok(Value::int(value.trunc() as i128)),
        ("SQRT", [Value::Real(value)]) if *value >= 0.0 => Ok(Value::Real(value.sqrt())),
        ("EXPT", [base, exponent]) => Value::binary(BinaryOp::Power, base, exponent),
        ("SUB", [a, b]) => Value::binary(BinaryOp::Sub, a, b),
        ("DIV", [a, b]) => Value::binary(BinaryOp::Div, a, b),
        ("MOD", [a, b]) => Value::binary(BinaryOp::Mod, a, b),
        ("NE", [a, b]) => Value::binary(BinaryOp::Ne, a, b),
        ("ADD", args) => folded(BinaryOp::Add, args),
        ("MUL", args) => folded(BinaryOp::Mul, args),
        ("AND", args) => folded(BinaryOp::And, args),
        ("OR", args) => folded(BinaryOp::Or, args),
        ("XOR", args) => folded(BinaryOp::Xor, args),
        ("EQ", args) => chain(BinaryOp::Eq, args),
        ("LT", args) => chain(BinaryOp::Lt, args),
        ("LE", args) => chain(BinaryOp::Le, args),
        ("GT", args) => chain(BinaryOp::Gt, args),
        ("GE", args) => chain(BinaryOp::Ge, args),
        _ => Err(NoValue(format!("`{name}` does not take these arguments"))),
    }
}

fn zero(like: &Value) -> Value {
    match like {
        Value::Time(_) => Value::Time(0),
        Value::Real(_) => Value::Real(0.0),
        _ => Value::int(0),
    }
}

fn least(a: &Value, b: &Value) -> Result<Value> {
    Ok(if b.order(a)? == Some(Ordering::Less) { b.clone() } else { a.clone() })
}

fn greatest(a: &Value, b: &Value) -> Result<Value> {
    Ok(if b.order(a)? == Some(Ordering::Greater) { b.clone() } else { a.clone() })
}

fn folded(op: BinaryOp, args: &[Value]) -> Result<Value> {
    match args {
        [first, rest @ ..] if !rest.is_empty() => {
            rest.iter().try_fold(first.clone(), |sum, next| Value::binary(op, &sum, next))
        }
        _ => Err(NoValue("two arguments at least".to_owned())),
    }
}

/// `LT(a, b, c)` is `a < b AND b < c`.
fn chain(op: BinaryOp, args: &[Value]) -> Result<Value> {
    let mut holds = args.len() > 1;
    for pair in args.windows(2) {
        holds &= Value::binary(op, &pair[0], &pair[1])?.truth()?;
    }
    Ok(Value::Bool(holds))
}
