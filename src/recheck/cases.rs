//! What an invariant makes equal, case by case, so that what is calculated from it is calculated once.
//!
//! A block that remembers what its table remembers calculates with the one what the table asks for of the other. Where both
//! words are known to be equal, one takes the place of both, and two multipliers become the same gates; to find that out
//! by clauses alone takes a solver too long. Nothing is taken on trust here: the words are found by the solver, and that
//! the invariant makes them equal is one of its answers.

use std::collections::BTreeMap;

use batsat::Lit;

use super::gates::Word;
use super::invariant::{Rejection, Stop, Unrolled};
use crate::logic::certificate::{Certificate, Fact};
use crate::logic::system::System;
use crate::logic::term::{Node, Op};

/// Most cases.
const CASES: usize = 64;
/// Most rounds in which words are told apart.
const ROUNDS: usize = 200;

/// For each state, the first one that it is equal to.
type Classes = Vec<usize>;

/// Whether two things that are no constants are multiplied or divided in what the obligations say.
pub(super) fn are_worthwhile(system: &System) -> bool {
    let roots = system.obligations.iter().map(|obligation| obligation.term);
    crate::logic::eval::below(&system.pool, roots).into_iter().any(|term| match system.pool.node(term) {
        Node::Apply(Op::Mul | Op::Udiv | Op::Sdiv | Op::Urem | Op::Srem, [a, b, _]) => {
            system.pool.value(a).is_none() && system.pool.value(b).is_none()
        }
        _ => false,
    })
}

/// That the invariant admits no state in which an obligation fails.
///
/// # Errors
/// If it does, or if the time was over.
pub(super) fn safe(system: &System, certificate: &Certificate, stop: &Stop) -> Result<(), Rejection> {
    let mut probe = Unrolled::new(system, stop);
    probe.assume_invariant(0, certificate);
    let base = equal_words(&mut probe, None)?;
    let mut before: Vec<Fact> = Vec::new();
    for guard in guards(certificate) {
        let lit = probe.fact(0, &[], guard);
        let classes = equal_words(&mut probe, Some(lit))?;
        if classes != base {
            holds(system, certificate, stop, &classes, (&before, Some(guard)))?;
            before.push(opposite(guard));
        }
    }
    holds(system, certificate, stop, &base, (&before, None))
}

const fn opposite(fact: Fact) -> Fact {
    match fact {
        Fact::Bit(mut bit) => {
            bit.value = !bit.value;
            Fact::Bit(bit)
        }
        Fact::Gate(gate, value) => Fact::Gate(gate, !value),
    }
}

/// Bits of states that say the most about others, in short clauses.
fn guards(certificate: &Certificate) -> Vec<Fact> {
    let mut counts: BTreeMap<Fact, usize> = BTreeMap::new();
    for clause in certificate.clauses.iter().filter(|clause| (2..=3).contains(&clause.len())) {
        for fact in clause.iter().filter(|fact| matches!(fact, Fact::Bit(_))) {
            *counts.entry(opposite(*fact)).or_default() += 1;
        }
    }
    let mut order: Vec<(usize, Fact)> = counts.into_iter().map(|(fact, count)| (count, fact)).collect();
    order.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    order.truncate(CASES);
    order.into_iter().map(|(_, fact)| fact).collect()
}

/// Which states are equal in every state of the invariant in which `guard` holds.
fn equal_words(probe: &mut Unrolled<'_>, guard: Option<Lit>) -> Result<Classes, Rejection> {
    let words: Vec<Word> = (0..probe.system.states.len())
        .map(|state| {
            let variable = probe.system.states[state].variable;
            probe.word(0, variable)
        })
        .collect();
    let mut widths: BTreeMap<usize, usize> = BTreeMap::new();
    let mut classes: Classes =
        words.iter().enumerate().map(|(state, word)| *widths.entry(word.len()).or_insert(state)).collect();
    for _ in 0..ROUNDS {
        let mut differ = Vec::new();
        for (state, class) in classes.iter().enumerate().filter(|(state, class)| *state != **class) {
            differ.push(!probe.gates.equal(&words[state], &words[*class]));
        }
        let goal = probe.gates.any(&differ);
        let assumptions: Vec<Lit> = guard.into_iter().chain([goal]).collect();
        if !probe.gates.satisfiable(&assumptions)? {
            return Ok(classes);
        }
        classes = split(probe, &words, &classes);
    }
    // Still not told apart: each for itself, which is always true.
    Ok((0..words.len()).collect())
}

/// Finer classes, by the values of the solver's model.
fn split(probe: &Unrolled<'_>, words: &[Word], classes: &[usize]) -> Classes {
    let mut first: BTreeMap<(usize, Vec<bool>), usize> = BTreeMap::new();
    let value = |word: &Word| word.iter().map(|lit| probe.gates.value(*lit)).collect::<Vec<bool>>();
    words.iter().enumerate().map(|(state, word)| *first.entry((classes[state], value(word))).or_insert(state)).collect()
}

/// That no obligation fails where the invariant holds, all of `before`, and `guard`.
fn holds(
    system: &System,
    certificate: &Certificate,
    stop: &Stop,
    classes: &[usize],
    (before, guard): (&[Fact], Option<Fact>),
) -> Result<(), Rejection> {
    let merged = classes.iter().enumerate().filter(|(state, class)| state != *class);
    let mut case = Unrolled::merged(system, stop, merged.map(|(state, class)| (state, *class)));
    case.assume_invariant(0, certificate);
    for fact in before.iter().copied().chain(guard) {
        let lit = case.fact(0, &[], fact);
        case.gates.clause(&[lit]);
    }
    let good = case.safe(0);
    case.refute(&[!good], Rejection::NotSafe)
}
