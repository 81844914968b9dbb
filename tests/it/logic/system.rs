//! Systems: runs on values, and what their cones keep.

use rungbook::logic::system::{Input, Labelled, State, System};
use rungbook::logic::term::Term;

fn labelled(term: Term, name: &str) -> Labelled {
    Labelled { term, name: name.to_owned(), origin: None }
}

/// A state variable of a system that is being made.
fn state(system: &mut System, name: &str, width: u32, initial: Option<Term>) -> Term {
    let variable = system.pool.variable(width, name);
    system.states.push(State { variable, name: name.to_owned(), initial, next: variable, origin: None });
    variable
}

fn input(system: &mut System, name: &str, width: u32) -> Term {
    let variable = system.pool.variable(width, name);
    system.inputs.push(Input { variable, name: name.to_owned(), origin: None });
    variable
}

/// A counter up to a frozen limit, which starts one below it, and another one that nobody asks for.
fn counters() -> System {
    let mut system = System::default();
    let up = input(&mut system, "up", 1);
    let reset = input(&mut system, "reset", 1);
    let limit = state(&mut system, "limit", 8, None);
    let one = system.pool.constant(8, 1);
    let below = system.pool.sub(limit, one);
    let count = state(&mut system, "count", 8, Some(below));
    let zero = system.pool.constant(8, 0);
    let other = state(&mut system, "other", 8, Some(zero));
    let pool = &mut system.pool;
    let (more, may) = (pool.add(count, one), pool.ult(count, limit));
    let step = pool.and(up, may);
    let next = pool.ite(step, more, count);
    let fall = pool.ite(reset, zero, other);
    let (within, nothing, not) = (pool.ule(count, limit), pool.eq(other, zero), pool.not(up));
    let positive = pool.ult(zero, limit);
    system.states[1].next = next;
    system.states[2].next = fall;
    system.constraints.push(labelled(positive, "limit is positive"));
    system.obligations.extend([labelled(within, "within"), labelled(nothing, "nothing")]);
    system.outputs.extend([labelled(more, "more"), labelled(not, "down"), labelled(reset, "reset")]);
    system
}

#[test]
fn a_run_follows_initial_and_next_values() {
    let system = counters();
    let run = system.simulate(&[5], &[vec![0, 0], vec![1, 1], vec![1, 0], vec![0, 0]]);
    assert_eq!(run.iter().map(|cycle| cycle.states[1]).collect::<Vec<_>>(), [4, 4, 5, 5]);
    assert_eq!(run.iter().map(|cycle| cycle.outputs[0]).collect::<Vec<_>>(), [5, 5, 6, 6]);
    assert!(run.iter().all(|cycle| cycle.obligations == [true, true] && cycle.constraints == [true]));
    let empty = system.simulate(&[0], &[vec![]]);
    assert_eq!(empty[0].constraints, [false]);
    assert_eq!(empty[0].obligations, [false, true]);
}

#[test]
fn a_cone_keeps_what_matters_and_behaves_the_same() {
    let system = counters();
    let cone = system.cone(&[0]);
    assert_eq!((cone.states, cone.inputs), (vec![0, 1], vec![0]));
    assert_eq!(cone.system.outputs.iter().map(|output| output.name.as_str()).collect::<Vec<_>>(), ["more", "down"]);
    let whole = system.simulate(&[7], &vec![vec![1, 1]; 5]);
    let part = cone.system.simulate(&[7], &vec![vec![1]; 5]);
    for (whole, part) in whole.iter().zip(&part) {
        assert_eq!(whole.states[..2], part.states[..]);
        assert_eq!(whole.obligations[..1], part.obligations[..]);
    }
    // The constraint stays although the other obligation shares nothing with it.
    assert_eq!(system.cone(&[1]).states, [0, 2]);
}
