//! Methods, properties, inheritance, interfaces, actions.

use super::Machine;

const SHAPES: &str = "
INTERFACE I_Shape
METHOD Area : INT
VAR_INPUT scale : INT; END_VAR
END_METHOD
PROPERTY Name : INT
GET
END_GET
END_PROPERTY
END_INTERFACE
FUNCTION_BLOCK FB_Square IMPLEMENTS I_Shape
VAR side : INT := 3; calls : INT; END_VAR
METHOD Area : INT
VAR_INPUT scale : INT; END_VAR
calls := calls + 1;
Area := side * side * scale;
END_METHOD
PROPERTY Name : INT
GET
Name := 1;
END_GET
END_PROPERTY
PROPERTY Side : INT
GET
Side := side;
END_GET
SET
side := Side;
END_SET
END_PROPERTY
METHOD Twice : INT
Twice := THIS^.Area(2);
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Cube EXTENDS FB_Square
VAR extra : INT; END_VAR
METHOD Area : INT
VAR_INPUT scale : INT; END_VAR
Area := SUPER^.Area(scale := scale) * 6;
extra := extra + 1;
END_METHOD
PROPERTY Name : INT
GET
Name := 2;
END_GET
END_PROPERTY
END_FUNCTION_BLOCK
";

fn run(body: &str) -> Machine {
    let text = format!("{SHAPES}
FUNCTION_BLOCK FB
VAR sq : FB_Square; cu : FB_Cube; any : I_Shape; p : POINTER TO FB_Square; i : INT; n : INT; list : ARRAY[1..2] OF FB_Square; END_VAR
VAR_OUTPUT x : INT; y : INT; END_VAR
{body}
END_FUNCTION_BLOCK");
    let mut machine = Machine::new(&text, "FB");
    machine.cycle();
    machine
}

#[test]
fn methods_run_on_their_instances() {
    let machine = run("x := sq.Area(1); y := list[2].Area(scale := 2); sq.Side := 4; i := sq.Side;");
    assert_eq!((machine.get("x"), machine.get("y"), machine.get("i")), (9, 18, 4));
    assert_eq!((machine.get("sq.calls"), machine.get("list[2].calls"), machine.get("list[1].calls")), (1, 1, 0));
}

#[test]
fn inherited_methods_call_what_is_overridden() {
    let machine = run("x := sq.Twice(); y := cu.Twice();");
    assert_eq!((machine.get("x"), machine.get("y")), (18, 108));
    assert_eq!((machine.get("cu.extra"), machine.get("cu.calls")), (1, 1));
}

#[test]
fn interfaces_call_by_the_class_of_the_instance() {
    let machine =
        run("any := sq; x := any.Area(1) * 10 + any.Name; any := cu; y := any.Area(scale := 1) * 10 + any.Name;");
    assert_eq!((machine.get("x"), machine.get("y")), (91, 542));
}

#[test]
fn pointers_to_a_base_call_by_the_class_of_the_instance() {
    let machine =
        run("p := ADR(sq); x := p^.Area(1); p := ADR(cu); y := p^.Area(1); n := p^.side; p^.Side := 5; i := cu.Side;");
    assert_eq!((machine.get("x"), machine.get("y"), machine.get("n"), machine.get("i")), (9, 54, 3, 5));
}

#[test]
fn bodies_of_bases_actions_and_programs() {
    let text = "
FUNCTION_BLOCK FB_Base
VAR_INPUT step : INT := 1; END_VAR
VAR_OUTPUT n : INT; END_VAR
n := n + step;
Double();
ACTION Double:
n := n * 2;
END_ACTION
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
VAR_OUTPUT m : INT; END_VAR
SUPER^();
m := THIS^.n + 1;
END_FUNCTION_BLOCK
PROGRAM Other
VAR_INPUT a : INT; END_VAR
VAR_OUTPUT b : INT; END_VAR
b := b + a;
END_PROGRAM
PROGRAM Main
VAR d : FB_Derived; END_VAR
VAR_OUTPUT x : INT; y : INT; END_VAR
d(step := 3);
x := d.n * 10 + d.m;
d.Double();
y := d.n;
Other(a := 5);
Other(a := 6);
y := y * 100 + Other.b;
END_PROGRAM
";
    let mut machine = Machine::new(text, "Main");
    machine.cycle();
    assert_eq!((machine.get("x"), machine.get("y")), (67, 1211));
}

#[test]
fn constructors_run_before_the_first_cycle() {
    let text = "
FUNCTION_BLOCK FB_Axis
VAR number : INT; ready : BOOL; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; no : INT; END_VAR
number := no;
ready := TRUE;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB
VAR a : FB_Axis(no := 7); b : FB_Axis(9); END_VAR
VAR_OUTPUT x : INT; END_VAR
x := a.number * 10 + b.number;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    assert_eq!(machine.cycle().get("x"), 79);
    assert_eq!(machine.get("b.ready"), 1);
}
