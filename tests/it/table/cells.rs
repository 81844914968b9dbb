//! The language of cells: what each form means, and where a wrong one is wrong.

use rungbook::table::Piece;
use rungbook::table::cell::ast::{ChunkKind, Constraint};
use rungbook::table::cell::print::{Style, constraint};
use rungbook::table::cell::{CellError, Context, parse};
use rungbook::text::FileId;

fn read(text: &str) -> Result<Constraint, CellError> {
    parse(&Piece::verbatim(FileId(0), text, 0), &Context { arguments: 1, ..Context::default() })
}

/// The cell in words: how each of its parts is meant, and the text with every parenthesis that matters.
fn meaning(text: &str) -> String {
    let cell = read(text).unwrap_or_else(|error| panic!("{text}: {}", error.message));
    let kinds: Vec<&str> = cell.chunks.iter().map(|chunk| kind(&chunk.kind)).collect();
    format!("{}: {}", kinds.join(", "), constraint(&cell, Style::Ascii))
}

fn kind(kind: &ChunkKind) -> &'static str {
    match kind {
        ChunkKind::Any => "any",
        ChunkKind::Value(_) => "value",
        ChunkKind::Compare(..) => "compare",
        ChunkKind::Interval(_) => "interval",
        ChunkKind::Condition(_) => "condition",
        ChunkKind::Trigger(_) => "trigger",
        ChunkKind::Guarded(_) => "guarded",
        ChunkKind::Predicate(_) => "predicate",
    }
}

#[test]
fn a_comparison_is_a_condition_and_a_bare_boolean_a_value() {
    assert_eq!(meaning("O1 > 3"), "condition: O1 > 3");
    assert_eq!(meaning("= I2 > 3"), "compare: = I2 > 3");
    assert_eq!(meaning("I2 > I3 AND I3 >= 5"), "condition: I2 > I3 AND I3 >= 5");
    assert_eq!(meaning("(a > 1 OR b = 2) AND c <> 3"), "condition: (a > 1 OR b = 2) AND c <> 3");
    assert_eq!(meaning("NOT a"), "value: NOT a");
    assert_eq!(meaning("x AND y"), "value: x AND y");
    assert_eq!(meaning("x AND y > 1"), "value: x AND y > 1");
    assert_eq!(meaning("2*p"), "value: 2 * p");
    assert_eq!(meaning(">= 1 AND <= 5"), "condition: >= 1 AND <= 5");
    assert_eq!(meaning("2*Z>Y"), "condition: 2 * Z > Y");
}

#[test]
fn each_form_of_the_reference_reads() {
    for (text, wanted) in [
        ("-", "any: -"),
        ("–", "any: -"),
        ("—", "any: -"),
        ("GREEN", "value: GREEN"),
        ("Colour#GREEN", "value: Colour#GREEN"),
        ("E.X", "value: E.X"),
        ("INT#3", "value: INT#3"),
        ("T#500ms", "value: T#500ms"),
        ("16#FF", "value: 16#FF"),
        ("≠ 7", "compare: <> 7"),
        ("!= 7", "compare: <> 7"),
        ("≥5", "compare: >= 5"),
        ("[7,∞]", "interval: [7, -]"),
        ("[-, 3)", "interval: [-, 3)"),
        ("(0,10]", "interval: (0, 10]"),
        ("(0+1)*2", "value: (0 + 1) * 2"),
        ("x2, <> x1", "value, compare: x2, <> x1"),
        ("√TRUE", "trigger: ^TRUE"),
        ("^>= 3", "trigger: ^>= 3"),
        ("vT", "trigger: ^T"),
        (">= A_Pos[-1]", "compare: >= A_Pos[-1]"),
        ("arr[3].x[-2]", "value: arr[3].x[-2]"),
        ("if :: a > 1 -> 5 :: TRUE -> >= 6 fi", "guarded: if :: a > 1 -> 5 :: TRUE -> >= 6 fi"),
        ("SEL(G := B1, IN0 := 1, IN1 := 0)", "value: SEL(G := B1, IN0 := 1, IN1 := 0)"),
        ("¬(R1∨R2)", "value: NOT (R1 OR R2)"),
        ("-(-x)", "value: -(-x)"),
        ("a → b → c", "value: a -> b -> c"),
    ] {
        assert_eq!(meaning(text), wanted, "{text}");
    }
}

#[test]
fn operators_bind_as_the_standard_says() {
    assert_eq!(meaning("(a*b)/c"), "value: a * b / c");
    assert_eq!(meaning("a*(b/c)"), "value: a * (b / c)");
    assert_eq!(meaning("(a - b) - c"), "value: a - b - c");
    assert_eq!(meaning("a - (b - c)"), "value: a - (b - c)");
    assert_eq!(meaning("(NOT a) = b"), "condition: NOT a = b");
    assert_eq!(meaning("(a AND b) XOR c OR d"), "value: a AND b XOR c OR d");
    assert_eq!(meaning("(a OR b) XOR c"), "value: (a OR b) XOR c");
}

#[test]
fn what_was_printed_reads_again_as_the_same() {
    for text in
        ["-(-x) ** 2", "if :: a -> b fi", "= (if :: a -> 1 fi) + 2", "√[1,5], <> 3", "x = (y = z)", "(x = y) = z"]
    {
        let cell = read(text).expect("a well-formed cell");
        for style in [Style::Ascii, Style::Signs] {
            let printed = constraint(&cell, style);
            let again = read(&printed).unwrap_or_else(|error| panic!("{printed}: {}", error.message));
            assert_eq!(constraint(&again, Style::Ascii), constraint(&cell, Style::Ascii), "{printed}");
        }
    }
}

#[test]
fn a_wrong_cell_is_wrong_at_its_place() {
    for (text, at, message) in [
        ("3 4", "4", "nothing was expected here any more"),
        ("[1, 5", "[", "an interval has two ends"),
        (">= ", "", "a value is missing at the end"),
        ("a ; b", ";", "`;` has no meaning in a cell"),
        ("f(1, 2", "", "`,` or `)` is missing at the end"),
        ("X[+1]", "[+1]", "`X[+1]` asks for the future"),
        ("√√T", "√T", "a trigger of a trigger means nothing"),
        ("T#5", "T#5", "`5` is no time"),
        ("a, , b", ",", "a value was expected here"),
    ] {
        let error = read(text).expect_err(text);
        assert_eq!((error.span.of(text), error.message.as_str()), (at, message), "{text}");
    }
}

#[test]
fn deep_nesting_is_refused_and_not_a_crash() {
    for open in ["(", "-", "NOT ", "√", "f(", "if :: ", "x["] {
        assert!(read(&open.repeat(100_000)).is_err(), "{open}");
    }
}
