//! The engines against explicit-state exploration, on random models.

pub(crate) mod aiger;
mod explicit;
pub(crate) mod families;
pub(crate) mod minmax;
pub(crate) mod random;
pub(crate) mod words;

use rungbook::prove::engine::{Answer, Budget, Engine};
use rungbook::prove::ic3::Ic3;

fn cases(usual: u64) -> u64 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// Whether the engine's answer is the oracle's, with evidence that holds; an engine that gives up is let go.
pub(crate) fn compare(engine: &dyn Engine, seed: u64, latches: usize) -> bool {
    let model = random::model(seed, latches);
    let expected = explicit::shortest(&model);
    match engine.run(&model, 0, &Budget::seconds(20.0), &|_| ()) {
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
    for seed in 0..cases(300) {
        assert!(compare(&Ic3, seed, 8), "seed {seed}");
    }
}
