//! Replays a run on the interpreter and on the game of the table, cycle by cycle, and says what is seen.

use std::collections::BTreeSet;

use crate::machine::interpret::{Assigned, Interpreter, Options};
use crate::machine::program::{Program, Role, SlotId};
use crate::semantics::eval::{FaultAt, Leaves, evaluate};
use crate::semantics::expr::Expr;
use crate::table::automaton::game::{Game, Judge, Standing};
use crate::table::automaton::{Automaton, Site};
use crate::table::bind::{BoundTable, Leaf, Role as TableRole};

/// What is replayed.
pub struct Subject<'a> {
    /// The block.
    pub program: &'a Program,
    /// The interpreter's options.
    pub options: Options,
    /// The table.
    pub table: &'a BoundTable,
    /// Its automaton.
    pub automaton: &'a Automaton,
}

/// What the environment does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Environment {
    /// The values of the table's global variables.
    pub globals: Vec<u64>,
    /// The slots that it sets.
    pub slots: Vec<SlotId>,
    /// Their values in each cycle.
    pub inputs: Vec<Vec<u64>>,
}

/// A replayed run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replay {
    /// Its cycles, as far as the game went.
    pub cycles: Vec<Cycle>,
    /// How the game stands after the last one.
    pub end: End,
}

/// A cycle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cycle {
    /// Of each variable of the table, what it is at the beginning of the cycle, inputs set, and at its end.
    pub values: Vec<[u64; 2]>,
    /// The rows whose assumptions admit the cycle's inputs and that a word was in, with whether it is their first cycle.
    pub tried: Vec<(usize, bool)>,
    /// The rows that are possible after the cycle.
    pub live: Vec<usize>,
    /// The assignments in the order of execution.
    pub assigned: Vec<Assigned>,
}

/// How a run ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// The table goes on.
    Open,
    /// The inputs are not those of the table.
    Uncovered,
    /// The end of the table is reached.
    Ended,
    /// The table is violated: the rows that were possible, and in each the columns whose cells do not hold.
    Lost(Vec<Failed>),
    /// The machine cannot go on, though the inputs are those of the table.
    Fault(FaultAt),
    /// The global variables do not satisfy what the table demands of them.
    WrongGlobals,
}

/// A row whose assertions do not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failed {
    /// Its index.
    pub row: usize,
    /// Whether it would have been its first cycle.
    pub first: bool,
    /// The indices of the columns.
    pub columns: Vec<usize>,
}

/// A variable of the table that the block does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Its path.
    pub path: String,
}

impl std::fmt::Display for Missing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the block has no variable `{}`", self.path)
    }
}

/// Plays `environment` against the block.
///
/// # Errors
/// Where the table names a variable that the block does not have.
pub fn replay(subject: &Subject<'_>, environment: &Environment) -> Result<Replay, Missing> {
    let mut player = Player::new(subject, environment)?;
    for inputs in &environment.inputs {
        player.cycle(inputs);
    }
    Ok(player.run)
}

/// A run that is being replayed.
pub(super) struct Player<'a> {
    pub(super) subject: &'a Subject<'a>,
    environment: &'a Environment,
    slots: Vec<SlotId>,
    pub(super) machine: Interpreter,
    pub(super) game: Game<'a>,
    pub(super) run: Replay,
}

impl<'a> Player<'a> {
    pub(super) fn new(subject: &'a Subject<'a>, environment: &'a Environment) -> Result<Self, Missing> {
        let game = Game::new(subject.automaton);
        let end = if *game.standing() == Standing::Ended { End::Ended } else { End::Open };
        Ok(Self {
            subject,
            environment,
            slots: slots(subject)?,
            machine: Interpreter::with(subject.program, &subject.options),
            game,
            run: Replay { cycles: Vec::new(), end },
        })
    }

    /// Plays one cycle, unless the run is over.
    pub(super) fn cycle(&mut self, inputs: &[u64]) {
        if self.run.end != End::Open {
            return;
        }
        let (machine, run, subject) = (&mut self.machine, &mut self.run, self.subject);
        for (slot, value) in self.environment.slots.iter().zip(inputs) {
            machine.set(*slot, *value);
        }
        let begin: Vec<u64> = self.slots.iter().map(|slot| machine.get(*slot)).collect();
        let mut assigned = Vec::new();
        let fault = machine.cycle_observed(&mut assigned).err();
        let end = self.slots.iter().map(|slot| machine.get(*slot));
        let values = begin.into_iter().zip(end).map(|(begin, end)| [begin, end]).collect();
        run.cycles.push(Cycle { values, assigned, ..Cycle::default() });
        let (slots, environment) = (&self.slots, self.environment);
        let mut judge = Cells {
            subject,
            slots,
            environment,
            cycles: &run.cycles,
            faulted: fault.is_some(),
            tried: BTreeSet::new(),
        };
        if !judge.globals_fit() {
            run.end = End::WrongGlobals;
            return;
        }
        let standing = self.game.play(&mut judge).clone();
        let tried: Vec<(usize, bool)> = judge.tried.iter().map(|site| (row(subject, *site), site.first)).collect();
        run.end = match (&standing, fault) {
            (Standing::Uncovered, _) => End::Uncovered,
            (_, Some(fault)) => End::Fault(fault),
            (Standing::Lost { rows }, None) => End::Lost(judge.failed(rows)),
            (Standing::Ended, None) => End::Ended,
            (Standing::Open, None) => End::Open,
        };
        let live = self.game.live().into_iter().map(|leaf| subject.automaton.leaves[leaf].row);
        let live: BTreeSet<usize> = live.collect();
        if let Some(cycle) = run.cycles.last_mut() {
            cycle.tried = tried;
            let possible = matches!(run.end, End::Open | End::Ended);
            cycle.live = if possible { live.into_iter().collect() } else { Vec::new() };
        }
    }
}

