//! Statements and operators.

use rungbook::machine::program::Role;
use rungbook::semantics::expr::Fault;

use super::{Machine, eval};

#[test]
fn expressions_have_the_widths_of_their_operands() {
    assert_eq!(eval("DINT", "SINT#127 + SINT#1"), -128);
    assert_eq!(eval("DINT", "INT#127 + SINT#1"), 128);
    assert_eq!(eval("INT", "-7 / 2"), -3);
    assert_eq!(eval("INT", "INT#-7 MOD INT#2"), -1);
    assert_eq!(eval("WORD", "16#F0F0 AND NOT WORD#16#00F0"), 0xF000);
    assert_eq!(eval("BOOL", "NOT (TRUE XOR TRUE) AND (1 < 2)"), 1);
    assert_eq!(eval("TIME", "T#1s + T#500ms * 2"), 2_000);
    assert_eq!(eval("INT", "LIMIT(0, MAX(INT#3, INT#9), 5)"), 5);
    assert_eq!(eval("INT", "SEL(G := TRUE, IN0 := INT#1, IN1 := INT#2)"), 2);
    assert_eq!(eval("DINT", "TRUNC(2.9) + REAL_TO_INT(2.5)"), 4);
    assert_eq!(eval("INT", "2 + 3 * 4 - 10 / 5"), 12);
}

#[test]
fn loops_end_where_they_should() {
    let text = "
FUNCTION F : INT
VAR_INPUT n : INT; END_VAR
VAR i : INT; j : INT; k : INT; END_VAR
FOR i := 1 TO n DO
    IF i = 3 THEN CONTINUE; END_IF
    IF i = 6 THEN EXIT; END_IF
    F := F + i;
END_FOR
FOR i := 10 TO 1 BY -3 DO j := j + 1; END_FOR
WHILE k < 5 DO k := k + 1; END_WHILE
REPEAT k := k + 10; UNTIL k > 30 END_REPEAT
F := F + 100 * j + k * 1;
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").set("n", 100).cycle().get("F"), 1 + 2 + 4 + 5 + 400 + 35);
    assert_eq!(Machine::new(text, "F").set("n", 0).cycle().get("F"), 435);
}

#[test]
fn case_takes_the_first_arm_that_fits() {
    let text = "
TYPE Mode : (Off, Slow := 5, Fast); END_TYPE
FUNCTION F : INT
VAR_INPUT m : Mode; x : INT; END_VAR
VAR CONSTANT TWO : INT := 2; END_VAR
CASE m OF
    Off: F := 1;
    Mode.Slow, Mode#Fast: F := 2;
END_CASE
CASE x OF
    -5..-1: F := F + 10;
    1, TWO, 3 + 1: F := F + 20;
ELSE
    F := F + 30;
END_CASE
END_FUNCTION
";
    let run = |m, x| Machine::new(text, "F").set("m", m).set("x", x).cycle().get("F");
    assert_eq!([run(0, -5), run(5, 2), run(6, 4), run(1, 0), run(0, 7)], [11, 22, 22, 30, 31]);
    let machine = Machine::new(text, "F");
    let values: Vec<&Vec<u64>> = machine.program.enumerations.values().collect();
    assert_eq!(values, [&vec![0, 5, 6]]);
}

#[test]
fn faults_stop_the_run() {
    let division = "FUNCTION F : INT VAR_INPUT a : INT; END_VAR F := 10 / a; END_FUNCTION";
    assert_eq!(Machine::new(division, "F").set("a", 0).fault(), Fault::DivisionByZero);
    let index =
        "FUNCTION F : INT VAR_INPUT a : INT; END_VAR VAR t : ARRAY[1..3] OF INT; END_VAR t[a] := 1; END_FUNCTION";
    assert_eq!(Machine::new(index, "F").set("a", 4).fault(), Fault::IndexOutOfBounds);
    Machine::new(index, "F").set("a", 3).cycle();
    let range = "FUNCTION F : INT VAR_INPUT a : INT; END_VAR VAR r : INT (0..9); END_VAR r := a; END_FUNCTION";
    assert_eq!(Machine::new(range, "F").set("a", 10).fault(), Fault::SubrangeViolation);
    let endless = "FUNCTION F : INT WHILE TRUE DO F := 1; END_WHILE END_FUNCTION";
    assert_eq!(Machine::new(endless, "F").fault(), Fault::LoopLimit);
}

