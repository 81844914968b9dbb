//! Inputs that the assumptions of a row admit.
//!
//! Values are kept as they were where the row allows it. Otherwise they are searched for among few: the constants of the cell, the values of
//! what else it reads, their neighbours, and the ends of the type; one variable is changed at a time, as long as fewer
//! assumptions are broken. That finds what people write in tables; where it finds nothing, a concrete table says more.

use std::collections::{BTreeMap, BTreeSet};

use crate::machine::interpret::Interpreter;
use crate::machine::program::{Program, Role, SlotId};
use crate::semantics::eval::{FaultAt, Leaves, evaluate, mask};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::scalar::Scalar;
use crate::table::bind::{BoundTable, Leaf, Role as TableRole, Term};

/// Finds inputs.
pub(super) struct Picker<'a> {
    program: &'a Program,
    table: &'a BoundTable,
    /// The slot of each variable of the table.
    slots: Vec<SlotId>,
    globals: Vec<u64>,
    /// Of each cycle, the values of each variable at its beginning and at its end.
    history: Vec<Vec<[u64; 2]>>,
    /// What the environment sets in the present cycle.
    now: Vec<u64>,
}

/// How often the search begins anew.
const ROUNDS: usize = 8;

impl<'a> Picker<'a> {
    /// For a table and its block.
    pub(super) fn new(program: &'a Program, table: &'a BoundTable) -> Result<Self, String> {
        let slot = |path: &str| {
            let named = program.variables.iter().find(|variable| variable.path.eq_ignore_ascii_case(path));
            named.map(|variable| variable.slot).ok_or_else(|| format!("`{path}` is no variable that a table can name"))
        };
        let slots: Result<Vec<_>, _> = table.variables.iter().map(|variable| slot(&variable.path)).collect();
        let slots = slots?;
        let now = slots.iter().map(|slot| program.slots[slot.0 as usize].initial).collect();
        Ok(Self { program, table, slots, globals: vec![0; table.globals.len()], history: Vec::new(), now })
    }

    /// The slots that the environment sets.
    pub(super) fn slots(&self) -> Vec<SlotId> {
        (0..self.slots.len()).filter(|index| self.is_set(*index)).map(|index| self.slots[index]).collect()
    }

    /// The values of the global variables.
    pub(super) fn globals(&self) -> &[u64] {
        &self.globals
    }

    fn is_set(&self, variable: usize) -> bool {
        let role = self.table.variables[variable].role;
        matches!(role, TableRole::Input | TableRole::InOut)
            || self.program.slots[self.slots[variable].0 as usize].role == Role::Input
    }

    /// Finds values of the global variables, but for those that are given.
    pub(super) fn pick_globals(&mut self, given: &BTreeMap<usize, u64>) -> Result<(), String> {
        for (index, value) in given {
            self.globals[*index] = *value;
        }
        let table = self.table;
        let constraints: Vec<&Term> = table.globals.iter().filter_map(|global| global.constraint.as_ref()).collect();
        let free = |leaf: Leaf| matches!(leaf, Leaf::Global(index) if !given.contains_key(&index));
        self.search(&constraints, &free).map_err(|_| "no values of the global variables were found".to_owned())
    }

    /// Finds the inputs of a cycle in `row`.
    pub(super) fn pick(&mut self, run: &Interpreter, row: usize, first: bool) -> Result<Vec<u64>, String> {
        self.now = self.slots.iter().map(|slot| run.get(*slot)).collect();
        let table = self.table;
        let constraints: Vec<&Term> = table.constraints(row, true, first).collect();
        let settable: Vec<bool> = (0..self.slots.len()).map(|index| self.is_set(index)).collect();
        let free = |leaf: Leaf| matches!(leaf, Leaf::Variable { index, ago: 0 } if settable[index]);
        self.search(&constraints, &free).map_err(|_| "no inputs were found that its assumptions admit".to_owned())?;
        Ok((0..self.slots.len()).filter(|index| settable[*index]).map(|index| self.now[index]).collect())
    }

    /// Keeps what the variables are at the beginning of a cycle.
    pub(super) fn begin(&mut self, run: &Interpreter) {
        self.history.push(self.slots.iter().map(|slot| [run.get(*slot); 2]).collect());
    }

    /// Keeps what they are at its end.
    pub(super) fn end(&mut self, run: &Interpreter) {
        if let Some(cycle) = self.history.last_mut() {
            for (values, slot) in cycle.iter_mut().zip(&self.slots) {
                values[1] = run.get(*slot);
            }
        }
    }

