//! What the engines work on: a model with one bad literal, the signals that their clauses may speak of, and facts that
//! are known to hold in every state that a run reaches.

use std::collections::BTreeMap;

use super::engine::{Fact, Proof};
use crate::logic::aig::{Gate, Lit, Model};

/// A literal over latches and what it is in the next cycle: a latch, or a predicate over latches (an *internal signal*:
/// Dureja, Gurfinkel, Ivrii, Vizel, "IC3 with internal signals", FMCAD 2021).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Signal {
    pub(crate) now: Lit,
    pub(crate) next: Lit,
    pub(crate) initial: Option<bool>,
    pub(crate) is_latch: bool,
}

/// A property to decide.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    /// The model; its graph may hold more than the model needs.
    pub(crate) model: Model,
    /// What must not become true.
    pub(crate) bad: Lit,
    /// The latches in their order, then predicates.
    pub(crate) signals: Vec<Signal>,
    /// Clauses over latches' cones, inductive together.
    pub(crate) facts: Vec<Vec<Lit>>,
    /// Whether states of the model are equal only where those are that the proof is about, so that an induction may look at
    /// paths of different states alone.
    pub(crate) is_whole: bool,
}

impl Problem {
    /// The property as it stands.
    pub(crate) fn new(model: &Model, property: usize) -> Self {
        let signals = model
            .latches
            .iter()
            .map(|l| Signal { now: l.lit, next: l.next, initial: l.initial, is_latch: true })
            .collect();
        Self { model: model.clone(), bad: model.bad[property], signals, facts: Vec::new(), is_whole: true }
    }

    /// Adds a predicate over latches as a signal; nothing where it is one already or constant.
    pub(crate) fn add_signal(&mut self, now: Lit) {
        let known = now.node() == 0 || self.signals.iter().any(|s| s.now.node() == now.node());
        if known {
            return;
        }
        let next = self.next_of(&[now])[0];
        let initial = self.initial_of(now);
        self.signals.push(Signal { now, next, initial, is_latch: false });
    }

    /// The literals in the next cycle.
    pub(crate) fn next_of(&mut self, lits: &[Lit]) -> Vec<Lit> {
        let mut map: BTreeMap<u32, Lit> = self.model.latches.iter().map(|l| (l.lit.node(), l.next)).collect();
        map.insert(0, Lit::FALSE);
        for node in cone(&self.model, lits) {
            if let Gate::And(a, b) = self.model.aig.gate(node) {
                let through = |l: Lit| map.get(&l.node()).map(|m| m.invert_if(l.inverted()));
                if let (Some(a), Some(b)) = (through(a), through(b)) {
                    let next = self.model.aig.and(a, b);
                    map.insert(node, next);
                }
            }
        }
        lits.iter().map(|l| map.get(&l.node()).copied().unwrap_or(Lit::FALSE).invert_if(l.inverted())).collect()
    }

    /// The value that a literal over latches has in every first state, where there is one.
    fn initial_of(&self, lit: Lit) -> Option<bool> {
        let mut values: BTreeMap<u32, Option<bool>> =
            self.model.latches.iter().map(|l| (l.lit.node(), l.initial)).collect();
        values.insert(0, Some(false));
        for node in cone(&self.model, &[lit]) {
            if let Gate::And(a, b) = self.model.aig.gate(node) {
                let of = |l: Lit| values.get(&l.node()).copied().flatten().map(|v| v != l.inverted());
                let value = match (of(a), of(b)) {
                    (Some(false), _) | (_, Some(false)) => Some(false),
                    (Some(true), Some(true)) => Some(true),
                    _ => None,
                };
                values.insert(node, value);
            }
        }
        values.get(&lit.node()).copied().flatten().map(|v| v != lit.inverted())
    }

    /// Everything that an engine's questions speak of.
    pub(crate) fn roots(&self) -> Vec<Lit> {
        let mut roots = vec![self.bad];
        roots.extend(&self.model.constraints);
        roots.extend(&self.model.inputs);
        roots.extend(self.signals.iter().flat_map(|s| [s.now, s.next]));
        roots.extend(self.facts.iter().flatten());
        roots
    }

    /// The proof with these clauses over latches' cones; the facts are added.
    pub(crate) fn proof(&self, clauses: &[Vec<Lit>], k: usize, simple_path: bool) -> Proof {
        let all: Vec<&Vec<Lit>> = self.facts.iter().chain(clauses).collect();
        let latches = self.model.latches.len();
        let mut place: BTreeMap<u32, usize> =
            self.model.latches.iter().enumerate().map(|(i, l)| (l.lit.node(), i)).collect();
        let lits: Vec<Lit> = all.iter().flat_map(|c| c.iter().copied()).collect();
        let mut gates = Vec::new();
        let fact = |place: &BTreeMap<u32, usize>, l: Lit| -> Fact {
            (*place.get(&l.node()).expect("clauses speak of latches' cones"), !l.inverted())
        };
        for node in cone(&self.model, &lits) {
            if let Gate::And(a, b) = self.model.aig.gate(node) {
                gates.push((fact(&place, a), fact(&place, b)));
                place.insert(node, latches + gates.len() - 1);
            }
        }
        let mut out: Vec<Vec<Fact>> = Vec::new();
        for clause in all {
            if clause.contains(&Lit::TRUE) {
                continue;
            }
            let mut facts: Vec<Fact> = clause.iter().filter(|&&l| l != Lit::FALSE).map(|&l| fact(&place, l)).collect();
            facts.sort_unstable();
            facts.dedup();
            out.push(facts);
        }
        out.sort();
        out.dedup();
        Proof { gates, clauses: out, k, simple_path }
    }
}

/// The nodes below some literals, those included, in ascending order.
pub(crate) fn cone(model: &Model, lits: &[Lit]) -> Vec<u32> {
    let mut seen = std::collections::BTreeSet::new();
    let mut open: Vec<u32> = lits.iter().map(|l| l.node()).collect();
    while let Some(node) = open.pop() {
        if seen.insert(node)
            && let Gate::And(a, b) = model.aig.gate(node)
        {
            open.extend([a.node(), b.node()]);
        }
    }
    seen.into_iter().collect()
}