fn row(subject: &Subject<'_>, site: Site) -> usize {
    subject.automaton.leaves[site.leaf].row
}

/// The slot of each variable of the table.
fn slots(subject: &Subject<'_>) -> Result<Vec<SlotId>, Missing> {
    let slot = |path: &str| {
        let named = subject.program.variables.iter().find(|variable| variable.path.eq_ignore_ascii_case(path));
        named.map(|variable| variable.slot).ok_or_else(|| Missing { path: path.to_owned() })
    };
    subject.table.variables.iter().map(|variable| slot(&variable.path)).collect()
}

/// Judges the cells in the cycle played last.
struct Cells<'a> {
    subject: &'a Subject<'a>,
    slots: &'a [SlotId],
    environment: &'a Environment,
    cycles: &'a [Cycle],
    /// Whether the cycle was not done to its end.
    faulted: bool,
    tried: BTreeSet<Site>,
}

/// The values that a cell reads.
struct Values<'a, 'b> {
    cells: &'b Cells<'a>,
    assumptions: bool,
}

impl Leaves<Leaf> for Values<'_, '_> {
    fn read(&mut self, leaf: &Leaf) -> Result<u64, FaultAt> {
        let Cells { subject, slots, environment, cycles, .. } = self.cells;
        Ok(match *leaf {
            Leaf::Global(index) => environment.globals.get(index).copied().unwrap_or(0),
            Leaf::Variable { index, ago } => {
                let slot = &subject.program.slots[slots[index].0 as usize];
                let in_out = subject.table.variables[index].role == TableRole::InOut;
                let at_begin = if in_out { self.assumptions && ago == 0 } else { slot.role == Role::Input };
                match cycles.len().checked_sub(1 + ago as usize) {
                    Some(cycle) => cycles[cycle].values[index][usize::from(!at_begin)],
                    None => slot.initial,
                }
            }
        })
    }

    fn address(&mut self, _: &Leaf) -> Result<u64, FaultAt> {
        // A cell has no addresses: its expressions are over values.
        Ok(0)
    }
}

impl Cells<'_> {
    fn holds(&self, constraint: &Expr<Leaf>, assumptions: bool) -> bool {
        evaluate(constraint, &mut Values { cells: self, assumptions }) == Ok(1)
    }

    fn globals_fit(&self) -> bool {
        let mut constraints = self.subject.table.globals.iter().filter_map(|global| global.constraint.as_ref());
        constraints.all(|constraint| self.holds(constraint, false))
    }

    fn fit(&self, site: Site, assumptions: bool) -> bool {
        let mut own = self.subject.table.constraints(row(self.subject, site), assumptions, site.first);
        own.all(|constraint| self.holds(constraint, assumptions) || (assumptions && self.has_no_value(constraint)))
    }

    /// Whether an assumption reads what a cycle that faulted would have set: it excuses no fault.
    fn has_no_value(&self, constraint: &Expr<Leaf>) -> bool {
        let mut found = false;
        constraint.leaves(&mut |leaf| {
            if let Leaf::Variable { index, ago: 0 } = *leaf {
                let slot = &self.subject.program.slots[self.slots[index].0 as usize];
                found |= slot.role != Role::Input && self.subject.table.variables[index].role != TableRole::InOut;
            }
        });
        self.faulted && found
    }

    fn failed(&self, sites: &[Site]) -> Vec<Failed> {
        let failed = |site: &Site| {
            let row = row(self.subject, *site);
            let cells = self.subject.table.rows[row].cells.iter().zip(&self.subject.table.assumptions).enumerate();
            let columns = cells.filter_map(|(column, (cell, assumption))| {
                let cell = cell.as_ref().filter(|_| !assumption)?;
                (!self.holds(cell.constraint(site.first), false)).then_some(column)
            });
            Failed { row, first: site.first, columns: columns.collect() }
        };
        sites.iter().map(failed).collect()
    }
}

impl Judge for Cells<'_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        let fits = self.fit(site, true);
        if fits {
            self.tried.insert(site);
        }
        fits
    }

    fn outputs_fit(&mut self, site: Site) -> bool {
        self.fit(site, false)
    }
}
