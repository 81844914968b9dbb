//! Charts that run on the interpreter.

use std::collections::BTreeMap;

use super::{Action, Association, Chart, Qualifier, Step, Target, Transition, active_key, statements, time_key};
use crate::library::ItemId;
use crate::machine::interpret::Interpreter;
use crate::machine::program::{Base, Location, Program, Role, Slot, SlotId, Statement, StatementKind, Value};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;

const COUNT: Scalar = Scalar::Int { signed: false, width: 16 };

/// Inputs are the slots 0 to 3, outputs 4 to 7, a counter 8; the chart's own variables follow.
struct Machine {
    run: Interpreter,
    slots: BTreeMap<String, u32>,
}

fn at(slot: u32) -> Location {
    Location { base: Base::Slot(SlotId(slot)), offset: 0, indices: Vec::new() }
}

fn input(slot: u32) -> Value {
    Expr { kind: ExprKind::Read(at(slot)), scalar: Scalar::Bool, place: None }
}

fn step(name: &str) -> Step {
    Step { name: name.to_owned(), initial: name == "Start", place: None }
}

fn transition(from: &[usize], to: &[usize], slot: u32) -> Transition {
    let (from, to) = (from.to_vec(), to.to_vec());
    Transition { from, to, priority: 0, before: Vec::new(), condition: input(slot), place: None }
}

fn association(step: usize, qualifier: &str, millis: u64) -> Association {
    let qualifier = Qualifier::named(qualifier).expect("a qualifier");
    let time = Expr { kind: ExprKind::Const(millis), scalar: Scalar::Time(32), place: None };
    Association { step, qualifier, time: qualifier.is_timed().then_some(time), place: None }
}

fn driven(slot: u32, associations: Vec<Association>) -> Action {
    Action { name: format!("Q{slot}"), target: Target::Variable(at(slot)), associations }
}

impl Machine {
    fn new(chart: &Chart) -> Self {
        let slot = |scalar: Scalar, name: &str| Slot {
            name: name.to_owned(),
            scalar,
            initial: 0,
            role: Role::State,
            range: None,
            place: None,
        };
        let mut all: Vec<Slot> = (0..8).map(|_| slot(Scalar::Bool, "")).collect();
        all.push(slot(COUNT, ""));
        let (mut slots, mut clocks) = (BTreeMap::new(), Vec::new());
        for hidden in chart.outline().hidden() {
            let number = u32::try_from(all.len()).expect("few slots");
            if hidden.is_clock {
                clocks.push((SlotId(number), 10));
            }
            assert_eq!(slots.insert(hidden.key.clone(), number), None, "{} twice", hidden.key);
            all.push(slot(hidden.scalar, &hidden.key));
        }
        let cycle = statements(chart, &|key| at(slots[key]));
        let program = Program {
            name: "Chart".into(),
            unit: ItemId(0),
            slots: all,
            routines: Vec::new(),
            startup: Vec::new(),
            cycle,
            this: SlotId(0),
            instances: Vec::new(),
            clocks,
            cycle_time: 10_000_000,
            assumptions: Vec::new(),
            cone: Vec::new(),
            variables: Vec::new(),
            enumerations: BTreeMap::new(),
        };
        Self { run: Interpreter::new(&program), slots }
    }

    /// One cycle with these inputs.
    fn cycle(&mut self, inputs: &[u64]) {
        for (slot, value) in (0..).zip(inputs) {
            self.run.set(SlotId(slot), *value);
        }
        assert_eq!(self.run.cycle(), Ok(()));
    }

    fn get(&self, slot: u32) -> u64 {
        self.run.get(SlotId(slot))
    }

    /// The names of the active steps.
    fn active(&self, chart: &Chart) -> Vec<String> {
        let active = |step: &&Step| self.get(self.slots[&active_key(&step.name)]) == 1;
        chart.steps.iter().filter(active).map(|step| step.name.clone()).collect()
    }
}

/// `Start`, and a step behind input 0 that input 1 leaves, with an action at it; a third step behind.
fn single(associations: Vec<Association>) -> Chart {
    Chart {
        steps: vec![step("Start"), step("Work"), step("Done")],
        transitions: vec![transition(&[0], &[1], 0), transition(&[1], &[2], 1), transition(&[2], &[0], 2)],
        actions: vec![driven(4, associations)],
    }
}

/// What the output is while the step is entered, held for `held` cycles in all, left, and for three cycles behind.
fn played(qualifier: &str, held: usize) -> String {
    let mut machine = Machine::new(&single(vec![association(1, qualifier, 30)]));
    let mut out = String::new();
    let inputs = [vec![[0, 0]; 2], vec![[1, 0]], vec![[0, 0]; held - 1], vec![[0, 1]], vec![[0, 0]; 3]].concat();
    for cycle in inputs {
        machine.cycle(&cycle);
        out.push(if machine.get(4) == 1 { '1' } else { '0' });
    }
    out
}

#[test]
fn every_qualifier_does_what_its_block_does() {
    // Two cycles before, five in the step, one that leaves it, three behind.
    assert_eq!(played("N", 5), "00111110000");
    assert_eq!(played("S", 5), "00111111111");
    assert_eq!(played("L", 5), "00111000000");
    assert_eq!(played("D", 5), "00000110000");
    assert_eq!(played("P", 5), "00100000000");
    assert_eq!(played("P1", 5), "00100000000");
    assert_eq!(played("P0", 5), "00000001000");
    assert_eq!(played("SD", 5), "00000111111");
    assert_eq!(played("DS", 5), "00000111111");
    assert_eq!(played("SL", 5), "00111000000");
    assert_eq!(played("R", 5), "00000000000");
}

