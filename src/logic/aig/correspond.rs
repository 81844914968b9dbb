//! Latches that are always equal, opposite or constant: van Eijk, *Sequential Equivalence Checking without State Space
//! Traversal*, DATE 1998, for latches alone, so that what is found is an invariant in clauses over latches.
//!
//! Random runs propose classes. Then, with each latch replaced by the first of its class, the next values in each class are
//! shown to be equal again by hashing and SAT; a counterexample splits classes, and all is shown again. Latches without a
//! first value take no part.

use super::reduce::{LatchClause, Reduced, cone, identity, rebuild, substituted, through};
use super::{Gate, Lit, Model, Random, word};
use crate::logic::hash::FastMap;
use crate::logic::sat::cadi::Cadical;
use crate::logic::sat::encode::Encoder;
use crate::logic::sat::{Solver, Stop};

/// Cycles of 64 random runs.
const CYCLES: usize = 64;
/// Conflicts for one query; a pair that takes more is split.
const CONFLICTS: u32 = 2000;

/// For each latch the class that it is in, by the index of its first member; `None` where it takes no part. The class of
/// the constant, when there is one, has no index of a latch, but [`CONSTANT`].
type Classes = Vec<Option<usize>>;

const CONSTANT: usize = usize::MAX;

/// The model with one latch of each class. Where `stop` comes first, the model itself.
#[must_use]
pub fn correspond(model: &Model, stop: &Stop) -> Reduced {
    let mut classes = propose(model);
    while classes.iter().enumerate().any(|(index, class)| class.is_some_and(|class| class != index)) {
        match refine(model, &classes, stop) {
            None => return Reduced::of(model.clone()),
            Some(finer) if finer == classes => return merged(model, &classes),
            Some(finer) => classes = finer,
        }
    }
    Reduced::of(model.clone())
}

fn merged(model: &Model, classes: &Classes) -> Reduced {
    let mut facts: Vec<LatchClause> = Vec::new();
    for (index, class) in classes.iter().enumerate().filter(|(index, class)| class.is_some_and(|own| own != *index)) {
        let (own, first) = (initial(model, index), class.unwrap_or(CONSTANT));
        if first == CONSTANT {
            facts.push(vec![(index, own)]);
        } else {
            let other = initial(model, first);
            facts.push(vec![(index, own), (first, !other)]);
            facts.push(vec![(index, !own), (first, other)]);
        }
    }
    rebuild(model, &substitution(model, classes), facts).then(cone)
}

/// The first value of a latch that takes part.
fn initial(model: &Model, latch: usize) -> bool {
    model.latches[latch].initial.unwrap_or_default()
}

/// For each node what it is when each latch is the first of its class. The first one has the smallest node too.
fn substitution(model: &Model, classes: &Classes) -> Vec<Lit> {
    let mut out = identity(model);
    for (index, class) in classes.iter().enumerate() {
        let Some(class) = class.filter(|class| *class != index) else { continue };
        let own = model.latches[index].lit.node() as usize;
        out[own] = if class == CONSTANT {
            Lit::FALSE.invert_if(initial(model, index))
        } else {
            model.latches[class].lit.invert_if(initial(model, index) != initial(model, class))
        };
    }
    out
}

/// Classes of latches whose difference from their first value is the same in random runs, in those cycles up to which
/// the constraints hold.
fn propose(model: &Model) -> Classes {
    let mut random = Random::default();
    let mut words = vec![0; model.aig.len()];
    let mut signatures = vec![Vec::with_capacity(CYCLES); model.latches.len()];
    let full = |value: bool| 0_u64.wrapping_sub(u64::from(value));
    for latch in &model.latches {
        words[latch.lit.node() as usize] = latch.initial.map_or_else(|| random.word(), full);
    }
    let mut alive = u64::MAX;
    for _ in 0..CYCLES {
        for (latch, signature) in model.latches.iter().zip(&mut signatures) {
            let changed = words[latch.lit.node() as usize] ^ full(latch.initial.unwrap_or_default());
            signature.push(changed & alive);
        }
        for input in &model.inputs {
            words[input.node() as usize] = random.word();
        }
        model.aig.propagate(&mut words);
        alive = model.constraints.iter().fold(alive, |alive, lit| alive & word(&words, *lit));
        step(model, &mut words);
    }
    let takes_part = |index: usize| model.latches[index].initial.is_some();
    grouped(model, |index| takes_part(index).then(|| (CONSTANT, std::mem::take(&mut signatures[index]))))
}

