//! The oracle: explicit-state exploration of small models, and the check of proofs and traces by enumeration. It shares
//! no code with the engines.

use std::collections::BTreeMap;

use rungbook::logic::aig::{Gate, Lit, Model, Trace};
use rungbook::prove::engine::Proof;

/// Values of all nodes, for a state and inputs given as bits.
pub(crate) fn nodes(model: &Model, state: u32, input: u32) -> Vec<bool> {
    let mut values = vec![false; model.aig.len()];
    for (i, latch) in model.latches.iter().enumerate() {
        values[latch.lit.node() as usize] = state >> i & 1 == 1;
    }
    for (i, lit) in model.inputs.iter().enumerate() {
        values[lit.node() as usize] = input >> i & 1 == 1;
    }
    for node in 0..model.aig.len() {
        if let Gate::And(a, b) = model.aig.gate(node as u32) {
            values[node] = of(&values, a) && of(&values, b);
        }
    }
    values
}

fn of(values: &[bool], lit: Lit) -> bool {
    values[lit.node() as usize] != lit.inverted()
}

fn next(model: &Model, values: &[bool]) -> u32 {
    model.latches.iter().enumerate().map(|(i, l)| u32::from(of(values, l.next)) << i).sum()
}

fn is_first(model: &Model, state: u32) -> bool {
    model.latches.iter().enumerate().all(|(i, l)| l.initial.is_none_or(|v| v == (state >> i & 1 == 1)))
}

/// One step from a state: whether the constraints hold, whether it is bad, and where it leads.
struct Step {
    allowed: bool,
    bad: bool,
    to: u32,
}

fn steps(model: &Model, state: u32) -> impl Iterator<Item = Step> + '_ {
    (0..1u32 << model.inputs.len()).map(move |input| {
        let values = nodes(model, state, input);
        Step {
            allowed: model.constraints.iter().all(|&c| of(&values, c)),
            bad: of(&values, model.bad[0]),
            to: next(model, &values),
        }
    })
}

/// The length of the shortest bad run, in cycles.
pub(crate) fn shortest(model: &Model) -> Option<usize> {
    let states = 0..1u32 << model.latches.len();
    let mut front: Vec<u32> = states.filter(|&s| is_first(model, s)).collect();
    let mut seen: BTreeMap<u32, ()> = front.iter().map(|&s| (s, ())).collect();
    let mut cycles = 1;
    while !front.is_empty() {
        let mut later = Vec::new();
        for state in front {
            for step in steps(model, state).filter(|s| s.allowed) {
                if step.bad {
                    return Some(cycles);
                }
                if seen.insert(step.to, ()).is_none() {
                    later.push(step.to);
                }
            }
        }
        front = later;
        cycles += 1;
    }
    None
}

/// Whether the invariant of the proof holds in a state.
fn holds(model: &Model, proof: &Proof, state: u32) -> bool {
    let mut values: Vec<bool> = (0..model.latches.len()).map(|i| state >> i & 1 == 1).collect();
    for &((a, x), (b, y)) in &proof.gates {
        values.push(values[a] == x && values[b] == y);
    }
    proof.clauses.iter().all(|c| c.iter().any(|&(f, v)| values[f] == v))
}

/// Panics unless the proof is one.
pub(crate) fn check_proof(model: &Model, proof: &Proof) {
    for state in 0..1u32 << model.latches.len() {
        let inside = holds(model, proof, state);
        assert!(inside || !is_first(model, state), "a first state is outside the invariant");
        if inside {
            for step in steps(model, state).filter(|s| s.allowed) {
                assert!(holds(model, proof, step.to), "the invariant is left");
                assert!(!step.bad || proof.k > 1, "the invariant allows a bad cycle");
            }
        }
    }
    if proof.k > 1 {
        check_induction(model, proof);
    }
}

