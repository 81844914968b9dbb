//! What a transition system looks like: what is a state, what is constant, what must hold.

use std::fmt::Write as _;

use rungbook::machine::elaborate::Options as ElaborateOptions;
use rungbook::machine::translate::{Options, Translated, translate};
use rungbook::semantics::expr::Fault;

fn translated(text: &str) -> Translated {
    let program = crate::elaborate::with(text, "B", &ElaborateOptions::default()).1.expect("everything is modelled");
    translate(&program, &Options::default()).expect("everything is translated")
}

fn states(system: &Translated) -> Vec<&str> {
    system.system.states.iter().map(|state| state.name.rsplit('.').next().unwrap_or_default()).collect()
}

#[test]
fn what_never_changes_is_no_state() {
    let system = translated(
        "FUNCTION_BLOCK B VAR_INPUT x : BOOL; END_VAR VAR_OUTPUT n : INT; m : INT; END_VAR\n\
         VAR idle : INT; frozen : INT := 4; t : INT; END_VAR\n\
         idle := 0; IF idle > 0 THEN frozen := 5; END_IF t := n + frozen; IF x THEN n := t; END_IF m := t * 2; END_FUNCTION_BLOCK",
    );
    assert_eq!(states(&system), ["n"]);
    assert!(system.faults.is_empty());
    assert!(system.system.constraints.is_empty());
}

#[test]
fn a_shift_register_is_found_in_a_few_rounds() {
    let system = translated(
        "FUNCTION_BLOCK B VAR_INPUT x : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR r : ARRAY[0..40] OF BOOL; i : INT; END_VAR\n\
         q := r[40]; FOR i := 40 TO 1 BY -1 DO r[i] := r[i - 1]; END_FOR r[0] := x; END_FUNCTION_BLOCK",
    );
    assert_eq!(system.system.states.len(), 41, "{:?}", states(&system));
    assert!(system.rounds < 10, "{}", system.rounds);
}

#[test]
fn each_site_of_a_fault_is_one_obligation_however_often_it_is_unrolled() {
    let system = translated(
        "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR VAR_OUTPUT n : INT; END_VAR VAR i : INT; a : ARRAY[0..3] OF INT; END_VAR\n\
         FOR i := 0 TO 3 DO n := n + a[x + i]; END_FOR n := n / x; END_FUNCTION_BLOCK",
    );
    let faults: Vec<Fault> = system.faults.iter().map(|(fault, _)| *fault).collect();
    assert_eq!(faults, [Fault::IndexOutOfBounds, Fault::DivisionByZero]);
    assert!(system.faults.iter().all(|(_, place)| place.is_some()));
    assert_eq!(system.system.obligations.len(), 2);
    assert_eq!(system.system.constraints.len(), 1, "no cycle after a fault");
}

#[test]
fn a_loop_that_may_turn_too_often_is_an_obligation() {
    let text = |limit: &str| {
        format!(
            "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR VAR_OUTPUT n : INT; END_VAR\n\
             n := 0; WHILE n < {limit} DO n := n + 1; END_WHILE END_FUNCTION_BLOCK"
        )
    };
    assert!(translated(&text("20")).faults.is_empty());
    let faults: Vec<Fault> = translated(&text("x")).faults.iter().map(|(fault, _)| *fault).collect();
    assert_eq!(faults, [Fault::LoopLimit]);
}

/// A block of many branches, one behind the other and within each other.
fn branches(count: u32) -> Translated {
    let mut body = String::new();
    for number in 0..count {
        let _ = writeln!(
            body,
            "IF x = {number} THEN n := n + {number}; IF n > 10 THEN RETURN; END_IF m[{}] := n; ELSE n := n - 1; END_IF",
            number % 8
        );
    }
    translated(&format!(
        "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR VAR_OUTPUT n : INT; END_VAR VAR m : ARRAY[0..7] OF INT; END_VAR\n\
         {body} END_FUNCTION_BLOCK"
    ))
}

#[test]
fn terms_grow_with_the_text_and_not_with_its_paths() {
    let (small, large) = (branches(100), branches(400));
    let (few, many) = (small.system.pool.len(), large.system.pool.len());
    assert!(many < few * 6, "{few} terms for 100 branches, {many} for 400");
}
