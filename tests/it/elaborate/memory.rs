//! Initial values, structures, arrays, references, unions.

use rungbook::semantics::expr::Fault;

use super::Machine;

#[test]
fn initial_values_of_structures_and_arrays() {
    let text = "
VAR_GLOBAL CONSTANT SIZE : INT := 4; END_VAR
TYPE
    Point : STRUCT x : INT := 1; y : INT; END_STRUCT;
    Celsius : INT := 20;
    Small : INT (5..9);
END_TYPE
FUNCTION_BLOCK FB
VAR
    a : ARRAY[0..SIZE] OF INT := [1, 2(7), 9];
    m : ARRAY[1..2, 1..3] OF INT := [11, 12, 13, 21, 22, 23];
    p : Point := (y := 5);
    q : ARRAY[1..2] OF Point := [(x := 3), (x := 4, y := 4)];
    t : Celsius;
    s : Small;
    r : REAL := 1.5;
    d : TIME := T#2s;
END_VAR
VAR_OUTPUT sum : INT; END_VAR
sum := a[0] + a[1] * 10 + a[2] * 100 + a[3] * 1000 + a[SIZE];
m[2, 1] := m[1, 3];
p.x := q[2].y;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!(machine.get("sum"), 9771);
    assert_eq!((machine.get("m[2,1]"), machine.get("m[2,2]"), machine.get("m[1,1]")), (13, 22, 11));
    assert_eq!((machine.get("p.x"), machine.get("p.y")), (4, 5));
    assert_eq!((machine.get("q[1].x"), machine.get("q[1].y")), (3, 0));
    assert_eq!((machine.get("t"), machine.get("s"), machine.get("d")), (20, 5, 2_000));
    assert_eq!(machine.bits("r"), u64::from(1.5_f32.to_bits()));
}

#[test]
fn structures_and_arrays_are_copied() {
    let text = "
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT; Point3 EXTENDS Point : STRUCT z : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK FB
VAR a : Point := (x := 1, y := 2); b : Point; l : ARRAY[1..2] OF Point; k : ARRAY[1..2] OF Point; c : Point3; END_VAR
b := a;
a.x := 9;
l[2] := a;
k := l;
c.x := 1; c.z := 3;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("b.x"), machine.get("b.y")), (1, 2));
    assert_eq!((machine.get("k[2].x"), machine.get("k[1].x")), (9, 0));
    assert_eq!((machine.get("c.x"), machine.get("c.z")), (1, 3));
}

#[test]
fn pointers_and_references_reach_what_they_refer_to() {
    let text = "
FUNCTION_BLOCK FB
VAR
    a : INT := 3;
    b : INT := 4;
    list : ARRAY[0..3] OF INT := [10, 20, 30, 40];
    p : POINTER TO INT;
    r : REFERENCE TO INT REF= a;
    l : POINTER TO ARRAY[0..3] OF INT;
    e : POINTER TO INT := ADR(list[2]);
END_VAR
VAR_OUTPUT x : INT; y : INT; z : INT; w : INT; valid : BOOL; END_VAR
p := ADR(b);
p^ := p^ + 1;
r := r + 10;
l := ADR(list);
x := l^[1];
y := e^;
valid := __ISVALIDREF(r) AND p <> 0;
r REF= b;
z := r;
w := (e + 2)^;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("a"), machine.get("b")), (13, 5));
    assert_eq!((machine.get("x"), machine.get("y"), machine.get("z")), (20, 30, 5));
    assert_eq!((machine.get("w"), machine.get("valid")), (40, 1));
}

#[test]
fn null_is_a_fault() {
    let text = "FUNCTION F : INT VAR p : POINTER TO INT; END_VAR F := p^; END_FUNCTION";
    assert_eq!(Machine::new(text, "F").fault(), Fault::NullReference);
}

#[test]
fn in_outs_are_the_variable_itself() {
    let text = "
FUNCTION_BLOCK FB_Inc
VAR_IN_OUT v : INT; END_VAR
v := v + 1;
END_FUNCTION_BLOCK
FUNCTION Twice : INT
VAR_IN_OUT v : INT; END_VAR
VAR_INPUT add : INT := 5; END_VAR
v := v * 2;
Twice := add;
END_FUNCTION
FUNCTION_BLOCK FB
VAR Inc : FB_Inc; list : ARRAY[1..3] OF INT; i : INT := 2; n : INT; END_VAR
VAR_IN_OUT own : INT; END_VAR
Inc(v := list[i]);
n := Twice(v := list[i]);
i := 3;
Inc(v := own);
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.set("own", 41).cycle();
    assert_eq!((machine.get("list[2]"), machine.get("n"), machine.get("own")), (2, 5, 42));
}

#[test]
fn a_union_of_one_width_shares_its_slot() {
    let text = "
TYPE Both : UNION u : UINT; s : INT; END_UNION; END_TYPE
FUNCTION F : INT
VAR b : Both; END_VAR
b.u := 65535;
F := b.s;
END_FUNCTION
";
    assert_eq!(Machine::new(text, "F").cycle().get("F"), -1);
}

#[test]
fn temporaries_are_set_anew_and_statics_stay() {
    let text = "
FUNCTION Next : INT
VAR_STAT n : INT := 5; END_VAR
VAR fresh : INT := 1; END_VAR
n := n + fresh;
fresh := 100;
Next := n;
END_FUNCTION
FUNCTION_BLOCK FB
VAR_TEMP t : INT; END_VAR
VAR_OUTPUT x : INT; y : INT; END_VAR
t := t + 1;
x := t;
y := Next() + Next();
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle().cycle();
    assert_eq!((machine.get("x"), machine.get("y")), (1, 17));
}

#[test]
fn a_data_block_is_a_variable_of_its_type() {
    let text = "
TYPE \"Limits\"
STRUCT low : INT := 3; high : INT; END_STRUCT;
END_TYPE
DATA_BLOCK \"DB\"
\"Limits\"
BEGIN
END_DATA_BLOCK
FUNCTION_BLOCK \"FB\"
VAR_OUTPUT x : INT; END_VAR
BEGIN
#x := \"DB\".low + 1;
\"DB\".high := #x;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("x"), machine.get("DB.high")), (4, 4));
}

/// What has no members takes no memory, and nothing that stands beside it is lost.
#[test]
fn structures_without_members() {
    let text = "
TYPE
    Nothing : STRUCT END_STRUCT;
    Encoder : STRUCT count : ULINT := 7; status : Nothing; more : ARRAY[1..3] OF Nothing; ref : ULINT := 4; END_STRUCT;
END_TYPE
FUNCTION_BLOCK FB
VAR first : Nothing; a : Encoder; b : Encoder; last : INT := 3; END_VAR
VAR_OUTPUT d : LINT; END_VAR
b.ref := a.count + 1;
d := ULINT_TO_LINT(b.count) - ULINT_TO_LINT(b.ref) + last;
END_FUNCTION_BLOCK
";
    let mut machine = Machine::new(text, "FB");
    machine.cycle();
    assert_eq!((machine.get("a.ref"), machine.get("b.ref"), machine.get("last")), (4, 8, 3));
    assert_eq!(machine.get("d"), 2);
}
