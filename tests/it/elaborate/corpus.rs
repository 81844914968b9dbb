//! Real trees: how many units elaborate, and why the others do not.
//!
//! Ignored unless asked for: `RUNGBOOK_CORPORA=DIR cargo test --test it elaborate::corpus -- --ignored --nocapture` reads every
//! folder of `DIR`; `RUNGBOOK_CORPUS=NAME` takes one of them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use rungbook::library::ItemKind;
use rungbook::machine::elaborate::{Options, elaborate};
use rungbook::machine::interpret::Interpreter;
use rungbook::source::Disk;

use crate::support::settings;

fn trees() -> Vec<PathBuf> {
    let root = std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names a folder of trees");
    let only = std::env::var("RUNGBOOK_CORPUS").ok();
    let mut trees: Vec<PathBuf> =
        std::fs::read_dir(root).expect("a folder").flatten().map(|entry| entry.path()).collect();
    trees.retain(|tree| only.as_ref().is_none_or(|only| tree.ends_with(only)));
    trees.sort();
    trees
}

#[test]
#[ignore = "needs RUNGBOOK_CORPORA, a folder of source trees"]
fn units_of_real_trees() {
    let verbose = std::env::var("RUNGBOOK_VERBOSE").is_ok();
    for tree in trees() {
        let fs = Disk::new(&tree).expect("a folder");
        let project = rungbook::pipeline::read(&fs, "tree", &settings(""), &|_| {});
        let kinds = [ItemKind::Function, ItemKind::FunctionBlock, ItemKind::Program];
        let mut done: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        let mut reasons: BTreeMap<&str, (usize, BTreeMap<String, usize>)> = BTreeMap::new();
        let mut ran = 0;
        for (id, item) in project.catalogue.iter().filter(|(_, item)| kinds.contains(&item.kind)) {
            let entry = done.entry(item.kind.key()).or_default();
            entry.1 += 1;
            match elaborate(&project.catalogue, &project.names, id, &Options::default()) {
                Ok(program) => {
                    entry.0 += 1;
                    // A fault is no panic: the inputs are what they are at the start.
                    let mut run = Interpreter::new(&program);
                    ran += usize::from(run.cycle().is_ok());
                }
                Err(errors) => {
                    let mut seen: Vec<&str> = errors.iter().map(|error| error.construct).collect();
                    seen.sort_unstable();
                    seen.dedup();
                    seen.iter().for_each(|construct| reasons.entry(construct).or_default().0 += 1);
                    for error in &errors {
                        let place = error.place.map_or_else(String::new, |place| {
                            let at = project.files.line_column(place);
                            format!(" [{}:{}]", project.files.get(place.file).path, at.line)
                        });
                        let message = if verbose { format!("{}{place}", error.message) } else { error.message.clone() };
                        *reasons.entry(error.construct).or_default().1.entry(message).or_default() += 1;
                    }
                }
            }
        }
        println!("{}: {done:?}, {ran} run a cycle", tree.file_name().expect("a name").to_string_lossy());
        let mut reasons: Vec<_> = reasons.into_iter().collect();
        reasons.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
        for (construct, (count, messages)) in reasons {
            println!("  {count:4}  {construct}");
            let mut messages: Vec<_> = messages.into_iter().collect();
            messages.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
            messages.iter().take(12).for_each(|(message, count)| println!("          {count:4} {message}"));
        }
    }
}
