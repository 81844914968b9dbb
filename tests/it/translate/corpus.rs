//! Real trees: what is elaborated is translated, and agrees with the interpreter on random inputs.
//!
//! Ignored unless asked for: `RUNGBOOK_CORPORA=DIR cargo test --test it translate::corpus -- --ignored --nocapture` reads every
//! folder of `DIR`; `RUNGBOOK_CORPUS=NAME` takes one of them.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use proptest::test_runner::TestCaseError;
use rungbook::library::ItemKind;
use rungbook::machine::elaborate::{Options as ElaborateOptions, elaborate};
use rungbook::machine::translate::{Options, translate};
use rungbook::source::Disk;

use super::agree::Agreement;
use super::choices::{Choices, stream};
use crate::support::settings;

#[derive(Default)]
struct Tally {
    units: usize,
    elaborated: usize,
    translated: usize,
    reasons: BTreeMap<String, usize>,
    terms: usize,
    time: Duration,
    cycles: u64,
    faults: u64,
}

#[test]
#[ignore = "needs RUNGBOOK_CORPORA, a folder of source trees"]
fn units_of_real_trees_are_translated() {
    let root = std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names a folder of trees");
    let only = std::env::var("RUNGBOOK_CORPUS").ok();
    let mut trees: Vec<_> = std::fs::read_dir(root).expect("a folder").flatten().map(|entry| entry.path()).collect();
    trees.retain(|tree| only.as_ref().is_none_or(|only| tree.ends_with(only)));
    trees.sort();
    for tree in trees {
        let project = rungbook::pipeline::read(&Disk::new(&tree).expect("a folder"), "tree", &settings(""), &|_| {});
        let mut tally = Tally::default();
        let kinds = [ItemKind::Function, ItemKind::FunctionBlock, ItemKind::Program];
        for (id, item) in project.catalogue.iter().filter(|(_, item)| kinds.contains(&item.kind)) {
            tally.units += 1;
            let Ok(program) = elaborate(&project.catalogue, &project.names, id, &ElaborateOptions::default()) else {
                continue;
            };
            tally.elaborated += 1;
            let start = Instant::now();
            match translate(&program, &Options::default()) {
                Ok(translated) => {
                    let time = start.elapsed();
                    if time > Duration::from_secs(1) {
                        let (terms, rounds) = (translated.system.pool.len(), translated.rounds);
                        println!("  {}: {time:?}, {terms} terms, {rounds} rounds", item.name);
                    }
                    tally.time += time;
                    tally.translated += 1;
                    tally.terms += translated.system.pool.len();
                    let stream = stream(u64::from(id.0), 4_000);
                    let agreement =
                        Agreement { program: &program, translated: &translated, loop_limit: 1_000, cycles: 10 };
                    match agreement.check(&mut Choices::new(&stream)) {
                        Ok(done) => {
                            tally.cycles += done.0;
                            tally.faults += done.1;
                        }
                        Err(TestCaseError::Fail(why)) => {
                            let why: String = why.message().chars().take(300).collect();
                            println!("  {} DIFFERS: {why}", item.name);
                            *tally.reasons.entry("DIFFERS".to_owned()).or_default() += 1;
                        }
                        Err(TestCaseError::Reject(why)) => println!("  {}: {why}", item.name),
                    }
                }
                Err(error) => {
                    tally.time += start.elapsed();
                    *tally.reasons.entry(error.what).or_default() += 1;
                }
            }
        }
        let name = tree.file_name().expect("a name").to_string_lossy().into_owned();
        let Tally { units, elaborated, translated, terms, time, cycles, faults, .. } = tally;
        println!("{name}: {units} units, {elaborated} elaborated, {translated} translated in {time:?}: {terms} terms");
        println!("  {cycles} cycles compared, {faults} runs ended in a fault");
        let mut reasons: Vec<_> = tally.reasons.into_iter().collect();
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        reasons.iter().for_each(|(reason, count)| println!("  {count:4}  {reason}"));
        assert!(reasons.iter().all(|(reason, _)| reason != "DIFFERS"), "{name}");
    }
}
