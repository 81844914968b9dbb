//! Cycle after cycle is executed, each time with what is known so far of what changes, until nothing new is found; then
//! the system is put together.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::flow::{Executor, Site};
use super::{Options, Translated, Unsupported};
use crate::logic::system::{Input, Labelled, State, System};
use crate::logic::term::{Node, Op, Pool, Term};
use crate::machine::program::{Program, Role, Slot};
use crate::semantics::expr::Fault;
use crate::semantics::scalar::Scalar;

/// After so many rounds, what is set at all is taken to change: a shift register would need a round for each place.
const PATIENT_ROUNDS: u32 = 6;

/// What is known of the slots from cycle to cycle.
struct Known {
    /// Before the first cycle.
    initial: Vec<u64>,
    /// Whether the slot is known to change.
    changes: Vec<bool>,
    /// The addresses that a reference may hold.
    addresses: Vec<BTreeSet<u32>>,
}

/// What a cycle begins with.
struct Begin {
    pool: Pool,
    cells: Vec<Term>,
    inputs: Vec<Option<Term>>,
    /// The variables of slots that change.
    variables: Vec<Option<Term>>,
}

pub(super) fn translate(program: &Program, options: &Options) -> Result<Translated, Unsupported> {
    let (initial, faults) = startup(program, options)?;
    if let Some(site) = faults.first() {
        return Ok(stillborn(program, &initial, *site));
    }
    let count = program.slots.len();
    let mut known = Known { initial, changes: vec![false; count], addresses: vec![BTreeSet::new(); count] };
    for rounds in 1.. {
        let begin = known.begin(program);
        let mut executor = Executor::new(program, options, begin.pool.clone(), begin.cells.clone());
        known.share_addresses(&begin, &mut executor);
        executor.enter(false);
        executor.block(&program.cycle)?;
        executor.leave();
        if !known.learn(program, &mut executor, rounds > PATIENT_ROUNDS)? {
            return Ok(assemble(program, &known, begin, executor, rounds));
        }
    }
    Err(Unsupported { what: "a program without end".to_owned(), place: None })
}

/// The memory before the first cycle, and the faults on the way there.
fn startup(program: &Program, options: &Options) -> Result<(Vec<u64>, Vec<Site>), Unsupported> {
    let mut pool = Pool::default();
    let cells = program.slots.iter().map(|slot| constant(&mut pool, slot, slot.initial)).collect();
    let mut executor = Executor::new(program, options, pool, cells);
    executor.enter(false);
    executor.block(&program.startup)?;
    executor.leave();
    let value = |(cell, slot): (&Term, &Slot)| {
        let what = || format!("the value of `{}` at startup", slot.name);
        executor.pool.value(*cell).ok_or_else(|| Unsupported { what: what(), place: slot.place })
    };
    let initial = executor.memory.cells().iter().zip(&program.slots).map(value).collect::<Result<_, _>>()?;
    Ok((initial, executor.sites))
}

/// The declared value of a slot.
fn constant(pool: &mut Pool, slot: &Slot, bits: u64) -> Term {
    pool.constant(slot.scalar.width(), bits)
}

/// Whether the environment sets the slot in each cycle.
const fn is_input(slot: &Slot) -> bool {
    matches!(slot.role, Role::Input | Role::Arbitrary)
}

impl Known {
    /// Variables for inputs and for what changes, constants for the rest; the clocks have gone on.
    fn begin(&self, program: &Program) -> Begin {
        let mut pool = Pool::default();
        let count = program.slots.len();
        let (mut cells, mut inputs, mut variables) = (Vec::with_capacity(count), vec![None; count], vec![None; count]);
        for (index, slot) in program.slots.iter().enumerate() {
            let width = slot.scalar.width();
            cells.push(if is_input(slot) || self.changes[index] {
                let variable = pool.variable(width, slot.name.as_str());
                *(if is_input(slot) { &mut inputs[index] } else { &mut variables[index] }) = Some(variable);
                variable
            } else {
                pool.constant(width, self.initial[index])
            });
        }
        for (slot, step) in &program.clocks {
            if let Some(cell) = cells.get_mut(slot.0 as usize) {
                let step = pool.constant(pool.width(*cell), *step);
                *cell = pool.apply(Op::Add, &[*cell, step]);
            }
        }
        Begin { pool, cells, inputs, variables }
    }

    /// Tells the execution which addresses the variables of references may hold.
    fn share_addresses(&self, begin: &Begin, executor: &mut Executor<'_>) {
        for (variable, addresses) in begin.variables.iter().zip(&self.addresses) {
            if let Some(variable) = variable
                && let Node::Var(var) = begin.pool.node(*variable)
                && !addresses.is_empty()
            {
                executor.addresses.insert(var, Rc::new(addresses.clone()));
            }
        }
    }

    /// What the cycle shows that was not known before; `true` if there is something.
    fn learn(&mut self, program: &Program, executor: &mut Executor<'_>, impatient: bool) -> Result<bool, Unsupported> {
        let mut learned = false;
        for (index, slot) in program.slots.iter().enumerate() {
            if is_input(slot) {
                continue;
            }
            let end = executor.memory.cells()[index];
            let stays = executor.pool.value(end) == Some(self.initial[index]);
            if !self.changes[index] && (!stays || (impatient && executor.memory.is_written(index))) {
                self.changes[index] = true;
                learned = true;
            }
            if self.changes[index] && slot.scalar == Scalar::Ref {
                let found = executor.targets_of(end, slot.place)?;
                let addresses = &mut self.addresses[index];
                let before = addresses.len();
                addresses.insert(u32::try_from(self.initial[index]).unwrap_or(0));
                addresses.extend(found.iter());
                learned |= addresses.len() > before;
            }
        }
        Ok(learned)
    }
}

