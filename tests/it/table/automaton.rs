//! The automaton against the definition: random small tables, played on unrolled words and on tokens.
//!
//! The oracle knows nothing of tokens, edges or counts that saturate. It writes down every word of `D(T)` up to the length of
//! the run, each place with the way to it through the tree, and plays the game of the reference on this set.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rungbook::table::automaton::game::{Game, Judge, Standing};
use rungbook::table::automaton::{Automaton, Site};

use crate::support::cases;

/// How often something is repeated: at least, at most, or for ever.
#[derive(Clone, Copy, Debug)]
pub(super) enum Tau {
    Times(usize, Option<usize>),
    Omega,
}

#[derive(Clone, Debug)]
pub(super) enum Tree {
    Row(Tau, bool),
    Block(Tau, bool, Vec<Tree>),
}

/// A place of a word: which row, in which of its cycles, and the child and iteration numbers that lead there.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct At {
    path: Vec<usize>,
    row: usize,
    count: usize,
}

/// A word, cut off at the length of the run, its places by their numbers; whether it ends there.
type Word = (Vec<usize>, bool);
type Words = BTreeSet<Word>;

/// More words than this are not worth the time.
const MAX_WORDS: usize = 200;

struct TooMany;

/// Facts about rows and blocks by the way to them.
struct Facts {
    /// For each row: whether flagged, and the lower bound.
    rows: Vec<(bool, usize)>,
}

struct Unroller {
    length: usize,
    facts: Facts,
    /// Every place that occurs, and its number.
    places: Vec<At>,
    numbers: BTreeMap<At, usize>,
    /// For each block, by the way to it without iteration numbers: whether its body may be empty.
    hollow: BTreeMap<Vec<usize>, bool>,
    /// For each flagged block: the way to it without iteration numbers of its own, and its lower bound.
    flagged: Vec<(Vec<usize>, usize)>,
}

impl Unroller {
    fn new(length: usize) -> Self {
        Self {
            length,
            facts: Facts { rows: Vec::new() },
            places: Vec::new(),
            numbers: BTreeMap::new(),
            flagged: Vec::new(),
            hollow: BTreeMap::new(),
        }
    }

    fn number(&mut self, at: At) -> usize {
        let next = self.places.len();
        let number = *self.numbers.entry(at.clone()).or_insert(next);
        if number == next {
            self.places.push(at);
        }
        number
    }

    fn join(&self, left: &Words, right: &Words) -> Result<Words, TooMany> {
        let mut out = Words::new();
        for (a, ends) in left {
            if !ends {
                out.insert((a.clone(), false));
                continue;
            }
            for (b, ends) in right {
                let mut word = a.clone();
                word.extend(b);
                let whole = word.len() <= self.length;
                word.truncate(self.length);
                out.insert((word, *ends && whole));
            }
            if out.len() > MAX_WORDS {
                return Err(TooMany);
            }
        }
        Ok(out)
    }

    fn sequence(&mut self, trees: &[Tree], path: &[usize]) -> Result<Words, TooMany> {
        let mut out = Words::from([(Vec::new(), true)]);
        for (child, tree) in trees.iter().enumerate() {
            let mut here = path.to_vec();
            here.push(child);
            let words = match tree {
                Tree::Row(tau, flag) => self.row(*tau, *flag, &here),
                Tree::Block(tau, flag, children) => self.block(*tau, *flag, children, &here)?,
            };
            out = self.join(&out, &words)?;
        }
        Ok(out)
    }

    fn row(&mut self, tau: Tau, flag: bool, path: &[usize]) -> Words {
        let row = self.facts.rows.len();
        let (low, high) = match tau {
            Tau::Times(low, high) => (low, high),
            Tau::Omega => (usize::MAX, None),
        };
        self.facts.rows.push((flag, low));
        let places: Vec<usize> =
            (1..=self.length).map(|count| self.number(At { path: path.to_vec(), row, count })).collect();
        let word = |n: usize| places[..n].to_vec();
        let mut out = Words::new();
        if low != usize::MAX {
            out.extend((low..=high.unwrap_or(self.length).min(self.length)).map(|n| (word(n), true)));
        }
        if high.is_none_or(|high| high > self.length) {
            out.insert((word(self.length), false));
        }
        out
    }

