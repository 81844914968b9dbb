//! From a test table to a verdict: make ready, prove, check again.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::cover::Known;
use super::ready::{Ready, cycle_time, prepare};
use super::{Project, artefact, cover, mutants};
use crate::config::Settings;
use crate::evidence::coverage::Coverage;
use crate::library::ItemId;
use crate::logic::certificate::{Certificate, Fact};
use crate::logic::system::System;
use crate::machine::program::{Program, SlotId};
use crate::prove::decide::{Choice, Decision, decide};
use crate::prove::engine::{self, Cancel, Progress};
use crate::prove::strict::repeated_from;
use crate::prove::verdict::{FailedRow, Loss, Run, Verdict};
use crate::recheck::invariant::{self, Rejection};
use crate::recheck::replay::{End, Environment, Replay};
use crate::table::AttachedTable;
use crate::table::bind::BoundTable;

/// A table with its verdict and what led to it.
#[derive(Clone, Debug)]
pub struct Verified {
    /// Its index in [`Project::tables`].
    pub table: usize,
    /// The block.
    pub unit: Option<ItemId>,
    /// The verdict; it has been checked again.
    pub verdict: Verdict,
    /// The engine that decided it; empty if none did.
    pub engine: &'static str,
    /// How long it took, the second check included.
    pub time: Duration,
    /// The cycle time in nanoseconds.
    pub cycle_time: u64,
    /// What the verdict rests on besides the source.
    pub assumptions: Vec<String>,
    /// How many implicit obligations (faults of the machine) were proven along.
    pub faults: usize,
    /// What the proof covered.
    pub coverage: Option<Coverage>,
    /// The run of a violation.
    pub replay: Option<Replay>,
    /// The slots that the environment sets, in the order of a run's inputs.
    pub input_slots: Vec<SlotId>,
    /// The certificate as it is kept.
    pub certificate: Option<serde_json::Value>,
    /// The table as it was bound.
    pub bound: Option<Arc<BoundTable>>,
    /// The block as it was elaborated.
    pub program: Option<Arc<Program>>,
    /// Why it is not decided, where it is not.
    pub ended: Option<engine::Reason>,
    /// An error of this tool: a verdict that the second check did not confirm, and that is none for this reason.
    pub internal: Option<String>,
}

/// Hears how a table goes: its index, and what is tried.
pub type Listener<'a> = dyn Fn(usize, Progress) + Sync + 'a;

/// Decides one table.
#[must_use]
pub fn verify(
    project: &Project,
    settings: &Settings,
    table: usize,
    cancel: &Cancel,
    listener: &Listener<'_>,
) -> Verified {
    let start = Instant::now();
    let attached = &project.tables[table];
    let cycle_time = cycle_time(&attached.table, project);
    let mut made = Verified {
        table,
        unit: attached.item,
        verdict: Verdict::Unusable(Vec::new()),
        engine: "",
        time: Duration::ZERO,
        cycle_time,
        assumptions: Vec::new(),
        faults: 0,
        coverage: None,
        replay: None,
        input_slots: Vec::new(),
        certificate: None,
        bound: None,
        program: None,
        ended: None,
        internal: None,
    };
    match prepare(project, attached, cycle_time) {
        Ok(ready) => {
            made.assumptions.clone_from(&ready.program.assumptions);
            made.faults = ready.product.system.obligations.len() - 1;
            made.bound = Some(ready.table.clone());
            made.program = Some(ready.program.clone());
            made.input_slots.clone_from(&ready.product.inputs);
            let runs = judge(&ready, settings, &mut made, (start, cancel), &|progress| listener(table, progress));
            made.time = start.elapsed();
            if let Verdict::Verified(proof) = &made.verdict
                && settings.verify.coverage
            {
                listener(table, Progress { engine: "coverage", depth: 0, clauses: 0 });
                // That of strict conformance is about another system.
                let known =
                    Known { runs, invariant: ready.strict.is_none().then_some(proof), patience: patience(settings) };
                match covered(project, attached, &ready, known, (settings, cancel)) {
                    Ok(coverage) => made.coverage = Some(coverage),
                    Err(error) => made.internal = Some(error),
                }
            }
        }
        Err(verdict) => made.verdict = verdict,
    }
    if made.time.is_zero() {
        made.time = start.elapsed();
    }
    made
}

/// What the proof covered, and which mutants the table notices where that is asked for.
fn covered(
    project: &Project,
    attached: &AttachedTable,
    ready: &Ready,
    known: Known<'_>,
    (settings, cancel): (&Settings, &Cancel),
) -> Result<Coverage, String> {
    let (mut coverage, runs) = cover::cover(project, &attached.table, ready, known, cancel)?;
    if settings.verify.mutants {
        coverage.mutants = Some(mutants::mutants(project, ready, &runs, cancel)?);
    }
    Ok(coverage)
}

