//! What is not modelled is said, with its place, and nothing panics.

use rungbook::machine::elaborate::Options;

use super::with;

fn refused(text: &str, unit: &str) -> Vec<(String, String)> {
    let (project, program) = with(text, unit, &Options::default());
    let errors = program.expect_err("something is not modelled");
    let at = |place| {
        let at = project.files.line_column(place);
        format!("{}:{}", at.line, at.column)
    };
    errors.into_iter().map(|error| (error.place.map(at).unwrap_or_default(), error.construct.to_owned())).collect()
}

fn one(place: &str, construct: &str) -> Vec<(String, String)> {
    vec![(place.to_owned(), construct.to_owned())]
}

#[test]
fn everything_is_told_with_its_place() {
    let text = "FUNCTION_BLOCK FB
VAR x : INT; END_VAR
x := Missing(1);
JMP here;
x := NoSuch;
here:
END_FUNCTION_BLOCK
";
    let expected = [("3:6", "a function without source"), ("4:1", "a jump"), ("5:6", "a name without source")];
    assert_eq!(refused(text, "FB"), expected.map(|(a, b)| (a.to_owned(), b.to_owned())));
}

#[test]
fn types_that_need_themselves() {
    let block = "FUNCTION_BLOCK FB\nVAR inner : FB; END_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(refused(block, "FB"), one("1:16", "a type that contains itself"));
    let constant = "FUNCTION_BLOCK FB\nVAR CONSTANT A : INT := B; B : INT := A; END_VAR\nVAR x : INT := A; END_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(refused(constant, "FB")[0].1, "a constant that needs itself");
    let alias = "TYPE A : B; B : A; END_TYPE\nFUNCTION_BLOCK FB\nVAR x : A; END_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(refused(alias, "FB")[0].1, "a type that is not modelled");
    let base = "FUNCTION_BLOCK A EXTENDS B\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK B EXTENDS A\nEND_FUNCTION_BLOCK\n";
    assert_eq!(refused(base, "A")[0].1, "a type that contains itself");
}

#[test]
fn recursion() {
    let direct = "FUNCTION F : INT\nVAR_INPUT n : INT; END_VAR\nF := F(n - 1);\nEND_FUNCTION\n";
    assert_eq!(refused(direct, "F"), one("3:6", "a recursive call"));
    let mutual = "FUNCTION F : INT\nF := G();\nEND_FUNCTION\nFUNCTION G : INT\nG := F();\nEND_FUNCTION\n";
    assert_eq!(refused(mutual, "F"), one("1:10", "a recursive call"));
}

#[test]
fn memory_has_a_limit() {
    let text = "FUNCTION_BLOCK FB\nVAR a : ARRAY[1..100000, 1..100000] OF INT; END_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(refused(text, "FB")[0].1, "more memory than the limit");
}

#[test]
fn what_reinterprets_memory() {
    let text = "FUNCTION F : INT\nVAR r : REAL; p : POINTER TO BYTE; END_VAR\np := ADR(r);\nEND_FUNCTION\n";
    assert_eq!(refused(text, "F"), one("3:6", "a reference that reinterprets memory"));
    let union =
        "TYPE U : UNION a : INT; b : DINT; END_UNION; END_TYPE\nFUNCTION F : INT\nVAR u : U; END_VAR\nEND_FUNCTION\n";
    assert_eq!(refused(union, "F")[0].1, "a union that reinterprets memory");
}

#[test]
fn charts_lists_and_broken_text() {
    let list = "FUNCTION F : INT\nLD 1\nST F\nEND_FUNCTION\n";
    assert_eq!(refused(list, "F")[0].1, "a body in Instruction List");
    let broken = "FUNCTION F : INT\nF := ;\nEND_FUNCTION\n";
    assert!(!refused(broken, "F").is_empty());
    let constant =
        "FUNCTION F : INT\nVAR CONSTANT c : ARRAY[0..1] OF INT := [1, 2]; END_VAR\nc[0] := 1;\nEND_FUNCTION\n";
    assert_eq!(refused(constant, "F"), one("3:1", "an assignment to a constant"));
}

#[test]
fn addresses_on_the_same_bits() {
    let block = |first: &str, second: &str| {
        format!(
            "PROGRAM P\nVAR a AT {first}; b AT {second}; out : BOOL; END_VAR\nout := a = b;\nEND_PROGRAM\n",
            first = first,
            second = second
        )
    };
    let overlap = "addresses that overlap";
    assert_eq!(refused(&block("%IB0 : BOOL", "%IX0.3 : BOOL"), "P"), one("3:12", overlap));
    assert_eq!(refused(&block("%QW0 : WORD", "%QD0 : DWORD"), "P")[0].1, overlap);
    assert_eq!(refused(&block("%MW0 : ARRAY[0..3] OF WORD", "%MW3 : ARRAY[0..3] OF WORD"), "P")[0].1, overlap);
    for (first, second) in
        [("%IW0 : WORD", "%IW1 : WORD"), ("%IX0.0 : BOOL", "%IX0.1 : BOOL"), ("%IW0 : WORD", "%QW0 : WORD")]
    {
        assert!(with(&block(first, second), "P", &Options::default()).1.is_ok(), "{first} {second}");
    }
}
