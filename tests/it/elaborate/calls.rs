//! Functions in expressions: order, nesting, outputs.

use super::Machine;

const TRACE: &str = "
VAR_GLOBAL Log : DINT; END_VAR
FUNCTION Note : INT
VAR_INPUT n : INT; END_VAR
Log := Log * 10 + n;
Note := n;
END_FUNCTION
";

fn log(body: &str) -> (i128, i128) {
    let text = format!(
        "{TRACE}FUNCTION_BLOCK FB\nVAR_OUTPUT x : DINT; END_VAR\nVAR t : ARRAY[0..9] OF DINT; b : BOOL; END_VAR\n{body}\nEND_FUNCTION_BLOCK"
    );
    let mut machine = Machine::new(&text, "FB");
    machine.cycle();
    (machine.get("a.Log"), machine.get("x"))
}

#[test]
fn calls_are_made_from_left_to_right() {
    assert_eq!(log("x := Note(1) - Note(2) * Note(3);"), (123, -5));
    assert_eq!(log("x := Note(Note(1) + Note(2)) + Note(4);"), (1234, 7));
    assert_eq!(log("x := MAX(Note(1), Note(5), Note(3));"), (153, 5));
    assert_eq!(log("t[Note(3)] := Note(7); x := t[3];"), (37, 7));
}

#[test]
fn what_a_call_changes_is_read_where_it_stands() {
    assert_eq!(log("x := Log + Note(5) + Log;"), (5, 10));
    assert_eq!(log("Log := 1; x := Log * 100 + Note(2);"), (12, 102));
}

#[test]
fn short_circuit_leaves_calls_out() {
    assert_eq!(log("b := FALSE AND_THEN Note(1) = 1; b := TRUE OR_ELSE Note(2) = 2;").0, 0);
    assert_eq!(log("b := TRUE AND_THEN Note(1) = 1 AND_THEN Note(2) = 0; b := b OR_ELSE Note(3) = 3;").0, 123);
    assert_eq!(log("b := FALSE AND Note(1) = 1;").0, 1);
}

#[test]
fn conditions_of_loops_call_each_time() {
    assert_eq!(log("WHILE Note(1) = 1 AND x < 2 DO x := x + 1; END_WHILE"), (111, 2));
    assert_eq!(log("REPEAT x := x + 1; UNTIL Note(2) = 2 AND x > 1 END_REPEAT"), (22, 2));
    assert_eq!(
        log("IF Note(1) = 2 THEN x := 1; ELSIF Note(2) = 2 THEN x := 2; ELSIF Note(3) = 3 THEN x := 3; END_IF"),
        (12, 2)
    );
}

#[test]
fn outputs_defaults_and_enable() {
    let text = "
FUNCTION Divide : INT
VAR_INPUT a : INT; b : INT := 2; END_VAR
VAR_OUTPUT rest : INT; END_VAR
Divide := a / b;
rest := a MOD b;
END_FUNCTION
FUNCTION_BLOCK FB
VAR_INPUT on : BOOL; END_VAR
VAR_OUTPUT q : INT; r : INT; bit : BYTE; ok : BOOL; END_VAR
q := Divide(a := 7, rest => r);
q := q * 10 + Divide(9, 4);
Divide(EN := on, a := 100, rest => r, ENO => ok);
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("q"), machine.get("r"), machine.get("ok")), (32, 1, 0));
    machine.set("on", 1).cycle();
    assert_eq!((machine.get("r"), machine.get("ok")), (0, 1));
}

#[test]
fn functions_give_structures_and_strings() {
    let text = "
TYPE Pair : STRUCT a : INT; b : INT; END_STRUCT; END_TYPE
FUNCTION Make : Pair
VAR_INPUT a : INT; END_VAR
Make.a := a; Make.b := a + 1;
END_FUNCTION
FUNCTION Greet : STRING(20)
VAR_INPUT name : STRING(10); END_VAR
Greet := CONCAT('hi ', name);
END_FUNCTION
FUNCTION_BLOCK FB
VAR p : Pair; END_VAR
VAR_OUTPUT same : BOOL; n : INT; b : INT; END_VAR
p := Make(4);
b := Make(6).b;
same := Greet('you') = CONCAT(Greet(''), 'you');
n := LEN(Greet('all'));
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("p.a"), machine.get("p.b"), machine.get("b")), (4, 5, 7));
    assert_eq!((machine.get("same"), machine.get("n")), (1, 6));
}
