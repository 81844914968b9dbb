//! Blocks as a whole: the cycle, states, standard blocks, time, what the variables are for.

use rungbook::machine::elaborate::{Options, Stub};
use rungbook::machine::program::Role;

use super::{Machine, with};

const COUNTER: &str = "
FUNCTION_BLOCK FB_Counter
VAR_INPUT Up : BOOL; Limit : INT := 3; END_VAR
VAR_OUTPUT Count : INT; Full : BOOL; END_VAR
VAR Before : BOOL; END_VAR
IF Up AND NOT Before AND Count < Limit THEN
    Count := Count + 1;
END_IF
Full := Count >= Limit;
Before := Up;
END_FUNCTION_BLOCK
";

#[test]
fn a_block_keeps_its_state_from_cycle_to_cycle() {
    let mut machine = Machine::new(COUNTER, "FB_Counter");
    let mut seen = Vec::new();
    for up in [1, 1, 0, 1, 0, 1, 0, 1] {
        machine.set("Up", up).cycle();
        seen.push(machine.get("Count"));
    }
    assert_eq!(seen, [1, 1, 1, 2, 2, 3, 3, 3]);
    assert_eq!(machine.get("Full"), 1);
    assert_eq!(machine.get("Before"), 1);
}

#[test]
fn roles_say_who_sets_what() {
    let machine = Machine::new(COUNTER, "FB_Counter");
    let roles: Vec<(&str, Role)> = machine.program.variables.iter().map(|v| (v.path.as_str(), v.role)).collect();
    assert_eq!(
        roles,
        [
            ("Up", Role::Input),
            ("Limit", Role::Input),
            ("Count", Role::Output),
            ("Full", Role::Output),
            ("Before", Role::State)
        ]
    );
    for variable in &machine.program.variables {
        assert_eq!(machine.program.slots[variable.slot.0 as usize].role, variable.role, "{}", variable.path);
    }
}

