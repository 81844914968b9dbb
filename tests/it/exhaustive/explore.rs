//! Everything that a block can do within its table, state by state: the interpreter for the block, the game on words for
//! the table.

use std::collections::{BTreeSet, HashMap};

use rungbook::machine::interpret::Interpreter;
use rungbook::machine::program::{Program, SlotId};

use super::blocks::{Block, Use};
use super::tables::{Table, Values};
use super::words::{Letter, Outcome, Rest};

/// A block with its table.
pub(super) struct Subject<'a> {
    pub(super) program: &'a Program,
    pub(super) block: &'a Block,
    pub(super) table: &'a Table,
}

/// What can happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Explored {
    /// The length of the shortest run that loses.
    pub(super) shortest: Option<usize>,
    /// Whether a fair environment can keep the system in the table for ever; looked for where no run loses.
    pub(super) kept: bool,
    /// How many states there are.
    pub(super) states: usize,
}

/// A cycle that a run has come to.
#[derive(Clone)]
pub(super) struct State {
    machine: Interpreter,
    words: BTreeSet<Rest>,
    history: Vec<Vec<i64>>,
    globals: Vec<i64>,
}

impl State {
    pub(super) fn globals(&self) -> &[i64] {
        &self.globals
    }
}

type Key = (Vec<u64>, BTreeSet<Rest>, Vec<Vec<i64>>, Vec<i64>);

/// What a cycle comes to.
pub(super) enum Step {
    Over,
    Lost,
    Open(Box<State>, u32),
}

struct Judged<'a> {
    subject: &'a Subject<'a>,
    values: Values<'a>,
    fault: bool,
}

impl Judged<'_> {
    fn holds(&self, row: usize, first: bool, assumption: bool) -> bool {
        let columns = self.subject.table.columns.iter().zip(&self.subject.table.cells[row]);
        columns.filter(|(column, _)| column.assumption == assumption).all(|(column, cell)| {
            let own = self.values.history[0][column.variable];
            let set = |index: usize| self.subject.block.variables[index].role == Use::Input;
            let vague = self.fault && assumption && !cell.reads_only(column.variable, &set);
            vague || cell.holds(own, first, &self.values)
        })
    }
}

impl Letter for Judged<'_> {
    fn inputs(&self, row: usize, first: bool) -> bool {
        self.holds(row, first, true)
    }

    fn outputs(&self, row: usize, first: bool) -> bool {
        self.holds(row, first, false)
    }
}

/// Every choice of one number of each range from 0.
fn choices(most: &[i64]) -> Vec<Vec<i64>> {
    most.iter().fold(vec![Vec::new()], |all, most| {
        all.iter().flat_map(|one| (0..=*most).map(move |value| [one.as_slice(), &[value]].concat())).collect()
    })
}

