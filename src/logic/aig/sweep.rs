//! SAT sweeping (Kuehlmann, *Dynamic Transition Relation Simplification for Bounded Property Checking*, ICCAD 2004; the
//! functionally reduced graphs of Mishchenko, Chatterjee, Jiang, Brayton, 2005): conjunctions that are the same function of
//! inputs and latches become one. Random words propose classes, SAT decides with few conflicts, and counterexamples
//! part nodes that are not. No state is involved, so that there is no fact.

use super::reduce::{Reduced, cone, identity, needed, rebuild, through};
use super::{Aig, Gate, Lit, Model, Random, word};
use crate::logic::hash::FastMap;
use crate::logic::sat::cadi::Cadical;
use crate::logic::sat::encode::Encoder;
use crate::logic::sat::{Solver, Stop};

/// Words of random values at the start.
const WORDS: usize = 8;
/// Conflicts for one query.
const CONFLICTS: u32 = 100;
/// Queries for a node, and members of its class that it is compared with.
const TRIES: usize = 4;
const MEMBERS: usize = 64;
/// Counterexamples that are kept.
const EXTRA: usize = 2000;

/// The model with one node for each function found. Where `stop` comes, what was found until then.
#[must_use]
pub fn sweep(model: &Model, stop: &Stop) -> Reduced {
    let needed = needed(model, &identity(model));
    let mut sweeper = Sweeper::new(model, &needed, stop);
    for node in (1_u32..).take(model.aig.len() - 1).filter(|node| needed[*node as usize]) {
        match model.aig.gate(node) {
            Gate::False => {}
            Gate::Leaf => sweeper.map[node as usize] = sweeper.new.leaf(),
            Gate::And(a, b) => sweeper.visit(node, a, b),
        }
    }
    rebuild(model, &sweeper.substitute, Vec::new()).then(cone)
}

struct Sweeper<'m> {
    model: &'m Model,
    stop: &'m Stop,
    random: Random,
    /// Values of every node: random ones, by which nodes are classed, and those near counterexamples.
    patterns: Vec<Vec<u64>>,
    extra: Vec<Vec<u64>>,
    classes: FastMap<Vec<u64>, Vec<u32>>,
    new: Aig,
    map: Vec<Lit>,
    substitute: Vec<Lit>,
    solver: Cadical,
    encoder: Encoder,
}

impl<'m> Sweeper<'m> {
    fn new(model: &'m Model, needed: &[bool], stop: &'m Stop) -> Self {
        let mut random = Random::default();
        let patterns = (0..WORDS).map(|_| {
            let leaf = |node: usize| needed[node] && model.aig.gates[node] == Gate::Leaf;
            let mut words: Vec<u64> =
                (0..model.aig.len()).map(|node| if leaf(node) { random.word() } else { 0 }).collect();
            model.aig.propagate(&mut words);
            words
        });
        let patterns = patterns.collect();
        let mut solver = Cadical::default();
        solver.set_stop(stop.clone());
        solver.set_conflicts(Some(CONFLICTS));
        let mut out = Self {
            model,
            stop,
            random,
            patterns,
            extra: Vec::new(),
            classes: FastMap::default(),
            new: Aig::default(),
            map: vec![Lit::FALSE; model.aig.len()],
            substitute: identity(model),
            solver,
            encoder: Encoder::default(),
        };
        let key = out.signature(0);
        out.classes.insert(key, vec![0]);
        out
    }

    /// Whether the node is true in the first pattern of all; its class is that of its complement then.
    fn inverted(&self, node: u32) -> bool {
        self.patterns[0][node as usize] & 1 == 1
    }

    fn signature(&self, node: u32) -> Vec<u64> {
        let flip = 0_u64.wrapping_sub(u64::from(self.inverted(node)));
        self.patterns.iter().map(|words| words[node as usize] ^ flip).collect()
    }

    fn visit(&mut self, node: u32, a: Lit, b: Lit) {
        let own = self.new.and(through(&self.map, a), through(&self.map, b));
        self.map[node as usize] = own;
        let key = self.signature(node);
        let members = self.classes.get(&key).cloned().unwrap_or_default();
        let mut tries = 0;
        for other in members.into_iter().take(MEMBERS) {
            let flipped = self.inverted(node) != self.inverted(other);
            let (left, right) = (Lit::of(node), Lit::of(other).invert_if(flipped));
            if self.extra.iter().any(|words| word(words, left) != word(words, right)) {
                continue;
            }
            let target = through(&self.map, right);
            tries += 1;
            match if tries > TRIES || self.stop.reached() { None } else { self.same(own, target) } {
                Some(true) => {
                    self.map[node as usize] = target;
                    self.substitute[node as usize] = right;
                    return;
                }
                Some(false) => self.learn(),
                None => break,
            }
        }
        self.classes.entry(key).or_default().push(node);
    }

    /// Whether two literals of the new graph are the same function; `None` where that took too long.
    fn same(&mut self, a: Lit, b: Lit) -> Option<bool> {
        if a == b {
            return Some(true);
        }
        let x = self.encoder.encode(&self.new, a, &mut self.solver);
        let y = self.encoder.encode(&self.new, b, &mut self.solver);
        for query in [[x, -y], [-x, y]] {
            if self.solver.solve(&query)? {
                return Some(false);
            }
        }
        self.solver.add_clause(&[x, -y]);
        self.solver.add_clause(&[-x, y]);
        Some(true)
    }

    /// Keeps the counterexample, with 63 neighbours of it in which some leaves differ.
    fn learn(&mut self) {
        if self.extra.len() >= EXTRA {
            return;
        }
        let mut words = vec![0; self.model.aig.len()];
        for (node, gate) in self.model.aig.gates.iter().enumerate() {
            if *gate == Gate::Leaf {
                let value = self.encoder.value(self.map[node], &self.solver);
                let near = self.random.word() & self.random.word() & self.random.word() & !1;
                words[node] = 0_u64.wrapping_sub(u64::from(value)) ^ near;
            }
        }
        self.model.aig.propagate(&mut words);
        self.extra.push(words);
    }
}