    /// Changes free leaves until all constraints that can be satisfied by them hold.
    fn search(&mut self, constraints: &[&Term], free: &dyn Fn(Leaf) -> bool) -> Result<(), ()> {
        // What no free leaf bears on is not the environment's to satisfy.
        let concerned: Vec<&&Term> = constraints.iter().filter(|term| !self.leaves(term, free).is_empty()).collect();
        for _ in 0..ROUNDS {
            let broken = |this: &Self| concerned.iter().filter(|term| !this.holds(term)).count();
            let before = broken(self);
            let Some(term) = concerned.iter().find(|term| !self.holds(term)) else { return Ok(()) };
            let mut best: Option<(usize, Leaf, u64)> = None;
            for leaf in self.leaves(term, free) {
                let kept = self.get(leaf);
                for candidate in self.candidates(term, leaf) {
                    self.put(leaf, candidate);
                    let count = broken(self);
                    if self.holds(term) && best.is_none_or(|(least, _, _)| count < least) {
                        best = Some((count, leaf, candidate));
                    }
                }
                self.put(leaf, kept);
            }
            match best {
                Some((count, leaf, value)) if count <= before => self.put(leaf, value),
                _ => return Err(()),
            }
        }
        if concerned.iter().all(|term| self.holds(term)) { Ok(()) } else { Err(()) }
    }

    fn leaves(&self, term: &Term, free: &dyn Fn(Leaf) -> bool) -> BTreeSet<Leaf> {
        let mut found = BTreeSet::new();
        term.leaves(&mut |leaf| {
            if free(*leaf) {
                found.insert(*leaf);
            }
        });
        found
    }

    fn scalar(&self, leaf: Leaf) -> Scalar {
        match leaf {
            Leaf::Variable { index, .. } => self.table.variables[index].scalar,
            Leaf::Global(index) => self.table.globals[index].scalar,
        }
    }

    fn get(&self, leaf: Leaf) -> u64 {
        match leaf {
            Leaf::Global(index) => self.globals[index],
            Leaf::Variable { index, ago: 0 } => self.now[index],
            Leaf::Variable { index, ago } => match self.history.len().checked_sub(ago as usize) {
                Some(cycle) => {
                    let input = self.program.slots[self.slots[index].0 as usize].role == Role::Input;
                    self.history[cycle][index][usize::from(!input)]
                }
                None => self.program.slots[self.slots[index].0 as usize].initial,
            },
        }
    }

    fn put(&mut self, leaf: Leaf, value: u64) {
        match leaf {
            Leaf::Global(index) => self.globals[index] = value,
            Leaf::Variable { index, .. } => self.now[index] = value,
        }
    }

    fn holds(&self, term: &Term) -> bool {
        evaluate(term, &mut Values(self)) == Ok(1)
    }

    /// Values for `leaf` that may satisfy `term`.
    fn candidates(&self, term: &Term, leaf: Leaf) -> BTreeSet<u64> {
        let scalar = self.scalar(leaf);
        let (mut found, sign) = (BTreeSet::new(), 1_u64 << (scalar.width() - 1));
        found.extend([0, 1, u64::MAX, sign, sign - 1].map(|value| mask(scalar, value)));
        let mut near = |value: u64| {
            found.extend([value, value.wrapping_add(1), value.wrapping_sub(1)].map(|value| mask(scalar, value)));
        };
        constants(term, &mut near);
        term.leaves(&mut |other| near(self.get(*other)));
        found
    }
}

fn constants(term: &Term, found: &mut dyn FnMut(u64)) {
    let mut all = |parts: &[&Expr<Leaf>]| parts.iter().for_each(|part| constants(part, found));
    match &term.kind {
        ExprKind::Const(value) => found(*value),
        ExprKind::Read(_) | ExprKind::Address(_) => {}
        ExprKind::Apply(_, operands) => operands.iter().for_each(|operand| constants(operand, found)),
        ExprKind::AndThen(a, b) | ExprKind::OrElse(a, b) => all(&[a, b]),
        ExprKind::If(a, b, c) => all(&[a, b, c]),
    }
}

struct Values<'a, 'b>(&'b Picker<'a>);

impl Leaves<Leaf> for Values<'_, '_> {
    fn read(&mut self, leaf: &Leaf) -> Result<u64, FaultAt> {
        Ok(self.0.get(*leaf))
    }

    fn address(&mut self, _: &Leaf) -> Result<u64, FaultAt> {
        // A cell has no addresses: its expressions are over values.
        Ok(0)
    }
}
