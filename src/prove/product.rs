//! The obligation: a block and the game of its table as one transition system.
//!
//! The block's translation gives inputs, states, and an obligation for each site of a fault. The table's automaton adds its
//! own states over the values at the beginning of the cycle (inputs) and at its end (everything else). What must hold
//! in every cycle: the table is not lost; and, as long as the inputs are those of the table, no fault happens.
//!
//! Global variables of the table are states that are any value at first, constrained by their `with`, and never change. `X[-n]`
//! is a chain of registers that begin with the declared initial value. Inputs of an enumeration's type take its declared
//! values.
//!
//! In a cycle that faults, what the block would have set has no value: an assumption that reads it is taken to hold, so that
//! it excuses no fault.

use std::collections::BTreeMap;

use super::meeting::Meeting;
use super::verdict::Reason;
use crate::logic::system::{Labelled, State, System};
use crate::logic::term::{Pool, Term};
use crate::machine::program::{NamedVariable, Program, Role, SlotId};
use crate::machine::translate::Translated;
use crate::semantics::encode::encode;
use crate::semantics::expr::Expr;
use crate::table::automaton::encode::{Encoding, Sites, encode as encode_game};
use crate::table::automaton::{Automaton, Site};
use crate::table::bind::{BoundTable, Leaf, Role as TableRole};

/// A block with its table, ready to be proven.
#[derive(Clone, Debug)]
pub struct Product {
    /// The system; its obligations are those of the block's faults, in the order of [`Translated::faults`], and the table's.
    pub system: System,
    /// The game.
    pub game: Encoding,
    /// The slot of each input of the system.
    pub inputs: Vec<SlotId>,
    /// The state of each global variable of the table.
    pub globals: Vec<usize>,
}

/// The block and its table as they were made.
pub struct Parts<'a> {
    /// The block.
    pub program: &'a Program,
    /// The block in terms.
    pub translated: &'a Translated,
    /// The table.
    pub table: &'a BoundTable,
    /// The table's automaton.
    pub automaton: &'a Automaton,
}

/// Where in the cycle a value is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Moment {
    Begin,
    End,
}

/// The terms of what a table names.
struct Leaves {
    /// Of each variable at the beginning and at the end of the cycle.
    now: Vec<[Term; 2]>,
    /// By variable, what it was so many cycles ago.
    past: BTreeMap<(usize, u32), Term>,
    globals: Vec<Term>,
    /// Of each variable, whether the environment sets it.
    set: Vec<bool>,
}

impl Leaves {
    fn term(&self, leaf: &Leaf, moment: Moment) -> Term {
        match *leaf {
            Leaf::Global(index) => self.globals[index],
            Leaf::Variable { index, ago: 0 } => self.now[index][moment as usize],
            Leaf::Variable { index, ago } => self.past[&(index, ago)],
        }
    }

    /// Whether an assumption reads what the block sets in the same cycle.
    fn reads_end(&self, assumption: &Expr<Leaf>) -> bool {
        let mut found = false;
        assumption.leaves(&mut |leaf| {
            if let Leaf::Variable { index, ago: 0 } = leaf {
                found |= !self.set[*index];
            }
        });
        found
    }
}

/// Builds the product.
///
/// # Errors
/// What the block does not have, and what has no term.
pub fn product(parts: &Parts<'_>) -> Result<Product, Vec<Reason>> {
    let mut system = parts.translated.system.clone();
    let slots = slots(parts)?;
    let globals = globals(parts, &mut system);
    let leaves = leaves(parts, &slots, &mut system, &globals);
    constrain(parts, &mut system, &leaves)?;
    let mut rows =
        Rows { parts, leaves: &leaves, wrong: Vec::new(), known: BTreeMap::new(), meeting: Meeting::new(parts) };
    let game = encode_game(parts.automaton, &mut system.pool, &mut rows);
    let wrong = rows.wrong;
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let Some(game) = game else {
        return Err(vec![reason("the table's rows overlap in more ways than fit in memory", "say more in the inputs")]);
    };
    system.states.extend(game.states.iter().cloned());
    obligations(parts.translated, &mut system, &game);
    let inputs = inputs(parts, &system);
    Ok(Product { system, game, inputs, globals })
}

fn reason(message: &str, help: &str) -> Reason {
    Reason { message: message.to_owned(), help: help.to_owned(), place: None }
}

