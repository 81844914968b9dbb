//! Simplified systems run as the systems do, and their facts are invariants.

use proptest::prelude::*;
use rungbook::logic::simplify::simplify;
use rungbook::logic::system::{Input, Labelled, State, System};
use rungbook::logic::term::{Op, Term};

const INPUTS: usize = 2;
const STATES: usize = 5;
/// Bits of each variable: few, so that all states can be looked at.
const WIDTH: u32 = 2;

const OPS: [Op; 8] = [Op::And, Op::Or, Op::Add, Op::Sub, Op::Mul, Op::Xor, Op::Udiv, Op::Shl];

/// A system from numbers; two state variables in three begin with a constant.
fn system(steps: &[(usize, usize, usize)], roots: &[usize], initials: &[u64], constraint: &[u8]) -> System {
    let mut out = System::default();
    for index in 0..INPUTS {
        let (variable, name) = (out.pool.variable(WIDTH, "in"), format!("in {index}"));
        out.inputs.push(Input { variable, name, origin: None });
    }
    for (index, initial) in initials.iter().enumerate() {
        let (variable, name) = (out.pool.variable(WIDTH, "state"), format!("state {index}"));
        let before = out.states.last().map(|state| state.variable);
        let initial = match initial % 6 {
            0 => None,
            1 => before,
            value => Some(out.pool.constant(WIDTH, value / 4)),
        };
        out.states.push(State { variable, name, initial, next: variable, origin: None });
    }
    let inputs = out.inputs.iter().map(|input| input.variable);
    let mut terms: Vec<Term> = inputs.chain(out.states.iter().map(|state| state.variable)).collect();
    for (op, a, b) in steps {
        let (a, b) = (terms[a % terms.len()], terms[b % terms.len()]);
        let condition = out.pool.sign(a);
        let made = if op % 9 == 8 { out.pool.ite(condition, b, a) } else { out.pool.apply(OPS[op % 9], &[a, b]) };
        terms.push(made);
    }
    for index in 0..STATES {
        out.states[index].next = terms[roots[index] % terms.len()];
    }
    let labelled = |term| Labelled { term, name: String::new(), origin: None };
    let (left, right) = (terms[roots[STATES] % terms.len()], terms[roots[STATES + 1] % terms.len()]);
    let safe = out.pool.ule(left, right);
    out.obligations.push(labelled(safe));
    out.outputs = terms.iter().map(|term| labelled(*term)).collect();
    for (index, kind) in constraint.iter().enumerate() {
        let (a, b) = (terms[index % terms.len()], terms[(index * 3 + 1) % terms.len()]);
        let one = out.pool.constant(WIDTH, 1);
        let (equal, less) = (out.pool.eq(a, one), out.pool.ult(a, b));
        let (either, not) = (out.pool.or(equal, less), out.pool.not(less));
        let held = [equal, less, either, not][usize::from(kind % 4)];
        out.constraints.push(labelled(held));
    }
    out
}

fn cases() -> u32 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(1000)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]
    #[test]
    fn a_simplified_system_runs_as_the_system(
        steps in proptest::collection::vec((0_usize..100, 0_usize..100, 0_usize..100), 0..16),
        roots in proptest::collection::vec(0_usize..100, STATES + 2),
        initials in proptest::collection::vec(0_u64..12, STATES),
        constraint in proptest::collection::vec(0_u8..4, 0..3),
        free in proptest::collection::vec(0_u64..4, STATES),
        inputs in proptest::collection::vec(proptest::collection::vec(0_u64..4, INPUTS), 1..12),
    ) {
        let system = system(&steps, &roots, &initials, &constraint);
        let simple = simplify(&system);
        let small: Vec<u64> = simple.states.iter().map(|index| free[*index]).collect();
        let old = system.simulate(&simple.free(&small), &inputs);
        let new = simple.system.simulate(&small, &inputs);
        for (old, new) in old.iter().zip(&new) {
            for fact in &simple.facts {
                let holds = |bit: &rungbook::logic::certificate::StateBit| {
                    (old.states[bit.state as usize] >> bit.bit & 1 == 1) == bit.value
                };
                prop_assert!(fact.iter().any(holds));
            }
            prop_assert_eq!(&old.constraints, &new.constraints);
            if !old.constraints.iter().all(|holds| *holds) {
                break;
            }
            prop_assert_eq!(&old.obligations, &new.obligations);
            prop_assert_eq!(&old.outputs, &new.outputs);
            for (at, index) in simple.states.iter().enumerate() {
                prop_assert_eq!(old.states[*index], new.states[at]);
            }
        }
    }
}

#[test]
fn equal_and_constant_states_go() {
    let mut system = System::default();
    let zero = system.pool.constant(8, 0);
    let names = ["a", "b", "never", "limit"];
    let variables = names.map(|name| system.pool.variable(8, name));
    let [a, b, never, limit] = variables;
    let input = system.pool.variable(8, "in");
    system.inputs.push(Input { variable: input, name: "in".to_owned(), origin: None });
    let pool = &mut system.pool;
    let (left, right) = (pool.add(a, input), pool.add(b, input));
    let differ = pool.sub(a, b);
    let rows = [(Some(zero), left), (Some(zero), right), (Some(zero), differ), (None, limit)];
    for ((name, variable), (initial, next)) in names.into_iter().zip(variables).zip(rows) {
        system.states.push(State { variable, name: name.to_owned(), initial, next, origin: None });
    }
    let safe = system.pool.eq(never, zero);
    system.obligations.push(Labelled { term: safe, name: "never".to_owned(), origin: None });
    let simple = simplify(&system);
    assert_eq!(simple.states, [0, 3]);
    assert_eq!(simple.system.pool.value(simple.system.obligations[0].term), Some(1));
    assert_eq!(simple.facts.len(), 8 + 2 * 8);
}
