//! The game in terms against the game on values: random tables, random constraints, random runs.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rungbook::logic::system::{Input, Labelled, System};
use rungbook::logic::term::{Pool, Term};
use rungbook::table::automaton::encode::{Encoding, Sites, encode};
use rungbook::table::automaton::{Automaton, Site};

use super::automaton::{Case, Letters, Outcome, case, played, source};
use crate::support::cases;

/// Constraints as sets of letters, over one input and one output of two bits.
struct Alphabet<'a> {
    constraints: &'a [Letters],
    automaton: &'a Automaton,
    letters: [Term; 2],
    /// Whether it tells which rows exclude each other.
    precise: bool,
}

impl Alphabet<'_> {
    fn set(&self, site: Site, output: usize) -> u8 {
        self.constraints[self.automaton.leaves[site.leaf].row][output][usize::from(!site.first)] & 0b111
    }

    fn holds(&self, pool: &mut Pool, site: Site, output: usize) -> Term {
        let set = self.set(site, output);
        let letters = (0..3_u64).filter(|letter| set >> letter & 1 == 1);
        let terms: Vec<Term> = letters
            .map(|letter| {
                let letter = pool.constant(2, letter);
                pool.eq(self.letters[output], letter)
            })
            .collect();
        pool.any(terms)
    }
}

impl Sites for Alphabet<'_> {
    fn inputs(&mut self, pool: &mut Pool, site: Site) -> Term {
        self.holds(pool, site, 0)
    }

    fn outputs(&mut self, pool: &mut Pool, site: Site) -> Term {
        self.holds(pool, site, 1)
    }

    fn compatible(&mut self, one: Site, other: Site) -> bool {
        !self.precise || (0..2).all(|output| self.set(one, output) & self.set(other, output) != 0)
    }
}

/// The system of the game alone, and what to look at: covered, lost, ended.
fn system(automaton: &Automaton, constraints: &[Letters], precise: bool) -> (System, Encoding) {
    let mut pool = Pool::default();
    let letters = [pool.variable(2, "in"), pool.variable(2, "out")];
    let mut alphabet = Alphabet { constraints, automaton, letters, precise };
    let encoding = encode(automaton, &mut pool, &mut alphabet).expect("few holders");
    let input = |variable, name: &str| Input { variable, name: name.to_owned(), origin: None };
    let seen = |term, name: &str| Labelled { term, name: name.to_owned(), origin: None };
    let system = System {
        pool,
        inputs: vec![input(letters[0], "in"), input(letters[1], "out")],
        states: encoding.states.clone(),
        outputs: vec![seen(encoding.covered, "covered"), seen(encoding.lost, "lost"), seen(encoding.ended, "ended")],
        ..System::default()
    };
    (system, encoding)
}

/// What the game in terms says of each run. The table is encoded once: that is what takes the time.
fn encoded(automaton: &Automaton, constraints: &[Letters], runs: &[Vec<(u8, u8)>], precise: bool) -> Vec<Vec<Outcome>> {
    if automaton.may_be_empty {
        return runs.iter().map(|_| vec![Outcome::Ended]).collect();
    }
    let (system, _) = system(automaton, constraints, precise);
    runs.iter().map(|run| outcomes(&system, run)).collect()
}

fn outcomes(system: &System, run: &[(u8, u8)]) -> Vec<Outcome> {
    let inputs: Vec<Vec<u64>> = run.iter().map(|(a, b)| vec![u64::from(*a), u64::from(*b)]).collect();
    let mut out = Vec::new();
    for cycle in system.simulate(&[], &inputs) {
        let [covered, lost, ended] = [0, 1, 2].map(|index| cycle.outputs[index] == 1);
        let outcome = match (covered, lost, ended) {
            (false, ..) => Outcome::Uncovered,
            (true, true, _) => Outcome::Lost,
            (true, false, true) => Outcome::Ended,
            (true, false, false) => Outcome::Open,
        };
        let over = outcome != Outcome::Open;
        out.push(outcome);
        if over {
            break;
        }
    }
    out
}

fn agree((trees, constraints, runs): &Case) -> Result<(), TestCaseError> {
    let text = source(trees);
    let read = super::gtt(&text);
    prop_assert!(read.findings.is_empty(), "{}: {:?}", text, read.findings);
    let automaton = Automaton::build(&read.tables[0]).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let wanted: Vec<_> = runs.iter().map(|run| played(&automaton, constraints, run)).collect();
    for precise in [false, true] {
        let found = encoded(&automaton, constraints, runs, precise);
        prop_assert_eq!(&found, &wanted, "precise: {} {} {:?} {:?}", precise, text, constraints, runs);
    }
    Ok(())
}

#[test]
fn terms_and_tokens_play_the_same_game() {
    let config = Config { cases: cases(), failure_persistence: None, max_shrink_iters: 500, ..Config::default() };
    if let Err(error) = TestRunner::new(config).run(&case(12, 6), |case| agree(&case)) {
        panic!("{error}");
    }
}

/// The states of the game of one table.
fn states(text: &str, precise: bool) -> usize {
    let read = super::gtt(text);
    assert!(read.findings.is_empty(), "{:?}", read.findings);
    let automaton = Automaton::build(&read.tables[0]).expect("an automaton");
    let letters = vec![[[0b001, 0b001], [7, 7]], [[0b010, 0b010], [7, 7]], [[0b100, 0b100], [7, 7]]];
    let (system, _) = system(&automaton, &letters, precise);
    system.states.iter().map(|state| system.pool.width(state.variable) as usize).sum()
}

#[test]
fn memory_grows_with_the_logarithm_of_durations_where_rows_exclude_each_other() {
    let table = |high: usize| {
        format!(
            "table T {{ var input x : INT var output y : INT group {{ row [1,{high}] {{}} row [5,{high}] {{}} row 3 {{}} }} }}"
        )
    };
    let (small, large) = (states(&table(10), true), states(&table(10_000), true));
    assert!(large <= small + 2 * 10, "{small} bits for 10, {large} for 10,000");
    // An upper bound alone needs no more where they overlap.
    let open = |high: usize| {
        format!(
            "table T {{ var input x : INT var output y : INT group {{ row [1,{high}] {{}} row [0,{high}] {{}} row >= {high} {{}} }} }}"
        )
    };
    let (small, large) = (states(&open(10), false), states(&open(10_000), false));
    assert!(large <= small + 3 * 10, "{small} bits for 10, {large} for 10,000");
}