#[test]
fn timers_see_the_cycle_time() {
    let text = "
FUNCTION_BLOCK FB_Delay
VAR_INPUT In : BOOL; END_VAR
VAR_OUTPUT Out : BOOL; Passed : TIME; END_VAR
VAR Timer : TON := (PT := T#30ms); END_VAR
Timer(IN := In);
Out := Timer.Q;
Passed := Timer.ET;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB_Delay");
    machine.set("In", 1);
    let mut seen = Vec::new();
    for _ in 0..5 {
        machine.cycle();
        seen.push((machine.get("Out"), machine.get("Passed")));
    }
    assert_eq!(seen, [(0, 0), (0, 10), (0, 20), (1, 30), (1, 30)]);
    let options = Options { cycle_time: 30_000_000, ..Options::default() };
    let mut slow = Machine::with(text, "FB_Delay", &options);
    slow.set("In", 1).cycle().cycle();
    assert_eq!(slow.get("Out"), 1);
}

#[test]
fn time_is_cycles_times_cycle_time() {
    let text =
        "FUNCTION_BLOCK FB\nVAR_OUTPUT t : TIME; l : LTIME; END_VAR\nt := TIME(); l := LTIME();\nEND_FUNCTION_BLOCK";
    let mut machine = Machine::new(text, "FB");
    machine.cycle().cycle().cycle();
    assert_eq!((machine.get("t"), machine.get("l")), (30, 30_000_000));
}

#[test]
fn a_block_of_the_project_wins_over_the_standard_one() {
    let text = "
FUNCTION_BLOCK R_TRIG
VAR_INPUT CLK : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
Q := TRUE;
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB
VAR Edge : R_TRIG; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
Edge(CLK := FALSE, Q => Q);
END_FUNCTION_BLOCK
";
    assert_eq!(Machine::new(text, "FB").cycle().get("Q"), 1);
}

#[test]
fn calls_that_leave_inputs_out_keep_them() {
    let text = "
FUNCTION_BLOCK FB_Sum
VAR_INPUT a : INT; b : INT; END_VAR
VAR_OUTPUT s : INT; END_VAR
s := s + a + b;
END_FUNCTION_BLOCK
PROGRAM Main
VAR Sum : FB_Sum; END_VAR
VAR_OUTPUT First : INT; Second : INT; END_VAR
Sum(a := 1, b := 10, s => First);
Sum(a := 2);
Second := Sum.s;
END_PROGRAM
";
    let mut machine = Machine::new(text, "Main");
    machine.cycle();
    assert_eq!((machine.get("First"), machine.get("Second")), (11, 23));
    machine.cycle();
    assert_eq!((machine.get("First"), machine.get("Second")), (34, 46));
    assert_eq!(machine.get("Sum.a"), 2);
}

#[test]
fn edges_of_inputs_last_one_call() {
    let text = "
FUNCTION_BLOCK FB
VAR_INPUT Up : BOOL R_EDGE; Down : BOOL F_EDGE; END_VAR
VAR_OUTPUT Ups : INT; Downs : INT; END_VAR
IF Up THEN Ups := Ups + 1; END_IF
IF Down THEN Downs := Downs + 1; END_IF
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    for value in [0, 1, 1, 0, 0, 1, 0] {
        machine.set("Up", value).set("Down", value).cycle();
    }
    assert_eq!((machine.get("Ups"), machine.get("Downs")), (2, 2));
}

#[test]
fn globals_that_are_only_read_are_inputs() {
    let text = "
VAR_GLOBAL
    Speed : INT := 7;
    Alarm : BOOL;
    Sensor AT %IX0.3 : BOOL;
    Lamp AT %QX0.1 : BOOL;
END_VAR
VAR_GLOBAL CONSTANT
    MAX_SPEED : INT := 5;
END_VAR
FUNCTION_BLOCK FB
VAR_EXTERNAL Speed : INT; END_VAR
Alarm := Speed > MAX_SPEED;
Lamp := Sensor AND %IX1.0;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    let role = |machine: &Machine, path: &str| {
        machine.program.variables.iter().find(|variable| variable.path == path).map(|variable| variable.role)
    };
    assert_eq!(role(&machine, "a.Speed"), Some(Role::Input));
    assert_eq!(role(&machine, "a.Alarm"), Some(Role::Output));
    assert_eq!(role(&machine, "%IX0.3"), Some(Role::Input));
    assert_eq!(role(&machine, "%QX0.1"), Some(Role::Output));
    machine.cycle();
    assert_eq!(machine.get("a.Alarm"), 1);
    machine.set("a.Speed", 5).set("%IX0.3", 1).set("%IX1.0", 1).cycle();
    assert_eq!((machine.get("a.Alarm"), machine.get("%QX0.1")), (0, 1));
}

#[test]
fn constants_are_overridden_and_said() {
    let text = "
FUNCTION_BLOCK FB
VAR CONSTANT N : INT := 3; END_VAR
VAR_OUTPUT Size : INT; List : ARRAY[1..N] OF INT; END_VAR
Size := N;
END_FUNCTION_BLOCK
";
    let constants = [("FB.N".to_owned(), "5".to_owned())].into();
    let mut machine = Machine::with(text, "FB", &Options { constants, ..Options::default() });
    assert_eq!(machine.cycle().get("Size"), 5);
    assert_eq!(machine.get("List[5]"), 0);
    assert_eq!(machine.program.assumptions, ["`N` is 5"]);
}

#[test]
fn a_stub_stands_for_a_block_without_source() {
    let text = "
FUNCTION_BLOCK FB
VAR Vendor : FB_Vendor; END_VAR
VAR_OUTPUT Done : BOOL; END_VAR
Vendor(Go := TRUE, Done => Done);
END_FUNCTION_BLOCK
";
    let (_, missing) = with(text, "FB", &Options::default());
    let missing = missing.expect_err("no source");
    assert_eq!(missing[0].construct, "a type without source");
    let stub = "FUNCTION_BLOCK FB_Vendor VAR_INPUT Go : BOOL; END_VAR VAR_OUTPUT Done : BOOL; END_VAR
Done := Go; END_FUNCTION_BLOCK";
    let stubs = vec![Stub { text: stub.to_owned(), arbitrary: false }];
    let mut machine = Machine::with(text, "FB", &Options { stubs, ..Options::default() });
    assert_eq!(machine.cycle().get("Done"), 1);
    assert_eq!(machine.program.assumptions, ["`FB_Vendor` is a stub"]);
    let stubs = vec![Stub { text: stub.to_owned(), arbitrary: true }];
    let machine = Machine::with(text, "FB", &Options { stubs, ..Options::default() });
    let arbitrary = machine.program.slots.iter().filter(|slot| slot.role == Role::Arbitrary).count();
    assert_eq!(arbitrary, 1);
    assert_eq!(machine.program.assumptions, ["the outputs of `FB_Vendor` are arbitrary"]);
}

#[test]
fn conditional_pragmas_leave_statements_out() {
    let text = "
FUNCTION_BLOCK FB
VAR_OUTPUT x : INT; END_VAR
{IF defined (Fast)}
x := 1;
{ELSE}
x := 2;
{END_IF}
END_FUNCTION_BLOCK
";
    assert_eq!(Machine::new(text, "FB").cycle().get("x"), 2);
    let symbols = ["FAST".to_owned()].into();
    assert_eq!(Machine::with(text, "FB", &Options { symbols, ..Options::default() }).cycle().get("x"), 1);
}
