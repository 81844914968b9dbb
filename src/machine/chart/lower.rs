//! A chart as statements of one call.

use super::{Association, Chart, Qualifier, Target, active_key, time_key};
use crate::machine::program::{Location, Statement, StatementKind, Value};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

const TIME: Scalar = Scalar::Time(32);

/// What one call of the block does, with the chart's own variables at the places that `memory` gives for
/// [`super::Outline::hidden`].
pub fn statements(chart: &Chart, memory: &dyn Fn(&str) -> Location) -> Vec<Statement> {
    let mut lowering = Lowering { chart, memory, out: Vec::new(), place: None };
    lowering.start();
    lowering.evolution();
    lowering.times();
    for action in 0..chart.actions.len() {
        lowering.control(action);
    }
    for action in 0..chart.actions.len() {
        lowering.drive(action);
    }
    lowering.remember();
    lowering.out
}

struct Lowering<'a> {
    chart: &'a Chart,
    memory: &'a dyn Fn(&str) -> Location,
    out: Vec<Statement>,
    place: Option<Place>,
}

fn constant(scalar: Scalar, bits: u64) -> Value {
    Expr { kind: ExprKind::Const(bits), scalar, place: None }
}

fn apply(op: Op, operands: Vec<Value>) -> Value {
    Expr { kind: ExprKind::Apply(op, operands), scalar: Scalar::Bool, place: None }
}

fn not(value: Value) -> Value {
    apply(Op::Not, vec![value])
}

fn and(left: Value, right: Value) -> Value {
    apply(Op::And, vec![left, right])
}

fn or(left: Value, right: Value) -> Value {
    apply(Op::Or, vec![left, right])
}

/// Whether one of them holds; `FALSE` for none.
fn any(values: impl IntoIterator<Item = Value>) -> Value {
    values.into_iter().reduce(or).unwrap_or_else(|| constant(Scalar::Bool, 0))
}