/// The two halves of an induction of depth `k`, by walking all paths.
fn check_induction(model: &Model, proof: &Proof) {
    assert!(shortest(model).is_none_or(|n| n > proof.k), "a short run is bad");
    for state in (0..1u32 << model.latches.len()).filter(|&s| holds(model, proof, s)) {
        walk(model, proof, &mut vec![state]);
    }
}

fn walk(model: &Model, proof: &Proof, path: &mut Vec<u32>) {
    let last = path[path.len() - 1];
    for step in steps(model, last).filter(|s| s.allowed) {
        if path.len() == proof.k + 1 {
            assert!(!step.bad, "the induction's step fails");
        } else if !(step.bad || proof.simple_path && path.len() < proof.k && path.contains(&step.to)) {
            path.push(step.to);
            walk(model, proof, path);
            path.pop();
        }
    }
}

/// Panics unless the trace is a run that is bad in its last cycle.
pub(crate) fn check_trace(model: &Model, trace: &Trace) {
    let bits = |values: &[bool]| values.iter().enumerate().map(|(i, &v)| u32::from(v) << i).sum::<u32>();
    let mut state = bits(&trace.latches);
    assert!(is_first(model, state));
    let mut bad = false;
    for inputs in &trace.inputs {
        let values = nodes(model, state, bits(inputs));
        assert!(model.constraints.iter().all(|&c| of(&values, c)));
        bad = of(&values, model.bad[0]);
        state = next(model, &values);
    }
    assert!(bad);
}

/// Whether the proof is one, as the second check has it: all states of an induction's step differ, the last one too, which a
/// shortest bad run satisfies.
pub(crate) fn is_proof(model: &Model, proof: &Proof) -> bool {
    if proof.k == 0 {
        return false;
    }
    let inside: Vec<bool> = (0..1u32 << model.latches.len()).map(|state| holds(model, proof, state)).collect();
    let allowed = |state: u32| steps(model, state).any(|step| step.allowed);
    for state in (0..1u32 << model.latches.len()).filter(|&state| allowed(state)) {
        if is_first(model, state) && !inside[state as usize] {
            return false;
        }
        // What no cycle follows is no state of a run.
        let leaves = |step: &Step| step.allowed && allowed(step.to) && !inside[step.to as usize];
        if inside[state as usize] && steps(model, state).any(|step| leaves(&step)) {
            return false;
        }
        if proof.k == 1 && inside[state as usize] && steps(model, state).any(|step| step.allowed && step.bad) {
            return false;
        }
    }
    let starts = (0..1u32 << model.latches.len()).filter(|&state| inside[state as usize]);
    proof.k == 1
        || shortest(model).is_none_or(|length| length > proof.k)
            && starts.into_iter().all(|state| no_bad_step(model, proof, &inside, &mut vec![state]))
}

fn no_bad_step(model: &Model, proof: &Proof, inside: &[bool], path: &mut Vec<u32>) -> bool {
    for step in steps(model, path[path.len() - 1]).filter(|step| step.allowed) {
        if path.len() == proof.k + 1 {
            if step.bad {
                return false;
            }
        } else if !step.bad && inside[step.to as usize] && !(proof.simple_path && path.contains(&step.to)) {
            path.push(step.to);
            let none = no_bad_step(model, proof, inside, path);
            path.pop();
            if !none {
                return false;
            }
        }
    }
    true
}

/// Whether the trace is a run that is bad in its last cycle.
pub(crate) fn is_bad_run(model: &Model, trace: &Trace) -> bool {
    let bits = |values: &[bool]| values.iter().enumerate().map(|(i, &v)| u32::from(v) << i).sum::<u32>();
    let mut state = bits(&trace.latches);
    let (mut fits, mut bad) = (is_first(model, state), false);
    for inputs in &trace.inputs {
        let values = nodes(model, state, bits(inputs));
        fits &= model.constraints.iter().all(|&constraint| of(&values, constraint));
        bad = of(&values, model.bad[0]);
        state = next(model, &values);
    }
    fits && bad
}
