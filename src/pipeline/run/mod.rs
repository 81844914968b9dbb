//! Tables that are played on the interpreter, and recorded traces that are held against a table.
//!
//! A table is played as a script: its rows from top to bottom, each as short as its duration allows (but shown for a cycle where it
//! may be), with inputs that its assumptions admit. A concrete table has one script; of a generalized one this is one run of
//! many, and proves nothing beyond it.

mod inputs;
mod monitor;
mod script;
mod show;

use std::collections::BTreeMap;

use super::Project;
use crate::diagnostic::Severity;
use crate::library::ItemId;
use crate::machine::elaborate::{self, elaborate};
use crate::machine::interpret::{self, Interpreter};
use crate::machine::program::Program;
use crate::machine::trace::Trace;
use crate::recheck::replay::{End, Environment, Subject, replay};
use crate::table::automaton::{Automaton, NoAutomaton};
use crate::table::bind::{BoundTable, bind};

pub use monitor::{kind, monitor};
pub use show::{Failure, Outcome};

use inputs::Picker;

/// How tables are played.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// For how many cycles a row without an end is played.
    pub cycles: u64,
    /// How often a block without an end is repeated.
    pub repeats: u64,
    /// Values of the table's global variables by their names, as literals.
    pub globals: BTreeMap<String, String>,
}

impl Default for Options {
    fn default() -> Self {
        Self { cycles: 10, repeats: 2, globals: BTreeMap::new() }
    }
}

/// Why a table cannot be played.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotPlayed {
    /// One line for each reason.
    pub reasons: Vec<String>,
    /// Whether the table or what was given with it is wrong, and not only beyond what this tool can play.
    pub is_wrong: bool,
}

impl NotPlayed {
    fn because(reason: impl Into<String>) -> Self {
        Self { reasons: vec![reason.into()], is_wrong: false }
    }

    fn wrong(reasons: impl IntoIterator<Item = String>) -> Self {
        Self { reasons: reasons.into_iter().collect(), is_wrong: true }
    }

    fn beyond(reasons: impl IntoIterator<Item = String>) -> Self {
        Self { reasons: reasons.into_iter().collect(), is_wrong: false }
    }
}

/// A table that is ready to be played.
struct Ready<'a> {
    project: &'a Project,
    index: usize,
    bound: BoundTable,
    automaton: Automaton,
    cycle_time: u64,
}

impl<'a> Ready<'a> {
    fn new(project: &'a Project, index: usize) -> Result<Self, NotPlayed> {
        let attached = &project.tables[index];
        let table = &attached.table;
        if table.has_errors() {
            return Err(NotPlayed::wrong(attached.errors.iter().map(|error| error.message.clone())));
        }
        let Some(unit) = attached.item else {
            return Err(NotPlayed::wrong(["the table belongs to no block".to_owned()]));
        };
        let (bound, findings) = bind(table, &project.catalogue, &project.names, unit);
        if bound.errors > 0 {
            let errors = findings.into_iter().filter(|finding| finding.severity == Severity::Error);
            return Err(NotPlayed::wrong(errors.map(|finding| finding.message)));
        }
        if !bound.unsupported.is_empty() {
            return Err(NotPlayed::beyond(bound.unsupported.iter().map(|unsupported| unsupported.what.clone())));
        }
        let automaton = Automaton::build(table).map_err(|error| {
            NotPlayed::because(match error {
                NoAutomaton::Errors => "the table has errors",
                NoAutomaton::NoCycleTime => "durations are times, and the cycle time is not known",
                NoAutomaton::Unsupported => "the table compares several runs, or jumps",
                NoAutomaton::TooLarge => "its rows can follow each other in too many ways",
            })
        })?;
        Ok(Self { project, index, bound, automaton, cycle_time: cycle_time(project, index) })
    }

    fn unit(&self) -> ItemId {
        self.bound.unit
    }

    fn program(&self) -> Result<Program, NotPlayed> {
        let stubs = self.project.asked.stubs.iter().map(|(_, stub)| stub.clone()).collect();
        let options = elaborate::Options { cycle_time: self.cycle_time, stubs, ..elaborate::Options::default() };
        elaborate(&self.project.catalogue, &self.project.names, self.unit(), &options).map_err(|list| {
            let files = &self.project.files;
            let line = |one: elaborate::Unsupported| match one.place {
                Some(place) => {
                    let path = &files.get(place.file).path;
                    format!("{path}:{}: {}", files.line_column(place).line, one.message)
                }
                None => one.message,
            };
            NotPlayed::beyond(list.into_iter().map(line))
        })
    }
}

/// The cycle time of a table in nanoseconds.
#[must_use]
pub fn cycle_time(project: &Project, index: usize) -> u64 {
    super::ready::asked(project, &project.tables[index].table).0
}

/// Plays a table on its block.
///
/// # Errors
/// Why it cannot be played.
pub fn play(project: &Project, index: usize, options: &Options) -> Result<Outcome, NotPlayed> {
    let ready = Ready::new(project, index)?;
    let program = ready.program()?;
    let table = &project.tables[index].table;
    let script = script::script(table, options.cycles, options.repeats).map_err(NotPlayed::because)?;
    let mut picker = Picker::new(&program, &ready.bound).map_err(NotPlayed::because)?;
    let given = |name: &str| options.globals.iter().find(|(other, _)| other.eq_ignore_ascii_case(name));
    let mut values = BTreeMap::new();
    for (number, global) in ready.bound.globals.iter().enumerate() {
        if let Some((name, text)) = given(&global.name) {
            let kind = show::kind(project, Some(&program), global.scalar, global.enumeration);
            let wrong = || NotPlayed::wrong([format!("`{text}` is no value of the global variable `{name}`")]);
            values.insert(number, crate::semantics::show::parse(&kind, text).ok_or_else(wrong)?);
        }
    }
    picker.pick_globals(&values).map_err(NotPlayed::because)?;
    let interpreter = interpret::Options { loop_limit: project.asked.loop_limit };
    let mut run = Interpreter::with(&program, &interpreter);
    let mut environment = Environment { globals: picker.globals().to_vec(), slots: picker.slots(), inputs: Vec::new() };
    for turn in &script {
        let name = || table.rows()[turn.row].id.clone();
        let inputs = picker.pick(&run, turn.row, turn.first);
        let inputs = inputs.map_err(|reason| NotPlayed::because(format!("row {}: {reason}", name())))?;
        for (slot, value) in environment.slots.iter().zip(&inputs) {
            run.set(*slot, *value);
        }
        environment.inputs.push(inputs);
        picker.begin(&run);
        if run.cycle().is_err() {
            break;
        }
        picker.end(&run);
    }
    let subject = Subject { program: &program, options: interpreter, table: &ready.bound, automaton: &ready.automaton };
    let replay = replay(&subject, &environment).map_err(|missing| NotPlayed::because(missing.to_string()))?;
    Ok(show::outcome(&ready, &program, &environment, &replay))
}

/// An empty trace of the table's variables.
fn trace_of(name: &str, cycle_time: u64) -> Trace {
    Trace::new(name, cycle_time)
}

/// Whether the run is one that the block has passed.
#[must_use]
pub const fn passes(end: &End) -> bool {
    matches!(end, End::Open | End::Uncovered | End::Ended)
}
