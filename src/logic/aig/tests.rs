//! Reductions of small random models against enumeration of their states and inputs.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::{Aig, Latch, Lit, Model, Reduced, Trace, cone, constants, correspond, sweep, word};
use crate::logic::sat::Stop;

const INPUTS: usize = 2;
const LATCHES: usize = 6;

/// A model from numbers. Some gates are built twice, in another way, so that there is something to find.
fn model(gates: &[(usize, usize, u8)], roots: &[usize], initials: &[u8]) -> Model {
    let mut out = Model::default();
    let mut lits: Vec<Lit> = (0..INPUTS + LATCHES).map(|_| out.aig.leaf()).collect();
    out.inputs = lits[..INPUTS].to_vec();
    let leaves = lits[INPUTS..].to_vec();
    let pick = |lits: &[Lit], number: usize| lits[number / 2 % lits.len()].invert_if(number % 2 == 1);
    for (left, right, kind) in gates {
        let (a, b) = (pick(&lits, *left), pick(&lits, *right));
        let aig = &mut out.aig;
        let made = match kind % 4 {
            0 => aig.and(a, b),
            1 => aig.xor(a, b),
            2 => aig.ite(a, b, !b),
            _ => {
                let (first, second) = (aig.or(a, b), aig.and(a, b));
                aig.and(first, !second)
            }
        };
        lits.push(made);
    }
    for (index, leaf) in leaves.into_iter().enumerate() {
        let initial = [Some(false), Some(false), Some(true), None][usize::from(initials[index] % 4)];
        out.latches.push(Latch { lit: leaf, next: pick(&lits, roots[index]), initial });
    }
    out.bad = roots[LATCHES..LATCHES + 2].iter().map(|root| pick(&lits, *root)).collect();
    if roots[LATCHES + 2].is_multiple_of(2) {
        out.constraints.push(pick(&lits, roots[LATCHES + 2]));
    }
    out
}

/// All states of a model: first ones, and what each leads to under each input: whether that is allowed, what is bad, and the
/// next state. State and input are numbers, bit by bit.
fn explore(model: &Model, state: usize, input: usize) -> (bool, Vec<bool>, usize) {
    let mut words = vec![0; model.aig.len()];
    for (bit, lit) in model.inputs.iter().enumerate() {
        words[lit.node() as usize] = (input >> bit & 1) as u64;
    }
    for (bit, latch) in model.latches.iter().enumerate() {
        words[latch.lit.node() as usize] = (state >> bit & 1) as u64;
    }
    model.aig.propagate(&mut words);
    let value = |lit: &Lit| word(&words, *lit) & 1 == 1;
    let next = model.latches.iter().enumerate().map(|(bit, latch)| usize::from(value(&latch.next)) << bit).sum();
    (model.constraints.iter().all(value), model.bad.iter().map(value).collect(), next)
}

fn first_states(model: &Model) -> Vec<usize> {
    let begins = |state: &usize| {
        let mut latches = model.latches.iter().enumerate();
        latches.all(|(bit, latch)| latch.initial.is_none_or(|value| value == (state >> bit & 1 == 1)))
    };
    (0..1 << model.latches.len()).filter(begins).collect()
}

/// For each bad literal, the first cycle in which it can be true.
fn depths(model: &Model) -> Vec<Option<usize>> {
    let mut out = vec![None; model.bad.len()];
    let mut seen: BTreeSet<usize> = first_states(model).into_iter().collect();
    let mut frontier: Vec<usize> = seen.iter().copied().collect();
    for depth in 0.. {
        let mut new = Vec::new();
        for state in frontier {
            for input in 0..1 << model.inputs.len() {
                let (allowed, bad, next) = explore(model, state, input);
                if !allowed {
                    continue;
                }
                for (out, bad) in out.iter_mut().zip(bad) {
                    if bad && out.is_none() {
                        *out = Some(depth);
                    }
                }
                if seen.insert(next) {
                    new.push(next);
                }
            }
        }
        if new.is_empty() {
            return out;
        }
        frontier = new;
    }
    out
}

fn hold(facts: &[super::LatchClause], state: usize) -> bool {
    facts.iter().all(|clause| clause.iter().any(|(latch, value)| (state >> latch & 1 == 1) == *value))
}

fn check(model: &Model, reduced: &Reduced, inputs: &[u8]) -> Result<(), TestCaseError> {
    prop_assert_eq!(depths(model), depths(&reduced.model));
    prop_assert!(first_states(model).into_iter().all(|state| hold(&reduced.facts, state)));
    for state in (0..1 << LATCHES).filter(|state| hold(&reduced.facts, *state)) {
        for input in 0..1 << INPUTS {
            let (allowed, _, next) = explore(model, state, input);
            prop_assert!(!allowed || hold(&reduced.facts, next));
        }
    }
    let bits = |value: u8, count: usize| (0..count).map(|bit| value >> bit & 1 == 1).collect::<Vec<bool>>();
    let small = Trace {
        latches: bits(inputs[0], reduced.model.latches.len()),
        inputs: inputs.iter().map(|cycle| bits(*cycle, reduced.model.inputs.len())).collect(),
    };
    let runs = model.simulate(&reduced.trace(&small)).into_iter().zip(reduced.model.simulate(&small));
    for (old, new) in runs {
        prop_assert_eq!(old.constrained, new.constrained);
        if !old.constrained {
            break;
        }
        prop_assert_eq!(old.bad, new.bad);
    }
    Ok(())
}

