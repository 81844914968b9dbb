//! Both solvers against enumeration, and against each other's way to stop.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use proptest::prelude::*;

use super::bat::BatSat;
use super::cadi::Cadical;
use super::encode::Encoder;
use super::{Solver, Stop};
use crate::logic::aig::{Aig, Lit};

const VARIABLES: i32 = 8;

fn clauses() -> impl Strategy<Value = Vec<Vec<i32>>> {
    let lit = (1..=VARIABLES, any::<bool>()).prop_map(|(var, sign)| if sign { var } else { -var });
    proptest::collection::vec(proptest::collection::vec(lit, 1..4), 1..45)
}

fn holds(lit: i32, model: u32) -> bool {
    (model >> (lit.abs() - 1) & 1 == 1) == (lit > 0)
}

fn satisfiable(clauses: &[Vec<i32>], assumptions: &[i32]) -> bool {
    (0..1 << VARIABLES).any(|model| {
        assumptions.iter().all(|lit| holds(*lit, model))
            && clauses.iter().all(|clause| clause.iter().any(|lit| holds(*lit, model)))
    })
}

fn check(solver: &mut dyn Solver, clauses: &[Vec<i32>], queries: &[Vec<i32>]) -> Result<(), TestCaseError> {
    for _ in 0..VARIABLES {
        solver.new_var();
    }
    let mut added: Vec<Vec<i32>> = Vec::new();
    let share = clauses.len().div_ceil(queries.len());
    for (query, new) in queries.iter().zip(clauses.chunks(share)) {
        for clause in new {
            solver.add_clause(clause);
            added.push(clause.clone());
        }
        let answer = solver.solve(query);
        prop_assert_eq!(answer, Some(satisfiable(&added, query)));
        if answer == Some(true) {
            for clause in &added {
                prop_assert!(clause.iter().any(|lit| solver.value(*lit)));
            }
            prop_assert!(query.iter().all(|lit| solver.value(*lit) && !solver.value(-*lit)));
        } else {
            let core: Vec<i32> = query.iter().copied().filter(|lit| solver.failed(*lit)).collect();
            prop_assert!(!satisfiable(&added, &core));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]
    #[test]
    fn solvers_agree_with_enumeration(
        clauses in clauses(),
        queries in proptest::collection::vec(proptest::collection::btree_set(1..=VARIABLES, 0..4), 1..5),
        signs: u32,
    ) {
        let signed = |var: &i32| if signs >> var & 1 == 1 { *var } else { -var };
        let queries: Vec<Vec<i32>> = queries.iter().map(|query| query.iter().map(signed).collect()).collect();
        check(&mut Cadical::default(), &clauses, &queries)?;
        check(&mut BatSat::default(), &clauses, &queries)?;
    }

    #[test]
    fn encodings_have_the_models_of_the_graph(steps in proptest::collection::vec((0_usize..64, 0_usize..64, 0_usize..64, 0_u8..4), 1..20), model in 0_u32..16) {
        let mut aig = Aig::default();
        let mut lits: Vec<(Lit, bool)> = (0..4).map(|bit| (aig.leaf(), model >> bit & 1 == 1)).collect();
        lits.push((Lit::TRUE, true));
        let leaves: Vec<(Lit, bool)> = lits[..4].to_vec();
        for (a, b, c, kind) in steps {
            let pick = |n: usize| { let (lit, value) = lits[n / 2 % lits.len()]; (lit.invert_if(n % 2 == 1), value ^ (n % 2 == 1)) };
            let ((a, x), (b, y), (c, z)) = (pick(a), pick(b), pick(c));
            lits.push(match kind {
                0 => (aig.and(a, b), x && y),
                1 => (aig.or(a, b), x || y),
                2 => (aig.xor(a, b), x ^ y),
                _ => (aig.ite(a, b, c), if x { y } else { z }),
            });
        }
        for solver in [&mut Cadical::default() as &mut dyn Solver, &mut BatSat::default()] {
            let mut encoder = Encoder::default();
            let all: Vec<i32> = lits.iter().map(|(lit, _)| encoder.encode(&aig, *lit, solver)).collect();
            let given: Vec<i32> = leaves.iter().map(|(lit, value)| {
                let var = encoder.encode(&aig, *lit, solver);
                if *value { var } else { -var }
            }).collect();
            prop_assert_eq!(solver.solve(&given), Some(true));
            for (var, (_, value)) in all.iter().zip(&lits) {
                prop_assert_eq!(solver.value(*var), *value);
            }
        }
    }
}

/// So many pigeons in one hole less: hard for resolution.
fn pigeons(solver: &mut dyn Solver, count: usize) {
    let at: Vec<Vec<i32>> = (0..count).map(|_| (1..count).map(|_| solver.new_var()).collect()).collect();
    for pigeon in &at {
        solver.add_clause(pigeon);
    }
    for (first, second) in (0..count).flat_map(|first| (0..first).map(move |second| (first, second))) {
        for (one, other) in at[first].iter().zip(&at[second]) {
            solver.add_clause(&[-one, -other]);
        }
    }
}

#[test]
fn a_deadline_ends_a_hopeless_search() {
    for solver in [&mut Cadical::default() as &mut dyn Solver, &mut BatSat::default()] {
        pigeons(solver, 14);
        let start = Instant::now();
        solver.set_stop(Stop::at(start + Duration::from_millis(200)));
        assert_eq!(solver.solve(&[]), None);
        assert!(start.elapsed() < Duration::from_secs(3));
        let flag = Arc::new(AtomicBool::new(true));
        solver.set_stop(Stop::default().or_flag(flag));
        assert_eq!(solver.solve(&[]), None);
    }
}

#[test]
fn a_limit_of_conflicts_ends_one_call_only() {
    for solver in [&mut Cadical::default() as &mut dyn Solver, &mut BatSat::default()] {
        pigeons(solver, 7);
        solver.set_conflicts(Some(3));
        assert_eq!(solver.solve(&[]), None);
        solver.set_conflicts(None);
        assert_eq!(solver.solve(&[]), Some(false));
    }
}

#[test]
fn what_was_not_asked_about_has_a_value_and_its_complement_the_other() {
    let mut aig = Aig::default();
    let (asked, other) = (aig.leaf(), aig.leaf());
    let (mut solver, mut encoder) = (Cadical::default(), Encoder::default());
    let query = encoder.encode(&aig, !asked, &mut solver);
    assert_eq!(solver.solve(&[query]), Some(true));
    let values = [asked, !asked, other, !other, Lit::FALSE, Lit::TRUE].map(|lit| encoder.value(lit, &solver));
    assert_eq!(values, [false, true, false, true, false, true]);
}
