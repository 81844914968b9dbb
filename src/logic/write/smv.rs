//! The language of NuSMV and nuXmv (*NuSMV 2.6 User Manual*, chapter 2). Every value is an unsigned word, also a truth value.
//! Operators whose totals differ there (division by zero, shifts by the width and more), and floats, are lowered to bits.

use std::fmt::Write;

use super::lower;
use crate::logic::eval::below;
use crate::logic::system::{Labelled, System};
use crate::logic::term::{Node, Op, Term, Var};

/// The system as a module `main`; constraints are `INVAR`, obligations `INVARSPEC`, in their order.
#[must_use]
pub fn smv(system: &System) -> String {
    let system = lower(system, kept);
    let writer = Writer { system: &system };
    let mut out = "MODULE main\n".to_owned();
    out.push_str(&writer.variables());
    out.push_str(&writer.definitions());
    out.push_str(&writer.assignments());
    let section = |keyword: &str, list: &[Labelled]| -> String {
        let lines =
            list.iter().map(|own| format!("-- {}\n{keyword} bool({});\n", comment(&own.name), writer.name(own.term)));
        lines.collect()
    };
    out + &section("INVAR", &system.constraints) + &section("INVARSPEC", &system.obligations)
}

const fn kept(op: Op) -> bool {
    matches!(
        op,
        Op::Not
            | Op::Neg
            | Op::And
            | Op::Or
            | Op::Xor
            | Op::Add
            | Op::Sub
            | Op::Mul
            | Op::Eq
            | Op::Ult
            | Op::Ule
            | Op::Slt
            | Op::Sle
            | Op::Ite
            | Op::Concat
            | Op::Extract { .. }
            | Op::ZeroExtend(_)
            | Op::SignExtend(_)
    )
}

fn comment(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

struct Writer<'s> {
    system: &'s System,
}

impl Writer<'_> {
    /// Letters and digits of a name behind the variable's number, which makes it unique.
    fn variable(&self, var: Var) -> String {
        let name = self.system.pool.name(var);
        let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        format!("v{}_{plain}", var.0)
    }

    /// How a term is named where it is used.
    fn name(&self, term: Term) -> String {
        match self.system.pool.node(term) {
            Node::Const(value) => format!("0ud{}_{value}", self.system.pool.width(term)),
            Node::Var(var) => self.variable(var),
            Node::Apply(..) => format!("t{}", term.0),
        }
    }

    fn variables(&self) -> String {
        let system = self.system;
        let inputs = system.inputs.iter().map(|input| (input.variable, &input.name));
        let states = system.states.iter().map(|state| (state.variable, &state.name));
        inputs.chain(states).fold(String::new(), |mut out, (variable, name)| {
            let (own, width) = (self.name(variable), system.pool.width(variable));
            let _ = writeln!(out, "VAR {own} : unsigned word[{width}]; -- {}", comment(name));
            out
        })
    }

    fn definitions(&self) -> String {
        let system = self.system;
        let lists = [&system.constraints, &system.obligations, &system.outputs];
        let values = system.states.iter().flat_map(|state| [Some(state.next), state.initial]).flatten();
        let roots = lists.into_iter().flatten().map(|own| own.term).chain(values);
        below(&system.pool, roots).into_iter().fold(String::new(), |mut out, term| {
            if let Node::Apply(op, operands) = system.pool.node(term) {
                let _ = writeln!(out, "DEFINE {} := {};", self.name(term), self.application(op, &operands));
            }
            out
        })
    }

    fn application(&self, op: Op, operands: &[Term; 3]) -> String {
        let [a, b, c] = operands.map(|operand| self.name(operand));
        let from = self.system.pool.width(operands[0]);
        match op {
            Op::Not => format!("!{a}"),
            Op::Neg => format!("-{a}"),
            Op::And => format!("{a} & {b}"),
            Op::Or => format!("{a} | {b}"),
            Op::Xor => format!("{a} xor {b}"),
            Op::Add => format!("{a} + {b}"),
            Op::Sub => format!("{a} - {b}"),
            Op::Mul => format!("{a} * {b}"),
            Op::Eq => format!("word1({a} = {b})"),
            Op::Ult => format!("word1({a} < {b})"),
            Op::Ule => format!("word1({a} <= {b})"),
            Op::Slt => format!("word1(signed({a}) < signed({b}))"),
            Op::Sle => format!("word1(signed({a}) <= signed({b}))"),
            Op::Ite => format!("bool({a}) ? {b} : {c}"),
            Op::Concat => format!("{a} :: {b}"),
            Op::Extract { high, low } => format!("{a}[{high}:{low}]"),
            Op::ZeroExtend(to) => format!("extend({a}, {})", to - from),
            Op::SignExtend(to) => format!("unsigned(extend(signed({a}), {}))", to - from),
            _ => unreachable!("other operators were lowered"),
        }
    }

    fn assignments(&self) -> String {
        self.system.states.iter().fold(String::new(), |mut out, state| {
            let own = self.name(state.variable);
            if let Some(initial) = state.initial {
                let _ = writeln!(out, "ASSIGN init({own}) := {};", self.name(initial));
            }
            let _ = writeln!(out, "ASSIGN next({own}) := {};", self.name(state.next));
            out
        })
    }
}