fn cases() -> u32 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(300)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]
    #[test]
    fn reductions_keep_what_is_bad(
        gates in proptest::collection::vec((0_usize..200, 0_usize..200, 0_u8..4), 1..24),
        roots in proptest::collection::vec(0_usize..200, LATCHES + 3),
        initials in proptest::collection::vec(0_u8..4, LATCHES),
        inputs in proptest::collection::vec(any::<u8>(), 1..12),
    ) {
        let (model, stop) = (model(&gates, &roots, &initials), Stop::default());
        check(&model, &cone(&model), &inputs)?;
        check(&model, &constants(&model), &inputs)?;
        check(&model, &correspond(&model, &stop), &inputs)?;
        check(&model, &sweep(&model, &stop), &inputs)?;
        let all = constants(&model).then(|model| correspond(model, &stop)).then(|model| sweep(model, &stop));
        check(&model, &all, &inputs)?;
    }
}

#[test]
fn equal_counters_become_one() {
    let mut model = Model::default();
    let enable = model.aig.leaf();
    model.inputs.push(enable);
    let bits: Vec<Lit> = (0..16).map(|_| model.aig.leaf()).collect();
    for (half, word) in bits.chunks(8).enumerate() {
        let mut carry = enable;
        for bit in word {
            let next = if half == 0 { model.aig.xor(*bit, carry) } else { model.aig.ite(carry, !*bit, *bit) };
            carry = if half == 0 { model.aig.and(carry, *bit) } else { model.aig.ite(*bit, carry, Lit::FALSE) };
            model.latches.push(Latch { lit: *bit, next, initial: Some(false) });
        }
    }
    let differ = bits[..8].iter().zip(&bits[8..]).fold(Lit::FALSE, |differ, (a, b)| {
        let bit = model.aig.xor(*a, *b);
        model.aig.or(differ, bit)
    });
    model.bad.push(differ);
    let reduced = correspond(&model, &Stop::default());
    assert_eq!(reduced.model.bad, [Lit::FALSE]);
    assert_eq!(reduced.facts.len(), 16);
    assert_eq!(reduced.model.latches.len(), 0);
}

#[test]
fn equal_functions_become_one_node() {
    let mut model = Model::default();
    let leaves: Vec<Lit> = (0..8).map(|_| model.aig.leaf()).collect();
    model.inputs.clone_from(&leaves);
    let up = leaves.iter().fold(Lit::FALSE, |parity, lit| model.aig.xor(parity, *lit));
    let down = leaves.iter().rev().fold(Lit::FALSE, |parity, lit| model.aig.xor(parity, *lit));
    let differ = model.aig.xor(up, down);
    model.bad.extend([differ, up]);
    let reduced = sweep(&model, &Stop::default());
    assert_eq!(reduced.model.bad[0], Lit::FALSE);
    assert!(reduced.model.aig.len() <= 9 + 3 * 7);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]
    #[test]
    fn a_copy_in_another_graph_is_the_same_function(
        gates in proptest::collection::vec((0_usize..200, 0_usize..200, 0_u8..4), 1..24),
        roots in proptest::collection::vec(0_usize..200, LATCHES + 3),
        shift in 0..INPUTS + LATCHES,
    ) {
        let all = Model { latches: Vec::new(), ..model(&gates, &roots, &[0; LATCHES]) };
        let leaves: Vec<Lit> = (1_u32..).map(Lit::of).take(INPUTS + LATCHES).collect();
        let other = Model { inputs: leaves.clone(), ..all };
        let mut aig = Aig::default();
        let mut own: Vec<Lit> = leaves.iter().map(|_| aig.leaf()).collect();
        own.rotate_left(shift);
        let copies: Vec<Lit> = other.bad.iter().map(|&bad| aig.import(&other, &own, bad)).collect();
        for round in 0..4_u64 {
            let (mut there, mut here) = (vec![0; other.aig.len()], vec![0; aig.len()]);
            for (index, (old, new)) in leaves.iter().zip(&own).enumerate() {
                let bits = (round * 64..).take(64).map(|number| number >> index & 1);
                let bits = bits.enumerate().map(|(lane, bit)| bit << lane).sum();
                (there[old.node() as usize], here[new.node() as usize]) = (bits, bits);
            }
            other.aig.propagate(&mut there);
            aig.propagate(&mut here);
            for (bad, copy) in other.bad.iter().zip(&copies) {
                prop_assert_eq!(word(&there, *bad), word(&here, *copy));
            }
        }
    }
}
