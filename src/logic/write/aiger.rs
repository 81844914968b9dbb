//! AIGER 1.9 (Biere, Heljanko, Wieringa, *AIGER 1.9 and Beyond*, 2011), ASCII and binary, with what is bad, constraints, and
//! a symbol table. Nodes that nothing needs are left out. A leaf that is neither an input nor a latch is an input that the
//! model does not name, and stands behind the others.

use super::Names;
use super::names::symbol;
use crate::logic::aig::{Gate, Latch, Lit, Model};

/// A model with the nodes numbered as the format wants them: inputs, latches, conjunctions.
struct Numbered<'m> {
    model: &'m Model,
    inputs: Vec<Lit>,
    ands: Vec<(u32, Lit, Lit)>,
    number: Vec<u32>,
}

impl<'m> Numbered<'m> {
    fn new(model: &'m Model) -> Self {
        let needed = needed(model);
        let mut known = vec![false; model.aig.len()];
        for lit in model.inputs.iter().copied().chain(model.latches.iter().map(|latch| latch.lit)) {
            known[lit.node() as usize] = true;
        }
        let nodes = (1..).zip(&needed[1..]).filter(|(_, needed)| **needed).map(|(node, _)| node);
        let (mut inputs, mut ands) = (model.inputs.clone(), Vec::new());
        for node in nodes {
            match model.aig.gate(node) {
                Gate::And(a, b) => ands.push((node, a, b)),
                _ if known[node as usize] => {}
                _ => inputs.push(Lit::of(node)),
            }
        }
        let mut number = vec![0; model.aig.len()];
        let latches = model.latches.iter().map(|latch| latch.lit);
        let order = inputs.iter().copied().chain(latches).map(Lit::node).chain(ands.iter().map(|(node, ..)| *node));
        for (at, node) in (1..).zip(order) {
            number[node as usize] = at;
        }
        Self { model, inputs, ands, number }
    }

    fn lit(&self, lit: Lit) -> u32 {
        self.number[lit.node() as usize] << 1 | u32::from(lit.inverted())
    }

    /// The operands, the greater one first.
    fn operands(&self, a: Lit, b: Lit) -> (u32, u32) {
        let (a, b) = (self.lit(a), self.lit(b));
        (a.max(b), a.min(b))
    }

    fn header(&self, magic: &str) -> String {
        let (inputs, latches, ands) = (self.inputs.len(), self.model.latches.len(), self.ands.len());
        let (bad, constraints) = (self.model.bad.len(), self.model.constraints.len());
        let most = inputs + latches + ands;
        if constraints > 0 {
            format!("{magic} {most} {inputs} {latches} 0 {ands} {bad} {constraints}\n")
        } else {
            format!("{magic} {most} {inputs} {latches} 0 {ands} {bad}\n")
        }
    }

    /// The next value of a latch, and its first one where it is not 0; a latch that begins anyhow names itself.
    fn latch(&self, latch: &Latch) -> String {
        let next = self.lit(latch.next);
        match latch.initial {
            Some(false) => format!("{next}\n"),
            Some(true) => format!("{next} 1\n"),
            None => format!("{next} {}\n", self.lit(latch.lit)),
        }
    }

    fn properties(&self) -> String {
        let all = self.model.bad.iter().chain(&self.model.constraints);
        all.map(|lit| format!("{}\n", self.lit(*lit))).collect()
    }
}

/// Which nodes something needs.
fn needed(model: &Model) -> Vec<bool> {
    let mut needed = vec![false; model.aig.len()];
    let roots = model.bad.iter().chain(&model.constraints).copied();
    for lit in roots.chain(model.latches.iter().map(|latch| latch.next)) {
        needed[lit.node() as usize] = true;
    }
    for node in (0..u32::try_from(model.aig.len()).unwrap_or(u32::MAX)).rev() {
        if let (true, Gate::And(a, b)) = (needed[node as usize], model.aig.gate(node)) {
            needed[a.node() as usize] = true;
            needed[b.node() as usize] = true;
        }
    }
    needed
}

fn symbols(names: &Names) -> String {
    let lists = [('i', &names.inputs), ('l', &names.latches), ('b', &names.bad), ('c', &names.constraints)];
    let mut out = String::new();
    for (kind, list) in lists {
        for (index, name) in list.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
            out.push_str(&format!("{kind}{index} {}\n", symbol(name)));
        }
    }
    out
}

/// The model in the ASCII form, `.aag`.
#[must_use]
pub fn ascii(model: &Model, names: &Names) -> String {
    let numbered = Numbered::new(model);
    let mut out = numbered.header("aag");
    for lit in &numbered.inputs {
        out.push_str(&format!("{}\n", numbered.lit(*lit)));
    }
    for latch in &model.latches {
        out.push_str(&format!("{} {}", numbered.lit(latch.lit), numbered.latch(latch)));
    }
    out.push_str(&numbered.properties());
    for (node, a, b) in &numbered.ands {
        let (a, b) = numbered.operands(*a, *b);
        out.push_str(&format!("{} {a} {b}\n", numbered.lit(Lit::of(*node))));
    }
    out + &symbols(names)
}

/// The model in the binary form, `.aig`.
#[must_use]
pub fn binary(model: &Model, names: &Names) -> Vec<u8> {
    let numbered = Numbered::new(model);
    let mut out = numbered.header("aig").into_bytes();
    for latch in &model.latches {
        out.extend(numbered.latch(latch).bytes());
    }
    out.extend(numbered.properties().bytes());
    for (node, a, b) in &numbered.ands {
        let ((a, b), own) = (numbered.operands(*a, *b), numbered.lit(Lit::of(*node)));
        delta(&mut out, own - a);
        delta(&mut out, a - b);
    }
    out.extend(symbols(names).bytes());
    out
}

/// Seven bits a byte, the lowest first; a set eighth bit says that more follow.
fn delta(out: &mut Vec<u8>, mut value: u32) {
    while value > 0x7f {
        out.push(u8::try_from(value & 0x7f).unwrap_or_default() | 0x80);
        value >>= 7;
    }
    out.push(u8::try_from(value).unwrap_or_default());
}
