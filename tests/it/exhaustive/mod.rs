//! The whole chain, from text to checked verdict, against exploration of everything that a block can do within its table:
//! random small blocks and tables, each verdict, and how long the run of a violation is.
//!
//! The oracle shares no code with the engines, nor with the translation to terms or the automaton: the table is played on
//! its words, the cells are calculated on values, and the block runs on the interpreter.

mod blocks;
mod explore;
mod random;
mod tables;
mod words;

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use rungbook::pipeline::Project;
use rungbook::pipeline::verify::{self, Verified};
use rungbook::prove::engine::Cancel;
use rungbook::prove::verdict::{Run, Verdict};

use self::blocks::Block;
use self::explore::{Explored, Step, Subject};
use self::random::Random;
use self::tables::Table;

/// More states are not looked at.
const STATES: usize = 400;
const TABLES: usize = 4;

/// What came of the pairs.
#[derive(Default)]
struct Count {
    verified: AtomicU64,
    violated: AtomicU64,
    undecided: AtomicU64,
    large: AtomicU64,
    states: AtomicU64,
}

fn add(count: &AtomicU64, more: u64) {
    count.fetch_add(more, Ordering::Relaxed);
}

/// A random block with some random tables: all that they mean, and the text.
struct Batch {
    block: Block,
    tables: Vec<Table>,
    text: String,
}

fn batch(seed: u64) -> Batch {
    let random = &mut Random::new(seed);
    let block = Block::random(random);
    let tables: Vec<Table> = (0..TABLES).map(|_| Table::random(random, &block)).collect();
    let texts = tables.iter().enumerate().map(|(index, table)| table.text(&format!("T{index}"), &block, false));
    let text = format!("(*\n{}*)\n{}", texts.collect::<Vec<_>>().join("\n"), block.text("B"));
    Batch { block, tables, text }
}

fn compare(seed: u64, count: &Count) {
    let Batch { block, tables, text } = batch(seed);
    let project = super::support::project(&[("b.st", &text)], "");
    assert_eq!(project.tables.len(), TABLES, "seed {seed}\n{text}");
    for (index, table) in tables.iter().enumerate() {
        let about = format!("seed {seed}, table T{index}\n{text}");
        one(&project, index, &block, table, count, &about);
    }
}

fn one(project: &Project, index: usize, block: &Block, table: &Table, count: &Count, about: &str) {
    let mut settings = super::support::settings("");
    settings.verify.options.timeout = Duration::from_secs(60);
    let verified = verify::verify(project, &settings, index, &Cancel::default(), &|_, _| ());
    let program = verified.program.clone().unwrap_or_else(|| panic!("{:?}: {about}", verified.verdict));
    assert_eq!(verified.internal, None, "{about}");
    let subject = Subject { program: &program, block, table };
    let Some(explored) = subject.explore(STATES) else { return add(&count.large, 1) };
    add(&count.states, explored.states as u64);
    match &verified.verdict {
        Verdict::Verified(_) => {
            assert_eq!(explored.shortest, None, "verified, but violated: {about}");
            add(&count.verified, 1);
        }
        Verdict::Violated(run) => {
            loses(&subject, &explored, &verified, run, about);
            add(&count.violated, 1);
        }
        Verdict::Bounded(cycles) => {
            let fits = explored.shortest.is_none_or(|shortest| shortest as u64 > *cycles);
            assert!(fits, "{cycles} cycles, but {explored:?}: {about}");
            add(&count.undecided, 1);
        }
        other => panic!("{other:?}: {about}"),
    }
}

/// The run loses in its last cycle, and not before.
fn loses(subject: &Subject<'_>, explored: &Explored, verified: &Verified, run: &Run, about: &str) {
    let shortest = explored.shortest.unwrap_or_else(|| panic!("violated, but conforms: {about}"));
    assert!(
        run.inputs.len() >= shortest,
        "a run of {} cycles, and the shortest has {shortest}: {about}",
        run.inputs.len()
    );
    let globals = |state: &explore::State| {
        let numbers = state.globals().iter().zip(&run.globals);
        numbers.clone().count() == run.globals.len() && numbers.clone().all(|(number, bits)| *number as u64 == *bits)
    };
    let mut state = subject.begin().into_iter().find(globals).unwrap_or_else(|| panic!("{run:?}: {about}"));
    for (cycle, inputs) in run.inputs.iter().enumerate() {
        let set: Vec<_> = verified.input_slots.iter().copied().zip(inputs.iter().copied()).collect();
        match subject.step(&state, &set) {
            Step::Open(next, _) if cycle + 1 < run.inputs.len() => state = *next,
            Step::Lost if cycle + 1 == run.inputs.len() => return,
            _ => break,
        }
    }
    panic!("{run:?} does not lose: {about}");
}

/// How many pairs: 200, or what `RUNGBOOK_CASES` says.
fn pairs() -> u64 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(200)
}

/// The seed to begin with, to go on where another run has ended.
fn first() -> u64 {
    std::env::var("RUNGBOOK_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(0)
}

#[test]
fn verdicts_are_those_of_exhaustive_exploration() {
    let (pairs, first) = (pairs(), first());
    let (count, next) = (Count::default(), AtomicU64::new(0));
    let batches = pairs.div_ceil(TABLES as u64);
    let work = || loop {
        let seed = next.fetch_add(1, Ordering::Relaxed);
        if seed >= batches {
            return;
        }
        compare(first + seed, &count);
    };
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let [verified, violated, undecided, large, states] =
        [&count.verified, &count.violated, &count.undecided, &count.large, &count.states]
            .map(|count| count.load(Ordering::Relaxed));
    println!(
        "{} pairs: {verified} verified, {violated} violated, {undecided} undecided, {large} too large; {states} states",
        batches * TABLES as u64
    );
    assert!(verified > pairs / 10 && violated > pairs / 10, "{verified} verified, {violated} violated");
    assert!(large < pairs / 3, "{large} are too large");
}
