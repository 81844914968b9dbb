//! A table and its block, ready to be decided: bound, elaborated, translated, made one system.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::Project;
use crate::library::ItemId;
use crate::logic::system::System;
use crate::machine::elaborate::{self, elaborate};
use crate::machine::program::{Program, SlotId};
use crate::machine::{fixed, interpret, translate};
use crate::prove::product::{Parts, Product, product};
use crate::prove::strict::strict;
use crate::prove::verdict::{Reason, Verdict};
use crate::recheck::lasso;
use crate::recheck::replay::{Environment, Missing, Replay, Subject, replay};
use crate::recheck::strict::extend;
use crate::table::automaton::{Automaton, NoAutomaton};
use crate::table::bind::{BoundTable, bind};
use crate::table::{AttachedTable, Table};

/// A table and its block, ready to be decided.
#[derive(Debug)]
pub struct Ready {
    pub(super) program: Arc<Program>,
    pub(super) table: Arc<BoundTable>,
    pub(super) automaton: Automaton,
    pub(super) product: Product,
    pub(super) strict: Option<Strict>,
    pub(super) loop_limit: u64,
}

/// What strict conformance adds where words may be of any length; where they are bounded, every run ends, and it is weak
/// conformance.
#[derive(Debug)]
pub(super) struct Strict {
    /// What the engines prove.
    pub(super) product: Product,
    /// What certificates are checked against.
    checked: System,
    /// The slots that the game depends on.
    slots: Vec<SlotId>,
}

impl Ready {
    /// The obligation.
    #[must_use]
    pub fn system(&self) -> &System {
        self.strict.as_ref().map_or(&self.product.system, |strict| &strict.checked)
    }

    /// The slots that the environment sets.
    #[must_use]
    pub fn input_slots(&self) -> Vec<SlotId> {
        self.product.inputs.clone()
    }

    /// Their names.
    #[must_use]
    pub fn input_names(&self) -> Vec<&str> {
        let slots = self.product.inputs.iter().map(|slot| &self.program.slots[slot.0 as usize]);
        slots.map(|slot| slot.name.as_str()).collect()
    }

    /// Plays `environment` on the interpreter and the game.
    ///
    /// # Errors
    /// Where the table names a variable that the block does not have.
    pub fn replay(&self, environment: &Environment) -> Result<Replay, Missing> {
        replay(&self.subject(), environment)
    }

    /// Whether the cycles of `environment` from `from` on can be repeated for ever, within the table, by a fair
    /// environment, and strict conformance is asked for.
    ///
    /// # Errors
    /// Why it is not so.
    pub fn repeats(&self, environment: &Environment, from: usize) -> Result<(), String> {
        let strict = self.strict.as_ref().ok_or("a run that never ends violates nothing where conformance is weak")?;
        lasso::check(&self.subject(), environment, from, &strict.slots).map_err(|rejection| format!("{rejection:?}"))
    }

    fn subject(&self) -> Subject<'_> {
        Subject {
            program: &self.program,
            options: interpret::Options { loop_limit: self.loop_limit },
            table: &self.table,
            automaton: &self.automaton,
        }
    }
}

/// The table with this index and its block, ready to be decided.
///
/// # Errors
/// Why they are not.
pub fn ready(project: &Project, table: usize) -> Result<Ready, String> {
    let attached = &project.tables[table];
    prepare(project, attached, cycle_time(&attached.table, project)).map_err(|verdict| match verdict {
        Verdict::Unsupported(reasons) | Verdict::Unusable(reasons) => {
            reasons.into_iter().map(|reason| reason.message).collect::<Vec<_>>().join("; ")
        }
        other => other.word().to_owned(),
    })
}

/// The table's cycle time, or the configured one, or 10 ms.
pub(super) fn cycle_time(table: &Table, project: &Project) -> u64 {
    let own = table.options.cycle.map(|cycle| cycle.nanos).or(project.asked.cycle);
    own.and_then(|nanos| u64::try_from(nanos).ok()).filter(|nanos| *nanos > 0).unwrap_or(10_000_000)
}

/// What a verdict on the table depends on besides the source: the cycle time in nanoseconds, and options by name.
#[must_use]
pub fn asked(project: &Project, table: &Table) -> (u64, BTreeMap<String, String>) {
    let asked = &project.asked;
    let mut options = BTreeMap::from([("loop-limit".to_owned(), asked.loop_limit.to_string())]);
    if asked.strict {
        options.insert("strict".to_owned(), "true".to_owned());
    }
    if let Some(reading) = asked.fixed {
        options.insert("fixed".to_owned(), reading.written());
    }
    options.extend(asked.constants.iter().map(|(name, value)| (format!("const {name}"), value.clone())));
    let stubs = asked.stubs.iter().map(|(name, stub)| {
        let text = if stub.arbitrary { "arbitrary".to_owned() } else { stub.text.clone() };
        (format!("stub {name}"), text)
    });
    options.extend(stubs);
    (cycle_time(table, project), options)
}