    fn block(&mut self, tau: Tau, flag: bool, children: &[Tree], path: &[usize]) -> Result<Words, TooMany> {
        let (rows, flagged) = (self.facts.rows.len(), self.flagged.len());
        let iteration = |me: &mut Self, number: usize| {
            // The rows of a block have the same numbers in each of its iterations.
            me.facts.rows.truncate(rows);
            me.flagged.truncate(flagged);
            let mut here = path.to_vec();
            here.push(number);
            me.sequence(children, &here)
        };
        let mut powers = vec![Words::from([(Vec::new(), true)])];
        let mut empty = false;
        for number in 1..=self.length + 1 {
            let mut once = iteration(self, number)?;
            empty = once.remove(&(Vec::new(), true));
            let next = self.join(&powers[number - 1], &once)?;
            powers.push(next);
        }
        let most = self.length + 1;
        if powers[1].is_empty() {
            return Ok(Words::from([(Vec::new(), true)]));
        }
        self.hollow.insert(without_iterations(path), empty);
        let (low, high) = match tau {
            Tau::Times(low, high) => (if empty { 0 } else { low }, high),
            Tau::Omega => (usize::MAX, None),
        };
        if flag {
            self.flagged.push((path.to_vec(), low));
        }
        let high = high.unwrap_or(most).min(most);
        Ok(powers[low.min(most)..=high.max(low.min(most))].iter().flatten().cloned().collect())
    }
}

/// What the inputs and outputs of a row admit: a set of letters, for its first cycle and for later ones.
pub(super) type Letters = [[u8; 2]; 2];

struct Judged<'a> {
    constraints: &'a [Letters],
    letter: (u8, u8),
    automaton: &'a Automaton,
}

fn fits(constraints: &[Letters], row: usize, first: bool, output: usize, letter: u8) -> bool {
    constraints[row][output][usize::from(!first)] >> letter & 1 == 1
}

impl Judge for Judged<'_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        fits(self.constraints, self.automaton.leaves[site.leaf].row, site.first, 0, self.letter.0)
    }

    fn outputs_fit(&mut self, site: Site) -> bool {
        fits(self.constraints, self.automaton.leaves[site.leaf].row, site.first, 1, self.letter.1)
    }
}

#[derive(Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Open,
    Uncovered,
    Ended,
    Lost,
}

/// The game on the set of words, as the reference writes it.
fn oracle(words: &Words, unroller: &Unroller, constraints: &[Letters], run: &[(u8, u8)]) -> Vec<Outcome> {
    let mut left: Vec<&Word> = words.iter().collect();
    if left.iter().any(|(word, _)| word.is_empty()) {
        return vec![Outcome::Ended];
    }
    let mut out = Vec::new();
    for (cycle, letter) in run.iter().enumerate() {
        let fit = |at: &At, output: usize, letter: u8| fits(constraints, at.row, at.count == 1, output, letter);
        let place = |word: &[usize]| &unroller.places[word[cycle]];
        let mut alike: BTreeMap<&[usize], BTreeSet<&At>> = BTreeMap::new();
        left.retain(|(word, _)| fit(place(word), 0, letter.0));
        for (word, _) in &left {
            alike.entry(&word[..cycle]).or_default().insert(place(word));
        }
        left.retain(|(word, _)| {
            let rivals = alike.get(&word[..cycle]);
            !rivals.is_some_and(|rivals| forced_out(word, cycle, rivals, unroller))
        });
        if left.is_empty() {
            out.push(Outcome::Uncovered);
            return out;
        }
        left.retain(|(word, _)| fit(place(word), 1, letter.1));
        if left.is_empty() {
            out.push(Outcome::Lost);
            return out;
        }
        if left.iter().any(|(word, ends)| *ends && word.len() == cycle + 1) {
            out.push(Outcome::Ended);
            return out;
        }
        out.push(Outcome::Open);
    }
    out
}

