//! Charts in text, from the source to the interpreter.

use std::collections::BTreeMap;

use rungbook::config::{ConfigFile, Settings};
use rungbook::machine::elaborate::{Options, elaborate};
use rungbook::machine::interpret::Interpreter;
use rungbook::machine::program::{Program, SlotId};
use rungbook::pipeline;
use rungbook::source::Memory;

fn program(text: &str) -> Result<Program, Vec<String>> {
    let settings = Settings::new(ConfigFile::default()).expect("the defaults");
    let fs = Memory::new().with("unit.st", text.as_bytes());
    let project = pipeline::read(&fs, "test", &settings, &|_| {});
    let (unit, _) = project.catalogue.iter().find(|(_, item)| item.name == "FB_Chart").expect("the block");
    let made = elaborate(&project.catalogue, &project.names, unit, &Options::default());
    made.map_err(|list| list.into_iter().map(|one| one.message).collect())
}

/// Runs cycles with inputs by name; the values of `outputs` after each, as one line.
fn run(program: &Program, cycles: &[&[(&str, u64)]], outputs: &[&str]) -> Vec<String> {
    let slots: BTreeMap<&str, SlotId> = program.variables.iter().map(|v| (v.path.as_str(), v.slot)).collect();
    let mut run = Interpreter::new(program);
    let mut seen = Vec::new();
    for inputs in cycles {
        for (name, value) in *inputs {
            run.set(slots[name], *value);
        }
        run.cycle().expect("no fault");
        let values: Vec<String> = outputs.iter().map(|name| run.get(slots[name]).to_string()).collect();
        seen.push(values.join(" "));
    }
    seen
}

const CHART: &str = "\
FUNCTION_BLOCK FB_Chart
VAR_INPUT
    Go   : BOOL;
    Stop : BOOL;
END_VAR
VAR_OUTPUT
    Lamp    : BOOL;
    Late    : BOOL;
    Count   : INT;
    Working : BOOL;
    Passed  : TIME;
END_VAR

INITIAL_STEP Start:
END_STEP

STEP Work:
    Lamp(N);
    Late(D, T#20ms);
    Counting(N);
END_STEP

TRANSITION FROM Start TO Work := Go;
END_TRANSITION

TRANSITION FROM Work TO Start := Stop AND Work.T >= T#30ms;
END_TRANSITION

ACTION Counting:
    Count := Count + 1;
    Working := Work.X;
    Passed := Work.T;
END_ACTION
END_FUNCTION_BLOCK
";

#[test]
fn a_chart_in_text_runs() {
    let program = program(CHART).expect("supported");
    let cycles: [&[(&str, u64)]; 7] = [&[], &[("Go", 1)], &[("Go", 0), ("Stop", 1)], &[], &[], &[], &[]];
    let seen = run(&program, &cycles, &["Lamp", "Late", "Count", "Working", "Passed"]);
    // The step's time as the transition sees it is that of the cycle before, so the step lasts five cycles.
    let expected = ["0 0 0 0 0", "1 0 1 1 0", "1 0 2 1 10", "1 1 3 1 20", "1 1 4 1 30", "0 0 5 0 30", "0 0 5 0 30"];
    assert_eq!(seen, expected);
}

#[test]
fn two_instances_have_charts_of_their_own() {
    let outer = CHART.replace("FB_Chart", "FB_Inner")
        + "FUNCTION_BLOCK FB_Chart\nVAR_INPUT Go : BOOL; END_VAR\nVAR_OUTPUT A : BOOL; B : BOOL; END_VAR\n\
           VAR One : FB_Inner; Two : FB_Inner; END_VAR\n\
           One(Go := Go);\nTwo(Go := NOT Go);\nA := One.Late;\nB := Two.Late;\nEND_FUNCTION_BLOCK\n";
    let program = program(&outer).expect("supported");
    let cycles: [&[(&str, u64)]; 4] = [&[("Go", 1)], &[], &[], &[]];
    assert_eq!(run(&program, &cycles, &["A", "B"]), ["0 0", "0 0", "1 0", "1 0"]);
}

#[test]
fn what_a_chart_may_not_say_is_told() {
    let told = |from: &str, to: &str| program(&CHART.replace(from, to)).expect_err("unsupported").join("; ");
    assert!(told("Lamp(N)", "Lamp(X)").contains("`X` is no action qualifier"));
    assert!(told("Late(D, T#20ms)", "Late(D)").contains("needs a time"));
    assert!(told("FROM Start TO Work", "FROM Start TO Nowhere").contains("no step `Nowhere`"));
    assert!(told("INITIAL_STEP", "STEP").contains("0 initial steps"));
    assert!(told("    Lamp(N);", "    Count(N);").contains("neither an action nor a Boolean variable"));
}

/// A step may name an action of an instance, and a variable of it, by their paths; each instance's own.
#[test]
fn steps_drive_what_instances_have() {
    let text = "FUNCTION_BLOCK FB_Valve\nVAR_OUTPUT Turns : INT; Open : BOOL; END_VAR\n\
                ACTION Turn: Turns := Turns + 1; END_ACTION\nEND_FUNCTION_BLOCK\n\
                FUNCTION_BLOCK FB_Chart\nVAR_INPUT Go : BOOL; END_VAR\n\
                VAR_OUTPUT First : INT; Second : INT; Open : BOOL; END_VAR\nVAR One : FB_Valve; Two : FB_Valve; END_VAR\n\
                INITIAL_STEP Start: One.Turn(N); END_STEP\nSTEP Work: Two.Turn(N); Two.Open(N); Show(N); END_STEP\n\
                TRANSITION FROM Start TO Work := Go; END_TRANSITION\n\
                ACTION Show: First := One.Turns; Second := Two.Turns; Open := Two.Open; END_ACTION\n\
                END_FUNCTION_BLOCK\n";
    let chart = program(text).expect("supported");
    let cycles: [&[(&str, u64)]; 4] = [&[], &[("Go", 1)], &[], &[]];
    let seen = run(&chart, &cycles, &["First", "Second", "Open"]);
    // An action runs once more in the cycle in which its step is left.
    assert_eq!(seen, ["0 0 0", "2 1 1", "2 2 1", "2 3 1"]);
    let told = program(&text.replace("Two.Open(N)", "Two.Turns(N)")).expect_err("no Boolean").join("; ");
    assert!(told.contains("`Two.Turns` is neither an action nor a Boolean variable"), "{told}");
}