fn reason(message: impl Into<String>, help: impl Into<String>) -> Reason {
    Reason { message: message.into(), help: help.into(), place: None }
}

pub(super) fn prepare(project: &Project, attached: &AttachedTable, cycle_time: u64) -> Result<Ready, Verdict> {
    let (unit, mut table) = bound(project, attached)?;
    let automaton = Automaton::build(&attached.table).map_err(|error| no_automaton(error, &attached.table))?;
    let is_strict = project.asked.strict || attached.table.options.strict;
    if is_strict && !automaton.ends {
        let help = "ask for weak conformance, the default, or let the table end";
        let mut reason = reason("the table never ends, so nothing can conform to it strictly", help);
        reason.place = Some(attached.table.name_place);
        return Err(Verdict::Unusable(vec![reason]));
    }
    let options = elaborate::Options {
        cycle_time,
        stubs: project.asked.stubs.iter().map(|(_, stub)| stub.clone()).collect(),
        ..elaborate::Options::default()
    };
    let mut program = elaborate(&project.catalogue, &project.names, unit, &options).map_err(|list| {
        let reasons = list.into_iter().map(|one| Reason { message: one.message, help: one.help, place: one.place });
        Verdict::Unsupported(reasons.collect())
    })?;
    if let Some(reading) = project.asked.fixed {
        fixed::read(&mut program, reading);
        table.read_in_fixed_point(reading);
    }
    let loop_limit = project.asked.loop_limit;
    let options = translate::Options { loop_limit, ..translate::Options::default() };
    let translated = translate::translate(&program, &options).map_err(|unsupported| {
        let message = format!("{} is not modelled", unsupported.what);
        Verdict::Unsupported(vec![Reason { message, help: String::new(), place: unsupported.place }])
    })?;
    let parts = Parts { program: &program, translated: &translated, table: &table, automaton: &automaton };
    let product = product(&parts).map_err(Verdict::Unsupported)?;
    let strict = (is_strict && !automaton.is_bounded()).then(|| strictly(&product, &translated.begin));
    Ok(Ready { program: Arc::new(program), table: Arc::new(table), automaton, product, strict, loop_limit })
}

/// The obligation of strict conformance, once for the engines and once for the second check.
fn strictly(product: &Product, begin: &[crate::logic::term::Term]) -> Strict {
    let extended = extend(&product.system, product.game.alive, &product.game.fair);
    let compared: BTreeSet<_> = extended.compared.iter().map(|index| product.system.states[*index].variable).collect();
    let slots = (0..).zip(begin).filter(|(_, term)| compared.contains(term)).map(|(slot, _)| SlotId(slot));
    Strict { product: strict(product), checked: extended.system, slots: slots.collect() }
}

/// The table bound to its block, if it can be.
fn bound(project: &Project, attached: &AttachedTable) -> Result<(ItemId, BoundTable), Verdict> {
    let Some(unit) = attached.item else {
        let help = "name the file after its block, or write `for BLOCK` in the table's heading";
        return Err(Verdict::Unusable(vec![reason("the table belongs to no block", help)]));
    };
    if attached.table.has_errors() {
        let errors = attached.errors.iter();
        let reasons = errors.map(|error| Reason {
            message: error.message.clone(),
            help: String::new(),
            place: Some(error.place),
        });
        return Err(Verdict::Unusable(reasons.collect()));
    }
    let (table, findings) = bind(&attached.table, &project.catalogue, &project.names, unit);
    if table.errors > 0 {
        let errors = findings.iter().filter(|finding| finding.severity == crate::diagnostic::Severity::Error);
        let reasons = errors.map(|finding| Reason {
            message: finding.message.clone(),
            help: finding.help.join("; "),
            place: Some(finding.place),
        });
        return Err(Verdict::Unusable(reasons.collect()));
    }
    if !table.unsupported.is_empty() {
        let reasons = table.unsupported.iter().map(|unsupported| Reason {
            message: unsupported.what.clone(),
            help: String::new(),
            place: Some(unsupported.place),
        });
        return Err(Verdict::Unsupported(reasons.collect()));
    }
    Ok((unit, table))
}

fn no_automaton(error: NoAutomaton, table: &Table) -> Verdict {
    let at = |mut reason: Reason| {
        reason.place = Some(table.name_place);
        vec![reason]
    };
    match error {
        NoAutomaton::Errors => Verdict::Unusable(at(reason("the table has errors", ""))),
        NoAutomaton::NoCycleTime => {
            let help = "write `(cycle 10ms)` in its heading, or `cycle = \"10ms\"` under `[tables]`";
            Verdict::Unusable(at(reason("durations are times, and the cycle time is not known", help)))
        }
        NoAutomaton::Unsupported => {
            let help = "split it into tables that specify one block and are read from top to bottom";
            Verdict::Unsupported(at(reason("the table compares several runs, or jumps", help)))
        }
        NoAutomaton::TooLarge => {
            let help = "give nested blocks fewer ways to follow each other";
            Verdict::Unsupported(at(reason("its rows can follow each other in too many ways", help)))
        }
    }
}