/// The slot of each variable of the table.
fn slots<'p>(parts: &Parts<'p>) -> Result<Vec<&'p NamedVariable>, Vec<Reason>> {
    let by_path: BTreeMap<String, &NamedVariable> =
        parts.program.variables.iter().map(|variable| (variable.path.to_lowercase(), variable)).collect();
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for variable in &parts.table.variables {
        match by_path.get(&variable.path.to_lowercase()) {
            Some(named) if named.scalar == variable.scalar => found.push(*named),
            Some(_) => missing.push(Reason {
                message: format!("`{}` has another type in the table than in the block", variable.path),
                help: String::new(),
                place: Some(variable.place),
            }),
            None => missing.push(Reason {
                message: format!("`{}` is not modelled", variable.path),
                help: "name a scalar variable, a member or an element of one".to_owned(),
                place: Some(variable.place),
            }),
        }
    }
    if missing.is_empty() { Ok(found) } else { Err(missing) }
}

fn globals(parts: &Parts<'_>, system: &mut System) -> Vec<usize> {
    let mut out = Vec::new();
    for global in &parts.table.globals {
        let variable = system.pool.variable(global.scalar.width(), format!("table.{}", global.name));
        out.push(system.states.len());
        system.states.push(State {
            variable,
            name: format!("table.{}", global.name),
            initial: None,
            next: variable,
            origin: Some(global.place),
        });
    }
    out
}

fn leaves(parts: &Parts<'_>, slots: &[&NamedVariable], system: &mut System, globals: &[usize]) -> Leaves {
    let translated = parts.translated;
    let now: Vec<[Term; 2]> = slots
        .iter()
        .zip(&parts.table.variables)
        .map(|(slot, variable)| {
            let at = slot.slot.0 as usize;
            let (begin, end) = (translated.begin[at], translated.end[at]);
            match variable.role {
                TableRole::InOut => [begin, end],
                // What the environment sets is what it set, also where the block writes to it.
                _ if slot.role == Role::Input => [begin, begin],
                _ => [end, end],
            }
        })
        .collect();
    let mut past = BTreeMap::new();
    for (index, depth) in depths(parts.table) {
        let slot = &parts.program.slots[slots[index].slot.0 as usize];
        let mut value = now[index][Moment::End as usize];
        for ago in 1..=depth {
            let width = slot.scalar.width();
            let name = format!("table.{}[-{ago}]", slots[index].path);
            let variable = system.pool.variable(width, name.clone());
            let initial = Some(system.pool.constant(width, slot.initial));
            system.states.push(State { variable, name, initial, next: value, origin: slot.place });
            past.insert((index, ago), variable);
            value = variable;
        }
    }
    let globals = globals.iter().map(|index| system.states[*index].variable).collect();
    let roles = slots.iter().zip(&parts.table.variables);
    let set = roles.map(|(slot, variable)| variable.role == TableRole::InOut || slot.role == Role::Input).collect();
    Leaves { now, past, globals, set }
}

/// How far back the table looks, by variable.
fn depths(table: &BoundTable) -> BTreeMap<usize, u32> {
    let mut depths = BTreeMap::new();
    let mut see = |leaf: &Leaf| {
        if let Leaf::Variable { index, ago } = *leaf
            && ago > 0
        {
            let known = depths.entry(index).or_insert(0);
            *known = ago.max(*known);
        }
    };
    for cell in table.rows.iter().flat_map(|row| row.cells.iter().flatten()) {
        cell.distinct().for_each(|constraint| constraint.leaves(&mut see));
    }
    for constraint in table.globals.iter().filter_map(|global| global.constraint.as_ref()) {
        constraint.leaves(&mut see);
    }
    depths
}