impl Lowering<'_> {
    fn bit(&self, key: &str) -> Value {
        Expr { kind: ExprKind::Read((self.memory)(key)), scalar: Scalar::Bool, place: None }
    }

    fn time(&self, key: &str) -> Value {
        Expr { kind: ExprKind::Read((self.memory)(key)), scalar: TIME, place: None }
    }

    fn step_key(&self, step: usize, what: &str) -> String {
        format!("{}${what}", self.chart.steps[step].name.to_lowercase())
    }

    fn active(&self, step: usize) -> Value {
        self.bit(&active_key(&self.chart.steps[step].name))
    }

    fn was(&self, step: usize) -> Value {
        self.bit(&self.step_key(step, "was"))
    }

    fn statement(&self, kind: StatementKind) -> Statement {
        Statement { kind, place: self.place }
    }

    fn assignment(&self, key: &str, value: Value) -> Statement {
        self.statement(StatementKind::Assign { target: (self.memory)(key), value, range: None })
    }

    fn truth(&self, key: &str, value: bool) -> Statement {
        self.assignment(key, constant(Scalar::Bool, value.into()))
    }

    fn branch(&self, condition: Value, then: Vec<Statement>, otherwise: Vec<Statement>) -> Statement {
        self.statement(StatementKind::If { condition, then, otherwise })
    }

    fn set(&mut self, key: &str, value: Value) {
        let statement = self.assignment(key, value);
        self.out.push(statement);
    }

    fn start(&mut self) {
        let initial = self.chart.steps.iter().filter(|step| step.initial);
        let mut then: Vec<_> = initial.map(|step| self.truth(&active_key(&step.name), true)).collect();
        then.push(self.truth("started$", true));
        let statement = self.branch(not(self.bit("started$")), then, Vec::new());
        self.out.push(statement);
    }

    fn evolution(&mut self) {
        for step in 0..self.chart.steps.len() {
            self.set(&self.step_key(step, "claimed"), constant(Scalar::Bool, 0));
        }
        let mut order: Vec<usize> = (0..self.chart.transitions.len()).collect();
        order.sort_by_key(|number| (self.chart.transitions[*number].priority, *number));
        for number in order {
            self.test(number);
        }
        for (number, transition) in self.chart.transitions.iter().enumerate() {
            self.fire(number, &transition.from, false);
        }
        for (number, transition) in self.chart.transitions.iter().enumerate() {
            self.fire(number, &transition.to, true);
        }
        self.place = None;
    }

    /// Tests a transition if it is enabled, and claims the steps before it if it fires.
    fn test(&mut self, number: usize) {
        let transition = &self.chart.transitions[number];
        self.place = transition.place;
        let key = format!("fires${number}");
        self.set(&key, constant(Scalar::Bool, 0));
        let free = |step: &usize| and(self.active(*step), not(self.bit(&self.step_key(*step, "claimed"))));
        let Some(enabled) = transition.from.iter().map(free).reduce(and) else { return };
        let claim = transition.from.iter().map(|step| self.truth(&self.step_key(*step, "claimed"), true)).collect();
        let mut then = transition.before.clone();
        then.push(self.assignment(&key, transition.condition.clone()));
        then.push(self.branch(self.bit(&key), claim, Vec::new()));
        let statement = self.branch(enabled, then, Vec::new());
        self.out.push(statement);
    }

    /// Leaves or enters steps if the transition fires.
    fn fire(&mut self, number: usize, steps: &[usize], value: bool) {
        self.place = self.chart.transitions[number].place;
        let flags = steps.iter().map(|step| self.truth(&active_key(&self.chart.steps[*step].name), value)).collect();
        let statement = self.branch(self.bit(&format!("fires${number}")), flags, Vec::new());
        self.out.push(statement);
    }

    fn times(&mut self) {
        for (number, step) in self.chart.steps.iter().enumerate() {
            let (time, clock) = (time_key(&step.name), self.step_key(number, "clock"));
            let entered = and(self.active(number), not(self.was(number)));
            let zero = vec![self.assignment(&clock, constant(TIME, 0))];
            let then = vec![self.branch(entered, zero, Vec::new()), self.assignment(&time, self.time(&clock))];
            let statement = self.branch(self.active(number), then, vec![]);
            self.out.push(statement);
        }
    }

    /// Finds out whether an action is on.
    fn control(&mut self, action: usize) {
        let associations = &self.chart.actions[action].associations;
        let resets = associations.iter().filter(|each| each.qualifier == Qualifier::Reset);
        let reset = any(resets.map(|each| self.active(each.step)));
        let mut on = Vec::new();
        let mut pulses = Vec::new();
        for (number, association) in associations.iter().enumerate() {
            self.place = association.place;
            let (active, was) = (self.active(association.step), self.was(association.step));
            match association.qualifier {
                Qualifier::Reset => {}
                Qualifier::NonStored => on.push(active),
                Qualifier::Pulse => on.push(and(active, not(was))),
                Qualifier::Active => pulses.push(active),
                Qualifier::PulseRising | Qualifier::OnEntry => pulses.push(and(active, not(was))),
                Qualifier::PulseFalling | Qualifier::OnExit => pulses.push(and(not(active), was)),
                _ => on.push(self.kept(&format!("{action}${number}"), association, &reset)),
            }
        }
        let on = and(not(reset), any(on));
        self.set(&format!("on${action}"), on);
        self.set(&format!("pulse${action}"), any(pulses));
        self.place = None;
    }

    /// What a stored or timed qualifier contributes.
    fn kept(&mut self, id: &str, association: &Association, reset: &Value) -> Value {
        let active = self.active(association.step);
        let stored = format!("stored${id}");
        match association.qualifier {
            Qualifier::Limited => and(active.clone(), not(self.timer(id, active, association))),
            Qualifier::Delayed => self.timer(id, active, association),
            Qualifier::DelayedStored => {
                let over = self.timer(id, active, association);
                self.latch(&stored, over, reset)
            }
            Qualifier::StoredDelayed => {
                let input = self.latch(&stored, active, reset);
                self.timer(id, input, association)
            }
            Qualifier::StoredLimited => {
                let input = self.latch(&stored, active, reset);
                and(input.clone(), not(self.timer(id, input, association)))
            }
            _ => self.latch(&stored, active, reset),
        }
    }

    /// A bistable block in which resetting wins.
    fn latch(&mut self, key: &str, set: Value, reset: &Value) -> Value {
        self.set(key, and(not(reset.clone()), or(set, self.bit(key))));
        self.bit(key)
    }

    /// An on-delay timer: whether `input` has held for the association's time.
    fn timer(&mut self, id: &str, input: Value, association: &Association) -> Value {
        let (before, over, clock) = (format!("timed${id}"), format!("over${id}"), format!("clock${id}"));
        let limit = association.time.clone().unwrap_or_else(|| constant(TIME, 0));
        let begin = vec![self.assignment(&clock, constant(TIME, 0)), self.truth(&over, false)];
        let late = apply(Op::Le, vec![limit, self.time(&clock)]);
        let then = vec![
            self.branch(not(self.bit(&before)), begin, Vec::new()),
            self.branch(late, vec![self.truth(&over, true)], Vec::new()),
        ];
        let statement = self.branch(input.clone(), then, vec![self.truth(&over, false)]);
        self.out.push(statement);
        self.set(&before, input);
        self.bit(&over)
    }

    /// Sets the variable, or runs the body.
    fn drive(&mut self, action: usize) {
        let (on, pulse) = (format!("on${action}"), format!("pulse${action}"));
        let now = or(self.bit(&on), self.bit(&pulse));
        match &self.chart.actions[action].target {
            Target::Variable(target) => {
                let kind = StatementKind::Assign { target: target.clone(), value: now, range: None };
                self.out.push(self.statement(kind));
            }
            Target::Body(body) => {
                let before = format!("before${action}");
                let runs = or(now, self.bit(&before));
                let statement = self.branch(runs, body.clone(), Vec::new());
                self.out.push(statement);
                self.set(&before, self.bit(&on));
            }
        }
    }

    fn remember(&mut self) {
        for step in 0..self.chart.steps.len() {
            self.set(&self.step_key(step, "was"), self.active(step));
        }
    }
}
