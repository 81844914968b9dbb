//! The solver against the truth tables of random formulas.

use super::Solver;
use crate::logic::aig::Lit;
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
