//! BTOR2 (Niemetz, Preiner, Wolf, Biere, *Btor2, BtorMC and Boolector 3.0*, CAV 2018). Floats, which it lacks, are lowered
//! to bits; every other operator is its own.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;

use super::lower;
use super::names::symbol;
use crate::logic::eval::below;
use crate::logic::system::{Labelled, System};
use crate::logic::term::{Node, Op, Term};

struct Writer<'s> {
    system: &'s System,
    text: String,
    last: usize,
    sorts: BTreeMap<u32, usize>,
    terms: HashMap<Term, usize>,
}

/// The system in BTOR2; each obligation is a `bad` of its complement, in their order.
#[must_use]
pub fn btor2(system: &System) -> String {
    let lowered = lower(system, |op| name(op).is_some());
    let mut writer =
        Writer { system: &lowered, text: String::new(), last: 0, sorts: BTreeMap::new(), terms: HashMap::new() };
    writer.variables();
    for state in &lowered.states {
        let (sort, next) = (writer.sort(state.variable), writer.term(state.next));
        let own = writer.terms[&state.variable];
        writer.line(&format!("next {sort} {own} {next}"), "");
    }
    writer.labelled("constraint", &lowered.constraints, false);
    writer.labelled("bad", &lowered.obligations, true);
    writer.labelled("output", &lowered.outputs, false);
    writer.text
}

/// The name of an operator that takes terms alone.
const fn name(op: Op) -> Option<&'static str> {
    Some(match op {
        Op::Not => "not",
        Op::Neg => "neg",
        Op::And => "and",
        Op::Or => "or",
        Op::Xor => "xor",
        Op::Add => "add",
        Op::Sub => "sub",
        Op::Mul => "mul",
        Op::Udiv => "udiv",
        Op::Sdiv => "sdiv",
        Op::Urem => "urem",
        Op::Srem => "srem",
        Op::Shl => "sll",
        Op::Lshr => "srl",
        Op::Ashr => "sra",
        Op::Eq => "eq",
        Op::Ult => "ult",
        Op::Ule => "ulte",
        Op::Slt => "slt",
        Op::Sle => "slte",
        Op::Ite => "ite",
        Op::Concat => "concat",
        Op::Extract { .. } => "slice",
        Op::ZeroExtend(_) => "uext",
        Op::SignExtend(_) => "sext",
        _ => return None,
    })
}

impl Writer<'_> {
    fn line(&mut self, line: &str, name: &str) -> usize {
        self.last += 1;
        let name = symbol(name);
        let space = if name.is_empty() { "" } else { " " };
        // Writing to a string does not fail.
        let _ = writeln!(self.text, "{} {line}{space}{name}", self.last);
        self.last
    }

    fn sort(&mut self, term: Term) -> usize {
        let width = self.system.pool.width(term);
        if let Some(sort) = self.sorts.get(&width) {
            return *sort;
        }
        let sort = self.line(&format!("sort bitvec {width}"), "");
        self.sorts.insert(width, sort);
        sort
    }

    /// Inputs, and states with their initial values, which stand before them.
    fn variables(&mut self) {
        let system = self.system;
        for input in &system.inputs {
            let sort = self.sort(input.variable);
            let own = self.line(&format!("input {sort}"), &input.name);
            self.terms.insert(input.variable, own);
        }
        for state in &system.states {
            let sort = self.sort(state.variable);
            let initial = state.initial.map(|term| self.term(term));
            let own = self.line(&format!("state {sort}"), &state.name);
            self.terms.insert(state.variable, own);
            if let Some(initial) = initial {
                self.line(&format!("init {sort} {own} {initial}"), "");
            }
        }
    }

    fn term(&mut self, term: Term) -> usize {
        if let Some(known) = self.terms.get(&term) {
            return *known;
        }
        let system = self.system;
        for term in below(&system.pool, [term]) {
            if self.terms.contains_key(&term) {
                continue;
            }
            let sort = self.sort(term);
            let line = match system.pool.node(term) {
                Node::Const(value) => format!("constd {sort} {value}"),
                // A variable that the system does not list is free in every cycle.
                Node::Var(_) => format!("input {sort}"),
                Node::Apply(op, operands) => self.application(sort, op, &operands),
            };
            let own = self.line(&line, "");
            self.terms.insert(term, own);
        }
        self.terms[&term]
    }

    fn application(&self, sort: usize, op: Op, operands: &[Term; 3]) -> String {
        let mut line = format!("{} {sort}", name(op).expect("other operators were lowered"));
        for operand in &operands[..op.arity()] {
            let _ = write!(line, " {}", self.terms[operand]);
        }
        let from = self.system.pool.width(operands[0]);
        match op {
            Op::Extract { high, low } => line + &format!(" {high} {low}"),
            Op::ZeroExtend(to) | Op::SignExtend(to) => line + &format!(" {}", to - from),
            _ => line,
        }
    }

    fn labelled(&mut self, keyword: &str, list: &[Labelled], complement: bool) {
        for own in list {
            let mut term = self.term(own.term);
            if complement {
                let sort = self.sort(own.term);
                term = self.line(&format!("not {sort} {term}"), "");
            }
            self.line(&format!("{keyword} {term}"), &own.name);
        }
    }
}
