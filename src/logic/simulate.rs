//! A system run on values, cycle by cycle.

use super::eval::{Evaluator, Values};
use super::system::{Labelled, System};
use super::term::{Node, Term};

/// What a run is free to choose: values by the order of [`System::states`] and [`System::inputs`]. What is missing is 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stimulus {
    /// The first value of each state variable that has no initial one; others are ignored.
    pub free: Vec<u64>,
    /// The inputs, for each cycle.
    pub inputs: Vec<Vec<u64>>,
}

/// What is seen in one cycle, by the order of the system's lists.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Snapshot {
    /// The inputs.
    pub inputs: Vec<u64>,
    /// The state variables, as the cycle finds them.
    pub states: Vec<u64>,
    /// Whether each constraint holds.
    pub constraints: Vec<bool>,
    /// Whether each obligation holds.
    pub obligations: Vec<bool>,
    /// The outputs.
    pub outputs: Vec<u64>,
}

impl System {
    /// The run that `stimulus` says.
    #[must_use]
    pub fn run(&self, stimulus: &Stimulus) -> Vec<Snapshot> {
        self.simulate(&stimulus.free, &stimulus.inputs)
    }

    /// Runs for as many cycles as there are inputs; `free` and `inputs` are as in [`Stimulus`]. It does not stop where a
    /// constraint fails.
    #[must_use]
    pub fn simulate(&self, free: &[u64], inputs: &[Vec<u64>]) -> Vec<Snapshot> {
        let labelled = self.constraints.iter().chain(&self.obligations).chain(&self.outputs);
        let roots = labelled.map(|labelled| labelled.term).chain(self.states.iter().map(|state| state.next));
        let own = self.states.iter().map(|state| state.variable).chain(self.inputs.iter().map(|input| input.variable));
        let evaluator = Evaluator::new(&self.pool, roots.chain(own));
        let mut values = Values::default();
        let mut variables = vec![0; self.pool.variables()];
        for (state, value) in self.states.iter().zip(self.first_values(free)) {
            self.set(&mut variables, state.variable, value);
        }
        let mut run = Vec::with_capacity(inputs.len());
        for inputs in inputs {
            for (index, input) in self.inputs.iter().enumerate() {
                self.set(&mut variables, input.variable, inputs.get(index).copied().unwrap_or_default());
            }
            evaluator.run(&self.pool, |var| variables[var.0 as usize], &mut values);
            run.push(self.snapshot(&values));
            for state in &self.states {
                self.set(&mut variables, state.variable, values.get(state.next));
            }
        }
        run
    }

    /// The values of the state variables before the first cycle.
    #[must_use]
    pub fn first_values(&self, free: &[u64]) -> Vec<u64> {
        let mut variables = vec![0; self.pool.variables()];
        let mut values = Values::default();
        let mut first = Vec::with_capacity(self.states.len());
        for (index, state) in self.states.iter().enumerate() {
            let value = match state.initial {
                Some(term) => match self.pool.value(term) {
                    Some(value) => value,
                    None => {
                        let evaluator = Evaluator::new(&self.pool, [term]);
                        evaluator.run(&self.pool, |var| variables[var.0 as usize], &mut values);
                        values.get(term)
                    }
                },
                None => free.get(index).copied().unwrap_or_default(),
            };
            self.set(&mut variables, state.variable, value);
            first.push(value & super::term::mask(self.pool.width(state.variable)));
        }
        first
    }

    fn set(&self, variables: &mut [u64], variable: Term, value: u64) {
        if let Node::Var(var) = self.pool.node(variable) {
            variables[var.0 as usize] = value;
        }
    }

    fn snapshot(&self, values: &Values) -> Snapshot {
        let holding = |list: &[Labelled]| list.iter().map(|labelled| values.holds(labelled.term)).collect();
        Snapshot {
            inputs: self.inputs.iter().map(|input| values.get(input.variable)).collect(),
            states: self.states.iter().map(|state| values.get(state.variable)).collect(),
            constraints: holding(&self.constraints),
            obligations: holding(&self.obligations),
            outputs: self.outputs.iter().map(|output| values.get(output.term)).collect(),
        }
    }
}