/// The next values take the place of the present ones.
fn step(model: &Model, words: &mut [u64]) {
    let next: Vec<u64> = model.latches.iter().map(|latch| word(words, latch.next)).collect();
    for (latch, next) in model.latches.iter().zip(next) {
        words[latch.lit.node() as usize] = next;
    }
}

/// Classes of equal keys, which are an old class and words; zeros in the class of the constant stay there.
fn grouped(model: &Model, mut key: impl FnMut(usize) -> Option<(usize, Vec<u64>)>) -> Classes {
    let mut order: Vec<usize> = (0..model.latches.len()).collect();
    order.sort_by_key(|index| model.latches[*index].lit.node());
    let (mut first, mut classes) = (FastMap::<(usize, Vec<u64>), usize>::default(), vec![None; order.len()]);
    for index in order {
        classes[index] = key(index).map(|(class, words)| {
            if class == CONSTANT && words.iter().all(|word| *word == 0) {
                CONSTANT
            } else {
                *first.entry((class, words)).or_insert(index)
            }
        });
    }
    classes
}

/// Classes in which the next values are equal where the present ones are in the old classes: the same classes, or finer
/// ones. `None` where `stop` came first.
fn refine(model: &Model, classes: &Classes, stop: &Stop) -> Option<Classes> {
    let substitute = substitution(model, classes);
    let (mut aig, reduced) = substituted(model, &substitute);
    let (mut solver, mut encoder) = (Cadical::default(), Encoder::default());
    solver.set_stop(stop.clone());
    solver.set_conflicts(Some(CONFLICTS));
    for constraint in &model.constraints {
        let lit = encoder.encode(&aig, through(&reduced, *constraint), &mut solver);
        solver.add_clause(&[lit]);
    }
    let changed = |index: usize| through(&reduced, model.latches[index].next).invert_if(initial(model, index));
    let mut splits: Vec<Vec<u64>> = vec![Vec::new(); model.latches.len()];
    let is_parted = |splits: &[Vec<u64>], index: usize, class: usize| match class {
        CONSTANT => splits[index].iter().any(|word| *word != 0),
        class => splits[index] != splits[class],
    };
    for (index, class) in classes.iter().enumerate() {
        let Some(class) = class.filter(|class| *class != index) else { continue };
        let (own, other) = (changed(index), if class == CONSTANT { Lit::FALSE } else { changed(class) });
        if own == other || is_parted(&splits, index, class) {
            continue;
        }
        let differ = aig.xor(own, other);
        let query = encoder.encode(&aig, differ, &mut solver);
        match solver.solve(&[query]) {
            Some(false) => {
                solver.add_clause(&[-query]);
                continue;
            }
            None if stop.reached() => return None,
            None => {}
            Some(true) => {
                let words = counterexample(model, &substitute, &encoder, &reduced, &solver);
                for (at, split) in splits.iter_mut().enumerate() {
                    split.push(word(&words, model.latches[at].next.invert_if(initial(model, at))) & 1);
                }
            }
        }
        // What is not shown to be equal in time is parted all the same, by a pattern of its own.
        if !is_parted(&splits, index, class) {
            splits.iter_mut().enumerate().for_each(|(at, split)| split.push(u64::from(at == index)));
        }
    }
    Some(grouped(model, |index| classes[index].map(|class| (class, splits[index].clone()))))
}

/// The solver's model in the old graph.
fn counterexample(model: &Model, substitute: &[Lit], encoder: &Encoder, reduced: &[Lit], solver: &Cadical) -> Vec<u64> {
    let mut words = vec![0; model.aig.len()];
    let leaves = (0_u32..).take(model.aig.len()).filter(|node| model.aig.gate(*node) == Gate::Leaf).map(Lit::of);
    for leaf in leaves {
        let lit = through(reduced, through(substitute, leaf));
        let value = encoder.value(lit, solver);
        words[leaf.node() as usize] = u64::from(value);
    }
    model.aig.propagate(&mut words);
    words
}
