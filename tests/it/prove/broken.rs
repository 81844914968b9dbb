//! Engines that are broken on purpose, and what the second check says of them.
//!
//! An engine that decides another model than it was given (a latch with the wrong first value, an inverted next value, a
//! forgotten constraint, a frozen latch, another bad literal) is broken in the way that an engine, a reduction or an encoding
//! would be; and each answer of a sound one is spoiled in every small way. The second check must reject every
//! certificate that is none, decided by enumeration of the states, and accept every one that is.

use std::sync::Arc;

use rungbook::logic::aig::{Aig, Gate, Lit, Model, Trace};
use rungbook::logic::certificate::{Certificate, Fact, StateBit};
use rungbook::logic::system::{Input, Labelled, State, System};
use rungbook::logic::term::{Pool, Term};
use rungbook::prove::bmc::Bmc;
use rungbook::prove::engine::{Answer, Budget, Engine, Proof};
use rungbook::prove::ic3::Ic3;
use rungbook::prove::induction::Induction;
use rungbook::prove::interpolation::Interpolation;
use rungbook::prove::mine::Mine;
use rungbook::prove::portfolio::Portfolio;
use rungbook::prove::simulate::is_violation;
use rungbook::recheck::invariant::{Stop, check};

use super::explicit;
use super::random::{Dice, model};

/// The model as a system of single bits: the states are the latches in their order.
fn system(model: &Model) -> System {
    let mut pool = Pool::default();
    let mut terms: Vec<Term> = Vec::new();
    for node in 0..model.aig.len() as u32 {
        let of = |pool: &mut Pool, terms: &[Term], lit: Lit| {
            let term = terms[lit.node() as usize];
            if lit.inverted() { pool.not(term) } else { term }
        };
        let term = match model.aig.gate(node) {
            Gate::False => pool.truth(false),
            Gate::Leaf => pool.variable(1, format!("x{node}")),
            Gate::And(a, b) => {
                let (a, b) = (of(&mut pool, &terms, a), of(&mut pool, &terms, b));
                pool.and(a, b)
            }
        };
        terms.push(term);
    }
    let mut of = |lit: Lit| {
        let term = terms[lit.node() as usize];
        if lit.inverted() { pool.not(term) } else { term }
    };
    let labelled = |term| Labelled { term, name: String::new(), origin: None };
    let constraints = model.constraints.iter().map(|&lit| labelled(of(lit))).collect();
    let obligations = vec![labelled(of(!model.bad[0]))];
    let input = |lit: &Lit| Input { variable: terms[lit.node() as usize], name: String::new(), origin: None };
    let inputs = model.inputs.iter().map(input).collect();
    let ends: Vec<(Term, Term)> = model.latches.iter().map(|latch| (of(latch.lit), of(latch.next))).collect();
    let states = model.latches.iter().zip(ends).map(|(latch, (variable, next))| {
        let initial = latch.initial.map(|value| pool.truth(value));
        State { variable, name: String::new(), initial, next, origin: None }
    });
    let states = states.collect();
    System { pool, inputs, states, constraints, obligations, ..System::default() }
}

fn certificate(model: &Model, proof: &Proof) -> Certificate {
    let latches = model.latches.len();
    let fact = |&(index, value): &(usize, bool)| match index.checked_sub(latches) {
        None => Fact::Bit(StateBit { state: index as u32, bit: 0, value }),
        Some(gate) => Fact::Gate(gate as u32, value),
    };
    Certificate {
        gates: proof.gates.iter().map(|(a, b)| [fact(a), fact(b)]).collect(),
        clauses: proof.clauses.iter().map(|clause| clause.iter().map(fact).collect()).collect(),
        k: proof.k as u32,
        simple_path: proof.simple_path,
    }
}

fn accepted(model: &Model, proof: &Proof) -> bool {
    let never: Stop = Arc::new(|| false);
    check(&system(model), &certificate(model, proof), &never).is_ok()
}

fn engines() -> Vec<Box<dyn Engine>> {
    vec![
        Box::new(Bmc),
        Box::new(Induction),
        Box::new(Interpolation),
        Box::new(Ic3),
        Box::new(Mine::default()),
        Box::new(Portfolio::default()),
    ]
}

/// Another model with the same latches and inputs.
fn broken(model: &Model, dice: &mut Dice) -> Model {
    let mut broken = model.clone();
    let latch = dice.below(broken.latches.len());
    let latches = &mut broken.latches;
    match dice.below(7) {
        0 => latches[latch].initial = Some(latches[latch].initial != Some(true)),
        1 => latches[latch].next = !latches[latch].next,
        2 => latches[latch].next = latches[latch].lit,
        3 => broken.bad[0] = !broken.bad[0],
        4 if !broken.constraints.is_empty() => broken.constraints.clear(),
        5 => {
            // What IC3 or BMC does that reads the next value of another latch.
            let other = dice.below(latches.len());
            let next = latches[other].next;
            latches[latch].next = next;
        }
        _ => {
            let lit = Lit::of(dice.below(broken.aig.len()) as u32);
            broken.bad[0] = Aig::and(&mut broken.aig, model.bad[0], lit);
        }
    }
    broken
}