/// The system of a cycle that holds no surprise any more.
fn assemble(program: &Program, known: &Known, begin: Begin, mut executor: Executor<'_>, rounds: u32) -> Translated {
    let fault = executor.harmed();
    let end = executor.memory.cells().to_vec();
    let sites = std::mem::take(&mut executor.sites);
    let mut system = System { pool: std::mem::take(&mut executor.pool), ..System::default() };
    let roots = end.iter().copied().chain([fault]).chain(sites.iter().map(|site| site.condition));
    let used = used(&system.pool, roots);
    let mut states = vec![None; end.len()];
    for (index, slot) in program.slots.iter().enumerate() {
        if let Some(variable) = begin.inputs[index] {
            system.inputs.push(Input { variable, name: slot.name.clone(), origin: slot.place });
            constrain(&mut system, slot, variable);
        }
        if let Some(variable) = begin.variables[index].filter(|variable| used[variable.0 as usize]) {
            let initial = system.pool.constant(system.pool.width(variable), known.initial[index]);
            states[index] = Some(system.states.len());
            let (name, origin) = (slot.name.clone(), slot.place);
            system.states.push(State { variable, name, initial: Some(initial), next: end[index], origin });
        }
    }
    for site in &sites {
        let term = system.pool.apply(Op::Not, &[site.condition]);
        system.obligations.push(Labelled { term, name: name(site.fault).to_owned(), origin: site.place });
    }
    stop_after(&mut system, fault);
    show(&mut system, program, &end);
    let faults = sites.iter().map(|site| (site.fault, site.place)).collect();
    Translated { system, begin: begin.cells, end, inputs: begin.inputs, states, faults, fault, rounds }
}

/// The input respects its subrange.
fn constrain(system: &mut System, slot: &Slot, variable: Term) {
    let Some((low, high)) = slot.range else { return };
    let (pool, scalar) = (&mut system.pool, slot.scalar);
    let le = if scalar.is_signed() { Op::Sle } else { Op::Ule };
    let (low, high) =
        (pool.constant(scalar.width(), scalar.bits(low)), pool.constant(scalar.width(), scalar.bits(high)));
    let (above, below) = (pool.apply(le, &[low, variable]), pool.apply(le, &[variable, high]));
    let term = pool.apply(Op::And, &[above, below]);
    system.constraints.push(Labelled { term, name: format!("the subrange of `{}`", slot.name), origin: slot.place });
}

/// No cycle follows one with a fault.
fn stop_after(system: &mut System, fault: Term) {
    if system.pool.value(fault) == Some(0) {
        return;
    }
    let name = "the run has stopped";
    let variable = system.pool.variable(1, name);
    let no = system.pool.truth(false);
    let term = system.pool.apply(Op::Not, &[variable]);
    system.states.push(State { variable, name: name.to_owned(), initial: Some(no), next: fault, origin: None });
    system.constraints.push(Labelled { term, name: "no cycle after a fault".to_owned(), origin: None });
}

/// The variables that tables may name are outputs.
fn show(system: &mut System, program: &Program, end: &[Term]) {
    for variable in &program.variables {
        let index = variable.slot.0 as usize;
        if let (Some(term), Some(slot)) = (end.get(index), program.slots.get(index)) {
            let (name, origin) = (variable.path.clone(), slot.place);
            system.outputs.push(Labelled { term: *term, name, origin });
        }
    }
}

/// A program whose startup runs into a fault: it never gets further.
fn stillborn(program: &Program, initial: &[u64], site: Site) -> Translated {
    let mut system = System::default();
    let cells: Vec<Term> = program
        .slots
        .iter()
        .zip(initial)
        .map(|(slot, bits)| system.pool.constant(slot.scalar.width(), *bits))
        .collect();
    let (yes, no) = (system.pool.truth(true), system.pool.truth(false));
    system.obligations.push(Labelled { term: no, name: name(site.fault).to_owned(), origin: site.place });
    show(&mut system, program, &cells);
    let none = vec![None; cells.len()];
    Translated {
        system,
        begin: cells.clone(),
        end: cells,
        inputs: none,
        states: vec![None; program.slots.len()],
        faults: vec![(site.fault, site.place)],
        fault: yes,
        rounds: 0,
    }
}

/// Which terms the roots are made of.
fn used(pool: &Pool, roots: impl Iterator<Item = Term>) -> Vec<bool> {
    let mut used = vec![false; pool.len()];
    for root in roots {
        used[root.0 as usize] = true;
    }
    for index in (0..pool.len()).rev() {
        let term = Term(u32::try_from(index).unwrap_or(u32::MAX));
        if used[index]
            && let Node::Apply(_, operands) = pool.node(term)
        {
            for operand in operands {
                used[operand.0 as usize] = true;
            }
        }
    }
    used
}

/// What an obligation is called.
const fn name(fault: Fault) -> &'static str {
    match fault {
        Fault::DivisionByZero => "no division by zero",
        Fault::IndexOutOfBounds => "every index is inside of its array",
        Fault::SubrangeViolation => "every value is inside of its subrange",
        Fault::LoopLimit => "every loop ends within the limit",
        Fault::NullReference => "every reference that is followed refers to something",
    }
}
