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
use rungbook::prove::verdict::{Loss, Run, Verdict};

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
    kept: AtomicU64,
    endless: AtomicU64,
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
    /// Each with whether strict conformance is asked for.
    tables: Vec<(Table, bool)>,
    text: String,
}

fn batch(seed: u64) -> Batch {
    let random = &mut Random::new(seed);
    let block = Block::random(random);
    let mut table = || {
        let strict = random.once_in(2);
        (Table::random(random, &block, strict), strict)
    };
    let tables: Vec<(Table, bool)> = (0..TABLES).map(|_| table()).collect();
    let named = tables.iter().enumerate();
    let texts = named.map(|(index, (table, strict))| table.text(&format!("T{index}"), &block, *strict));
    let text = format!("(*\n{}*)\n{}", texts.collect::<Vec<_>>().join("\n"), block.text("B"));
    Batch { block, tables, text }
}

fn compare(seed: u64, count: &Count) {
    let Batch { block, tables, text } = batch(seed);
    let project = super::support::project(&[("b.st", &text)], "");
    assert_eq!(project.tables.len(), TABLES, "seed {seed}\n{text}");
    for (index, (table, strict)) in tables.iter().enumerate() {
        let about = format!("seed {seed}, table T{index}\n{text}");
        one(&project, index, &block, (table, *strict), count, &about);
    }
}

fn one(project: &Project, index: usize, block: &Block, (table, strict): (&Table, bool), count: &Count, about: &str) {
    let mut settings = super::support::settings("");
    settings.verify.options.timeout = Duration::from_secs(60);
    // What the proof covered is not compared here.
    settings.verify.coverage = false;
    let verified = verify::verify(project, &settings, index, &Cancel::default(), &|_, _| ());
    if strict && !table.tree.ends() {
        assert!(matches!(verified.verdict, Verdict::Unusable(_)), "{:?}: {about}", verified.verdict);
        return add(&count.endless, 1);
    }
    let program = verified.program.clone().unwrap_or_else(|| panic!("{:?}: {about}", verified.verdict));
    assert_eq!(verified.internal, None, "{about}");
    let subject = Subject { program: &program, block, table };
    let Some(explored) = subject.explore(STATES) else { return add(&count.large, 1) };
    add(&count.states, explored.states as u64);
    match &verified.verdict {
        Verdict::Verified(_) => {
            assert_eq!(explored.shortest, None, "verified, but violated: {about}");
            assert!(!(strict && explored.kept), "verified, but kept in the table: {about}");
            add(&count.verified, 1);
        }
        Verdict::Violated(run) => match run.loss {
            Loss::NeverEnds(from) => {
                assert!(strict && (explored.kept || explored.shortest.is_some()), "left in the end: {about}");
                goes_on(&subject, &verified, run, from, about);
                add(&count.kept, 1);
            }
            _ => {
                loses(&subject, &explored, &verified, run, about);
                add(&count.violated, 1);
            }
        },
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
    let mut state = beginning(subject, run, about);
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

/// The first state with the run's global variables.
fn beginning(subject: &Subject<'_>, run: &Run, about: &str) -> explore::State {
    let globals = |state: &explore::State| state.globals().iter().map(|number| *number as u64).eq(run.globals.clone());
    subject.begin().into_iter().find(globals).unwrap_or_else(|| panic!("{run:?}: {about}"))
}

/// The run can be repeated from the cycle `from` on until nothing new comes, and the environment is fair in what is repeated.
fn goes_on(subject: &Subject<'_>, verified: &Verified, run: &Run, from: usize, about: &str) {
    let mut state = beginning(subject, run, about);
    let mut go = |inputs: &[u64]| {
        let set: Vec<_> = verified.input_slots.iter().copied().zip(inputs.iter().copied()).collect();
        let Step::Open(next, fair) = subject.step(&state, &set) else { panic!("{run:?} ends: {about}") };
        state = *next;
        (subject.key(&state), fair)
    };
    run.inputs[..from].iter().for_each(|inputs| drop(go(inputs)));
    let mut rounds = Vec::new();
    for _ in 0..10_000 {
        let mut fair = 0;
        let mut key = None;
        for inputs in &run.inputs[from..] {
            let (after, more) = go(inputs);
            (key, fair) = (Some(after), fair | more);
        }
        let seen = rounds.iter().position(|(known, _)| *known == key);
        rounds.push((key, fair));
        if let Some(at) = seen {
            let fair = rounds[at + 1..].iter().fold(0, |all, (_, fair)| all | fair);
            assert_eq!(fair, subject.table.tree.units(), "{run:?} is not fair: {about}");
            return;
        }
    }
    panic!("{run:?} is not repeated: {about}");
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
    let [verified, violated, kept, endless, undecided, large, states] =
        [&count.verified, &count.violated, &count.kept, &count.endless, &count.undecided, &count.large, &count.states]
            .map(|count| count.load(Ordering::Relaxed));
    println!(
        "{} pairs: {verified} verified, {violated} violated, {kept} kept for ever, {endless} without an end, {undecided} undecided, {large} too large; {states} states",
        batches * TABLES as u64
    );
    assert!(verified > pairs / 10 && violated > pairs / 10, "{verified} verified, {violated} violated");
    assert!(kept > pairs / 100, "{kept} are kept for ever");
    assert!(large < pairs / 3, "{large} are too large");
}