#[test]
fn what_is_stored_outlasts_a_short_step() {
    assert_eq!(played("L", 2), "00110000");
    assert_eq!(played("D", 2), "00000000");
    assert_eq!(played("SD", 2), "00000111");
    assert_eq!(played("DS", 2), "00000000");
    assert_eq!(played("SL", 2), "00111000");
}

#[test]
fn resetting_ends_what_is_stored_and_wins() {
    for qualifier in ["S", "SD", "DS", "SL"] {
        let chart = single(vec![association(1, qualifier, 0), association(2, "R", 0)]);
        let mut machine = Machine::new(&chart);
        machine.cycle(&[1, 0]);
        let first = machine.get(4);
        machine.cycle(&[0, 1]);
        assert_eq!((machine.get(4), machine.active(&chart)), (0, vec!["Done".to_owned()]), "{qualifier}");
        machine.cycle(&[0, 0, 1]);
        assert_eq!(machine.get(4), 0, "{qualifier} stays reset");
        assert_eq!(first, u64::from(qualifier != "SL"), "{qualifier} with no time");
    }
}

#[test]
fn simultaneous_branches_part_and_wait_for_each_other() {
    let chart = Chart {
        steps: ["Start", "Left", "Right", "LeftDone"].map(step).to_vec(),
        transitions: vec![transition(&[0], &[1, 2], 0), transition(&[1], &[3], 1), transition(&[3, 2], &[0], 2)],
        actions: Vec::new(),
    };
    let mut machine = Machine::new(&chart);
    let mut seen = Vec::new();
    for inputs in [[0, 1, 1], [1, 1, 1], [0, 0, 1], [0, 1, 0], [0, 0, 0], [0, 0, 1]] {
        machine.cycle(&inputs);
        seen.push(machine.active(&chart).join("+"));
    }
    assert_eq!(seen, ["Start", "Left+Right", "Left+Right", "Right+LeftDone", "Right+LeftDone", "Start"]);
}

#[test]
fn of_alternative_branches_the_first_one_is_taken_unless_priorities_say_otherwise() {
    let mut chart = Chart {
        steps: ["Start", "A", "B"].map(step).to_vec(),
        transitions: vec![transition(&[0], &[1], 0), transition(&[0], &[2], 1)],
        actions: Vec::new(),
    };
    let taken = |chart: &Chart, inputs: &[u64]| {
        let mut machine = Machine::new(chart);
        machine.cycle(inputs);
        machine.active(chart)
    };
    assert_eq!(taken(&chart, &[1, 1]), ["A"]);
    assert_eq!(taken(&chart, &[0, 1]), ["B"]);
    chart.transitions[0].priority = 2;
    chart.transitions[1].priority = 1;
    assert_eq!(taken(&chart, &[1, 1]), ["B"]);
    assert_eq!(taken(&chart, &[1, 0]), ["A"]);
}

#[test]
fn a_step_is_active_for_a_cycle_at_least() {
    // Both transitions hold from the beginning: one step a cycle.
    let chart = single(vec![association(1, "N", 0)]);
    let mut machine = Machine::new(&chart);
    let mut seen = Vec::new();
    for _ in 0..4 {
        machine.cycle(&[1, 1, 1]);
        seen.push(machine.active(&chart).join("+"));
    }
    assert_eq!(seen, ["Work", "Done", "Start", "Work"]);
}

#[test]
fn a_step_that_is_left_and_entered_at_once_stays_active() {
    let chart = Chart {
        steps: vec![step("Start")],
        transitions: vec![transition(&[0], &[0], 0)],
        actions: vec![driven(4, vec![association(0, "P", 0)])],
    };
    let mut machine = Machine::new(&chart);
    let mut seen = Vec::new();
    for _ in 0..3 {
        machine.cycle(&[1]);
        seen.push((machine.active(&chart).len(), machine.get(4), machine.get(machine.slots[&time_key("Start")])));
    }
    assert_eq!(seen, [(1, 1, 0), (1, 0, 10), (1, 0, 20)]);
}

#[test]
fn step_times_stand_when_the_step_is_left() {
    let chart = single(Vec::new());
    let mut machine = Machine::new(&chart);
    let mut seen = Vec::new();
    for inputs in [[1, 0], [0, 0], [0, 0], [0, 1], [0, 0]] {
        machine.cycle(&inputs);
        seen.push(machine.get(machine.slots[&time_key("Work")]));
    }
    assert_eq!(seen, [0, 10, 20, 20, 20]);
}

#[test]
fn bodies_run_once_more_when_they_go_off_and_pulses_once_only() {
    let runs = |qualifier: &str| {
        let sum = Expr {
            kind: ExprKind::Apply(
                Op::Add,
                vec![
                    Expr { kind: ExprKind::Read(at(8)), scalar: COUNT, place: None },
                    Expr { kind: ExprKind::Const(1), scalar: COUNT, place: None },
                ],
            ),
            scalar: COUNT,
            place: None,
        };
        let kind = StatementKind::Assign { target: at(8), value: sum, range: None };
        let mut chart = single(vec![association(1, qualifier, 0)]);
        chart.actions[0].target = Target::Body(vec![Statement { kind, place: None }]);
        let mut machine = Machine::new(&chart);
        for inputs in [[0, 0], [1, 0], [0, 0], [0, 0], [0, 1], [0, 0]] {
            machine.cycle(&inputs);
        }
        machine.get(8)
    };
    // Three cycles in the step.
    assert_eq!(runs("N"), 4);
    assert_eq!(runs("P"), 2);
    assert_eq!(runs("P1"), 1);
    assert_eq!(runs("P0"), 1);
}