/// Every proof that differs from `proof` in a small way.
fn spoiled(proof: &Proof) -> Vec<Proof> {
    let mut out = Vec::new();
    let mut add = |change: &dyn Fn(&mut Proof)| {
        let mut other = proof.clone();
        change(&mut other);
        out.push(other);
    };
    add(&|proof| proof.clauses.clear());
    add(&|proof| proof.k += 1);
    add(&|proof| proof.k -= 1);
    add(&|proof| proof.k = 1);
    add(&|proof| proof.simple_path = !proof.simple_path);
    for clause in 0..proof.clauses.len() {
        add(&|proof| drop(proof.clauses.remove(clause)));
        for literal in 0..proof.clauses[clause].len() {
            add(&|proof| {
                proof.clauses[clause].remove(literal);
            });
            add(&|proof| proof.clauses[clause][literal].1 ^= true);
        }
    }
    for gate in 0..proof.gates.len() {
        add(&|proof| proof.gates[gate].0.1 ^= true);
        add(&|proof| proof.gates[gate].1 = proof.gates[gate].0);
    }
    out
}

/// Every run that differs from `trace` in a small way.
fn altered(trace: &Trace) -> Vec<Trace> {
    let mut out = Vec::new();
    let mut add = |change: &dyn Fn(&mut Trace)| {
        let mut other = trace.clone();
        change(&mut other);
        out.push(other);
    };
    add(&|trace| drop(trace.inputs.pop()));
    add(&|trace| trace.inputs.extend(trace.inputs.last().cloned()));
    for latch in 0..trace.latches.len() {
        add(&|trace| trace.latches[latch] ^= true);
    }
    for cycle in 0..trace.inputs.len() {
        add(&|trace| drop(trace.inputs.remove(cycle)));
        for input in 0..trace.inputs[cycle].len() {
            add(&|trace| trace.inputs[cycle][input] ^= true);
        }
    }
    out
}

/// How many answers were wrong, and were caught.
#[derive(Default)]
struct Caught {
    proofs: usize,
    runs: usize,
}

fn judge(model: &Model, proof: &Proof, about: &str, caught: &mut Caught) {
    let right = explicit::is_proof(model, proof);
    assert_eq!(accepted(model, proof), right, "{about}: {proof:?}");
    caught.proofs += usize::from(!right);
}

fn judge_run(model: &Model, trace: &Trace, about: &str, caught: &mut Caught) {
    let right = explicit::is_bad_run(model, trace);
    assert_eq!(is_violation(model, 0, trace), right, "{about}: {trace:?}");
    caught.runs += usize::from(!right);
}

#[test]
fn what_broken_engines_say_is_rejected() {
    for engine in engines() {
        let mut caught = Caught::default();
        for seed in 0..super::cases(1_000) / 10 {
            let model = model(seed, 4);
            let broken = broken(&model, &mut Dice(seed ^ 0x5EED));
            let about = format!("{}, seed {seed}", engine.name());
            // Bounded model checking alone never ends where there is nothing to be found.
            let budget = Budget::seconds(if engine.name() == "bmc" { 0.02 } else { 20.0 });
            match engine.run(&broken, 0, &budget, &|_| ()) {
                Answer::Proved(proof) => judge(&model, &proof, &about, &mut caught),
                Answer::Violated(trace) => judge_run(&model, &trace, &about, &mut caught),
                Answer::Bounded { .. } | Answer::GaveUp(_) => {}
            }
        }
        assert!(caught.proofs + caught.runs > 3, "{}: {}, {}", engine.name(), caught.proofs, caught.runs);
    }
}

#[test]
fn spoiled_answers_are_rejected() {
    let mut caught = Caught::default();
    for engine in engines().into_iter().filter(|engine| engine.name() != "bmc") {
        for seed in 0..super::cases(500) / 10 {
            let model = model(seed, 4);
            let about = format!("{}, seed {seed}", engine.name());
            match engine.run(&model, 0, &Budget::seconds(20.0), &|_| ()) {
                Answer::Proved(proof) => {
                    assert!(accepted(&model, &proof), "{about}");
                    spoiled(&proof).iter().for_each(|proof| judge(&model, proof, &about, &mut caught));
                }
                Answer::Violated(trace) => {
                    altered(&trace).iter().for_each(|trace| judge_run(&model, trace, &about, &mut caught));
                }
                Answer::Bounded { .. } | Answer::GaveUp(_) => {}
            }
        }
    }
    assert!(caught.proofs > 50 && caught.runs > 50, "{}, {}", caught.proofs, caught.runs);
}