/// What the environment may choose: the constraints of the global variables, the declared values of enumerations.
fn constrain(parts: &Parts<'_>, system: &mut System, leaves: &Leaves) -> Result<(), Vec<Reason>> {
    for global in &parts.table.globals {
        let Some(constraint) = &global.constraint else { continue };
        let term = holds(&mut system.pool, constraint, &mut |leaf| leaves.term(leaf, Moment::End))
            .map_err(|reason| vec![reason])?;
        let name = format!("the constraint of `{}`", global.name);
        system.constraints.push(Labelled { term, name, origin: Some(global.place) });
    }
    let chosen = parts.program.variables.iter().filter(|variable| variable.role == Role::Input);
    let mut enumerated: Vec<(Term, crate::library::ItemId, String)> = chosen
        .filter_map(|variable| {
            let term = parts.translated.inputs[variable.slot.0 as usize]?;
            Some((term, variable.enumeration?, variable.path.clone()))
        })
        .collect();
    for (term, global) in leaves.globals.iter().zip(&parts.table.globals) {
        enumerated.extend(global.enumeration.map(|item| (*term, item, global.name.clone())));
    }
    for (term, item, name) in enumerated {
        let Some(values) = parts.program.enumerations.get(&item) else { continue };
        let pool = &mut system.pool;
        let width = pool.width(term);
        let allowed: Vec<Term> = values
            .iter()
            .map(|value| {
                let value = pool.constant(width, *value);
                pool.eq(term, value)
            })
            .collect();
        let term = pool.any(allowed);
        system.constraints.push(Labelled { term, name: format!("`{name}` has a declared value"), origin: None });
    }
    Ok(())
}

/// Whether a constraint holds; where it faults, it does not.
pub(super) fn holds(
    pool: &mut Pool,
    constraint: &Expr<Leaf>,
    leaf: &mut dyn FnMut(&Leaf) -> Term,
) -> Result<Term, Reason> {
    let encoded = encode(pool, constraint, &mut |_, l| leaf(l)).map_err(|unsupported| Reason {
        message: format!("{} is not modelled", unsupported.what),
        help: String::new(),
        place: unsupported.place.or(constraint.place),
    })?;
    let faults: Vec<Term> = encoded.faults.iter().map(|fault| fault.condition).collect();
    let fault = pool.any(faults);
    let fine = pool.not(fault);
    Ok(pool.and(encoded.value, fine))
}

/// The rows of the table in terms.
struct Rows<'a> {
    parts: &'a Parts<'a>,
    leaves: &'a Leaves,
    wrong: Vec<Reason>,
    known: BTreeMap<(Site, bool), Term>,
    meeting: Meeting<'a>,
}

impl Rows<'_> {
    fn row(&mut self, pool: &mut Pool, site: Site, assumptions: bool) -> Term {
        if let Some(known) = self.known.get(&(site, assumptions)) {
            return *known;
        }
        let row = self.parts.automaton.leaves[site.leaf].row;
        let moment = if assumptions { Moment::Begin } else { Moment::End };
        let mut all = pool.truth(true);
        for constraint in self.parts.table.constraints(row, assumptions, site.first) {
            match holds(pool, constraint, &mut |leaf| self.leaves.term(leaf, moment)) {
                Ok(mut term) => {
                    if assumptions && self.leaves.reads_end(constraint) {
                        term = pool.or(term, self.parts.translated.fault);
                    }
                    all = pool.and(all, term);
                }
                Err(reason) => self.wrong.push(reason),
            }
        }
        self.known.insert((site, assumptions), all);
        all
    }
}

impl Sites for Rows<'_> {
    fn inputs(&mut self, pool: &mut Pool, site: Site) -> Term {
        self.row(pool, site, true)
    }

    fn outputs(&mut self, pool: &mut Pool, site: Site) -> Term {
        self.row(pool, site, false)
    }

    fn compatible(&mut self, one: Site, other: Site) -> bool {
        self.meeting.compatible(one, other)
    }
}

fn obligations(translated: &Translated, system: &mut System, game: &Encoding) {
    let pool = &mut system.pool;
    let outside = pool.not(game.covered);
    for obligation in &mut system.obligations {
        obligation.term = pool.or(obligation.term, outside);
    }
    let fine = pool.not(translated.fault);
    let lost = pool.and(game.lost, fine);
    let term = pool.not(lost);
    system.obligations.push(Labelled { term, name: "the table".to_owned(), origin: None });
}

fn inputs(parts: &Parts<'_>, system: &System) -> Vec<SlotId> {
    let slots: BTreeMap<Term, SlotId> =
        (0..).zip(&parts.translated.inputs).filter_map(|(slot, term)| Some(((*term)?, SlotId(slot)))).collect();
    system.inputs.iter().filter_map(|input| slots.get(&input.variable).copied()).collect()
}