#[test]
fn and_evaluates_both_sides_and_and_then_one() {
    let text = "
FUNCTION F : BOOL
VAR_INPUT a : INT; short : BOOL; END_VAR
IF short THEN
    F := a <> 0 AND_THEN 10 / a > 2;
ELSE
    F := a <> 0 AND 10 / a > 2;
END_IF
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").set("a", 0).set("short", 1).cycle().get("F"), 0);
    assert_eq!(Machine::new(text, "F").set("a", 0).set("short", 0).fault(), Fault::DivisionByZero);
}

#[test]
fn bits_are_read_and_written() {
    let text = "
FUNCTION F : BYTE
VAR_INPUT b : BYTE; END_VAR
VAR CONSTANT HIGH : INT := 7; END_VAR
VAR w : WORD; END_VAR
F := b;
F.0 := NOT b.0;
F.HIGH := b.%X1;
w.15 := TRUE;
IF w <> 16#8000 THEN F := 0; END_IF
END_FUNCTION
";
    let run = |b| Machine::new(text, "F").set("b", b).cycle().get("F");
    assert_eq!(run(0b0000_0010), 0b1000_0011);
    assert_eq!(run(0b1000_0101), 0b0000_0100);
}

#[test]
fn chained_and_conditional_assignments() {
    let text = "
FUNCTION F : INT
VAR_INPUT go : BOOL; END_VAR
VAR a : INT; b : DINT; s : BOOL; r : BOOL := TRUE; END_VAR
a := b := 7;
s S= go;
r R= go;
IF (a := 8) = 8 THEN b := b + 1; END_IF
F := a * 100 + DINT_TO_INT(b) * 10 + BOOL_TO_INT(s) * 2 + BOOL_TO_INT(r);
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").set("go", 1).cycle().get("F"), 882);
    assert_eq!(Machine::new(text, "F").set("go", 0).cycle().get("F"), 881);
}

#[test]
fn strings() {
    let text = "
FUNCTION F : INT
VAR_INPUT n : INT; END_VAR
VAR a : STRING(10) := 'ab'; b : STRING(4); c : STRING; END_VAR
b := CONCAT(a, 'cdef');
IF b = 'abcd' THEN F := F + 1; END_IF
IF LEFT(b, n) = 'ab' AND RIGHT(b, 2) <> 'ab' THEN F := F + 2; END_IF
c := MID(b, 2, 2);
IF c = 'bc' AND 'a' < c THEN F := F + 4; END_IF
F := F + 10 * LEN(a) + 100 * FIND(b, 'cd');
IF b[0] = 'a' THEN F := F + 1000; END_IF
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").set("n", 2).cycle().get("F"), 1327);
}

#[test]
fn siemens_names_and_regions() {
    let text = "
FUNCTION_BLOCK \"Motor Control\"
VAR_INPUT Start : BOOL; END_VAR
VAR_OUTPUT Run : BOOL; END_VAR
VAR Count : INT; END_VAR
BEGIN
REGION Logic
    #Run := #Start;
    IF #Run THEN #Count += 2; END_IF;
END_REGION
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "Motor Control");
    machine.set("Start", 1).cycle().cycle();
    assert_eq!((machine.get("Run"), machine.get("Count")), (1, 4));
    assert!(machine.program.variables.iter().any(|variable| variable.role == Role::State));
}

#[test]
fn integers_become_strings_and_back() {
    let text = "
FUNCTION F : BOOL
VAR_INPUT n : INT; END_VAR
VAR b : BYTE := 255; s : STRING; END_VAR
s := CONCAT('n = ', INT_TO_STRING(n));
F := s = 'n = -120' AND TO_STRING(b) = '255' AND BOOL_TO_STRING(n < 0) = 'TRUE'
    AND STRING_TO_INT(' -42x') = -42 AND STRING_TO_DINT('') = 0 AND STRING_TO_INT(INT_TO_STRING(n)) = n;
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").set("n", -120).cycle().get("F"), 1);
}

#[test]
fn a_pointer_with_an_index_and_characters_as_labels() {
    let text = "
FUNCTION F : INT
VAR t : ARRAY[0..3] OF INT := [1, 2, 3, 4]; p : POINTER TO INT; s : STRING := 'b'; END_VAR
p := ADR(t[1]);
p[1] := p[2] * 10;
CASE s[0] OF
    'a': F := 0;
    'b'..'d', 'x': F := t[2];
END_CASE
END_FUNCTION
";
    let text = text.replace("'b'..'d', 'x'", "'x', 'b'");
    assert_eq!(Machine::new(&text, "F").cycle().get("F"), 40);
}