impl Subject<'_> {
    fn slot(&self, variable: usize) -> SlotId {
        let name = self.block.variables[variable].name;
        let found = self.program.variables.iter().find(|named| named.path.eq_ignore_ascii_case(name));
        found.unwrap_or_else(|| panic!("no variable {name}")).slot
    }

    fn value(&self, variable: usize, bits: u64) -> i64 {
        self.program.slots[self.slot(variable).0 as usize].scalar.number(bits) as i64
    }

    fn inputs(&self) -> Vec<usize> {
        (0..self.block.variables.len()).filter(|index| self.block.variables[*index].role == Use::Input).collect()
    }

    /// The first states: one for each choice of the global variables. None where the end is reached at once.
    pub(super) fn begin(&self) -> Vec<State> {
        let Some(words) = self.table.tree.begin() else { return Vec::new() };
        let most: Vec<i64> = self.table.globals.iter().map(|global| global.most).collect();
        let machine = Interpreter::new(self.program);
        let initial: Vec<i64> = self.block.variables.iter().map(|variable| variable.initial).collect();
        let history = vec![initial; 2];
        let state =
            |globals| State { machine: machine.clone(), words: words.clone(), history: history.clone(), globals };
        choices(&most).into_iter().map(state).collect()
    }

    /// Does a cycle with these bits in the input slots.
    pub(super) fn step(&self, state: &State, inputs: &[(SlotId, u64)]) -> Step {
        let mut machine = state.machine.clone();
        for (slot, bits) in inputs {
            machine.set(*slot, *bits);
        }
        let set: Vec<u64> = (0..self.block.variables.len()).map(|index| machine.get(self.slot(index))).collect();
        let fault = machine.cycle().is_err();
        let now = self.block.variables.iter().enumerate().map(|(index, variable)| {
            let bits = if variable.role == Use::Input { set[index] } else { machine.get(self.slot(index)) };
            self.value(index, bits)
        });
        let mut history = vec![now.collect::<Vec<i64>>()];
        history.extend(state.history.iter().cloned());
        let values = Values { kind: self.block.kind, history: &history, globals: &state.globals };
        let outcome = self.table.tree.play(&state.words, &Judged { subject: self, values, fault });
        match outcome {
            Outcome::Uncovered => Step::Over,
            _ if fault => Step::Lost,
            Outcome::Lost => Step::Lost,
            Outcome::Ended => Step::Over,
            Outcome::Open(words, fair) => {
                history.truncate(2);
                for (index, variable) in self.block.variables.iter().enumerate() {
                    if variable.role == Use::Input {
                        machine.set(self.slot(index), 0);
                    }
                }
                Step::Open(Box::new(State { machine, words, history, globals: state.globals.clone() }), fair)
            }
        }
    }

    /// What tells a state from others.
    pub(super) fn key(&self, state: &State) -> Key {
        let mut history = state.history.clone();
        if self.table.depth() < 2 {
            history.truncate(self.table.depth());
        }
        (state.machine.memory().to_vec(), state.words.clone(), history, state.globals.clone())
    }

    /// Everything; `None` where there are more than `most` states.
    pub(super) fn explore(&self, most: usize) -> Option<Explored> {
        let inputs: Vec<Vec<(SlotId, u64)>> = {
            let variables = self.inputs();
            let ranges: Vec<i64> = variables.iter().map(|index| self.block.variables[*index].most).collect();
            let slots: Vec<SlotId> = variables.iter().map(|index| self.slot(*index)).collect();
            let set = |values: Vec<i64>| slots.iter().copied().zip(values.into_iter().map(|v| v as u64)).collect();
            choices(&ranges).into_iter().map(set).collect()
        };
        let mut known: HashMap<Key, usize> = HashMap::new();
        let mut edges: Vec<Vec<(usize, u32)>> = Vec::new();
        let mut front = self.begin();
        for state in &front {
            known.insert(self.key(state), edges.len());
            edges.push(Vec::new());
        }
        let mut cycle = 0;
        while !front.is_empty() {
            cycle += 1;
            let mut later = Vec::new();
            for state in &front {
                let from = known[&self.key(state)];
                for choice in &inputs {
                    match self.step(state, choice) {
                        Step::Over => {}
                        Step::Lost => {
                            return Some(Explored { shortest: Some(cycle), kept: false, states: edges.len() });
                        }
                        Step::Open(next, fair) => {
                            let to = *known.entry(self.key(&next)).or_insert_with(|| {
                                edges.push(Vec::new());
                                later.push(*next);
                                edges.len() - 1
                            });
                            edges[from].push((to, fair));
                        }
                    }
                }
            }
            if edges.len() > most {
                return None;
            }
            front = later;
        }
        let kept = fair_cycle(&edges, self.table.tree.units());
        Some(Explored { shortest: None, kept, states: edges.len() })
    }
}

/// Whether some edges that lead to each other have all bits of `all` between them: a run that takes them again and again.
fn fair_cycle(edges: &[Vec<(usize, u32)>], all: u32) -> bool {
    let component = components(edges);
    let mut bits: HashMap<usize, u32> = HashMap::new();
    for (from, edges) in edges.iter().enumerate() {
        for (to, fair) in edges {
            if component[from] == component[*to] {
                *bits.entry(component[from]).or_default() |= fair;
            }
        }
    }
    bits.values().any(|bits| *bits == all)
}

/// The strongly connected component of each node (Kosaraju and Sharir).
fn components(edges: &[Vec<(usize, u32)>]) -> Vec<usize> {
    let mut back = vec![Vec::new(); edges.len()];
    for (from, edges) in edges.iter().enumerate() {
        edges.iter().for_each(|(to, _)| back[*to].push(from));
    }
    let (mut seen, mut order) = (vec![false; edges.len()], Vec::new());
    for root in 0..edges.len() {
        let mut stack = vec![(root, 0)];
        if std::mem::replace(&mut seen[root], true) {
            continue;
        }
        while let Some((node, at)) = stack.pop() {
            let Some((to, _)) = edges[node].get(at) else {
                order.push(node);
                continue;
            };
            stack.push((node, at + 1));
            if !std::mem::replace(&mut seen[*to], true) {
                stack.push((*to, 0));
            }
        }
    }
    let mut component = vec![usize::MAX; edges.len()];
    for root in order.into_iter().rev() {
        let mut stack = vec![root];
        while let Some(node) = stack.pop() {
            if component[node] == usize::MAX {
                component[node] = root;
                stack.extend(back[node].iter().filter(|from| component[**from] == usize::MAX));
            }
        }
    }
    component
}
