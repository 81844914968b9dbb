//! Mutants of a block before its table: which changes the table notices.
//!
//! A mutant is first played against the runs that the proof covered, which most do not survive, then searched and proven with
//! little work. One that is said to violate the table has done so on the interpreter.

use super::Project;
use super::cover::counted;
use super::ready::Ready;
use crate::evidence::coverage::{Mutant, Mutants, Outcome};
use crate::logic::system::Labelled;
use crate::machine::program::{Program, Role};
use crate::machine::{interpret, translate};
use crate::prove::cover::mutate::{Change, Mutation, mutant, mutations};
use crate::prove::cover::trial::{Seen, Trial, seen, trial};
use crate::prove::decide::Choice;
use crate::prove::engine::Cancel;
use crate::prove::product::{Parts, Product, product};
use crate::recheck::replay::{End, Environment, Subject, replay};
use crate::semantics::show::{Kind as Shown, literal};

/// So many mutants of a block are tried.
const MOST: usize = 120;

/// Tries mutants; `runs` are runs within the table.
///
/// # Errors
/// That a run of the prover was not confirmed, which is an error of this tool.
pub(super) fn mutants(project: &Project, ready: &Ready, runs: &[Choice], cancel: &Cancel) -> Result<Mutants, String> {
    let counted = counted(project, ready.program.unit);
    let counts = |item| counted.contains(&item);
    let all = mutations(&ready.program, &counts);
    let taken = all.len().min(MOST);
    let Some(original) = obligation(ready, &ready.program).map(|product| seen(&product)) else {
        return Err("the block is modelled with its verdict and not with its mutants".to_owned());
    };
    let mut list = Vec::with_capacity(taken);
    for index in 0..taken {
        let (number, mutation) = &all[index * all.len() / taken];
        let changed = mutant(&ready.program, &counts, *number);
        let outcome = outcome(ready, &changed, &original, runs, cancel)?;
        let files = &project.files;
        list.push(Mutant {
            file: files.get(mutation.place.file).path.clone(),
            line: files.line_column(mutation.place).line,
            change: change(project, mutation),
            outcome,
        });
    }
    Ok(Mutants { possible: all.len() as u64, list })
}

fn outcome(
    ready: &Ready,
    changed: &Program,
    original: &Seen,
    runs: &[Choice],
    cancel: &Cancel,
) -> Result<Outcome, String> {
    if let Some(cycle) = runs.iter().find_map(|run| violation(ready, changed, run)) {
        return Ok(Outcome::Caught { cycle });
    }
    let Some(product) = obligation(ready, changed) else { return Ok(Outcome::Unsupported) };
    match trial(&product, original, cancel) {
        Trial::Violated(run) => match violation(ready, changed, &run) {
            Some(cycle) => Ok(Outcome::Caught { cycle }),
            None => Err("the run of a mutant does not violate the table when it is replayed".to_owned()),
        },
        Trial::Conforms => Ok(Outcome::Survived),
        Trial::Bounded(cycles) => Ok(Outcome::NotCaught { cycles }),
        Trial::Same => Ok(Outcome::Equivalent),
    }
}

/// The cycle, from 1, in which a run violates the table or faults.
fn violation(ready: &Ready, changed: &Program, run: &Choice) -> Option<usize> {
    let environment =
        Environment { globals: run.globals.clone(), slots: ready.product.inputs.clone(), inputs: run.inputs.clone() };
    let options = interpret::Options { loop_limit: ready.loop_limit };
    let subject = Subject { program: changed, options, table: &ready.table, automaton: &ready.automaton };
    let replay = replay(&subject, &environment).ok()?;
    matches!(replay.end, End::Lost(_) | End::Fault(_)).then_some(replay.cycles.len())
}

fn obligation(ready: &Ready, changed: &Program) -> Option<Product> {
    let options = translate::Options { loop_limit: ready.loop_limit, ..translate::Options::default() };
    let translated = translate::translate(changed, &options).ok()?;
    let parts = Parts { program: changed, translated: &translated, table: &ready.table, automaton: &ready.automaton };
    let mut made = product(&parts).ok()?;
    let outputs = changed.variables.iter().filter(|variable| variable.role == Role::Output);
    made.system.outputs.extend(outputs.map(|variable| Labelled {
        term: translated.end[variable.slot.0 as usize],
        name: variable.path.clone(),
        origin: None,
    }));
    // An input that is read no more is no input of the system: a run would be misread.
    Some(made).filter(|product| product.inputs == ready.product.inputs)
}

/// What was changed, in words.
fn change(project: &Project, mutation: &Mutation) -> String {
    let text = mutation.place.span.of(&project.files.get(mutation.place.file).text);
    let text: String = text.lines().next().unwrap_or_default().trim().chars().take(80).collect();
    match &mutation.change {
        Change::Deleted => format!("`{text}` deleted"),
        Change::Operator(name) => format!("`{text}`: {name} instead"),
        Change::Negated => format!("`{text}` negated"),
        Change::Fixed(truth) => format!("`{text}` always {}", if *truth { "TRUE" } else { "FALSE" }),
        Change::Constant(scalar, bits) => format!("`{text}` → `{}`", literal(&Shown::from(*scalar), *bits)),
    }
}