/// Whether a progress flag takes the word out at this place: `rivals` are the places whose inputs fit, of words that begin alike.
fn forced_out(word: &[usize], cycle: usize, rivals: &BTreeSet<&At>, unroller: &Unroller) -> bool {
    let at = &unroller.places[word[cycle]];
    let (flag, low) = unroller.facts.rows[at.row];
    let previous = cycle.checked_sub(1).map(|cycle| &unroller.places[word[cycle]]);
    let behind = |rival: &&&At| rival.path > at.path && (at.count > 1 || may_skip(at, previous, rival, unroller));
    if flag && at.count > low && rivals.iter().any(|rival| behind(&rival)) {
        return true;
    }
    let Some(previous) = previous else { return false };
    unroller.flagged.iter().any(|(block, low)| {
        let depth = block.len();
        let inside =
            |path: &[usize]| path.len() > depth && without_iterations(&path[..depth]) == without_iterations(block);
        let same = inside(&at.path) && inside(&previous.path) && at.path[..depth] == previous.path[..depth];
        let again = same && at.path[depth] == previous.path[depth] + 1;
        let could_leave = again && previous.path[depth] >= *low;
        could_leave && rivals.iter().any(|rival| rival.path[..depth.min(rival.path.len())] != at.path[..depth])
    })
}

/// Whether leaving the row out before its first cycle leads to the rival: a block that begins here and that the rival is not in
/// must be able to do without any row.
fn may_skip(at: &At, previous: Option<&At>, rival: &At, unroller: &Unroller) -> bool {
    let parts = at.path.iter().zip(&rival.path).take_while(|(a, b)| a == b).count();
    let begins = |depth: usize| previous.is_none_or(|previous| !previous.path.starts_with(&at.path[..=depth]));
    let mut left = (1..at.path.len()).step_by(2).filter(|depth| *depth >= parts);
    left.all(|depth| !begins(depth) || unroller.hollow[&without_iterations(&at.path[..depth])])
}

/// The child numbers alone: every second number of a path is an iteration.
fn without_iterations(path: &[usize]) -> Vec<usize> {
    path.iter().step_by(2).copied().collect()
}

fn tau(longest: usize) -> impl Strategy<Value = Tau> {
    prop_oneof![
        4 => (0..longest, 0_usize..3).prop_map(|(low, more)| Tau::Times(low, Some(low + more))),
        2 => (0..longest).prop_map(|low| Tau::Times(low, None)),
        1 => Just(Tau::Omega),
    ]
}

fn flagged_tau(longest: usize) -> impl Strategy<Value = (Tau, bool)> {
    (tau(longest), any::<bool>()).prop_map(|(tau, flag)| (tau, flag && matches!(tau, Tau::Times(..))))
}

fn trees(longest: usize) -> impl Strategy<Value = Vec<Tree>> {
    let row = flagged_tau(longest).prop_map(|(tau, flag)| Tree::Row(tau, flag)).boxed();
    let tree = row.prop_recursive(2, 6, 3, move |inner| {
        (flagged_tau(longest), prop::collection::vec(inner, 1..4))
            .prop_map(|((tau, flag), children)| Tree::Block(tau, flag, children))
            .boxed()
    });
    prop::collection::vec(tree, 1..4)
}

fn rows(trees: &[Tree]) -> usize {
    trees.iter().map(|tree| if let Tree::Block(_, _, children) = tree { rows(children) } else { 1 }).sum()
}

/// The tree as a table in the language of geteta.
pub(super) fn source(trees: &[Tree]) -> String {
    fn write(trees: &[Tree], out: &mut String) {
        for tree in trees {
            let (tau, flag) = match tree {
                Tree::Row(tau, flag) | Tree::Block(tau, flag, _) => (tau, flag),
            };
            let tau = match tau {
                Tau::Times(low, None) => format!(">= {low}"),
                Tau::Times(low, Some(high)) => format!("[{low},{high}]"),
                Tau::Omega => "omega".to_owned(),
            };
            let tau = if *flag { format!("{tau} progress") } else { tau };
            match tree {
                Tree::Row(..) => out.push_str(&format!("row {tau} {{ }} ")),
                Tree::Block(_, _, children) => {
                    out.push_str(&format!("group {tau} {{ "));
                    write(children, out);
                    out.push_str("} ");
                }
            }
        }
    }
    let mut out = "table T { var input x : INT var output y : INT group { ".to_owned();
    write(trees, &mut out);
    out + "} }"
}

