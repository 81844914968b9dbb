//! The solver against the truth tables of random formulas.

use super::{Part, Solver};
use crate::logic::aig::{Aig, Lit, word};
use crate::prove::simulate::Random;

/// Whether some assignment of `count` variables satisfies all clauses.
fn satisfiable(count: usize, clauses: &[Vec<Lit>]) -> bool {
    let holds = |l: &Lit, bits: u32| (bits >> l.node() & 1 == 1) != l.inverted();
    (0..1u32 << count).any(|bits| clauses.iter().all(|c| c.iter().any(|l| holds(l, bits))))
}

fn random_clause(random: &mut Random, count: usize) -> Vec<Lit> {
    let length = 1 + random.next() % 3;
    (0..length).map(|_| Lit((random.next() % (2 * count as u64)) as u32)).collect()
}

#[test]
fn answers_as_enumeration_does() {
    let mut random = Random::new(7);
    for _ in 0..3000 {
        let count = 3 + (random.next() % 7) as usize;
        let mut solver = Solver::new();
        solver.reserve(count);
        let mut clauses = Vec::new();
        for _ in 0..4 {
            for _ in 0..random.next() % (2 * count as u64) {
                clauses.push(random_clause(&mut random, count));
                solver.add(&clauses[clauses.len() - 1]);
            }
            let assumptions = random_clause(&mut random, count);
            let extra = random.next().is_multiple_of(2).then(|| random_clause(&mut random, count));
            let answer = solver.solve(&assumptions, extra.as_deref(), None, u64::MAX);
            let with = |chosen: &[Lit]| {
                let mut all = clauses.clone();
                all.extend(extra.clone());
                all.extend(chosen.iter().map(|&l| vec![l]));
                all
            };
            let all = with(&assumptions);
            assert_eq!(answer, Some(satisfiable(count, &all)), "{all:?}");
            if answer == Some(true) {
                assert!(all.iter().all(|c| c.iter().any(|&l| solver.value(l) == Some(true))));
            } else {
                let core: Vec<Lit> = assumptions.iter().copied().filter(|&l| solver.failed(l)).collect();
                assert!(!satisfiable(count, &with(&core)));
            }
        }
        assert!(!solver.is_broken() || !satisfiable(count, &clauses));
    }
}

/// The value of a literal of a graph whose leaves are numbered from 1 on by the bits.
fn value(graph: &Aig, lit: Lit, bits: u32) -> bool {
    let mut words = vec![0; graph.len()];
    (1..=6).for_each(|leaf| words[leaf] = u64::from(bits >> (leaf - 1) & 1));
    graph.propagate(&mut words);
    word(&words, lit) & 1 == 1
}

#[test]
fn interpolants_lie_between_the_parts() {
    let mut random = Random::new(11);
    let mut refuted = 0;
    // Variables 0 to 3 are the first part's own, 4 to 7 are shared, 8 to 11 are the second part's own.
    let (own, shared, all) = (4, 8, 12);
    while refuted < 1500 {
        let mut solver = Solver::with_proof();
        solver.reserve(all);
        let mut parts: [Vec<Vec<Lit>>; 2] = [Vec::new(), Vec::new()];
        for _ in 0..24 + random.next() % 20 {
            let is_first = random.next().is_multiple_of(2);
            let shift = if is_first { 0 } else { 2 * own as u32 };
            let clause: Vec<Lit> =
                random_clause(&mut random, shared).into_iter().map(|lit| Lit(lit.0 + shift)).collect();
            solver.add_to(if is_first { Part::First } else { Part::Second }, &clause);
            parts[usize::from(!is_first)].push(clause);
        }
        let answer = solver.solve(&[], None, None, u64::MAX);
        let both: Vec<Vec<Lit>> = parts.concat();
        assert_eq!(answer, Some(satisfiable(all, &both)));
        if answer == Some(true) {
            continue;
        }
        refuted += 1;
        let mut graph = Aig::default();
        let leaves: Vec<Lit> = (0..6).map(|_| graph.leaf()).collect();
        let leaf = |variable: u32| {
            let at = variable as usize;
            (own..shared).contains(&at).then(|| leaves[at - own])
        };
        let between = solver
            .interpolant(&mut graph, &leaf, &|variable| (variable as usize) < own, usize::MAX)
            .expect("it is refuted");
        for bits in 0..1u32 << all {
            let holds = |clauses: &[Vec<Lit>]| {
                clauses.iter().all(|c| c.iter().any(|l| (bits >> l.node() & 1 == 1) != l.inverted()))
            };
            let inside = value(&graph, between, bits >> own);
            assert!(inside || !holds(&parts[0]), "the first part implies it");
            assert!(!inside || !holds(&parts[1]), "the second part excludes it");
        }
    }
}
