//! The engines against explicit-state exploration, on random models; and on families of systems, with their proofs
//! checked by another solver.

mod broken;
pub(crate) mod check;
mod covered;
mod explicit;
pub(crate) mod families;
pub(crate) mod minmax;
mod mutants;
pub(crate) mod random;
pub(crate) mod words;

use minmax::minmax;
use rungbook::logic::read::aiger;
use rungbook::logic::write::{Names, binary};
use rungbook::prove::bmc::Bmc;
use rungbook::prove::engine::{Answer, Budget, Engine, Hints};
use rungbook::prove::ic3::Ic3;
use rungbook::prove::induction::Induction;
use rungbook::prove::interpolation::Interpolation;
use rungbook::prove::mine::Mine;
use rungbook::prove::portfolio::{self, Options, Portfolio};
use words::Builder;

fn cases(usual: u64) -> u64 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// Whether the engine's answer is the oracle's, with evidence that holds; an engine that gives up is let go.
pub(crate) fn compare(engine: &dyn Engine, seed: u64, latches: usize) -> bool {
    compare_within(engine, seed, latches, &Budget::seconds(20.0))
}

fn compare_within(engine: &dyn Engine, seed: u64, latches: usize, budget: &Budget) -> bool {
    let model = random::model(seed, latches);
    let expected = explicit::shortest(&model);
    match engine.run(&model, 0, budget, &|_| ()) {
        Answer::Proved(proof) => {
            assert_eq!(expected, None, "seed {seed}: proved, but violated");
            explicit::check_proof(&model, &proof);
            true
        }
        Answer::Violated(trace) => {
            let shortest = expected.unwrap_or_else(|| panic!("seed {seed}: violated, but safe"));
            assert!(trace.inputs.len() >= shortest);
            explicit::check_trace(&model, &trace);
            true
        }
        Answer::Bounded { depth, .. } => {
            assert!(expected.is_none_or(|n| n > depth), "seed {seed}: {depth} cycles, but {expected:?}");
            false
        }
        Answer::GaveUp(_) => false,
    }
}

#[test]
fn ic3_agrees() {
    for seed in 0..cases(500) {
        assert!(compare(&Ic3, seed, 8), "seed {seed}");
    }
}

#[test]
fn bounded_checking_agrees() {
    let budget = || Budget::seconds(0.05);
    for seed in 0..cases(60) {
        compare_within(&Bmc, seed, 4, &budget());
    }
}

#[test]
fn induction_agrees() {
    for seed in 0..cases(200) {
        assert!(compare(&Induction, seed, 4), "seed {seed}");
    }
}

#[test]
fn interpolation_agrees() {
    for seed in 0..cases(500) {
        assert!(compare(&Interpolation, seed, 8), "seed {seed}");
    }
}

#[test]
fn mining_agrees() {
    let decided = (0..cases(300)).filter(|&seed| compare(&Mine::default(), seed, 8)).count();
    assert!(decided > 0);
}

#[test]
fn the_portfolio_agrees() {
    for seed in 0..cases(300) {
        assert!(compare(&Portfolio::default(), seed, 8), "seed {seed}");
    }
}

/// The portfolio's answer on a system of a family, with the words known.
fn decide(system: &Builder, threads: usize) -> Answer {
    let options = Options { threads, hints: Hints { words: system.words.clone() } };
    portfolio::decide(&system.model, 0, &options, &Budget::seconds(60.0), &|_| ()).answer
}

#[test]
fn families_are_decided_with_evidence() {
    let safe = [
        families::counter(8, 20, 100),
        families::timer(16, 100, 4),
        families::queue(3),
        families::arbiter(6),
        families::extremes(8),
        minmax(6, false),
    ];
    for (index, system) in safe.iter().enumerate() {
        match decide(system, 1) {
            Answer::Proved(proof) => check::check_proof(&system.model, &proof),
            other => panic!("system {index}: {other:?}"),
        }
    }
    match decide(&families::counter(8, 30, 30), 2) {
        Answer::Violated(trace) => assert_eq!(trace.inputs.len(), 31),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_portfolio_finds_shortest_runs() {
    let mut violated = 0;
    for seed in 0..cases(200) {
        let model = random::model(seed, 8);
        let Some(shortest) = explicit::shortest(&model) else { continue };
        match portfolio::decide(&model, 0, &Options::default(), &Budget::seconds(20.0), &|_| ()).answer {
            Answer::Violated(trace) => assert_eq!(trace.inputs.len(), shortest, "seed {seed}"),
            other => panic!("seed {seed}: {other:?}"),
        }
        violated += 1;
    }
    assert!(violated > 20, "{violated}");
}

#[test]
fn aiger_files_say_the_same() {
    for seed in 0..cases(200) {
        let model = random::model(seed, 6);
        let (again, _) = aiger(&binary(&model.folded(), &Names::default())).expect("a file");
        let shortest = explicit::shortest(&model);
        assert_eq!(shortest, explicit::shortest(&again), "seed {seed}");
        // Where first values are chosen in a cycle of their own, it comes one cycle later.
        let begun = model.with_first_values();
        assert!(begun.latches.iter().all(|latch| latch.initial.is_some()));
        let late = usize::from(begun.latches.len() > model.latches.len());
        assert_eq!(shortest.map(|cycles| cycles + late), explicit::shortest(&begun), "seed {seed}");
        // Without that cycle it is as long as before. A model that has a latch like that of its own begins later still.
        let again = begun.without_first_cycle();
        assert!(again.latches.len() <= model.latches.len());
        let found = explicit::shortest(&again);
        assert_eq!(shortest.is_some(), found.is_some(), "seed {seed}");
        assert!(found <= shortest, "seed {seed}: {shortest:?}, {found:?}");
    }
}

/// Engines that are ahead of the plan change nothing.
#[test]
fn one_thread_and_two_give_the_same_evidence() {
    for system in [minmax(5, false), families::timer(16, 100, 4), families::counter(10, 300, 301)] {
        let (once, again) = (decide(&system, 1), decide(&system, 2));
        assert!(once.is_final());
        assert_eq!(once, again);
    }
    for seed in 0..cases(300) {
        let model = random::model(seed, 8);
        let outcome = |threads| {
            let options = Options { threads, hints: Hints::default() };
            portfolio::decide(&model, 0, &options, &Budget::seconds(60.0), &|_| ())
        };
        assert_eq!(outcome(1), outcome(2), "seed {seed}");
    }
}

#[test]
fn a_hopeless_model_ends_in_time() {
    let system = families::product(14);
    for threads in [1, 2] {
        let start = std::time::Instant::now();
        let options = Options { threads, hints: Hints::default() };
        let outcome = portfolio::decide(&system.model, 0, &options, &Budget::seconds(2.0), &|_| ());
        assert!(matches!(outcome.answer, Answer::Bounded { .. } | Answer::GaveUp(_)), "{outcome:?}");
        assert!(start.elapsed().as_secs_f64() < 3.5, "{:?}", start.elapsed());
    }
}