pub(super) fn played(automaton: &Automaton, constraints: &[Letters], run: &[(u8, u8)]) -> Vec<Outcome> {
    let mut game = Game::new(automaton);
    if *game.standing() == Standing::Ended {
        return vec![Outcome::Ended];
    }
    let mut out = Vec::new();
    for letter in run {
        let outcome = match game.play(&mut Judged { constraints, letter: *letter, automaton }) {
            Standing::Open => Outcome::Open,
            Standing::Uncovered => Outcome::Uncovered,
            Standing::Ended => Outcome::Ended,
            Standing::Lost { .. } => Outcome::Lost,
        };
        let over = outcome != Outcome::Open;
        out.push(outcome);
        if over {
            break;
        }
    }
    out
}

/// A run whose letters mostly fit, so that games go on.
fn letters() -> impl Strategy<Value = Letters> {
    let set = || prop_oneof![3 => Just(0b111_u8), 3 => 1_u8..8, 1 => 0_u8..8];
    let pair =
        move || (set(), set(), any::<bool>()).prop_map(|(first, rest, same)| [first, if same { first } else { rest }]);
    (pair(), pair()).prop_map(|(inputs, outputs)| [inputs, outputs])
}

/// A table, the constraints of its rows, and some runs.
pub(super) type Case = (Vec<Tree>, Vec<Letters>, Vec<Vec<(u8, u8)>>);

/// With runs of `length` cycles, and durations up to `longest` and a little more.
pub(super) fn case(length: usize, longest: usize) -> impl Strategy<Value = Case> {
    trees(longest).prop_flat_map(move |trees| {
        let count = rows(&trees);
        let run = prop::collection::vec((0_u8..3, 0_u8..3), length);
        (Just(trees), prop::collection::vec(letters(), count), prop::collection::vec(run, 4))
    })
}

fn agree(trees: &[Tree], constraints: &[Letters], runs: &[Vec<(u8, u8)>]) -> Result<bool, TestCaseError> {
    let text = source(trees);
    let read = super::gtt(&text);
    prop_assert!(read.findings.is_empty(), "{}: {:?}", text, read.findings);
    let automaton = Automaton::build(&read.tables[0]).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    for length in (3..=5).rev() {
        let mut unroller = Unroller::new(length);
        let Ok(words) = unroller.sequence(trees, &[]) else { continue };
        for run in runs {
            let run = &run[..length];
            let (wanted, found) = (oracle(&words, &unroller, constraints, run), played(&automaton, constraints, run));
            prop_assert_eq!(&found, &wanted, "{} {:?} {:?}", text, constraints, run);
        }
        return Ok(true);
    }
    Ok(false)
}

#[test]
fn tokens_and_words_play_the_same_game() {
    let config = Config { cases: cases(), failure_persistence: None, max_shrink_iters: 500, ..Config::default() };
    let tried = std::cell::Cell::new(0_u32);
    let result = TestRunner::new(config).run(&case(5, 3), |(trees, constraints, runs)| {
        tried.set(tried.get() + u32::from(agree(&trees, &constraints, &runs)?));
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    assert!(tried.get() > cases() / 2, "only {} of {} tables were small enough", tried.get(), cases());
}

/// How long 500 rows and 40 columns take; `cargo test -- --ignored --nocapture large` prints it.
#[test]
#[ignore = "measures"]
#[allow(clippy::print_stderr, reason = "a measurement")]
fn a_large_table_reads_and_unrolls() {
    let columns: Vec<String> = (0..40).map(|i| format!("{} v{i} : INT", if i < 20 { "in" } else { "out" })).collect();
    let mut text = format!("@gtt Large\n| # | {} | dur |\n|{}\n", columns.join(" | "), "---|".repeat(42));
    for row in 0..500 {
        let cells: Vec<String> = (0..40).map(|i| format!(">= {row}, <= {i} + 500")).collect();
        let duration = ["[1,10]", "-", "5", ">= 2 p"][row % 4];
        text += &format!("| {row} | {} | {duration} |\n", cells.join(" | "));
    }
    let start = std::time::Instant::now();
    let read = super::pipe(&text);
    let middle = start.elapsed();
    let automaton = Automaton::build(&read.tables[0]).expect("it has one");
    eprintln!("read {middle:?}, unrolled {:?}", start.elapsed() - middle);
    assert_eq!(automaton.leaves.len(), 500);
}