/// Decides, and checks the answer again; runs that came up on the way.
fn judge(
    ready: &Ready,
    settings: &Settings,
    made: &mut Verified,
    (start, cancel): (Instant, &Cancel),
    listener: &(dyn Fn(Progress) + Sync),
) -> Vec<Choice> {
    let product = ready.strict.as_ref().map_or(&ready.product, |strict| &strict.product);
    let decided = decide(product, &settings.verify.options, (start, cancel), listener);
    (made.engine, made.ended) = (decided.engine, decided.ended);
    match decided.decision {
        Decision::Proved(certificate) => {
            made.verdict = Verdict::Verified(certificate);
            confirm_certificate(ready, settings, made);
        }
        Decision::Violated(choice) => confirm_run(ready, &choice, made),
        Decision::Bounded(cycles) => made.verdict = Verdict::Bounded(cycles),
    }
    decided.runs
}

/// How long a second check may take: as long as the engines, and half a minute at least.
fn patience(settings: &Settings) -> Duration {
    settings.verify.options.timeout.max(Duration::from_secs(30))
}

/// Checks a certificate by the room that shares nothing with the engines.
fn confirm_certificate(ready: &Ready, settings: &Settings, made: &mut Verified) {
    let Verdict::Verified(certificate) = &made.verdict else { return };
    if let Err(rejection) = invariant::check(ready.system(), certificate, &invariant::within(patience(settings))) {
        made.internal = Some(match rejection {
            Rejection::OutOfTime => "the certificate could not be checked again in time".to_owned(),
            other => {
                let clause = match other {
                    Rejection::NotInductive(index) => clause_text(ready.system(), certificate, index),
                    _ => String::new(),
                };
                format!("the certificate of `{}` was rejected: {other:?}{clause}", made.engine)
            }
        });
        made.verdict = Verdict::Bounded(0);
        return;
    }
    made.certificate = Some(artefact::certificate(ready.system(), certificate));
}

/// A clause of a certificate, for the message that it was rejected.
fn clause_text(system: &System, certificate: &Certificate, index: usize) -> String {
    let fact = |fact: &Fact| match fact {
        Fact::Bit(bit) => {
            let name = system.states.get(bit.state as usize).map_or("?", |state| state.name.as_str());
            format!("{name}.{} = {}", bit.bit, u8::from(bit.value))
        }
        Fact::Gate(gate, value) => format!("gate {gate} = {}", u8::from(*value)),
    };
    let facts = certificate.clauses.get(index).map(|clause| clause.iter().map(fact).collect::<Vec<_>>().join(" or "));
    facts.map_or_else(String::new, |facts| format!(" ({facts})"))
}

/// Replays a run on the interpreter and on the game.
fn confirm_run(ready: &Ready, choice: &Choice, made: &mut Verified) {
    let environment = Environment {
        globals: choice.globals.clone(),
        slots: ready.product.inputs.clone(),
        inputs: choice.inputs.iter().map(|inputs| inputs[..ready.product.inputs.len()].to_vec()).collect(),
    };
    let replay = match ready.replay(&environment) {
        Ok(replay) => replay,
        Err(missing) => {
            made.internal = Some(format!("the run of `{}` cannot be replayed: {missing}", made.engine));
            made.verdict = Verdict::Bounded(0);
            return;
        }
    };
    if !matches!(replay.end, End::Lost(_) | End::Fault(_))
        && let Some(strict) = &ready.strict
        && let Some(from) = repeated_from(&strict.product, choice)
    {
        confirm_repetition(ready, environment, from, made);
        return;
    }
    let loss = match &replay.end {
        End::Lost(rows) => Loss::Table(rows.iter().map(failed).collect()),
        End::Fault(fault) => Loss::Fault { fault: fault.fault, place: fault.place },
        other => {
            made.internal = Some(format!("the run of `{}` does not lose when it is replayed: {other:?}", made.engine));
            made.verdict = Verdict::Bounded(0);
            return;
        }
    };
    let mut inputs = environment.inputs;
    inputs.truncate(replay.cycles.len());
    made.verdict = Verdict::Violated(Box::new(Run { globals: environment.globals, inputs, loss }));
    made.replay = Some(replay);
}

/// Replays a run that comes back to an earlier state in its last cycle; that cycle is not part of it.
fn confirm_repetition(ready: &Ready, mut environment: Environment, from: usize, made: &mut Verified) {
    environment.inputs.pop();
    let replayed = ready.repeats(&environment, from);
    let replayed = replayed.and_then(|()| ready.replay(&environment).map_err(|missing| missing.to_string()));
    match replayed {
        Ok(replay) => made.replay = Some(replay),
        Err(error) => {
            made.internal =
                Some(format!("the run of `{}` does not go on for ever when it is replayed: {error}", made.engine));
            made.verdict = Verdict::Bounded(0);
            return;
        }
    }
    let loss = Loss::NeverEnds(from);
    let Environment { globals, inputs, .. } = environment;
    made.verdict = Verdict::Violated(Box::new(Run { globals, inputs, loss }));
}

fn failed(row: &crate::recheck::replay::Failed) -> FailedRow {
    FailedRow { row: row.row, first: row.first, columns: row.columns.clone() }
}
